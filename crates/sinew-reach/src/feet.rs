//! The feet: planted or in a step, and the support that they give.

use crate::minimum_jerk::{MinimumJerk, arc, early, eased};
use crate::stop::BEFORE_SECS;
use crate::weight::{Support, legs_m};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose, Sole};
use sinew_snapshot::{Reader, Snapshot, SnapshotError, Writer, snapshot};

/// A foot flat on the floor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Placement {
    /// The ankle \[m\].
    pub ankle: DVec3,
    /// Heading of the toes \[rad about +Y from +Z to +X\].
    pub yaw_rad: f64,
}

/// A stride: one foot from a placement to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stride {
    /// 0 left, 1 right.
    pub side: usize,
    /// Where it lands.
    pub to: Placement,
    /// Lift-off time \[s\].
    pub start_secs: f64,
    /// Duration of the swing phase \[s\].
    pub for_secs: f64,
    /// Maximum height of the ankle during the swing \[m\].
    pub lift_m: f64,
    /// How far the heel rises before the foot lifts off \[rad\].
    pub heel_rad: f64,
    /// How much lower the hips are in the middle of it, beside what the stances ask \[m\].
    pub sinks_m: f64,
    /// When the weight begins to move to the new stance, and when it is there \[s\]: in a walk the times of several strides overlap, so
    /// that the hips do not stop between them.
    pub bears_secs: (f64, f64),
}

impl Stride {
    /// Whether it is one with which a body that walked comes to stand.
    pub(crate) fn stops(&self) -> bool {
        self.bears_secs == BEFORE_SECS
    }

    /// The middle of the swing \[s\].
    pub(crate) fn middle_secs(&self) -> f64 {
        self.start_secs + 0.5 * self.for_secs
    }

    /// When the foot lands \[s\].
    pub fn lands_secs(&self) -> f64 {
        self.start_secs + self.for_secs
    }
}

/// Duration of the arm swing of a stride \[1 of the stride's time\]: forward until landing, then back.
const LINGERS: f64 = 2.0;

/// Time after the last landing in which the weight comes to rest \[1 of the stride's time\].
const SETTLES: f64 = 0.3;

/// Maximum number of strides planned ahead.
pub const MAX_STRIDES: usize = 96;

/// Both feet over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Feet {
    pub(crate) soles: [Sole; 2],
    /// Length of a leg that is as straight as plans allow, and distance of the hip joints \[m\].
    pub(crate) legs_m: (f64, f64),
    /// From the hips to the centre of mass over the ground, standing \[m\].
    pub(crate) rest_com: DVec3,
    /// Placements before the strides.
    pub(crate) planted: [Placement; 2],
    pub(crate) strides: Vec<Stride>,
    /// Support before the strides and after each, flat and on the toes.
    pub(crate) stances: Vec<[Support; 2]>,
    /// Decaying rest of the initial placement: shift \[m\] and rotation (world) of each foot.
    pub(crate) rests: [(MinimumJerk<DVec3>, MinimumJerk<DVec3>); 2],
    pub(crate) linear: bool,
}

snapshot!(Placement { ankle, yaw_rad });
snapshot!(Stride { side, to, start_secs, for_secs, lift_m, heel_rad, sinks_m, bears_secs });

/// What feet carry is found anew from where they stand.
impl Snapshot for Feet {
    fn save(&self, to: &mut Writer) {
        self.planted.save(to);
        self.strides.save(to);
        self.rests.save(to);
        self.linear.save(to);
    }
    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        self.planted.restore(from)?;
        self.strides.restore(from)?;
        self.rests.restore(from)?;
        self.linear.restore(from)?;
        if self.strides.len() > MAX_STRIDES || self.strides.iter().any(|stride| stride.side > 1) {
            return Err(SnapshotError::invalid("stride"));
        }
        self.stand_anew();
        Ok(())
    }
}

impl Feet {
    /// Feet that stand.
    pub fn new(body: &Body, planted: [Placement; 2], linear: bool) -> Feet {
        let mut feet = Feet {
            soles: [Node::LeftFoot, Node::RightFoot].map(|foot| Sole::of(body, foot)),
            legs_m: legs_m(body),
            rest_com: {
                let centre = body.centre_of_mass(&Pose::STANDING);
                DVec3::new(centre.x, 0.0, centre.z)
            },
            planted,
            strides: Vec::with_capacity(MAX_STRIDES),
            stances: Vec::with_capacity(MAX_STRIDES + 1),
            rests: [(MinimumJerk::rest(DVec3::ZERO), MinimumJerk::rest(DVec3::ZERO)); 2],
            linear,
        };
        feet.stand_anew();
        feet
    }

    /// Strides planned or in progress.
    pub fn strides(&self) -> &[Stride] {
        &self.strides
    }

    /// Appends a stride. False when the maximum number is planned.
    pub(crate) fn push(&mut self, stride: Stride) -> bool {
        let fits = self.strides.len() < MAX_STRIDES;
        if fits {
            self.strides.push(stride);
            self.stances.push(self.supports_of(&self.last()));
        }
        fits
    }

