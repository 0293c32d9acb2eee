//! The feet: planted or in a step, and the support that they give.

use crate::minimum_jerk::{MinimumJerk, arc, eased};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Sole};
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
}

/// Support of two planted feet: a disc for the centre of mass.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Support {
    /// Its middle, on the floor \[m\].
    pub centre: DVec3,
    /// Position of the centre of mass at rest, a little behind the middle \[m\].
    pub rest: DVec3,
    /// Radius of the largest disc about the middle inside the soles' hull \[m\].
    pub radius_m: f64,
    /// Heading of the pelvis: the mean of the feet \[rad\].
    pub yaw_rad: f64,
}

/// Duration of the arm swing of a stride \[1 of the stride's time\]: forward until landing, then back.
const LINGERS: f64 = 2.0;

/// Maximum number of strides planned ahead.
pub const MAX_STRIDES: usize = 96;

/// Both feet over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Feet {
    soles: [Sole; 2],
    /// Placements before the strides.
    pub(crate) planted: [Placement; 2],
    strides: Vec<Stride>,
    /// Support before the strides and after each, flat and on the toes.
    stances: Vec<[Support; 2]>,
    /// Decaying rest of the initial placement: shift \[m\] and rotation (world) of each foot.
    pub(crate) rests: [(MinimumJerk<DVec3>, MinimumJerk<DVec3>); 2],
    linear: bool,
    /// Strides that belong to the start and are not dropped on a new goal.
    closing: Option<Stride>,
}

snapshot!(Placement { ankle, yaw_rad });
snapshot!(Stride { side, to, start_secs, for_secs, lift_m });
snapshot!(Support { centre, rest, radius_m, yaw_rad });

/// What feet carry is found anew from where they stand.
impl Snapshot for Feet {
    fn save(&self, to: &mut Writer) {
        self.planted.save(to);
        self.strides.save(to);
        self.rests.save(to);
        self.closing.save(to);
        self.linear.save(to);
    }
    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        self.planted.restore(from)?;
        self.strides.restore(from)?;
        self.rests.restore(from)?;
        self.closing.restore(from)?;
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
            planted,
            strides: Vec::with_capacity(MAX_STRIDES),
            stances: Vec::with_capacity(MAX_STRIDES + 1),
            rests: [(MinimumJerk::rest(DVec3::ZERO), MinimumJerk::rest(DVec3::ZERO)); 2],
            linear,
            closing: None,
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

    /// Marks the strides so far as part of the start: they are not dropped on a new goal.
    pub(crate) fn keep_closing(&mut self) {
        self.closing = self.strides.last().copied();
    }

    /// Drops strides that have not begun.
    pub(crate) fn stop(&mut self, secs: f64) {
        let before = self.strides.len();
        let closing = self.closing;
        self.strides.retain(|stride| stride.start_secs <= secs || Some(*stride) == closing);
        if self.strides.len() < before {
            self.stand_anew();
        }
    }

    fn stand_anew(&mut self) {
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

    /// The support of a pair of planted feet.
    pub fn support_of(&self, feet: &[Placement; 2]) -> Support {
        self.bearing(feet, false)
    }

    /// The support flat, and on the toes.
    pub(crate) fn supports_of(&self, feet: &[Placement; 2]) -> [Support; 2] {
        [self.bearing(feet, false), self.bearing(feet, true)]
    }

    /// The support of whole soles, or from the balls forward.
    fn bearing(&self, feet: &[Placement; 2], on_toes: bool) -> Support {
        let soles = self.soles.map(|sole| Sole { heel_m: if on_toes { sole.ball_m() } else { sole.heel_m }, ..sole });
        let middle = |side: usize, along: f64| {
            let sole = &soles[side];
            let place = &feet[side];
            place.ankle + DQuat::from_rotation_y(place.yaw_rad) * DVec3::new(sole.middle_m, -sole.ankle_m, along)
        };
        let along = |side: usize, share: f64| {
            let sole = &soles[side];
            sole.heel_m + share * (sole.toes_m - sole.heel_m)
        };
        let mean = |share: f64| (middle(0, along(0, share)) + middle(1, along(1, share))) * 0.5;
        let centre = mean(if on_toes { 0.5 } else { 0.42 });
        let corners = [0, 1].map(|side| {
            let place = &feet[side];
            let turn = DQuat::from_rotation_y(place.yaw_rad);
            soles[side].corners().map(|corner| place.ankle + turn * corner)
        });
        let yaw_rad = feet[0].yaw_rad + 0.5 * (feet[1].yaw_rad - feet[0].yaw_rad);
        Support { centre, rest: mean(0.30), radius_m: inner_radius(&corners, centre).max(0.02), yaw_rad }
    }

    /// The support at a time \[s\], flat: interpolated from stance to stance during strides.
    pub fn support(&self, secs: f64) -> Support {
        self.supports(secs)[0]
    }

    /// The support at a time \[s\], flat and on the toes.
    pub(crate) fn supports(&self, secs: f64) -> [Support; 2] {
        let mut total = self.stances[0];
        let mut stands = self.planted;
        for (index, stride) in self.strides.iter().enumerate() {
            let share = (secs - stride.start_secs) / stride.for_secs;
            stands[stride.side] = stride.to;
            if share <= 0.0 {
                continue;
            }
            let go = if self.linear { share.min(1.0) } else { eased(share) };
            for on in 0..2 {
                let (now, next) = (&self.stances[index][on], &self.stances[index + 1][on]);
                let total = &mut total[on];
                // The weight shifts only partly over the standing foot: a step is a controlled fall.
                let over = stands[1 - stride.side].ankle - self.stances[index][0].centre;
                let sway = DVec3::new(over.x, 0.0, over.z) * (SWAY * arc(share.min(1.0)));
                total.centre += (next.centre - now.centre) * go + sway;
                total.rest += (next.rest - now.rest) * go + sway;
                total.radius_m += (next.radius_m - now.radius_m) * go;
                total.yaw_rad += (next.yaw_rad - now.yaw_rad) * go;
            }
        }
        total
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

/// Share of the weight shift over the standing foot in a step \[1\].
const SWAY: f64 = 0.35;

/// Distance of a point inside the hull of the soles, on the floor \[m\].
fn inner_radius(soles: &[[DVec3; 4]; 2], point: DVec3) -> f64 {
    // The hull of two convex shapes: its support in every direction is the larger of theirs.
    let mut least = f64::INFINITY;
    for index in 0..48 {
        let (sin, cos) = libm::sincos(f64::from(index) * (std::f64::consts::PI / 24.0));
        let out = DVec3::new(sin, 0.0, cos);
        let reach = soles.iter().flatten().map(|corner| (*corner - point).dot(out)).fold(f64::NEG_INFINITY, f64::max);
        least = least.min(reach);
    }
    least
}
