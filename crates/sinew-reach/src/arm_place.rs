//! The arm in closed form: carried, on its path, or at its target.

use crate::compose::{ARMS, ArmNow, Composed, Now};
use crate::frame::Frame;
use crate::head::soft;
use crate::spine::wrapped;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Limb, LimbGoal, Limit, Node, exp, log, solve_limb, swing_twist};

const ARM_LIMBS: [Limb; 2] = [Limb::LeftArm, Limb::RightArm];

/// The carried arm in the parameters of the reaching one.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Carried {
    swivel: f64,
    pronation: f64,
    /// Its difference from the default arm: rotation vectors of upper and lower arm.
    missing: [DVec3; 2],
}

/// How far carried arms, which keep hanging down as the trunk bends, come forward and back, outward, and across the trunk \[rad\].
const MAX_HANG_RAD: f64 = 2.6;
const MAX_OUTWARD_RAD: f64 = 1.8;
const MAX_ACROSS_RAD: f64 = 0.3;

/// An instant of the whole body in which one arm is replaced.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moment {
    pub arm: ArmNow,
    carried: Carried,
    pub composed: Composed,
}

impl Frame {
    /// An instant of the whole body, in which one arm is replaced.
    pub fn moment(&self, side: usize, now: &Now) -> Moment {
        let composed = self.compose(now);
        let mut arm = now.arms[side];
        let hang = self.hang(side, &arm, composed.pose.world[Node::Chest.index()], now.swing);
        arm.carried[1] = (hang * arm.carried[1]).normalize();
        Moment { arm, carried: self.carried(side, &arm).unwrap_or_default(), composed }
    }

    /// Replaces that arm by `moment.arm`; the rest of the body stays, though its balance would change by millimetres.
    pub fn place_again(&self, side: usize, moment: &mut Moment) {
        let pose = &moment.composed.pose;
        let (hips, chest) = (pose.world[0], pose.world[Node::Chest.index()]);
        let chest_at = pose.hips_position + hips * self.body.link(Node::Chest).offset;
        self.place_arm(side, &moment.arm, &moment.carried, (chest_at, chest), &mut moment.composed);
    }

    /// The rotation of a carried upper arm that keeps it hanging down as the trunk bends, clear of the body.
    pub fn hang(&self, side: usize, arm: &ArmNow, chest: DQuat, swing: DVec3) -> DQuat {
        let girdle = chest * arm.carried[0] * exp(arm.girdle);
        let hang = -(girdle.conjugate() * swing);
        let outward = if side == 0 { 1.0 } else { -1.0 };
        let aside = outward * hang.z;
        let most = if aside > 0.0 { MAX_OUTWARD_RAD } else { MAX_ACROSS_RAD };
        exp(DVec3::new(soft(hang.x, MAX_HANG_RAD), 0.0, outward * (soft(aside, most) + arm.clear)))
    }

    /// Upper and lower arm for a hand at a point, by the default rotation and a swivel.
    pub fn arm(
        &self,
        side: usize,
        parent: (DVec3, DQuat),
        target: DVec3,
        hand: DQuat,
        swivel: f64,
        pronation: f64,
    ) -> Option<(DQuat, DQuat)> {
        let goal = LimbGoal {
            joint: parent.0,
            world_from_parent: parent.1,
            end: hand,
            effector: self.effector[side],
            target,
            near: [self.usual[side], exp(DVec3::X * -0.3) * exp(DVec3::Y * pronation)],
        };
        let turns = solve_limb(&self.free, ARM_LIMBS[side], &goal)?;
        let line = (parent.1.conjugate() * (target - parent.0)).try_normalize()?;
        Some(((exp(line * swivel) * turns.upper).normalize(), turns.lower))
    }

    /// The arm at a target, its hand turned against the forearm; `parent_from_node` of upper and lower arm.
    pub fn arm_to(
        &self,
        side: usize,
        parent: (DVec3, DQuat),
        target: DVec3,
        swivel: f64,
        wrist: DVec3,
    ) -> Option<(DQuat, DQuat)> {
        let line = target - parent.0;
        let distance = line.length().max(1e-9);
        let target = parent.0 + line * (self.within_reach(side, exp(wrist), distance) / distance);
        self.arm(side, parent, target, exp(wrist), swivel, 0.0)
    }

    /// Distances \[1 of the arm's length\] between which a hand arrives exactly.
    pub fn exact_stretch(&self) -> (f64, f64) {
        (1.2 * self.folded_m / self.values.arm_m, self.values.stretch.1)
    }

    /// Soft clamp of the distance from shoulder to hand \[m\]: below full extension, where the arm would snap straight,
    /// and above what the folded arm allows.
    fn within_reach(&self, side: usize, hand: DQuat, distance: f64) -> f64 {
        // A hand that is bent at the wrist reaches less far.
        let offset = |node: Node| self.body.link(node).offset;
        let lower = offset(ARMS[side][3]) + hand * self.effector[side];
        let arm = offset(ARMS[side][2]).length() + lower.length();
        let (far, most) = (self.values.stretch.1 * arm, 0.988 * arm);
        let (near, least) = (1.2 * self.folded_m, 1.03 * self.folded_m);
        if distance > far {
            far + (most - far) * libm::tanh((distance - far) / (most - far))
        } else if distance < near {
            near - (near - least) * libm::tanh((near - distance) / (near - least))
        } else {
            distance
        }
    }

