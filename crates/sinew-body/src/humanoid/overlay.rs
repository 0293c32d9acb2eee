//! The overlay: applies a deviation of the 18 bodies to the source's own joints.
//!
//! The result of a method is a *deviation* from the input. Joints that no node moves (fingers, toes, face, twist
//! helpers) keep their own local rotation; a spine or neck of several joints shares the deviation along its length;
//! both feet stay where the input has them, in place and orientation, and the legs are bent to reach them. Without a
//! deviation every joint keeps its value, bit for bit.

use super::hips::HipsDeviation;
use super::leg::{LegPose, solve_leg};
use super::node::LEGS;
use super::rotation::{exp, log};
use super::{Node, Pose, Reduction, UPPER_NODES};
use glam::{DQuat, DVec3};
use sinew_motion::Transform;

/// Rotations below this \[rad\] and shifts below this \[m\] count as no deviation: a hundredth of the last digit that a
/// motion file prints.
const NOTHING: f64 = 1e-10;

/// The deviation of a body from its input at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// The hips' shift in the world \[m of the clip\].
    pub hips_shift: DVec3,
    /// The hips' rotation: `world_from_hips` is rotated by the [`exp`] of this world vector \[rad\].
    pub hips_turn: DVec3,
    /// Shift of the ground that the body stands on \[m of the clip\]: hips and feet move with it.
    pub ground_shift: DVec3,
    /// Shift of the left and right foot against the ground that they stand on, world frame \[m of the clip\]; the leg follows.
    pub foot_shifts: [DVec3; 2],
    /// Per node of the upper body, a rotation vector in the node's own anatomical frame \[rad\]: the local rotation is the
    /// input's times its [`exp`]. The hips' entry is unused.
    pub turns: [DVec3; UPPER_NODES],
}

impl Deviation {
    /// No deviation: the input itself.
    pub const NONE: Deviation = Deviation {
        hips_shift: DVec3::ZERO,
        hips_turn: DVec3::ZERO,
        ground_shift: DVec3::ZERO,
        foot_shifts: [DVec3::ZERO; 2],
        turns: [DVec3::ZERO; UPPER_NODES],
    };

    /// The deviation at `fraction` between the middle two of four that follow each other at equal times: a cubic whose
    /// slope is continuous from one stretch to the next (Catmull-Rom).
    pub fn cubic(around: [&Deviation; 4], fraction: f64) -> Deviation {
        let (t, t2, t3) = (fraction, fraction * fraction, fraction * fraction * fraction);
        let weights = [
            0.5 * (-t3 + 2.0 * t2 - t),
            0.5 * (3.0 * t3 - 5.0 * t2 + 2.0),
            0.5 * (-3.0 * t3 + 4.0 * t2 + t),
            0.5 * (t3 - t2),
        ];
        let mix = |of: &dyn Fn(&Deviation) -> DVec3| -> DVec3 {
            around.iter().zip(weights).map(|(deviation, weight)| of(deviation) * weight).sum()
        };
        Deviation {
            hips_shift: mix(&|deviation| deviation.hips_shift),
            hips_turn: mix(&|deviation| deviation.hips_turn),
            ground_shift: mix(&|deviation| deviation.ground_shift),
            foot_shifts: std::array::from_fn(|foot| mix(&|deviation| deviation.foot_shifts[foot])),
            turns: std::array::from_fn(|node| mix(&|deviation| deviation.turns[node])),
        }
    }

    /// The deviation as far on from `from` to this one as these are apart: the neighbour for a [`cubic`](Deviation::cubic) at an end.
    pub fn beyond(&self, from: &Deviation) -> Deviation {
        let on = |end: DVec3, from: DVec3| end * 2.0 - from;
        Deviation {
            hips_shift: on(self.hips_shift, from.hips_shift),
            hips_turn: on(self.hips_turn, from.hips_turn),
            ground_shift: on(self.ground_shift, from.ground_shift),
            foot_shifts: std::array::from_fn(|foot| on(self.foot_shifts[foot], from.foot_shifts[foot])),
            turns: std::array::from_fn(|node| on(self.turns[node], from.turns[node])),
        }
    }

    /// The same with scaled shifts: metres of the clip from metres of the body.
    pub fn with_shifts_scaled(&self, scale: f64) -> Deviation {
        Deviation {
            hips_shift: self.hips_shift * scale,
            ground_shift: self.ground_shift * scale,
            foot_shifts: self.foot_shifts.map(|shift| shift * scale),
            ..*self
        }
    }
}

/// Applies deviations to a skeleton's joints; keeps its scratch memory, so that applying does not allocate.
#[derive(Clone, Debug)]
pub struct Overlay<'a> {
    reduction: &'a Reduction,
    /// Per joint, the change of its world orientation: `world_from_world`.
    deltas: Vec<DQuat>,
    /// Per joint, the node or chain share that sets its delta.
    roles: Vec<Role>,
    /// The joint whose translation shifts the body: the hips' nearest ancestor-or-self that may move.
    mover: usize,
}

