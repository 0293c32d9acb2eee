//! A run as a filmstrip and as a movie.

use super::Footage;
use crate::jobs::moments::{moments, without_repeats};
use sinew_picture::{Filmstrip, Movie, Sheet, Style};

/// Panels of a strip when the scene does not say when.
const PANELS: usize = 12;

/// The strip of a run: pictures of the moments that the scene states, or of those in which most happens.
pub fn sheet(footage: &Footage, title: &str, subtitle: &str) -> Sheet {
    let recording = footage.recording;
    let last = recording.frames.saturating_sub(1);
    let change_m = footage.change_m();
    let stated = &footage.scene.camera.times_secs;
    let frames = if stated.is_empty() {
        moments(&change_m, &footage.happens(), PANELS)
    } else {
        let frame = |secs: &f64| ((secs * recording.motion_hz).round() as usize).min(last);
        without_repeats(&stated.iter().map(frame).collect::<Vec<_>>(), &change_m)
    };
    let followed = footage.followed();
    let before = std::iter::once(None).chain(frames.iter().copied().map(Some));
    let panels = frames.iter().zip(before).map(|(&frame, before)| footage.panel(frame as f64, before, &followed));
    let strip = Filmstrip {
        panels: panels.collect(),
        camera: footage.camera(),
        style: Style { columns: 6, body_height_m: tallest_m(footage), ..Style::default() },
        ..Filmstrip::default()
    };
    let still = if frames.len() == 1 && last > 0 { "; nothing moves after the first picture" } else { "" };
    Sheet {
        title: title.to_owned(),
        subtitle: format!("{subtitle}{still}"),
        pieces: vec![strip.into()],
        footer: format!(
            "{} characters, {} props; motion at {:.0} Hz",
            recording.characters.len(),
            recording.props.len(),
            recording.motion_hz
        ),
        ..Sheet::default()
    }
}

/// The run as moving pictures, in real time.
pub fn movie(footage: &Footage, title: &str) -> Movie {
    let recording = footage.recording;
    let per_frame = recording.motion_hz / f64::from(Movie::FRAMES_PER_SEC);
    let secs = recording.time_secs(recording.frames.saturating_sub(1));
    let followed = footage.followed();
    let captions = (CAPTION_SECS * recording.motion_hz) as usize;
    let panels = (0..Movie::frames_in(secs)).map(|index| {
        let at = index as f64 * per_frame;
        footage.panel(at, (at as usize).checked_sub(captions), &followed)
    });
    Movie { title: title.to_owned(), panels: panels.collect(), camera: footage.camera(), ..Movie::default() }
}

/// How long an event stays under the headline \[s\].
const CAPTION_SECS: f64 = 0.8;

fn tallest_m(footage: &Footage) -> f64 {
    let heights = footage.recording.characters.iter().map(|character| character.body.stature_m());
    heights.fold(0.0, f64::max).max(0.5)
}
