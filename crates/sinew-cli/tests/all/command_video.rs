//! `--video` and `--picture` of every command that has them.

use crate::command::sinew;
use std::path::Path;

const WALK: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../samples/walk.bvh");
const SCENE: &str = "format = 1\n[stage]\nduration_secs = 1\n[characters.one]\npose = \"stand\"\n";

/// Frames of a GIF: every one has a graphic control extension (GIF89a, 23), here with a delay of 4 hundredths of a second.
fn frames_of_gif(path: &Path) -> usize {
    let bytes = std::fs::read(path).unwrap();
    assert!(bytes.starts_with(b"GIF89a"));
    let control = |window: &[u8]| window[..3] == [0x21, 0xf9, 4] && window[4..6] == [4, 0] && window[7] == 0;
    bytes.windows(8).filter(|window| control(window)).count()
}

#[test]
fn a_video_has_25_frames_for_every_second_of_the_motion() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("s.toml"), SCENE).unwrap();
    let run = ["run", "s.toml", "--no-live", "--video", "run.gif", "--take", "s.take"];
    sinew(at, run).done();
    assert_eq!(frames_of_gif(&at.join("run.gif")), 25);
    sinew(at, ["replay", "s.take", "--video", "again.gif"]).done();
    assert!(std::fs::read(at.join("run.gif")).unwrap() == std::fs::read(at.join("again.gif")).unwrap());
    sinew(at, ["respond", WALK, "--video", "clip.gif"]).done();
    // 529 frames at 60 a second.
    assert_eq!(frames_of_gif(&at.join("clip.gif")), 220);
    let reach = sinew(at, ["reach", "--target", "-0.2:1.3:0.4", "--video", "r.apng", "-o", "r.csv"]).done();
    assert!(reach.out.contains("r.apng"), "{}", reach.out);
    let rows = std::fs::read_to_string(at.join("r.csv")).unwrap().lines().count() - 1;
    let bytes = std::fs::read(at.join("r.apng")).unwrap();
    // The animation control chunk holds the number of frames (PNG, third edition, 11.3.5.1).
    let place = bytes.windows(4).position(|window| window == b"acTL").unwrap() + 4;
    let frames = u32::from_be_bytes(bytes[place..place + 4].try_into().unwrap()) as f64;
    assert!((frames - (rows - 1) as f64 / 60.0 * 25.0).abs() <= 0.5, "{frames} {rows}");
}

#[test]
fn the_readmes_film_is_what_its_command_makes() {
    let folder = tempfile::tempdir().unwrap();
    let made = folder.path().join("pushed.gif");
    sinew(folder.path(), ["respond", "--video", "pushed.gif"]).done();
    let shipped = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/pushed.gif"));
    let size = std::fs::metadata(shipped).unwrap().len();
    assert!(size < 1_000_000, "{size}");
    assert_eq!(frames_of_gif(shipped), frames_of_gif(&made));
}

#[test]
fn formats_that_are_not_drawn_are_refused_before_any_work_is_done() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("s.toml"), SCENE).unwrap();
    for name in ["p.jpg", "p", "p.gif"] {
        sinew(at, ["run", "s.toml", "--no-live", "--picture", name]).failed(&[name, "drawn as .png"]);
        sinew(at, ["respond", WALK, "--picture", name]).failed(&[name, "drawn as .png"]);
    }
    for name in ["v.avi", "v.webp", "v"] {
        sinew(at, ["run", "s.toml", "--no-live", "--video", name]).failed(&[name, ".gif, .apng or, with ffmpeg, .mp4"]);
    }
    sinew(at, ["reach", "--target", "-0.2:1.3:0.4", "--variations", "3", "--video", "v.gif"]).failed(&["one reach"]);
    assert_eq!(std::fs::read_dir(at).unwrap().count(), 1, "nothing but the scene");
}

#[test]
fn a_video_never_overwrites_an_input_or_another_result() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("s.gif"), SCENE).unwrap();
    sinew(at, ["run", "s.gif", "--no-live", "--video", "s.gif"]).failed(&["overwrite an input"]);
    sinew(at, ["respond", "--video", "v.gif", "-o", "v.bvh", "--report", "v.gif"]).failed(&["two results"]);
}
