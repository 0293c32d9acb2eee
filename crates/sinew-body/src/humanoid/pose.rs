//! A pose of the 18 bodies.

use super::node::LEGS;
use super::rotation::exp;
use super::{Body, Deviation, HipsDeviation, LegPose, Node, UPPER_NODES, solve_leg};
use glam::{DQuat, DVec3};
use sinew_snapshot::snapshot;

/// The pose of the 18 bodies: the hips' position and all world orientations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// The hips' origin in the world \[m\].
    pub hips_position: DVec3,
    /// `world_from_node` of the anatomical frames, by [`Node::index`].
    pub world: [DQuat; Node::COUNT],
}

snapshot!(Pose { hips_position, world });

/// [`Pose::STANDING`].
impl Default for Pose {
    fn default() -> Pose {
        Pose::STANDING
    }
}

impl Pose {
    /// Standing upright, arms hanging, facing +Z, hips at the origin.
    pub const STANDING: Pose = Pose { hips_position: DVec3::ZERO, world: [DQuat::IDENTITY; Node::COUNT] };

    /// `parent_from_node` of a node; for the hips `world_from_hips`.
    pub fn local(&self, node: Node) -> DQuat {
        match node.parent() {
            Some(parent) => self.world[parent.index()].conjugate() * self.world[node.index()],
            None => self.world[node.index()],
        }
    }

    /// The pose with these `parent_from_node` rotations (the hips': `world_from_hips`).
    pub fn from_locals(hips_position: DVec3, locals: &[DQuat; Node::COUNT]) -> Pose {
        let mut world = *locals;
        for node in Node::ALL {
            if let Some(parent) = node.parent() {
                world[node.index()] = (world[parent.index()] * locals[node.index()]).normalize();
            }
        }
        Pose { hips_position, world }
    }

    /// Position of every node's joint in the world \[m\].
    pub fn positions(&self, body: &Body) -> [DVec3; Node::COUNT] {
        let mut positions = [self.hips_position; Node::COUNT];
        for node in Node::ALL {
            if let Some(parent) = node.parent() {
                let offset = body.link(node).offset;
                positions[node.index()] = positions[parent.index()] + self.world[parent.index()] * offset;
            }
        }
        positions
    }

    /// This pose with a deviation on it (shifts in metres of the body), feet where this pose has them: what
    /// [`Overlay`](super::Overlay) does on a source skeleton.
    #[must_use]
    pub fn deviated(&self, body: &Body, deviation: &Deviation) -> Pose {
        let mut pose = *self;
        let wanted = HipsDeviation { shift: deviation.hips_shift, turn: deviation.hips_turn };
        let beside = deviation.foot_shifts.map(|shift| DVec3::ZERO - shift);
        let is_planted = wanted.is_none() && beside == [DVec3::ZERO; 2];
        let hips = if is_planted { wanted } else { wanted.held_beside(&self.legs(body), self.hips_position, beside) };
        pose.hips_position += hips.shift + deviation.ground_shift;
        let hips_turned = exp(hips.turn);
        let mut moved = [false; UPPER_NODES];
        if hips.turn != DVec3::ZERO {
            pose.world[0] = hips_turned * self.world[0];
            moved[0] = true;
        }
        for node in Node::ALL.into_iter().take(UPPER_NODES).skip(1) {
            let (at, parent) = (node.index(), node.parent().map_or(0, Node::index));
            moved[at] = moved[parent] || deviation.turns[at] != DVec3::ZERO;
            if moved[at] {
                pose.world[at] = (pose.world[parent] * (self.local(node) * exp(deviation.turns[at]))).normalize();
            }
        }
        if !is_planted {
            for (side, (leg, (upper, lower, _))) in self.legs(body).iter().zip(LEGS).enumerate() {
                let hip = self.hips_position + hips.shift + hips_turned * (leg.hip - self.hips_position) + beside[side];
                let (thigh, shank) = solve_leg(leg, hip, leg.ankle);
                pose.world[upper.index()] = (thigh * self.world[upper.index()]).normalize();
                pose.world[lower.index()] = (shank * self.world[lower.index()]).normalize();
            }
        }
        pose
    }

    /// Its legs in the world, left and right.
    pub fn legs(&self, body: &Body) -> [LegPose; 2] {
        let positions = self.positions(body);
        LEGS.map(|(upper, lower, foot)| {
            let [hip, knee, ankle] = [upper, lower, foot].map(|node| positions[node.index()]);
            LegPose { hip, knee, ankle, knee_axis: self.world[lower.index()] * DVec3::X }
        })
    }

    /// Turns the legs of this pose so that its feet are where `wanted` has them, when its hips are `wanted`'s turned by
    /// `hips_turned` (`world_from_world`) and then shifted.
    pub fn plant_feet(&mut self, body: &Body, wanted: &Pose, hips_shift: DVec3, hips_turned: DQuat) {
        for (leg, (upper, lower, _)) in wanted.legs(body).iter().zip(LEGS) {
            let hip = wanted.hips_position + hips_shift + hips_turned * (leg.hip - wanted.hips_position);
            let (thigh, shank) = solve_leg(leg, hip, leg.ankle);
            self.world[upper.index()] = (thigh * wanted.world[upper.index()]).normalize();
            self.world[lower.index()] = (shank * wanted.world[lower.index()]).normalize();
        }
    }

    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        self.hips_position.is_finite() && self.world.iter().all(|rotation| rotation.is_finite())
    }
}
