//! Joints of props: to each other, to the ground or to a part.

use super::error::{Fault, shortened};
use super::range::{number, optional, vector};
use super::{SceneSpec, Touchable};
use glam::DVec3;
use schemars::JsonSchema;
use serde::Deserialize;
use sinew_control::range;
use sinew_world::{Aim, Motor, PropJointKind};

/// A joint. Its kind decides which keys are allowed; others are refused.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PropJointSpec {
    /// The two bodies that it connects: props, `ground`, or a part as `character.part`.
    pub between: [String; 2],
    /// What it leaves free.
    pub kind: JointKind,
    /// Anchor on the first, in the world at the start \[m\]. Default: the second prop's position; for ropes and springs
    /// the first's.
    #[serde(default)]
    pub anchor_m: Option<[f64; 3]>,
    /// Anchor of a rope or spring on the second, in the world at the start \[m\]. Default: its position.
    #[serde(default)]
    pub end_m: Option<[f64; 3]>,
    /// The axis of a hinge or slider, in the world at the start.
    #[serde(default)]
    pub axis: Option<[f64; 3]>,
    /// Limits of a hinge relative to the start, negative and positive \[degrees\], within ±170. Default: unlimited.
    #[serde(default)]
    pub range_deg: Option<[f64; 2]>,
    /// Limits of a slider relative to the start, negative and positive \[m\]. Default: unlimited.
    #[serde(default)]
    pub range_m: Option<[f64; 2]>,
    /// Maximum length of a rope, rest length of a spring \[m\]. Default: the distance at the start.
    #[serde(default)]
    pub length_m: Option<f64>,
    /// A spring's stiffness \[N/m\].
    #[serde(default)]
    pub stiffness_n_m: Option<f64>,
    /// A spring's damping \[N s/m\]; 0 when left out.
    #[serde(default)]
    pub damping_n_s_m: Option<f64>,
    /// The motor of a hinge or slider.
    #[serde(default)]
    pub motor: Option<MotorSpec>,
    /// Breaks above this force \[N\]. Default: never.
    #[serde(default)]
    pub break_n: Option<f64>,
    /// The two bodies collide with each other.
    #[serde(default)]
    pub touches: bool,
}

/// What a joint leaves free.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum JointKind {
    /// Nothing.
    Fixed,
    /// All turns.
    Ball,
    /// Turns about an axis.
    Hinge,
    /// Shifts along an axis.
    Slider,
    /// Everything up to its length.
    Rope,
    /// Everything, against a spring.
    Spring,
}

/// A motor: its maximum strength, and its target until a command `motor` changes it. Default: no target.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct MotorSpec {
    /// Maximum torque of a hinge's motor \[N m\].
    pub strength_n_m: Option<f64>,
    /// Maximum force of a slider's motor \[N\].
    pub strength_n: Option<f64>,
    /// A hinge's speed \[rad/s\].
    pub speed_rad_s: Option<f64>,
    /// A hinge's angle from where it is at the start \[degrees\].
    pub angle_deg: Option<f64>,
    /// A slider's speed \[m/s\].
    pub speed_m_s: Option<f64>,
    /// A slider's shift from where it is at the start \[m\].
    pub shift_m: Option<f64>,
}

impl JointKind {
    pub(crate) fn name(self) -> &'static str {
        match self {
            JointKind::Fixed => "fixed",
            JointKind::Ball => "ball",
            JointKind::Hinge => "hinge",
            JointKind::Slider => "slider",
            JointKind::Rope => "rope",
            JointKind::Spring => "spring",
        }
    }
}

impl MotorSpec {
    /// Its target at the start.
    pub fn aim(&self) -> Option<Aim> {
        aim(self.speed_rad_s, self.angle_deg, self.speed_m_s, self.shift_m)
    }

    /// Its maximum strength \[N m, N\].
    pub fn strength(&self) -> f64 {
        self.strength_n_m.or(self.strength_n).unwrap_or(0.0)
    }
}

