//! What commands do that concern the stage, its props and their joints.

use crate::Stage;
use crate::apply_command::{number, vector};
use crate::event::Effect;
use crate::fade::Weighs;
use crate::scene::aim;
use crate::timed_effect::Expiry;
use sinew_control::Action;
use sinew_world::{Entity, Motor, PropJointId};

impl Stage {
    pub(crate) fn apply_to_stage(&mut self, action: &Action) -> Result<Option<Effect>, String> {
        let effect = match action {
            Action::Place { object, position_m, velocity_m_s } => {
                let prop = self.prop(object)?;
                let place = |value: &Option<[f64; 3]>, what| value.map(|value| vector(value, what)).transpose();
                let (position, velocity) = (place(position_m, "position_m")?, place(velocity_m_s, "velocity_m_s")?);
                self.world.place_prop(prop, position, velocity);
                Effect::PropPlaced { prop: object.clone() }
            }
            Action::Accelerate { object, acceleration_m_s2, for_secs } => {
                let prop = self.prop(object)?;
                let acceleration = vector(*acceleration_m_s2, "acceleration_m_s2")?;
                let until = self.until(Some(*for_secs))?;
                self.world.accelerate_prop(prop, acceleration);
                self.timed_effects.end_at(until, Expiry::Acceleration(prop));
                Effect::PropAccelerated {
                    prop: object.clone(),
                    acceleration_m_s2: acceleration.length(),
                    for_secs: *for_secs,
                }
            }
            Action::Push { on, force_n, for_secs, at_m, .. } => {
                let prop = self.prop(on)?;
                let force = vector(*force_n, "force_n")?;
                if !self.start_push(Entity::Prop(prop), force, *at_m, *for_secs)? {
                    return Ok(None);
                }
                Effect::PropPushed { prop: on.clone(), force_n: force.length(), for_secs: *for_secs }
            }
            Action::Gravity { scale, on: Some(on), over_secs, for_secs, .. } => {
                let prop = self.prop(on)?;
                let scale = number(*scale, "scale")?;
                let over_secs = over_secs.map(|secs| number(secs, "over_secs")).transpose()?;
                let until = self.until(*for_secs)?;
                self.weigh(&[Weighs::Prop(prop)], scale, over_secs);
                self.timed_effects.end_at(until, Expiry::PropGravity(prop));
                Effect::PropGravity { prop: on.clone(), scale, over_secs }
            }
            Action::Motor { joint: name, speed_rad_s, angle_deg, speed_m_s, shift_m } => {
                let joint = self.joint(name)?;
                let spec = self.scene.joints.get(name).and_then(|spec| spec.motor);
                let strength = spec.ok_or_else(|| format!("`{name}` has no motor"))?.strength();
                let stated = [
                    ("speed_rad_s", speed_rad_s),
                    ("angle_deg", angle_deg),
                    ("speed_m_s", speed_m_s),
                    ("shift_m", shift_m),
                ];
                for (key, value) in stated {
                    value.map(|value| number(value, key)).transpose()?;
                }
                let motor = aim(*speed_rad_s, *angle_deg, *speed_m_s, *shift_m).map(|aim| Motor { aim, strength });
                let before = self.world.prop_motor(joint);
                self.world.set_prop_motor(joint, motor);
                if self.world.prop_motor(joint) != motor {
                    return Err(format!("`{name}` cannot be driven like that"));
                }
                // A script may say something new at every step; only that a motor starts or stops is worth a note.
                match (before, motor) {
                    (None, None) | (Some(_), Some(_)) => return Ok(None),
                    (None, Some(_)) => Effect::Motor { joint: name.clone(), on: true },
                    (Some(_), None) => Effect::Motor { joint: name.clone(), on: false },
                }
            }
            Action::Cut { joint: name } => {
                let joint = self.joint(name)?;
                if !self.world.cut_prop_joint(joint) {
                    return Ok(None);
                }
                self.broken.insert(joint);
                Effect::JointCut { joint: name.clone() }
            }
            Action::Reload { name, text } => self.reload(name, text.as_deref())?,
            Action::ScriptKilled { name, reason } => self.kill_script(name, reason),
            Action::Say { text } => Effect::Said { text: text.clone() },
            _ => return Err("this command needs a character".to_owned()),
        };
        Ok(Some(effect))
    }

    fn joint(&self, name: &str) -> Result<PropJointId, String> {
        self.cast.joint(name).ok_or_else(|| format!("no joint `{name}`; there are {}", self.cast.joints().join(", ")))
    }
}
