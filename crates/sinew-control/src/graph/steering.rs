//! Feedback on the pose of a state: balance feedback, upright parts, hips controlled in the world.

use super::spec::{LegSide, TurnAxis};
use crate::Wanted;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Node, exp, swing_twist};
use sinew_world::{CharacterFrame, CharacterId, Frame};

/// The steering of one state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Steering {
    pub(super) feedback: Vec<Feedback>,
    pub(super) upright: Vec<Node>,
    pub(super) world_hips: Option<WorldHips>,
}

/// Control of the hips in the world by the stance leg.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct WorldHips {
    pub(super) stance: LegSide,
    /// Lean \[rad\], forward positive.
    pub(super) lean: f64,
    /// About +Y from +Z to +X \[rad\]; the present facing when left out.
    pub(super) heading: Option<f64>,
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

/// Maximum rotation by feedback \[rad\]: beyond it the body falls anyway, and limbs should not wind up.
const MAX_FEEDBACK: f64 = 1.2;

/// Maximum rotation of the hips towards their heading at once \[rad\]: a stance foot cannot transmit more.
const MAX_TURN: f64 = 0.35;

impl Steering {
    /// Changes a wanted pose. Feedback comes first, then parts controlled in the world, then the hips.
    pub fn apply(&self, frame: &Frame, own: CharacterId, target: &mut Wanted) {
        let Some(character) = frame.character(own) else {
            return;
        };
        for rule in &self.feedback {
            rule.apply(character, target);
        }
        for node in &self.upright {
            hold_upright(*node, character, target);
        }
        if let Some(hips) = &self.world_hips {
            hips.apply(character, target);
        }
    }
}

impl WorldHips {
    fn apply(&self, character: &CharacterFrame, target: &mut Wanted) {
        let (stance, swing) = match self.stance {
            LegSide::Left => (Node::LeftUpperLeg, Node::RightUpperLeg),
            LegSide::Right => (Node::RightUpperLeg, Node::LeftUpperLeg),
        };
        hold_upright(swing, character, target);
        let facing = facing_of(character.part(Node::Hips).rotation);
        let turn = self.heading.map_or(0.0, |heading| {
            // The shorter arc.
            let left = heading - facing;
            libm::atan2(libm::sin(left), libm::cos(left)).clamp(-MAX_TURN, MAX_TURN)
        });
        let world_from_hips = exp(DVec3::Y * (facing + turn)) * exp(DVec3::X * self.lean);
        // A rotation of the hips relative to the stance thigh, as if the thigh were fixed in the world.
        let thigh = character.part(stance);
        let joint = target.joint_mut(stance);
        joint.rotation = (world_from_hips.conjugate() * thigh.rotation).normalize();
        // And damped in the world: the rotating thigh does not drag the hips along.
        joint.velocity = finite(thigh.rotation.conjugate() * thigh.angular_velocity);
    }
}

impl Feedback {
    fn apply(&self, character: &CharacterFrame, target: &mut Wanted) {
        let arm = character.centre_of_mass - character.part(self.from).position;
        let (along, axis) = match self.axis {
            TurnAxis::X => (character.facing, DVec3::X),
            TurnAxis::Z => (character.left(), DVec3::Z),
        };
        let turn = self.rad_per_m * arm.dot(along) + self.rad_per_m_s * character.centre_velocity.dot(along);
        if turn.is_finite() {
            let joint = target.joint_mut(self.joint);
            joint.rotation = (exp(axis * turn.clamp(-MAX_FEEDBACK, MAX_FEEDBACK)) * joint.rotation).normalize();
        }
    }
}

/// Heading of a part \[rad\].
fn facing_of(world_from_part: DQuat) -> f64 {
    swing_twist(world_from_part).2
}

/// Makes a part's target rotation one in the world: the pose's rotation is relative to an upright frame. That frame has
/// the parent's heading, so that rotations about the vertical still propagate from part to part: a stance leg holds the
/// body's heading.
fn hold_upright(node: Node, character: &CharacterFrame, target: &mut Wanted) {
    let Some(parent) = node.parent() else {
        return;
    };
    let parent = character.part(parent);
    let joint = target.joint_mut(node);
    let world_from_node = exp(DVec3::Y * facing_of(parent.rotation)) * joint.rotation;
    joint.rotation = (parent.rotation.conjugate() * world_from_node).normalize();
    // A target in the world is damped in the world, independent of the parent, except about the vertical.
    let turning = parent.angular_velocity - DVec3::Y * parent.angular_velocity.y;
    joint.velocity -= finite(world_from_node.conjugate() * turning);
}

fn finite(velocity: DVec3) -> DVec3 {
    if velocity.is_finite() { velocity } else { DVec3::ZERO }
}