/// The target stated by one of the four keys.
pub(crate) fn aim(
    speed_rad_s: Option<f64>,
    angle_deg: Option<f64>,
    speed_m_s: Option<f64>,
    shift_m: Option<f64>,
) -> Option<Aim> {
    let place = angle_deg.map(f64::to_radians).or(shift_m).map(Aim::Place);
    speed_rad_s.or(speed_m_s).map(Aim::Speed).or(place)
}

impl PropJointSpec {
    /// What it leaves free, in the world's words.
    pub fn in_world(&self, anchors: [DVec3; 2]) -> PropJointKind {
        let axis = DVec3::from(self.axis.unwrap_or([0.0, 1.0, 0.0]));
        let length_m = self.length_m.unwrap_or((anchors[1] - anchors[0]).length());
        match self.kind {
            JointKind::Fixed => PropJointKind::Fixed,
            JointKind::Ball => PropJointKind::Ball,
            JointKind::Hinge => {
                PropJointKind::Hinge { axis, range: self.range_deg.map(|range| range.map(f64::to_radians)) }
            }
            JointKind::Slider => PropJointKind::Slider { axis, range: self.range_m },
            JointKind::Rope => PropJointKind::Rope { length_m },
            JointKind::Spring => PropJointKind::Spring {
                length_m,
                stiffness_n_m: self.stiffness_n_m.unwrap_or(0.0),
                damping_n_s_m: self.damping_n_s_m.unwrap_or(0.0),
            },
        }
    }

    /// Its motor at the start.
    pub fn motor(&self) -> Option<Motor> {
        let motor = self.motor?;
        Some(Motor { aim: motor.aim()?, strength: motor.strength() })
    }

    /// Its two anchors; `place` returns the position of a prop. `None` for bodies without a position of their own.
    pub fn anchors(&self, place: impl Fn(&str) -> Option<[f64; 3]>) -> Option<[DVec3; 2]> {
        let two_points = matches!(self.kind, JointKind::Rope | JointKind::Spring);
        let first = self.anchor_m.or_else(|| place(&self.between[usize::from(!two_points)]))?;
        let second = if two_points { self.end_m.or_else(|| place(&self.between[1]))? } else { first };
        Some([first.into(), second.into()])
    }

    pub(super) fn check(&self, name: &str, scene: &SceneSpec) -> Result<(), Fault> {
        let at = |key| ["joints", name, key];
        let mut moves = false;
        for thing in &self.between {
            let found = scene.touchable(thing).map_err(|error| Fault::of_order(&at("between"), &error))?;
            if let Touchable::Character(character) = &found {
                let problem =
                    format!("a character is fastened by a part; write `{}.hips` or another", shortened(character));
                return Err(Fault::at(&at("between"), problem));
            }
            moves |= match &found {
                Touchable::Prop(prop) => scene.props.get(prop).is_some_and(|prop| prop.mass_kg.is_some()),
                Touchable::Part(..) => true,
                _ => false,
            };
        }
        if self.between[0] == self.between[1] {
            return Err(Fault::at(&at("between"), "a thing cannot be fastened to itself; name two"));
        }
        if !moves {
            let problem =
                "neither of the two can move; give one a mass_kg in place of fixed or moving, or remove the joint";
            return Err(Fault::at(&at("between"), problem));
        }
        self.check_keys(name)?;
        let place = |prop: &str| scene.props.get(prop).map(|prop| prop.position_m);
        let Some(anchors) = self.anchors(place) else {
            let key = if self.anchor_m.is_none() { "anchor_m" } else { "end_m" };
            let problem = format!("the ground and parts have no place of their own; write {key} = [x, y, z]");
            return Err(Fault::at(&at("between"), problem));
        };
        if self.kind == JointKind::Rope && (anchors[1] - anchors[0]).length() < 1e-3 && self.length_m.is_none() {
            return Err(Fault::at(&at("kind"), "its ends are at the same place; write length_m, or end_m elsewhere"));
        }
        Ok(())
    }

