//! From an order back to the command that says it, for takes and for editors.

use super::{CharacterOrder, KdChange, Order, StageOrder};
use crate::Cast;
use sinew_body::humanoid::Node;
use sinew_control::{Action, Command};
use sinew_world::{Aim, Entity};

impl Order {
    /// The command that is resolved to this order. What is no longer there has an empty name.
    pub fn to_command(&self, cast: &Cast) -> Command {
        match self {
            Order::Character { id, order } => {
                let name = cast.character_name(*id).to_owned();
                Command::to(name, character_action(order, cast))
            }
            Order::Stage(order) => Command::stage(stage_action(order, cast)),
        }
    }
}

fn part(node: Node) -> String {
    node.part().name().to_owned()
}

fn parts(nodes: &[Node]) -> Vec<String> {
    nodes.iter().copied().map(part).collect()
}

fn thing(object: Option<Entity>, cast: &Cast) -> String {
    object.map_or(String::new(), |object| cast.name_of(object))
}

fn character_action(order: &CharacterOrder, cast: &Cast) -> Action {
    use CharacterOrder as O;
    match order.clone() {
        O::Pose { name } => Action::Pose { name },
        O::Graph { name, state } => Action::Graph { name, state },
        O::Signal { name } => Action::Signal { name },
        O::LimbReach { node, target } => Action::Ik { link: node.map(part), target_m: target.into() },
        O::LimbRelease { node } => Action::IkRelease { link: node.map(part) },
        O::Attach { node, object, soft, break_force_n } => {
            Action::Attach { link: part(node), object: thing(object, cast), soft, break_n: break_force_n }
        }
        O::Detach { node, object } => Action::Detach { link: part(node), object: thing(object, cast) },
        O::Push { node, force, facing, at, for_secs } => {
            Action::Push { on: part(node), force_n: force.into(), for_secs, facing, at_m: at.map(Into::into) }
        }
        O::Gain { node, factor } => Action::Gain { factor, part: node.map(part) },
        O::ForcesOff { nodes, for_secs } => Action::ForcesOff { parts: parts(&nodes), for_secs },
        O::ForcesOn { nodes } => Action::ForcesOn { parts: parts(&nodes) },
        O::Plane { facing_deg, for_secs } => Action::Plane { facing_deg, for_secs },
        O::PlaneOff => Action::PlaneOff {},
        O::Gravity { node, scale, over_secs, for_secs } => {
            Action::Gravity { scale, on: None, part: node.map(part), over_secs, for_secs }
        }
        O::Shape { node, shape, for_secs } => Action::Shape { part: part(node), shape: shape.to_string(), for_secs },
        O::AddShape { node, shape, for_secs } => Action::AddShape { part: part(node), shape, for_secs },
        O::RemoveShape { node, shape } => Action::RemoveShape { part: part(node), shape },
        O::Layer { layer, on } => Action::Layer { layer, on },
        O::Reflex { name, on } => Action::Reflex { name, on },
        O::Controller { name } => Action::Controller { name: name.unwrap_or_default() },
        O::Weights { nodes, pin, joint, fade_secs, for_secs } => {
            Action::Weights { parts: parts(&nodes), pin, joint, fade_secs: Some(fade_secs), for_secs }
        }
        O::Kd { change, fade_secs, for_secs } => {
            let KdChange { preset, k_p, d_p, k_q, d_q, damping, feed_forward } = change;
            let fade_secs = Some(fade_secs);
            Action::Kd { preset, k_p, d_p, k_q, d_q, damping, feed_forward, fade_secs, for_secs }
        }
        O::Pins { on, fade_secs, for_secs } => Action::Pins { on, fade_secs: Some(fade_secs), for_secs },
        O::Tracker(kind) => Action::Tracker { name: kind.name().to_owned() },
        O::Perform(sample) => Action::Perform { sample },
        O::Live { on } => Action::Live { on },
        O::Source(source) => Action::Source { source },
        O::Reach(order) => {
            let named = order.try_map(|prop| Ok::<String, std::convert::Infallible>(cast.prop_name(*prop).to_owned()));
            let Ok(named) = named;
            Action::Reach(named)
        }
        O::ReachEnd => Action::ReachEnd {},
        O::Say { text } => Action::Say { text },
    }
}

fn stage_action(order: &StageOrder, cast: &Cast) -> Action {
    use StageOrder as O;
    let prop = |prop| cast.name_of(Entity::Prop(prop));
    let joint = |joint| cast.joint_name(joint).to_owned();
    match order.clone() {
        O::PlaceProp { prop: place, position, velocity } => Action::Place {
            object: prop(place),
            position_m: position.map(Into::into),
            velocity_m_s: velocity.map(Into::into),
        },
        O::AccelerateProp { prop: moving, acceleration, for_secs } => {
            Action::Accelerate { object: prop(moving), acceleration_m_s2: acceleration.into(), for_secs }
        }
        O::PushProp { prop: pushed, force, at, for_secs } => {
            Action::Push { on: prop(pushed), force_n: force.into(), for_secs, facing: false, at_m: at.map(Into::into) }
        }
        O::PropGravity { prop: on, scale, over_secs, for_secs } => {
            Action::Gravity { scale, on: Some(prop(on)), part: None, over_secs, for_secs }
        }
        O::Motor { joint: driven, aim } => {
            let is_hinge = cast.is_hinge(driven);
            let speed = aim.and_then(|aim| if let Aim::Speed(speed) = aim { Some(speed) } else { None });
            let place = aim.and_then(|aim| if let Aim::Place(place) = aim { Some(place) } else { None });
            Action::Motor {
                joint: joint(driven),
                speed_rad_s: speed.filter(|_| is_hinge),
                angle_deg: place.filter(|_| is_hinge).map(f64::to_degrees),
                speed_m_s: speed.filter(|_| !is_hinge),
                shift_m: place.filter(|_| !is_hinge),
            }
        }
        O::CutJoint { joint: cut } => Action::Cut { joint: joint(cut) },
        O::Reload { controller, text } => Action::Reload { name: controller, text },
        O::ScriptKilled { controller, reason } => Action::ScriptKilled { name: controller, reason },
        O::Say { text } => Action::Say { text },
    }
}
