//! Guesses the unit and axes of a file that does not state them.

use crate::stature::{stature, up_axis};
use crate::{Clip, Humanoid, Note, SourceSpace};
use glam::{DQuat, DVec3};
use std::f64::consts::FRAC_PI_2;
use std::f64::consts::PI;

/// A unit that motion files are written in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnitCandidate {
    /// Its name.
    pub name: &'static str,
    /// Its length \[m\].
    pub unit_m: f64,
    /// Stature that it gives the body \[m\].
    pub stature_m: f64,
    /// Penalty for an unlikely stature and a rare unit (0 is best; above 8 the unit is excluded).
    pub doubt: f64,
}

/// Unit and axes of a clip, with the reasons.
#[derive(Clone, Debug, PartialEq)]
pub struct SpaceGuess {
    /// What to read the clip with.
    pub space: SourceSpace,
    /// Stature that this gives \[m\], see [`stature`].
    pub stature_m: f64,
    /// Whether the file stated its unit.
    pub unit_is_stated: bool,
    /// Whether the file stated its axes.
    pub up_is_stated: bool,
    /// Other units that would give a person, least doubtful first.
    pub alternatives: Vec<UnitCandidate>,
    /// What was guessed, as text.
    pub notes: Vec<Note>,
}

/// Units seen in files, with the penalty for their rarity.
const UNITS: [(&str, f64, f64); 7] = [
    ("metres", 1.0, 0.0),
    ("centimetres", 0.01, 0.0),
    ("inches", 0.0254, 0.3),
    ("CMU's units (inch / 0.45)", 0.0254 / 0.45, 0.3),
    ("millimetres", 0.001, 0.0),
    ("decimetres", 0.1, 1.0),
    ("feet", 0.3048, 1.0),
];

/// Above this penalty a unit does not give a human stature.
const OUT_OF_THE_QUESTION: f64 = 8.0;

/// Finds the unit and the up axis of a clip in its file's own numbers. What the file states (`unit_m`,
/// `world_from_source`) is taken as it is.
///
/// Up is the axis along which head and feet are apart on the mean of the clip. The unit is the one of a table (metres,
/// centimetres, millimetres, decimetres, inches, feet, and CMU's) that gives the likeliest stature: most likely 1.7 m, less and less so towards a
/// child's 1 m and a giant's 2.2 m, too tall being less likely than too short. Where no unit gives a person, the one that comes nearest is
/// taken, and a note says so.
///
/// ```no_run
/// # fn clip() -> sinew_motion::Clip { unimplemented!() }
/// let in_file_units: sinew_motion::Clip = clip();
/// let humanoid = sinew_motion::Humanoid::of(&in_file_units, &[])?;
/// let guess = sinew_motion::guess_space(&in_file_units, &humanoid, None, None);
/// let in_metres = guess.space.clip_to_world(&in_file_units);
/// # Ok::<(), sinew_motion::Error>(())
/// ```
pub fn guess_space(
    clip: &Clip,
    humanoid: &Humanoid,
    unit_m: Option<f64>,
    world_from_source: Option<DQuat>,
) -> SpaceGuess {
    let mut notes = Vec::new();
    let raw = stature(clip, humanoid);
    let mut candidates: Vec<UnitCandidate> = UNITS
        .iter()
        .map(|&(name, unit_m, rarity)| {
            let stature_m = raw * unit_m;
            UnitCandidate { name, unit_m, stature_m, doubt: rarity + doubt(stature_m) }
        })
        .collect();
    candidates.sort_by(|a, b| a.doubt.total_cmp(&b.doubt));
    let best = candidates[0];
    let chosen_m = unit_m.unwrap_or(best.unit_m);
    let stature_m = raw * chosen_m;
    let alternatives: Vec<UnitCandidate> = candidates
        .into_iter()
        .filter(|candidate| {
            candidate.doubt < OUT_OF_THE_QUESTION && (candidate.unit_m - chosen_m).abs() > 1e-9 * chosen_m
        })
        .collect();
    if unit_m.is_none() {
        let others: Vec<String> =
            alternatives.iter().map(|other| format!("{} would give {:.2} m", other.name, other.stature_m)).collect();
        let others = if others.is_empty() { String::new() } else { format!("; {}", others.join(", ")) };
        notes.push(Note::new(format!(
            "the file does not state its unit: taken as {} ({} m), which gives a stature of {stature_m:.2} m{others}",
            best.name,
            round(best.unit_m)
        )));
    }
    if doubt(stature_m) > OUT_OF_THE_QUESTION {
        let best = alternatives.first().map(|other| {
            let unit_m = round(other.unit_m);
            format!("; with a unit of {unit_m} m (--units {unit_m}) it is {:.2} m", other.stature_m)
        });
        notes.push(Note::new(format!(
            "a stature of {stature_m:.3} m is not human: check the unit{}",
            best.unwrap_or_default()
        )));
    }
    let up = up_axis(clip, humanoid);
    let space = world_from_source.unwrap_or_else(|| {
        if up != DVec3::Y {
            notes.push(Note::new(format!("the body stands along {}: turned to Y up", axis_name(up))));
        }
        y_up_from(up)
    });
    SpaceGuess {
        space: SourceSpace { unit_m: chosen_m, world_from_source: space },
        stature_m,
        unit_is_stated: unit_m.is_some(),
        up_is_stated: world_from_source.is_some(),
        alternatives,
        notes,
    }
}

/// Penalty for a stature: the squared number of standard deviations on a logarithmic scale. People taller than 1.7 m
/// thin out faster (2.3 m is as rare as it gets) than shorter ones, who include children and bodies without a neck.
fn doubt(stature_m: f64) -> f64 {
    let ratio = libm::log((stature_m / 1.7).max(1e-9));
    let deviation = if ratio > 0.0 { 0.12 } else { 0.25 };
    (ratio / deviation) * (ratio / deviation)
}

/// The shortest rotation that brings an axis to Y; a half turn is about X.
fn y_up_from(up: DVec3) -> DQuat {
    let turn = |axis, angle: f64| DQuat::from_axis_angle(axis, angle);
    if up == DVec3::Z {
        turn(DVec3::X, -FRAC_PI_2)
    } else if up == -DVec3::Z {
        turn(DVec3::X, FRAC_PI_2)
    } else if up == DVec3::X {
        turn(DVec3::Z, FRAC_PI_2)
    } else if up == -DVec3::X {
        turn(DVec3::Z, -FRAC_PI_2)
    } else if up == -DVec3::Y {
        turn(DVec3::X, PI)
    } else {
        DQuat::IDENTITY
    }
}

fn axis_name(axis: DVec3) -> String {
    let (name, sign) = [("X", axis.x), ("Y", axis.y), ("Z", axis.z)]
        .into_iter()
        .find(|(_, component)| *component != 0.0)
        .unwrap_or(("Y", 1.0));
    format!("{}{name}", if sign < 0.0 { "-" } else { "" })
}

fn round(unit_m: f64) -> f64 {
    (unit_m * 1e7).round() / 1e7
}
