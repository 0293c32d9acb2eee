//! Plans the strides from one stance to another.

use crate::Values;
use crate::feet::{Feet, Placement, Stride};
use crate::legs::StepKind;
use crate::spine::wrapped;
use glam::{DQuat, DVec3};

/// A stance: position and heading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stance {
    /// Middle of the ankles \[m\].
    pub middle: DVec3,
    /// Heading \[rad\].
    pub yaw_rad: f64,
    /// Distance of the ankles \[m\].
    pub breadth_m: f64,
}

/// A step for the report.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Step {
    /// Which foot goes first: 0 left, 1 right.
    pub side: usize,
    /// Half or full.
    pub kind: StepKind,
    /// Length of its stride \[m\].
    pub length_m: f64,
    /// Lift-off time \[s\].
    pub start_secs: f64,
}

sinew_snapshot::snapshot!(Step { side, kind, length_m, start_secs });

/// Maximum turn of a foot against the other \[rad\]: three strides turn by half a circle.
const MAX_TURN_RAD: f64 = 1.6;

/// Rise of the heel of a foot that is a usual step behind \[rad\].
const HEEL_OFF_RAD: f64 = 0.36;

/// Turn of a foot in each of the first strides of a walk \[rad\].
const TURNS_RAD: f64 = 1.1;

/// Distance of the ankles in standing [1 of the leg].
const USUAL_BREADTH: f64 = 0.217;

/// Turn that a single step makes without going anywhere \[rad\].
const TURNS_WITH_STEP_RAD: f64 = 1.9;

/// Length of a step of a walk \[1 of the longest step\].
const WALKS: f64 = 0.84;

impl Stance {
    /// The stance of two feet.
    pub fn of(feet: &[Placement; 2], values: &Values) -> Stance {
        let yaw_rad = feet[0].yaw_rad + 0.5 * wrapped(feet[1].yaw_rad - feet[0].yaw_rad);
        let middle = (feet[0].ankle + feet[1].ankle) * 0.5;
        let breadth = (feet[0].ankle - feet[1].ankle).dot(DQuat::from_rotation_y(yaw_rad) * DVec3::X);
        let usual = USUAL_BREADTH * values.leg_m;
        Stance { middle, yaw_rad, breadth_m: breadth.clamp(0.8 * usual, 1.4 * usual) }
    }

    /// The placement of a foot in it.
    pub fn foot(&self, side: usize) -> Placement {
        let x = if side == 0 { 0.5 } else { -0.5 } * self.breadth_m;
        Placement {
            ankle: self.middle + DQuat::from_rotation_y(self.yaw_rad) * DVec3::new(x, 0.0, 0.0),
            yaw_rad: self.yaw_rad,
        }
    }

    fn towards(&self, to: &Stance, share: f64) -> Stance {
        Stance {
            middle: self.middle.lerp(to.middle, share),
            yaw_rad: self.yaw_rad + (to.yaw_rad - self.yaw_rad) * share,
            breadth_m: self.breadth_m + (to.breadth_m - self.breadth_m) * share,
        }
    }
}

/// Appends the strides to a stance, beginning with a foot, and their steps. With a half step the last foot stays
/// behind. Appends nothing if both feet stand there already. False if it is too far.
#[allow(clippy::too_many_arguments, reason = "a walk is all of these")]
pub(crate) fn walk(
    feet: &mut Feet,
    to: &Stance,
    first: usize,
    last: StepKind,
    start_secs: f64,
    pace: f64,
    values: &Values,
    steps: &mut Vec<Step>,
) -> bool {
    let placed = feet.last();
    let from = Stance::of(&placed, values);
    let mut to = *to;
    to.yaw_rad = from.yaw_rad + wrapped(to.yaw_rad - from.yaw_rad);
    let away = to.middle - from.middle;
    let distance = libm::hypot(away.x, away.z);
    let turn = (to.yaw_rad - from.yaw_rad).abs();
    let unit = WALKS * values.longest_step_m;
    let effort = libm::hypot(distance / (1.05 * values.longest_step_m), turn / TURNS_WITH_STEP_RAD);
    let strides = if distance > 1.05 * values.longest_step_m {
        (distance / unit).ceil()
    } else if effort > 1.0 {
        2.0
    } else {
        1.0
    };
    let strides = strides.max((turn / MAX_TURN_RAD).ceil()).max(1.0);
    if strides > (crate::feet::MAX_STRIDES / 2) as f64 {
        return false;
    }
    // Whoever walks turns first.
    let turns = (turn / TURNS_RAD).ceil().clamp(1.0, strides);
    let strides = strides as usize;
    let mut at = placed;
    let mut start = start_secs;
    let mut side = first;
    for index in 1..=strides {
        let mut stance = from.towards(&to, index as f64 / strides as f64);
        stance.yaw_rad = from.yaw_rad + (to.yaw_rad - from.yaw_rad) * (index as f64 / turns).min(1.0);
        let place = stance.foot(side);
        let is_last = index == strides;
        let kind = if is_last && last == StepKind::Half { StepKind::Half } else { StepKind::Full };
        start = stride(feet, &mut at, side, place, kind, start, pace, values, Some(steps));
        if is_last && kind == StepKind::Full {
            let other = 1 - side;
            stride(feet, &mut at, other, to.foot(other), kind, start, pace, values, None);
        }
        side = 1 - side;
    }
    true
}

/// Adds one stride and returns when the next may begin.
#[allow(clippy::too_many_arguments, reason = "a stride is all of these")]
pub(crate) fn stride(
    feet: &mut Feet,
    at: &mut [Placement; 2],
    side: usize,
    to: Placement,
    kind: StepKind,
    start_secs: f64,
    pace: f64,
    values: &Values,
    steps: Option<&mut Vec<Step>>,
) -> f64 {
    let way = to.ankle - at[side].ankle;
    let length_m = libm::hypot(way.x, way.z);
    let turn = wrapped(to.yaw_rad - at[side].yaw_rad).abs();
    if length_m < 0.01 && turn < 0.05 {
        return start_secs;
    }
    // How far beyond the other foot: in a walk the foot swings twice as far.
    let beyond = to.ankle - at[1 - side].ankle;
    let aside = values.leg_m * USUAL_BREADTH;
    let beyond_m = (beyond.length_squared() - aside * aside).max(0.0).sqrt().min(length_m).max(0.55 * length_m);
    // A longer step takes longer, though not in proportion.
    let effort = (beyond_m / values.usual_step_m).max(0.45 * turn).min(1.6);
    let for_secs = values.step_secs * (0.53 + 0.3 * effort) * pace;
    let forward = DQuat::from_rotation_y(at[side].yaw_rad) * DVec3::Z;
    let behind_m = (at[1 - side].ankle - at[side].ankle).dot(forward).max(0.25 * way.dot(forward));
    let heel_rad = (HEEL_OFF_RAD * behind_m / values.usual_step_m).clamp(0.0, 1.1 * HEEL_OFF_RAD);
    // A risen heel lifts the foot by itself.
    let lift_m = values.foot_lift_m * (0.38 + 0.2 * effort.min(1.3)) * (1.0 - 0.6 * heel_rad / HEEL_OFF_RAD).max(0.3);
    if feet.push(Stride {
        side,
        to,
        start_secs,
        for_secs,
        lift_m,
        heel_rad,
        sinks_m: 0.0,
        bears_secs: (start_secs, start_secs + for_secs),
    }) && let Some(steps) = steps
    {
        steps.push(Step { side, kind, length_m, start_secs });
    }
    at[side] = to;
    start_secs + for_secs
}
