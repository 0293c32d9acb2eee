//! Orders for the stage, its props, joints and controllers.

use super::{Applied, prop_gravity, wrong_state};
use crate::Stage;
use crate::event::Effect;
use crate::fade::Weighs;
use crate::order::{Order, StageOrder as O, Undo};
use glam::DVec3;
use sinew_control::OrderError;
use sinew_world::{Entity, Motor, PropId};

impl Stage {
    pub(super) fn apply_to_stage(&mut self, order: &O) -> Result<Applied, OrderError> {
        let name = |prop: PropId| self.cast.name_of(Entity::Prop(prop));
        let (effect, undo) = match order {
            O::PlaceProp { prop, position, velocity } => {
                let effect = Effect::PropPlaced { prop: name(*prop) };
                let Some(before) = self.world.frame().prop(*prop) else {
                    return Err(wrong_state("the prop is not there any more"));
                };
                let undo = O::PlaceProp {
                    prop: *prop,
                    position: position.map(|_| before.position),
                    velocity: velocity.map(|_| before.velocity),
                };
                self.world.place_prop(*prop, *position, *velocity);
                (effect, Undo::Orders(vec![Order::Stage(undo)]))
            }
            O::AccelerateProp { prop, acceleration, for_secs } => {
                let prop = *prop;
                let effect = Effect::PropAccelerated {
                    prop: name(prop),
                    acceleration_m_s2: acceleration.length(),
                    for_secs: *for_secs,
                };
                self.world.accelerate_prop(prop, *acceleration);
                let rest = O::AccelerateProp { prop, acceleration: DVec3::ZERO, for_secs: 0.0 };
                let undo = [Order::Stage(rest)];
                // What keeps its speed needs no end.
                self.end_with((*acceleration != DVec3::ZERO).then_some(*for_secs), &undo);
                (effect, Undo::Orders(undo.to_vec()))
            }
            O::PushProp { prop, force, at, for_secs } => return self.apply_prop_push(*prop, *force, *at, *for_secs),
            O::PropGravity { prop, scale, over_secs, for_secs } => {
                let effect = Effect::PropGravity { prop: name(*prop), scale: *scale, over_secs: *over_secs };
                let undo = [prop_gravity(*prop, self.scale_without_timed(Weighs::Prop(*prop)))];
                self.weigh(&[Weighs::Prop(*prop)], *scale, *over_secs);
                self.end_with(*for_secs, &undo);
                (effect, Undo::Orders(undo.to_vec()))
            }
            O::Motor { joint, aim } => {
                let name = self.cast.joint_name(*joint).to_owned();
                let spec = self.scene.joints.get(&name).and_then(|spec| spec.motor);
                let strength = spec.ok_or_else(|| wrong_state(format!("`{name}` has no motor")))?.strength();
                let motor = aim.map(|aim| Motor { aim, strength });
                let before = self.world.prop_motor(*joint);
                self.world.set_prop_motor(*joint, motor);
                if self.world.prop_motor(*joint) != motor {
                    return Err(wrong_state(format!("`{name}` cannot be driven like that")));
                }
                let aim = before.map(|motor| motor.aim);
                let undo = Undo::Orders(vec![Order::Stage(O::Motor { joint: *joint, aim })]);
                // A script may say something new at every step; only that a motor starts or stops is worth a note.
                let effect = match (before, motor) {
                    (None, None) | (Some(_), Some(_)) => return Ok(Applied { effect: None, undo }),
                    (None, Some(_)) => Effect::Motor { joint: name, on: true },
                    (Some(_), None) => Effect::Motor { joint: name, on: false },
                };
                (effect, undo)
            }
            O::CutJoint { joint } => {
                if !self.world.cut_prop_joint(*joint) {
                    return Ok(Applied { effect: None, undo: Undo::Nothing });
                }
                self.broken.insert(*joint);
                (Effect::JointCut { joint: self.cast.joint_name(*joint).to_owned() }, Undo::Impossible)
            }
            O::Reload { controller, text } => (self.reload(controller, text.as_deref())?, Undo::Impossible),
            O::ScriptKilled { controller, reason } => (self.kill_script(controller, reason), Undo::Impossible),
            O::Say { text } => (Effect::Said { text: text.clone() }, Undo::Impossible),
        };
        Ok(Applied { effect: Some(effect), undo })
    }
}