    /// The carried arm in closed form, with the remaining difference.
    pub fn carried(&self, side: usize, arm: &ArmNow) -> Option<Carried> {
        if arm.share <= 0.0 {
            return None;
        }
        let [_, upper_turn, lower_turn, hand_turn] = arm.carried;
        let lower = upper_turn * lower_turn;
        let wrist = upper_turn * self.body.link(ARMS[side][2]).offset + lower * self.body.link(ARMS[side][3]).offset;
        let at = wrist + lower * hand_turn * self.effector[side];
        let distance = at.length().max(1e-9);
        let at = at * (self.within_reach(side, hand_turn, distance) / distance);
        let pronation = swing_twist(lower_turn).2;
        let (usual, bent) = self.arm(side, (DVec3::ZERO, DQuat::IDENTITY), at, hand_turn, 0.0, pronation)?;
        let line = at.try_normalize()?;
        let turn = upper_turn * usual.conjugate();
        let swivel = wrapped(2.0 * libm::atan2(DVec3::new(turn.x, turn.y, turn.z).dot(line), turn.w));
        let turned = exp(line * swivel) * usual;
        let missing = [log(turned.conjugate() * upper_turn), log(bent.conjugate() * lower_turn)];
        Some(Carried { swivel, pronation, missing })
    }

    pub fn place_arm(
        &self,
        side: usize,
        arm: &ArmNow,
        start: &Carried,
        chest: (DVec3, DQuat),
        composed: &mut Composed,
    ) {
        let [shoulder, upper, lower, hand] = ARMS[side];
        let mut set = |node: Node, world: DQuat| composed.pose.world[node.index()] = world.normalize();
        let girdle = chest.1 * (arm.carried[0] * exp(arm.girdle));
        let joint = chest.0 + chest.1 * self.body.link(shoulder).offset + girdle * self.body.link(upper).offset;
        let reach_upper = girdle * arm.carried[1];
        let reach_lower = reach_upper * arm.carried[2];
        let wrist = joint + reach_upper * self.body.link(lower).offset + reach_lower * self.body.link(hand).offset;
        let carried = wrist + reach_lower * arm.carried[3] * self.effector[side];
        set(shoulder, girdle);
        composed.shoulders[side] = joint;
        composed.stretch[side] = (arm.target - joint).length() / self.values.arm_m;
        if arm.share > 0.0 {
            let s = arm.share;
            let bowed = 4.0 * s * (1.0 - s);
            let wanted = carried + (arm.target - carried) * s + arm.bow * bowed;
            let line = wanted - joint;
            let distance = line.length().max(1e-9);
            let turn = between(arm.carried[3], exp(arm.wrist), s);
            let wanted = joint + line * (self.within_reach(side, turn, distance) / distance);
            let swivel = start.swivel + wrapped(arm.swivel - start.swivel) * s;
            let pronation = start.pronation + (arm.pronation - start.pronation) * s;
            if let Some((one, other)) = self.arm(side, (joint, girdle), wanted, turn, swivel, pronation) {
                let left = (1.0 - s) * (1.0 - s) * (1.0 - s);
                let mut bones = [one * exp(start.missing[0] * left), other * exp(start.missing[1] * left)];
                if arm.by_joints > 0.0 {
                    for (bone, node) in [upper, lower].into_iter().enumerate() {
                        let limit = &self.body.link(node).limit;
                        let way = within(limit, arm.carried[1 + bone], arm.end[bone], s);
                        bones[bone] = within(limit, bones[bone], way, arm.by_joints);
                    }
                }
                let one = girdle * bones[0];
                let other = one * bones[1];
                set(upper, one);
                set(lower, other);
                set(hand, other * turn);
                let wrist = joint + one * self.body.link(lower).offset + other * self.body.link(hand).offset;
                composed.hands[side] = wrist + other * turn * self.effector[side];
                return;
            }
        }
        set(upper, reach_upper);
        set(lower, reach_lower);
        set(hand, reach_lower * arm.carried[3]);
        composed.hands[side] = carried;
    }
}

/// Interpolates between two rotations of a joint by swing and twist from the middle of its range: the range is convex
/// in them, so that between two rotations inside it all are inside.
fn within(limit: &Limit, from: DQuat, to: DQuat, share: f64) -> DQuat {
    let of = |turn: DQuat| swing_twist(limit.centre.conjugate() * turn);
    let ((x, z, twist), (to_x, to_z, to_twist)) = (of(from), of(to));
    let at = |from: f64, to: f64| from + (to - from) * share;
    limit.centre * exp(DVec3::new(at(x, to_x), 0.0, at(z, to_z))) * exp(DVec3::Y * at(twist, to_twist))
}

/// Interpolates between two rotations along the shorter arc.
pub(crate) fn between(from: DQuat, to: DQuat, share: f64) -> DQuat {
    (from * exp(log(from.conjugate() * to) * share)).normalize()
}
