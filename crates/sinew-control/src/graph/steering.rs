//! What a state changes in its pose from how the body moves: balance feedback, upright parts, hips held in the world.

use super::spec::{LegSide, TurnAxis};
use crate::Target;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Node, exp};
use sinew_world::{CharacterFrame, Frame};

/// The steering of one state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Steering {
    pub(super) feedback: Vec<Feedback>,
    pub(super) upright: Vec<Node>,
    /// The leg that carries and the hips' wanted lean \[rad\], forward positive.
    pub(super) world_hips: Option<(LegSide, f64)>,
}

/// One rule of balance feedback.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Feedback {
    pub(super) joint: Node,
    pub(super) axis: TurnAxis,
    pub(super) from: Node,
    pub(super) rad_per_m: f64,
    pub(super) rad_per_m_s: f64,
}

/// Most that feedback turns a joint \[rad\]: beyond it the body falls anyway, and limbs should not wind themselves up.
const MOST_FEEDBACK: f64 = 1.2;

impl Steering {
    /// Changes a wanted pose that has been written. Feedback comes first, then parts measured in the world, then the hips.
    pub fn apply(&self, frame: &Frame, own: usize, target: &mut Target) {
        let Some(character) = frame.characters.get(own) else {
            return;
        };
        for rule in &self.feedback {
            rule.apply(character, target);
        }
        let world_from_facing = facing_turn(character);
        for node in &self.upright {
            hold_upright(*node, character, world_from_facing, target);
        }
        if let Some((stance, lean)) = self.world_hips {
            let (stance, swing) = match stance {
                LegSide::Left => (Node::LeftUpperLeg, Node::RightUpperLeg),
                LegSide::Right => (Node::RightUpperLeg, Node::LeftUpperLeg),
            };
            hold_upright(swing, character, world_from_facing, target);
            // A turn of the hips against the thigh that carries: as if the thigh stood still in the world.
            let world_from_hips = world_from_facing * exp(DVec3::X * lean);
            let thigh = character.part(stance);
            let joint = target.joint_mut(stance);
            joint.rotation = (world_from_hips.conjugate() * thigh.rotation).normalize();
            // And damped in the world: the thigh that turns under the hips does not drag them along.
            joint.velocity = finite(thigh.rotation.conjugate() * thigh.angular_velocity);
        }
    }
}

impl Feedback {
    fn apply(&self, character: &CharacterFrame, target: &mut Target) {
        let arm = character.centre_of_mass - character.part(self.from).position;
        let (along, axis) = match self.axis {
            TurnAxis::X => (character.facing, DVec3::X),
            TurnAxis::Z => (character.left(), DVec3::Z),
        };
        let turn = self.rad_per_m * arm.dot(along) + self.rad_per_m_s * character.centre_velocity.dot(along);
        if turn.is_finite() {
            let joint = target.joint_mut(self.joint);
            joint.rotation = (exp(axis * turn.clamp(-MOST_FEEDBACK, MOST_FEEDBACK)) * joint.rotation).normalize();
        }
    }
}

/// `world_from_facing`: upright, Z along the character's facing.
fn facing_turn(character: &CharacterFrame) -> DQuat {
    exp(DVec3::Y * libm::atan2(character.facing.x, character.facing.z))
}

/// Makes a part's wanted turn one in the world: what the pose says of it is measured from the upright facing frame.
fn hold_upright(node: Node, character: &CharacterFrame, world_from_facing: DQuat, target: &mut Target) {
    let Some(parent) = node.parent() else {
        return;
    };
    let parent = character.part(parent);
    let joint = target.joint_mut(node);
    let world_from_node = world_from_facing * joint.rotation;
    joint.rotation = (parent.rotation.conjugate() * world_from_node).normalize();
    // What is wanted in the world is damped in the world, whatever the parent does.
    joint.velocity -= finite(world_from_node.conjugate() * parent.angular_velocity);
}

fn finite(velocity: DVec3) -> DVec3 {
    if velocity.is_finite() { velocity } else { DVec3::ZERO }
}