    fn check_keys(&self, name: &str) -> Result<(), Fault> {
        use JointKind as K;
        let at = |key| ["joints", name, key];
        for (key, is_there, kinds) in [
            ("end_m", self.end_m.is_some(), &[K::Rope, K::Spring][..]),
            ("axis", self.axis.is_some(), &[K::Hinge, K::Slider]),
            ("range_deg", self.range_deg.is_some(), &[K::Hinge]),
            ("range_m", self.range_m.is_some(), &[K::Slider]),
            ("length_m", self.length_m.is_some(), &[K::Rope, K::Spring]),
            ("stiffness_n_m", self.stiffness_n_m.is_some(), &[K::Spring]),
            ("damping_n_s_m", self.damping_n_s_m.is_some(), &[K::Spring]),
            ("motor", self.motor.is_some(), &[K::Hinge, K::Slider]),
        ] {
            if is_there && !kinds.contains(&self.kind) {
                let kinds: Vec<&str> = kinds.iter().map(|kind| kind.name()).collect();
                let problem = format!("only for kind = {}; remove it, or change the kind", kinds.join(" or "));
                return Err(Fault::at(&at(key), problem));
            }
        }
        for (key, point) in [("anchor_m", self.anchor_m), ("end_m", self.end_m)] {
            vector(&at(key), point.unwrap_or_default(), 1e4, "metres are expected")?;
        }
        if matches!(self.kind, K::Hinge | K::Slider) {
            let Some(axis) = self.axis else {
                return Err(Fault::at(&["joints", name], "it needs an axis; write axis = [1, 0, 0] or another"));
            };
            vector(&at("axis"), axis, 1e3, "a direction is expected")?;
            if DVec3::from(axis).length() < 1e-3 {
                return Err(Fault::at(&at("axis"), "this is no direction; write axis = [1, 0, 0] or another"));
            }
        }
        for (key, range, most) in [("range_deg", self.range_deg, 170.0), ("range_m", self.range_m, 1e3)] {
            let Some([low, high]) = range else { continue };
            number(&at(key), low, -most..=0.0, "it begins at 0 or below, where the joint is at the start")?;
            number(&at(key), high, 0.0..=most, "it ends at 0 or above, where the joint is at the start")?;
            if low >= high {
                return Err(Fault::at(&at(key), "it leaves nothing free; write kind = \"fixed\" instead"));
            }
        }
        optional(&at("length_m"), self.length_m, 1e-3..=1e3, "metres are expected")?;
        if self.kind == K::Spring {
            let stiffness = self.stiffness_n_m.unwrap_or(0.0);
            number(&at("stiffness_n_m"), stiffness, 1e-3..=1e7, "newtons a metre are expected")?;
        }
        optional(&at("damping_n_s_m"), self.damping_n_s_m, 0.0..=1e6, "newtons by metres a second are expected")?;
        optional(&at("break_n"), self.break_n, range::BREAK_FORCE_N.inclusive(), "newtons are expected")?;
        self.motor.map_or(Ok(()), |motor| motor.check(self.kind, name))
    }
}

impl MotorSpec {
    fn check(&self, kind: JointKind, name: &str) -> Result<(), Fault> {
        let at = |key| ["joints", name, "motor", key];
        let own = if kind == JointKind::Hinge { "hinge" } else { "slider" };
        let keys = [
            ("strength_n_m", self.strength_n_m, "hinge", 1e5),
            ("strength_n", self.strength_n, "slider", 1e5),
            ("speed_rad_s", self.speed_rad_s, "hinge", 300.0),
            ("angle_deg", self.angle_deg, "hinge", 170.0),
            ("speed_m_s", self.speed_m_s, "slider", 300.0),
            ("shift_m", self.shift_m, "slider", 1e3),
        ];
        for (key, value, of, most) in keys {
            if value.is_some() && of != own {
                return Err(Fault::at(&at(key), format!("this is for a {of}, and the joint is a {own}; remove it")));
            }
            let least = if key.starts_with("strength") { 1e-3 } else { -most };
            optional(&at(key), value, least..=most, "it is too large or too small")?;
        }
        if self.strength() <= 0.0 {
            let key = if own == "hinge" { "strength_n_m" } else { "strength_n" };
            return Err(Fault::at(&["joints", name, "motor"], format!("it has no strength; add {key}")));
        }
        if keys[2..].iter().filter(|(_, value, ..)| value.is_some()).count() > 1 {
            return Err(Fault::at(&["joints", name, "motor"], "it aims at two things; keep a speed or a place"));
        }
        Ok(())
    }
}
