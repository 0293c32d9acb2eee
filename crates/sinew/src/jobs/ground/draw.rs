//! The picture of a grounding.

use super::job::Grounded;
use crate::figure::figure;
use crate::jobs::moments::moments;
use sinew_body::humanoid::Node;
use sinew_motion::{Clip, Humanoid, facing, resample};
use sinew_picture::{Camera, Filmstrip, Movie, MovieStyle, Panel, Plot, Series, Sheet, Style};

/// Panels of the filmstrip.
const PANELS: usize = 12;

/// A body this near to its ghost hides it \[m\].
const SAME_M: f64 = 0.005;

/// A filmstrip of the clip on its floor with the clip before as a ghost, and what was shifted, over time.
pub fn sheet(grounded: &Grounded, before: &Clip, humanoid: &Humanoid, title: &str) -> Sheet {
    let report = &grounded.report;
    let view = View { grounded, ours: &grounded.clip, before };
    let frames: Vec<usize> = (grounded.first_frame..grounded.clip.frames()).collect();
    let chosen = moments(&view.change_m(&frames), &[], PANELS);
    let strip = Filmstrip {
        panels: chosen.into_iter().map(|index| view.panel(frames[index])).collect(),
        camera: view.camera(humanoid),
        style: Style {
            floor_m: report.floor_m,
            columns: 6,
            body_height_m: grounded.reduction.body().stature_m() / grounded.reduction.scale(),
            ..Style::default()
        },
        ..Filmstrip::default()
    };
    Sheet {
        title: title.to_owned(),
        subtitle: format!(
            "on its floor: drift {:.1} cm, lifted by {:.1} to {:.1} cm, jitter {:.1} mm; standing feet slid at {:.1} cm/s, now {:.1}",
            report.drift_m * 1e2,
            report.lifted_m[0] * 1e2,
            report.lifted_m[1] * 1e2,
            report.jitter_m * 1e3,
            report.before.slide_mean_m_s * 1e2,
            report.after.slide_mean_m_s * 1e2
        ),
        pieces: vec![strip.into(), plot(grounded).into()],
        footer: "pale body: the clip before".to_owned(),
        ..Sheet::default()
    }
}

/// The clip on its floor as moving pictures in real time, with the clip before as a ghost.
pub fn movie(grounded: &Grounded, before: &Clip, humanoid: &Humanoid, title: &str) -> Movie {
    let rate = f64::from(Movie::FRAMES_PER_SEC);
    let (ours, input) = (resample(&grounded.clip, rate), resample(before, rate));
    let view = View { grounded, ours: &ours, before: &input };
    let last = Movie::frames_in(grounded.clip.duration_secs()).min(ours.frames());
    Movie {
        title: title.to_owned(),
        panels: (0..last).map(|frame| view.panel(frame)).collect(),
        camera: view.camera(humanoid),
        style: MovieStyle { floor_m: grounded.report.floor_m, ..MovieStyle::default() },
    }
}

/// The two clips, at one rate.
struct View<'a> {
    grounded: &'a Grounded,
    ours: &'a Clip,
    before: &'a Clip,
}

impl View<'_> {
    /// How far the body has gone in each frame since the one before \[m\].
    fn change_m(&self, frames: &[usize]) -> Vec<f64> {
        let hips = self.hips();
        let at = |frame: usize| self.ours.world(frame)[hips].translation;
        let change = |&frame: &usize| at(frame).distance(at(frame.saturating_sub(1)));
        frames.iter().map(change).collect()
    }

    fn hips(&self) -> usize {
        self.grounded.reduction.joint(Node::Hips).unwrap_or(0)
    }

    fn panel(&self, frame: usize) -> Panel {
        let shapes = self.grounded.reduction.shapes();
        let (ours, before) = (self.ours.world(frame), self.before.world(frame));
        let apart = |joint: &usize| ours[*joint].translation.distance(before[*joint].translation) > SAME_M;
        let differs = shapes.iter().any(|(_, joint, _)| apart(joint));
        Panel {
            time_secs: frame as f64 * self.ours.frame_time_secs(),
            figure: figure(&shapes, &ours),
            ghost: differs.then(|| figure(&shapes, &before)),
            follow: Some(ours[self.hips()].translation),
            ..Panel::default()
        }
    }

    /// From the side, a little above the floor: sliding and floating feet show best there.
    fn camera(&self, humanoid: &Humanoid) -> Camera {
        let world = self.ours.world(self.grounded.first_frame.min(self.ours.frames().saturating_sub(1)));
        Camera::three_quarter().about_heading(facing(&world, humanoid).unwrap_or(glam::DVec3::Z))
    }
}

fn plot(grounded: &Grounded) -> Plot {
    let scale = 1e2 / grounded.reduction.scale();
    let step_secs = grounded.clip.frame_time_secs();
    let of_axis = |axis: usize, name: &str| {
        let row =
            |(at, shift): (usize, &glam::DVec3)| ((grounded.first_frame + at) as f64 * step_secs, shift[axis] * scale);
        Series::new(name, grounded.grounding.body_shifts.iter().enumerate().map(row).collect())
    };
    Plot {
        title: "Shift of the whole body".to_owned(),
        x_label: "time (s)".to_owned(),
        y_label: "shift (cm)".to_owned(),
        unit: " cm".to_owned(),
        series: vec![of_axis(0, "x"), of_axis(1, "up"), of_axis(2, "z")],
        ..Plot::default()
    }
}