#[derive(Clone, Copy, Debug)]
enum Role {
    /// Turns with its parent.
    Follow,
    Node(usize),
    /// Carries this share of the chest's turn against the hips.
    Spine(f64),
    /// Carries this share of the head's turn against the chest.
    Neck(f64),
}

impl<'a> Overlay<'a> {
    /// An overlay for the skeleton that `reduction` was made for; `moving` are the joints whose translation may change,
    /// of which the hips or one of its ancestors must be one (otherwise shifts are ignored).
    pub fn new(reduction: &'a Reduction, moving: &[usize]) -> Overlay<'a> {
        let joints = reduction.parents.len();
        let mut roles = vec![Role::Follow; joints];
        for node in Node::ALL {
            if let Some(carrier) = reduction.carriers[node.index()] {
                roles[carrier.joint] = Role::Node(node.index());
            }
        }
        for &(joint, share) in &reduction.spine {
            roles[joint] = Role::Spine(share);
        }
        for &(joint, share) in &reduction.neck {
            roles[joint] = Role::Neck(share);
        }
        let mut mover = reduction.carriers[0].map_or(0, |carrier| carrier.joint);
        while !moving.contains(&mover)
            && let Some(parent) = reduction.parents[mover]
        {
            mover = parent;
        }
        Overlay { reduction, deltas: vec![DQuat::IDENTITY; joints], roles, mover }
    }

    /// Applies a deviation to one frame: `world` is the input's `world_from_joint`, `changed` is called for each joint
    /// whose local rotation or translation is no longer the input's, with the new rotation or, for the joint that
    /// shifts the body, the new translation.
    pub fn apply(
        &mut self,
        world: &[Transform],
        deviation: &Deviation,
        mut rotated: impl FnMut(usize, DQuat),
        mut moved: impl FnMut(usize, DVec3),
    ) {
        let input = self.reduction.orientations(world);
        let (turned, shift) = self.planted(world, &input, deviation);
        self.write(world, &turned, shift + deviation.ground_shift, &mut rotated, &mut moved);
    }

    /// Gives the joints a pose of the body (positions in metres of the body) instead: every joint that carries a node has its
    /// orientation, and the hips' joint its place. `world` is the `world_from_joint` of the frame from which all other joints have what no
    /// node says: fingers and toes, the twist of helpers, the bend between spine joints. Feet are where the skeleton's own legs bring
    /// them. `rotated` and `moved` are called as by [`Overlay::apply`].
    pub fn apply_pose(
        &mut self,
        world: &[Transform],
        pose: &Pose,
        mut rotated: impl FnMut(usize, DQuat),
        mut moved: impl FnMut(usize, DVec3),
    ) {
        let input = self.reduction.orientations(world);
        let turned = Turned::between(&input, &pose.world);
        let hips = self.reduction.joint(Node::Hips).unwrap_or(0);
        let shift = pose.hips_position / self.reduction.scale() - self.carried(world, hips, &turned);
        self.write(world, &turned, shift, &mut rotated, &mut moved);
    }

    /// Turns every joint as its role says, and shifts the body.
    fn write(
        &mut self,
        world: &[Transform],
        turned: &Turned,
        shift: DVec3,
        rotated: &mut impl FnMut(usize, DQuat),
        moved: &mut impl FnMut(usize, DVec3),
    ) {
        for (joint, transform) in world.iter().enumerate() {
            let parent = self.reduction.parents[joint];
            let parent_delta = parent.map_or(DQuat::IDENTITY, |parent| self.deltas[parent]);
            let delta = turned.delta(self.roles[joint]).unwrap_or(parent_delta);
            if log(parent_delta.conjugate() * delta).length() > NOTHING {
                self.deltas[joint] = delta;
                let new_world = delta * transform.rotation;
                let new_parent = parent.map_or(DQuat::IDENTITY, |parent| parent_delta * world[parent].rotation);
                rotated(joint, (new_parent.conjugate() * new_world).normalize());
            } else {
                self.deltas[joint] = parent_delta;
            }
        }
        if shift.length() > NOTHING {
            let parent = self.reduction.parents[self.mover].map(|parent| world[parent]);
            let parent = parent.unwrap_or(Transform::IDENTITY);
            let position = world[self.mover].translation + shift;
            moved(self.mover, parent.inverse().point(position));
        }
    }

    /// The changes with both legs bent so that the feet stay where the input has them, or are shifted from there, and the hips' shift. Their deviation is
    /// what the source's own legs allow, which may differ by millimetres from the body's.
    fn planted(&self, world: &[Transform], input: &[DQuat; Node::COUNT], deviation: &Deviation) -> (Turned, DVec3) {
        let at = |node: Node| Some(world[self.reduction.joint(node)?].translation);
        let leg = |(upper, lower, foot): (Node, Node, Node)| {
            let knee_axis = input[lower.index()] * DVec3::X;
            Some(LegPose { hip: at(upper)?, knee: at(lower)?, ankle: at(foot)?, knee_axis })
        };
        let wanted = HipsDeviation { shift: deviation.hips_shift, turn: deviation.hips_turn };
        let mut turned = Turned::of(input, deviation);
        let legs = leg(LEGS[0]).zip(leg(LEGS[1])).zip(at(Node::Hips));
        let Some(((left, right), joint)) = legs else { return (turned, wanted.shift) };
        let legs = [left, right];
        let carried = |side: usize, turned: &Turned| {
            let hip = self.reduction.joint(LEGS[side].0);
            hip.map_or(legs[side].hip, |hip| self.carried(world, hip, turned))
        };
        // Where the legs are attached to the spine, the trunk moves them too.
        let beside = [0, 1].map(|side| {
            let moved = carried(side, &turned) - joint - exp(wanted.turn) * (legs[side].hip - joint);
            if moved.length() > NOTHING { moved } else { DVec3::ZERO }
        });
        // A foot that moves away is to its leg what a hip is that moves the other way.
        let beside: [DVec3; 2] = std::array::from_fn(|side| beside[side] - deviation.foot_shifts[side]);
        if wanted.is_none() && beside == [DVec3::ZERO; 2] {
            return (turned, wanted.shift);
        }
        let hips = wanted.held_beside(&legs, joint, beside);
        turned = Turned::of(input, &Deviation { hips_turn: hips.turn, ..*deviation });
        for (side, (upper, lower, _)) in LEGS.into_iter().enumerate() {
            let hip = carried(side, &turned) + hips.shift - deviation.foot_shifts[side];
            let (thigh, shank) = solve_leg(&legs[side], hip, legs[side].ankle);
            turned.nodes[upper.index()] = thigh;
            turned.nodes[lower.index()] = shank;
        }
        (turned, hips.shift)
    }

    /// Position of a joint under the rotations of the joints above it \[m\]. Most rigs attach the legs to the hips,
    /// some to the spine.
    fn carried(&self, world: &[Transform], joint: usize, turned: &Turned) -> DVec3 {
        let mut moved = DVec3::ZERO;
        let mut at = joint;
        while let Some(parent) = self.reduction.parents[at] {
            let delta = self.delta(parent, turned);
            if delta != DQuat::IDENTITY {
                let arm = world[at].translation - world[parent].translation;
                moved += delta * arm - arm;
            }
            at = parent;
        }
        world[joint].translation + moved
    }

    /// The change of a joint's world orientation.
    fn delta(&self, joint: usize, turned: &Turned) -> DQuat {
        let mut at = Some(joint);
        while let Some(joint) = at {
            if let Some(delta) = turned.delta(self.roles[joint]) {
                return delta;
            }
            at = self.reduction.parents[joint];
        }
        DQuat::IDENTITY
    }
}

/// The change of every node's world orientation, `world_from_world`.
struct Turned {
    nodes: [DQuat; Node::COUNT],
    chest_against_hips: DVec3,
    head_against_chest: DVec3,
}

impl Turned {
    /// Legs and feet do not change.
    fn of(input: &[DQuat; Node::COUNT], deviation: &Deviation) -> Turned {
        let mut output = *input;
        let mut nodes = [DQuat::IDENTITY; Node::COUNT];
        nodes[0] = exp(deviation.hips_turn);
        output[0] = nodes[0] * input[0];
        for node in Node::ALL.into_iter().take(UPPER_NODES).skip(1) {
            let (at, parent) = (node.index(), node.parent().map_or(0, Node::index));
            let turn = deviation.turns[at];
            if turn.length() <= NOTHING {
                // Exactly the parent's change, so that an unchanged joint keeps its last bit.
                nodes[at] = nodes[parent];
                output[at] = nodes[at] * input[at];
            } else {
                output[at] = (output[parent] * (input[parent].conjugate() * input[at]) * exp(turn)).normalize();
                nodes[at] = (output[at] * input[at].conjugate()).normalize();
            }
        }
        Turned::of_nodes(nodes)
    }

    /// From one pose's orientations to another's.
    fn between(input: &[DQuat; Node::COUNT], output: &[DQuat; Node::COUNT]) -> Turned {
        Turned::of_nodes(std::array::from_fn(|node| (output[node] * input[node].conjugate()).normalize()))
    }

    fn of_nodes(nodes: [DQuat; Node::COUNT]) -> Turned {
        let (hips, chest) = (nodes[0], nodes[Node::Chest.index()]);
        let head = nodes[Node::Head.index()];
        Turned {
            nodes,
            chest_against_hips: log(hips.conjugate() * chest),
            head_against_chest: log(chest.conjugate() * head),
        }
    }

    /// The change of a joint of this role; `None` for one that rotates with its parent.
    fn delta(&self, role: Role) -> Option<DQuat> {
        match role {
            Role::Follow => None,
            Role::Node(node) => Some(self.nodes[node]),
            Role::Spine(share) => Some(self.nodes[0] * exp(self.chest_against_hips * share)),
            Role::Neck(share) => Some(self.nodes[Node::Chest.index()] * exp(self.head_against_chest * share)),
        }
    }
}