    /// Links the strides from an index on to a walk: the weight goes on from each to the next.
    pub(crate) fn link(&mut self, from: usize) {
        for index in from..self.strides.len() {
            let begins =
                if index == from { self.strides[index].start_secs } else { self.strides[index - 1].middle_secs() };
            let stride = &self.strides[index];
            let usual = stride.lands_secs() + SETTLES * stride.for_secs;
            let ends = self.strides.get(index + 1).map_or(usual, Stride::middle_secs);
            self.strides[index].bears_secs = (begins, ends);
        }
    }

    /// Drops strides to which the weight does not yet move.
    pub(crate) fn stop(&mut self, secs: f64) {
        let before = self.strides.len();
        self.strides.retain(|stride| stride.bears_secs.0 <= secs);
        if self.strides.len() < before {
            self.stand_anew();
        }
    }

    pub(crate) fn stand_anew(&mut self) {
        self.stances.clear();
        let mut stands = self.planted;
        self.stances.push(self.supports_of(&stands));
        for index in 0..self.strides.len() {
            let stride = &self.strides[index];
            stands[stride.side] = stride.to;
            self.stances.push(self.supports_of(&stands));
        }
    }

    /// Merges completed strides and their arm swing into the planted feet.
    pub(crate) fn settle(&mut self, secs: f64) {
        let before = self.strides.len();
        let planted = &mut self.planted;
        self.strides.retain(|stride| {
            let is_over = stride.start_secs + LINGERS * stride.for_secs <= secs;
            if is_over {
                planted[stride.side] = stride.to;
            }
            !is_over
        });
        if self.strides.len() < before {
            self.stand_anew();
        }
    }

    /// Landing time of the last stride \[s\]; `None` if both feet stand.
    pub fn lands_secs(&self) -> Option<f64> {
        self.strides.iter().map(|stride| stride.start_secs + stride.for_secs).reduce(f64::max)
    }

    /// Time at which the weight rests on the last stance \[s\]; `None` if it rests already.
    pub fn rests_secs(&self) -> Option<f64> {
        self.strides.iter().map(|stride| stride.bears_secs.1).reduce(f64::max)
    }

    /// Whether both feet stand at a time \[s\] and the rest of the initial placement has decayed.
    pub fn stand(&self, secs: f64) -> bool {
        let is_off = |stride: &Stride| stride.start_secs < secs && secs < stride.start_secs + stride.for_secs;
        !self.strides.iter().any(is_off)
            && self.rests.iter().all(|(shift, turn)| secs >= shift.end_secs() && secs >= turn.end_secs())
    }

    /// Placements after all strides.
    pub fn last(&self) -> [Placement; 2] {
        let mut planted = self.planted;
        for stride in &self.strides {
            planted[stride.side] = stride.to;
        }
        planted
    }

    /// A foot's ankle \[m\] and `world_from_foot` at a time \[s\].
    pub fn foot(&self, side: usize, secs: f64) -> (DVec3, DQuat) {
        let mut at = self.planted[side];
        for stride in self.strides.iter().filter(|stride| stride.side == side) {
            let share = (secs - stride.start_secs) / stride.for_secs;
            if share <= 0.0 {
                break;
            }
            // Who stops sets the foot off at once.
            let share = if stride.stops() { early(share) } else { share };
            let (go, rise) = self.profile(share);
            at.ankle = at.ankle + (stride.to.ankle - at.ankle) * go + DVec3::Y * (stride.lift_m * rise);
            at.yaw_rad += (stride.to.yaw_rad - at.yaw_rad) * go;
        }
        let (shift, turn) = &self.rests[side];
        let turned = sinew_body::humanoid::exp(turn.at(secs)) * DQuat::from_rotation_y(at.yaw_rad);
        (at.ankle + shift.at(secs), turned.normalize())
    }

    /// Progress and height of a swinging foot: a convex arc, under `print` of two straight pieces.
    fn profile(&self, share: f64) -> (f64, f64) {
        if self.linear {
            let share = share.clamp(0.0, 1.0);
            (share, 1.0 - (2.0 * share - 1.0).abs())
        } else {
            (eased(share), arc(share))
        }
    }

    /// Arm swing at a time \[s\], relative to that of a usual step: forward with the opposite leg, with its maximum
    /// when that foot lands \[1\].
    pub(crate) fn arm_swing(&self, side: usize, secs: f64, usual_step_m: f64) -> f64 {
        let mut from = self.planted;
        let mut swing = 0.0;
        for stride in &self.strides {
            let share = (secs - stride.start_secs) / (LINGERS * stride.for_secs);
            let way = stride.to.ankle - from[stride.side].ankle;
            from[stride.side] = stride.to;
            if share > 0.0 && share < 1.0 {
                let (sin, cos) = libm::sincos(stride.to.yaw_rad);
                let length = (way.x * sin + way.z * cos) / usual_step_m;
                let sign = if stride.side == side { -1.0 } else { 1.0 };
                swing += sign * crate::head::soft(length, 1.3) * arc(share);
            }
        }
        swing
    }
}
