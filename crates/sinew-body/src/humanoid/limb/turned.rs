//! Inverse kinematics of an arm or a leg with a goal for position and orientation of the hand or foot: seven degrees of
//! freedom.

use super::aim::{Aim, Flexed};
use super::hinge::{Hinge, Side};
use super::sweep::Sweep;
use super::{Limb, LimbGoal, LimbTurns, place, swivel};
use crate::humanoid::rotation::{exp, log, swing_twist};
use crate::humanoid::{Body, Swing};
use glam::{DQuat, DVec3};

/// The joint rotations that bring a limb to its goal and its hand or foot to the wanted orientation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurnedLimb {
    /// Upper and lower bone. The forearm's twist, which rotates the hand, is in `turns.lower`.
    pub turns: LimbTurns,
    /// `parent_from_node` of the hand or foot, inside its limit. A wrist does not twist about the forearm's axis, an
    /// ankle does.
    pub end: DQuat,
    /// Remaining angle between the orientation of the hand or foot and the wanted one \[rad\].
    pub end_miss_rad: f64,
}

/// Weight of the upper joint's limit relative to the wrist's or ankle's, if both cannot be kept.
const UPPER_WEIGHT: f64 = 4.0;

/// Position error above which a limb that cannot reach the orientation searches for the position once more \[m\].
const MISSED: f64 = 1e-9;

/// The joint rotations that bring a limb to its goal with the orientation `world_from_end` of the hand or foot;
/// `goal.end` is not read. `None` when a number is not finite or the limb has no length.
///
/// The wrist's place follows from the goal, the elbow's flexion from the wrist's distance, and the swivel is the
/// nearest to `goal.near` at which the shoulder, the forearm's turn and the wrist all stay inside their limits; a limb
/// that is too short keeps the orientation and misses the position. If no swivel is inside, position has priority over
/// orientation: the hand is rotated as far as its joints allow, and the effector still reaches the target if it can.
///
/// ```
/// use glam::{DQuat, DVec3};
/// use sinew_body::humanoid::{Body, Limb, LimbGoal, exp, solve_limb_turned};
///
/// let body = Body::standard(80.0, 1.7);
/// // The left palm faces down at the height of the elbow, 40 cm in front of the shoulder.
/// let goal = LimbGoal {
///     joint: DVec3::new(0.19, 1.4, 0.0),
///     world_from_parent: DQuat::IDENTITY,
///     end: DQuat::IDENTITY,
///     effector: DVec3::ZERO,
///     target: DVec3::new(0.19, 1.15, 0.4),
///     near: [DQuat::IDENTITY; 2],
/// };
/// let hand = exp(DVec3::X * -1.5) * exp(DVec3::Y * -1.5);
/// let solved = solve_limb_turned(&body, Limb::LeftArm, &goal, hand).expect("a sound goal");
/// assert!(solved.turns.miss_m < 1e-9 && solved.end_miss_rad < 1e-9);
/// ```
pub fn solve_limb_turned(body: &Body, limb: Limb, goal: &LimbGoal, world_from_end: DQuat) -> Option<TurnedLimb> {
    if !goal.is_finite() || !world_from_end.is_finite() {
        return None;
    }
    let world_from_end = world_from_end.normalize();
    let mut found = turned_once(body, limb, goal, world_from_end)?;
    // A forearm whose wrist is beside its own line, as captured ones are, moves the wrist as it turns about itself: the bend is found
    // for the turn that came out, until both agree. Each round leaves a few hundredths of what was missed.
    let wrist = body.link(limb.nodes()[2]).offset;
    if limb.is_leg() || wrist.x * wrist.x + wrist.z * wrist.z <= ON_LINE_M * ON_LINE_M {
        return Some(found);
    }
    for _ in 0..ROUNDS {
        let goal = LimbGoal { near: [goal.near[0], found.turns.lower], ..*goal };
        let again = turned_once(body, limb, &goal, world_from_end)?;
        let settled = log(found.turns.lower.conjugate() * again.turns.lower).length() < SETTLED_RAD;
        found = again;
        if settled {
            break;
        }
    }
    Some(found)
}

