//! What pictures and films of a run and of a response show.

use glam::DVec3;
use sinew::jobs::respond::{self, RespondJob, respond as answer};
use sinew::jobs::run::{Footage, Ran, RunJob, movie, run, sheet};
use sinew::motion::Part;
use sinew::motion::formats::{MotionFile, ReadOptions};
use sinew::picture::{Filmstrip, Movie, Piece, Sheet};
use sinew::response::{Push, PushFrame};
use sinew::stage::{Scene, sample_walk_bvh};

/// The strip of a scene, and the whole sheet.
fn drawn(text: &str) -> (Filmstrip, Sheet, Ran, Scene) {
    let scene = Scene::from_text(text).unwrap();
    let ran = run(scene.clone(), &RunJob::default(), &mut []).unwrap();
    let footage = Footage { recording: &ran.recording, scene: &scene, marks: &ran.marks };
    let sheet = sheet(&footage, "a scene", "some seconds");
    let Piece::Filmstrip(strip) = sheet.pieces[0].clone() else { panic!("the strip comes first") };
    (strip, sheet, ran, scene)
}

/// No two pictures show the same.
fn all_differ(strip: &Filmstrip) -> bool {
    strip.panels.windows(2).all(|pair| pair[0].time_secs < pair[1].time_secs && pair[0].figure != pair[1].figure)
}

#[test]
fn a_push_in_a_scene_is_seen_from_the_side_with_its_arrow() {
    for (force, along) in
        [("[0, 0, 200]", DVec3::Z), ("[200, 0, 0]", DVec3::X), ("[-140, 0, 140]", DVec3::new(-1.0, 0.0, 1.0))]
    {
        let text = format!(
            "format = 1\n[stage]\nduration_secs = 2\n[characters.one]\nreflexes = [\"balance\"]\n[[at]]\ntime_secs = 0.5\n\
             character = \"one\"\ndo = \"push\"\non = \"chest\"\nforce_n = {force}\nfor_secs = 0.1\n"
        );
        let (strip, _, ran, scene) = drawn(&text);
        let across = strip.camera.view().right.dot(along.normalize()).abs();
        assert!(across > 0.999, "{force}: {across}");
        let pushed: Vec<_> = strip.panels.iter().filter(|panel| !panel.arrows.is_empty()).collect();
        assert!(!pushed.is_empty() && pushed.iter().all(|panel| (0.49..0.65).contains(&panel.time_secs)), "{force}");
        assert!((pushed[0].arrows[0].force_n.length() - 200.0).abs() < 3.0);
        assert!(pushed.iter().any(|panel| panel.caption.contains("pushed with")), "{}", pushed[0].caption);
        assert!(all_differ(&strip));
        let footage = Footage { recording: &ran.recording, scene: &scene, marks: &ran.marks };
        let film = movie(&footage, "a scene");
        assert_eq!(film.panels.len(), 50);
        // A tenth of a second, and the frame in which it begins.
        let shown = film.panels.iter().filter(|panel| !panel.arrows.is_empty()).count();
        assert!((2..=4).contains(&shown), "{shown}");
    }
}

#[test]
fn a_hit_is_marked_once_where_the_ball_meets_the_body_and_told_in_words() {
    let (strip, ..) = drawn(
        "format = 1\n[stage]\nduration_secs = 1\n[characters.one]\nreflexes = [\"balance\"]\n[props.ball]\nball_radius_m = 0.1\n\
         mass_kg = 3\nposition_m = [0, 1.3, 1.5]\nvelocity_m_s = [0, 0.5, -6]\n",
    );
    let hit: Vec<_> = strip.panels.iter().filter(|panel| !panel.hits.is_empty()).collect();
    let first = hit.first().expect("the hit is shown");
    assert!((0.1..0.5).contains(&first.time_secs), "{}", first.time_secs);
    let at = first.hits[0].at;
    assert!(at.z.abs() < 0.3 && (0.8..1.6).contains(&at.y), "{at}");
    assert!(first.caption.contains("ball hits one's") || first.caption.contains("one's"), "{}", first.caption);
    assert!(first.caption.contains("N s"), "{}", first.caption);
}

#[test]
fn where_nothing_moves_there_is_one_picture() {
    let (strip, sheet, ..) =
        drawn("format = 1\n[stage]\nduration_secs = 1\n[characters.one]\npose = \"stand\"\ntracker = \"kinematic\"\n");
    assert_eq!(strip.panels.len(), 1);
    assert!(sheet.subtitle.contains("nothing moves"), "{}", sheet.subtitle);
}

#[test]
fn a_box_is_drawn_as_a_box() {
    let (strip, ..) = drawn(
        "format = 1\n[characters.one]\n[props.crate]\nbox_m = [1, 0.5, 2]\nfixed = true\nposition_m = [2, 0.25, 0]\n",
    );
    let boxes = &strip.panels[0].objects.boxes;
    assert_eq!(boxes.len(), 1);
    assert_eq!(boxes[0].size_m, DVec3::new(1.0, 0.5, 2.0));
}

#[test]
fn a_response_is_seen_across_its_push_at_the_moments_when_most_changes() {
    let file = MotionFile::from_bvh(&sample_walk_bvh().unwrap(), &ReadOptions::default()).unwrap();
    for (force_n, across) in [(DVec3::new(0.0, 0.0, -120.0), DVec3::Z), (DVec3::new(150.0, 0.0, 0.0), DVec3::X)] {
        let push =
            Push { part: Part::Chest, point: None, force_n, frame: PushFrame::Facing, at_secs: 2.0, for_secs: 0.1 };
        let job = RespondJob { pushes: vec![push], ..RespondJob::default() };
        let done = answer(&file, &job, None).unwrap();
        let sheet = respond::sheet(&done, file.body_parts().unwrap(), &job, "walk");
        let Piece::Filmstrip(strip) = &sheet.pieces[0] else { panic!("the strip comes first") };
        // The sample walks along z, and sways by some degrees as it does.
        assert!(strip.camera.view().right.dot(across).abs() > 0.99, "{force_n}");
        let pushed = strip.panels.iter().filter(|panel| !panel.arrows.is_empty()).count();
        assert!(pushed >= 1 && all_differ(strip), "{pushed}");
        // At least half of the pictures show a body that is visibly off its input.
        let off = strip.panels.iter().filter(|panel| panel.ghost.is_some()).count();
        assert!(off * 2 >= strip.panels.len(), "{off} of {}", strip.panels.len());
        let film = respond::movie(&done, file.body_parts().unwrap(), &job, "walk");
        let secs = done.report.recovered_after_s.unwrap() + 0.1 + 2.0;
        assert!(film.panels.len().abs_diff(Movie::frames_in(secs)) <= 1, "{}", film.panels.len());
        assert_eq!(film.panels[0].time_secs, 1.0);
    }
}
