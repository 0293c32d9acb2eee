//! Grounding: a captured or retargeted motion put on its floor.
//!
//! Motion from video, from inertial suits and from retargeting floats, sinks, drifts and shakes. [`ground`] finds for every frame
//! the shift of the whole body, and then of each foot, with which soles rest where they stand. Joint angles above the legs stay
//! as they are, and flight stays flight: where nothing stands, the shift passes smoothly from one contact to the next.
//!
//! | step | file |
//! |---|---|
//! | when a foot stands flat | `stance.rs` |
//! | shift of the whole body, by least squares over the clip | `root.rs` |
//! | shift of each foot | `planting.rs` |
//! | what is left: sliding, height over the floor, and the force that nothing in the world gives | `quality.rs` |
//!
//! Limits: the floor is level. Feet that really slide (skates, ice) are taken for errors. What is higher than 6 cm above the
//! floor on average is taken for a step, and stays.

mod banded;
mod clip;
mod planting;
mod quality;
mod root;
mod stance;

pub use quality::Quality;

use crate::humanoid::{Body, Deviation, Pose, Sole};
use glam::DVec3;
use root::RootErrors;
use stance::{FEET, Feet, Stands};

/// How a motion is put on its floor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GroundSettings {
    /// Height of the floor on which soles are to stand \[m of the body\]. Default `None`: where they stand on average, because a file
    /// tells neither where its floor is nor how thick soles are.
    pub floor_m: Option<f64>,
}

/// What [`ground`] found, a row per frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Grounding {
    /// Shift of the whole body, world frame \[m of the body\].
    pub body_shifts: Vec<DVec3>,
    /// Shift of the left and right foot on top of that, world frame \[m of the body\].
    pub foot_shifts: Vec<[DVec3; 2]>,
    /// Height of the floor \[m of the body\].
    pub floor_m: f64,
    /// Estimated jitter of the root before, as a standard deviation per axis \[m of the body\].
    pub jitter_m: DVec3,
    /// Heights of heel and toes of a foot that stands \[m of the body\].
    standing_m: [f64; 2],
    stands: Stands,
}

impl Grounding {
    /// The change of one frame, for an [`Overlay`](crate::humanoid::Overlay); lengths are of the body.
    pub fn deviation(&self, frame: usize) -> Deviation {
        Deviation { ground_shift: self.body_shifts[frame], foot_shifts: self.foot_shifts[frame], ..Deviation::NONE }
    }

    /// Share of the time below which grounding is unsure: up to two thirds of a float may then be left.
    pub const SURE_SHARE: f64 = 0.05;

    /// Time in which feet stand flat, left and right added, at a rate of frames per second \[s\].
    pub fn stands_secs(&self, fps: f64) -> f64 {
        self.stands.iter().flatten().sum::<f64>() / fps
    }

    /// The same as a share of the motion's time, 0 to 2 \[1\].
    pub fn stands_share(&self) -> f64 {
        self.stands_secs(1.0) / self.body_shifts.len().max(1) as f64
    }

    /// How surely the left and right foot stand flat in a frame, 0 to 1.
    pub fn stands(&self, frame: usize) -> [f64; 2] {
        [0, 1].map(|foot| self.stands[foot][frame])
    }
}

/// Leniency with which standing points are looked for, round by round: while errors are large, so are speeds.
const LENIENCY: [f64; 10] = [5.0, 3.5, 2.5, 1.8, 1.4, 1.0, 0.7, 0.5, 0.4, 0.4];

/// Puts a motion on its floor. `poses` follow each other at `fps` and are not filtered.
///
/// It is the least squares solution of the shift of the whole body of which each term is written out in `root.rs`, with weights
/// that follow from the last solution (iteratively reweighted); then that of each foot (`planting.rs`). Fewer than four poses stay as they are.
///
/// ```
/// use glam::DVec3;
/// use sinew_body::grounding::{GroundSettings, ground};
/// use sinew_body::humanoid::{Body, Pose};
/// let body = Body::standard(80.0, 1.7);
/// let standing = Pose::STANDING;
/// // Somebody who stands, drifts by 2 cm/s to the left.
/// let drifts = |frame: usize| DVec3::X * (0.02 * frame as f64 / 60.0);
/// let at = |frame: usize| {
///     let mut pose = standing;
///     pose.hips_position += drifts(frame);
///     pose
/// };
/// let poses: Vec<Pose> = (0..120).map(at).collect();
/// let grounding = ground(&body, &poses, 60.0, &GroundSettings::default());
/// let left = grounding.body_shifts[119] + drifts(119);
/// assert!(left.length() < 0.005, "{left}");
/// ```
pub fn ground(body: &Body, poses: &[Pose], fps: f64, settings: &GroundSettings) -> Grounding {
    let feet = Feet::of(body, poses, fps);
    let errors = RootErrors::of(poses.iter().map(|pose| pose.hips_position).collect(), fps);
    let frames = poses.len();
    let toes_m = FEET.map(|foot| Sole::of(body, foot).ankle_m + body.link(foot).tip.y);
    let on_floor_m = |floor_m: f64| [floor_m, floor_m + 0.5 * (toes_m[0] + toes_m[1])];
    let mut standing_m = on_floor_m(settings.floor_m.unwrap_or(0.0));
    let mut stands: Stands = [(); 2].map(|()| vec![0.0; frames]);
    let mut shifts = vec![DVec3::ZERO; frames];
    if frames >= 4 {
        // Jitter first: without any contact.
        shifts = errors.shifts(&feet, &stands, &stands, 0.0, &shifts);
        for leniency in LENIENCY {
            let moved = feet.clone().shifted(|_, frame| shifts[frame]);
            stands = moved.stands(leniency);
            if settings.floor_m.is_none() {
                standing_m = own_standing_m(&moved, &stands).unwrap_or(standing_m);
            }
            let rolls = moved.rolls(leniency, &stands);
            shifts = errors.shifts(&feet, &stands, &rolls, 0.5 * (standing_m[0] + standing_m[1]), &shifts);
        }
    }
    let moved = feet.shifted(|_, frame| shifts[frame]);
    let [left, right] = [0, 1].map(|foot| planting::planted(&moved, &stands[foot], foot, standing_m));
    Grounding {
        body_shifts: shifts,
        foot_shifts: left.into_iter().zip(right).map(|(left, right)| [left, right]).collect(),
        floor_m: standing_m[0] - on_floor_m(0.0)[0],
        jitter_m: errors.noise_m(),
        standing_m,
        stands,
    }
}

/// Heights at which heel and toes stand: means over all standing feet, without the lowest and the highest tenth. `None` where none stands.
fn own_standing_m(feet: &Feet, stands: &Stands) -> Option<[f64; 2]> {
    let mean = |point: usize| {
        let mut heights: Vec<(f64, f64)> = (0..2)
            .flat_map(|foot| feet.points[foot][point].iter().map(|at| at.y).zip(stands[foot].iter().copied()))
            .collect();
        heights.sort_by(|a, b| a.0.total_cmp(&b.0));
        let total = heights.iter().map(|(_, stands)| stands).sum::<f64>();
        let (mut passed, mut sum, mut kept) = (0.0, 0.0, 0.0);
        for (height, stands) in heights {
            passed += stands;
            if (0.1 * total..=0.9 * total).contains(&passed) {
                sum += height * stands;
                kept += stands;
            }
        }
        (kept > 0.0).then(|| sum / kept)
    };
    Some([mean(0)?, mean(1)?])
}