/// A wrist so near to the forearm's line is on it \[m\].
const ON_LINE_M: f64 = 1e-9;

/// Rounds in which bend and turn of a forearm come to agree, and the change at which they do \[rad\].
const ROUNDS: usize = 12;
const SETTLED_RAD: f64 = 1e-12;

fn turned_once(body: &Body, limb: Limb, goal: &LimbGoal, world_from_end: DQuat) -> Option<TurnedLimb> {
    let [upper, lower, end] = limb.nodes();
    let elbow = body.link(lower).offset;
    let hinge = Hinge::new(&body.link(lower).limit, limb, goal.near[1], elbow, body.link(end).offset);
    if !hinge.is_sound() {
        return None;
    }
    let wrist = LimbGoal { target: goal.target - world_from_end * goal.effector, ..*goal };
    let aim = Aim::new(&wrist, elbow, body.link(end).offset);
    // The hand in the frame of what the limb hangs from.
    let hand = goal.world_from_parent.conjugate() * world_from_end;
    let (upper_limit, end_limit) = (&body.link(upper).limit, &body.link(end).limit);
    let twist_range = body.link(lower).limit.twist;
    let sweeps = |way: &Flexed| {
        let wrist = if limb.is_leg() {
            let left = end_limit.centre.conjugate() * (way.straight * way.flexion).conjugate();
            Sweep::new(left, -way.to, hand, &end_limit.swing, end_limit.twist)
        } else {
            // From the hand to the bent elbow: a swing, the wrist's backward, and a twist, the forearm's backward.
            let range = (-twist_range.1, -twist_range.0);
            Sweep::new(hand.conjugate(), way.to, way.straight * way.flexion, &backward(&end_limit.swing), range)
        };
        [way.upper_sweep(upper_limit), wrist]
    };
    let fits = |way: &Flexed| swivel::nearest(&sweeps(way));
    let soft = hinge.softened(aim.distance);
    let bent = aim.flexed(&hinge, Side::Bent, soft)?;
    let found = fits(&bent).map(|angle| (angle, bent)).or_else(|| aim.straighter(&hinge, soft, fits));
    let fitted = found.is_some();
    let (angle, way) = found.unwrap_or_else(|| {
        let [shoulder, wrist] = sweeps(&bent);
        (swivel::least(&[(shoulder, UPPER_WEIGHT), (wrist, 1.0)]), bent)
    });
    let wanted = way.swivelled(angle);
    let upper_turn = upper_limit.clamp(wanted);
    let end_in_elbow = (upper_turn * way.flexion).conjugate() * hand;
    let (lower_turn, end_turn) = if limb.is_leg() {
        (way.flexion, end_limit.clamp(end_in_elbow))
    } else {
        let (x, z, twist) = swing_twist(end_in_elbow.conjugate());
        let carried = exp(DVec3::Y * (-twist).clamp(twist_range.0, twist_range.1));
        ((way.flexion * carried).normalize(), end_limit.clamp(exp(DVec3::new(-x, 0.0, -z))))
    };
    let in_lower = body.link(end).offset + end_turn * goal.effector;
    let arrived = upper_turn * (elbow + lower_turn * in_lower);
    let line = goal.world_from_parent.conjugate() * (goal.target - goal.joint);
    let turns = LimbTurns {
        upper: upper_turn,
        lower: lower_turn,
        miss_m: (arrived - line).length(),
        excess_rad: upper_limit.excess(wanted),
    };
    let solved = |turns: LimbTurns| TurnedLimb {
        turns,
        end: end_turn,
        end_miss_rad: log((turns.upper * turns.lower * end_turn).conjugate() * hand).length(),
    };
    let first = solved(turns);
    if fitted || turns.miss_m <= MISSED {
        return Some(first);
    }
    let again = LimbGoal { end: end_turn, near: [upper_turn, lower_turn], ..*goal };
    place(body, limb, &again, |hinge| hinge.side_of(lower_turn)).map(solved)
}

/// The ellipse of the turns the other way.
fn backward(swing: &Swing) -> Swing {
    Swing {
        x_negative: swing.x_positive,
        x_positive: swing.x_negative,
        z_negative: swing.z_positive,
        z_positive: swing.z_negative,
    }
}
