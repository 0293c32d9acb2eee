//! Commands for the stage, its props, joints and controllers.

use super::StageOrder;
use super::resolve::{MAX_WORDS, Resolver, not_found, words};
use crate::scene::{JointKind, MAX_PYTHON_BYTES, aim, shortened};
use glam::DVec3;
use sinew_control::{Action, OrderError, OrderErrorKind as Kind, range};
use sinew_world::Aim;

impl Resolver<'_> {
    pub(super) fn stage_order(&self, action: &Action) -> Result<StageOrder, OrderError> {
        use StageOrder as O;
        Ok(match action {
            Action::Place { object, position_m, velocity_m_s } => {
                let place = position_m.map(|place| range::PLACE_M.check_three("position_m", place)).transpose()?;
                let velocity = velocity_m_s
                    .map(|velocity| range::VELOCITY_M_S.check_three("velocity_m_s", velocity))
                    .transpose()?;
                O::PlaceProp {
                    prop: self.prop(object)?,
                    position: place.map(DVec3::from),
                    velocity: velocity.map(DVec3::from),
                }
            }
            Action::Accelerate { object, acceleration_m_s2, for_secs } => {
                let prop = self.prop(object)?;
                if !self.scene.props.get(object).is_some_and(|prop| prop.moving) {
                    let problem = format!("`{}` is no platform; write moving = true in [props.{0}]", shortened(object));
                    return Err(OrderError::new(Kind::WrongTarget, problem));
                }
                let acceleration = range::ACCELERATION_M_S2.check_three("acceleration_m_s2", *acceleration_m_s2)?;
                let for_secs = range::SECS.check("for_secs", *for_secs)?;
                O::AccelerateProp { prop, acceleration: acceleration.into(), for_secs }
            }
            Action::Push { facing: true, .. } => {
                let problem = "only a character has a facing; name it with character";
                return Err(OrderError::new(Kind::Contradiction, problem));
            }
            Action::Push { on, force_n, for_secs, facing: false, at_m } => O::PushProp {
                prop: self.prop(on)?,
                force: range::FORCE_N.check_three("force_n", *force_n)?.into(),
                at: at_m.map(|at| range::POINT_M.check_three("at_m", at)).transpose()?.map(DVec3::from),
                for_secs: range::SECS.check("for_secs", *for_secs)?,
            },
            Action::Gravity { part: Some(_), .. } => {
                return Err(OrderError::new(Kind::Contradiction, "only a character has parts; name it with character"));
            }
            Action::Gravity { scale, on, part: None, over_secs, for_secs } => O::PropGravity {
                prop: self.prop(on.as_deref().unwrap_or_default())?,
                scale: range::GRAVITY_SCALE.check("scale", *scale)?,
                over_secs: range::SECS.check_some("over_secs", *over_secs)?,
                for_secs: range::SECS.check_some("for_secs", *for_secs)?,
            },
            Action::Motor { joint, speed_rad_s, angle_deg, speed_m_s, shift_m } => {
                let stated = [
                    ("speed_rad_s", *speed_rad_s),
                    ("angle_deg", *angle_deg),
                    ("speed_m_s", *speed_m_s),
                    ("shift_m", *shift_m),
                ];
                O::Motor { joint: self.joint(joint)?, aim: self.motor_aim(joint, stated)? }
            }
            Action::Cut { joint } => O::CutJoint { joint: self.joint(joint)? },
            Action::Reload { name, text } => O::Reload {
                controller: self.controller(name)?,
                text: text.as_deref().map(|text| words(text, MAX_PYTHON_BYTES)).transpose()?,
            },
            Action::ScriptKilled { name, reason } => {
                O::ScriptKilled { controller: self.controller(name)?, reason: words(reason, MAX_WORDS)? }
            }
            Action::Edit { .. } => {
                return Err(OrderError::new(Kind::NotPermitted, "no command edits a scene; use Stage::edit"));
            }
            Action::Say { text } => O::Say { text: words(text, MAX_WORDS)? },
            _ => return Err(OrderError::new(Kind::WrongTarget, "it is for a character; add character")),
        })
    }

    /// What a motor is to aim at; at most one of the four is stated.
    fn motor_aim(&self, name: &str, stated: [(&str, Option<f64>); 4]) -> Result<Option<Aim>, OrderError> {
        let wrong = |kind, problem: String| Err(OrderError::new(kind, problem));
        let joint = self.scene.joints.get(name);
        let joint = joint.ok_or_else(|| not_found("joint", name, self.scene.joints.keys()))?;
        if joint.motor.is_none() {
            let problem = format!("`{}` has no motor; add motor = {{ ... }} in [joints.{0}]", shortened(name));
            return wrong(Kind::NotHonoured, problem);
        }
        let own = if joint.kind == JointKind::Hinge { ["speed_rad_s", "angle_deg"] } else { ["speed_m_s", "shift_m"] };
        let mut aims = stated.into_iter().filter_map(|(key, value)| Some((key, value?)));
        let Some((key, value)) = aims.next() else { return Ok(None) };
        if aims.next().is_some() {
            return wrong(Kind::Contradiction, "it aims at two things; keep a speed or a place".to_owned());
        }
        if !own.contains(&key) {
            let problem = format!("`{}` is a {}; write {}", shortened(name), joint.kind.name(), own.join(" or "));
            return wrong(Kind::NotHonoured, problem);
        }
        range::MOTOR_AIM.check(key, value)?;
        let [speed_rad_s, angle_deg, speed_m_s, shift_m] = stated.map(|(_, value)| value);
        Ok(aim(speed_rad_s, angle_deg, speed_m_s, shift_m))
    }
}
