//! Calibration: anatomical frames for a skeleton whose own joint frames are arbitrary.
//!
//! Every rig rotates its joints from its own rest pose: a T-pose, arms hanging, or (in captures exported without one)
//! bones stacked along local axes. Limits, hinge axes and inertias need anatomical frames. They are found from
//! geometry: a standing *reference* (the rest pose where it is a plausible one, else the clip's straightest standing
//! frame), the directions of the bones, and, for limbs, the axis about which the elbow or knee is seen to bend in the
//! clip, which fixes the twist of the bone better than any rest pose. Feet are level while they stand in the clip.

use super::Node;
use super::flat_foot::flat_foot;
use glam::{DMat3, DQuat, DVec3};
use sinew_motion::{Clip, Humanoid, Part, Transform};

/// Maximum number of sampled frames: enough to see an elbow bend, few enough to cost nothing.
const SAMPLES: usize = 200;

/// Mean sine of the bend below which a hinge axis is not trusted: a limb bent by less than about 8 degrees.
const MIN_BEND: f64 = 0.14;

/// Minimum concentration of hinge axes for averaging: length of their mean over their mean length.
const MIN_AGREEMENT: f64 = 0.7;

/// World poses of a skeleton for measuring.
pub(super) struct Samples {
    /// Up to [`SAMPLES`] frames of the clip, each `world_from_joint`.
    frames: Vec<Vec<Transform>>,
    /// The frame in which the body stands best: the rest pose or one of the clip's.
    pub reference: Vec<Transform>,
}

/// Position of a part; the end of the limb if the part itself is missing.
pub(super) fn position(world: &[Transform], clip: &Clip, humanoid: &Humanoid, part: Part) -> Option<DVec3> {
    match humanoid.joint(part) {
        Some(joint) => Some(world[joint].translation),
        None => {
            let parent = humanoid.joint(part.parent()?)?;
            clip.skeleton().end(parent).map(|tip| world[parent].point(tip))
        }
    }
}

impl Samples {
    pub(super) fn of(clip: &Clip, humanoid: &Humanoid) -> Samples {
        let count = clip.frames().clamp(1, SAMPLES);
        let frames: Vec<Vec<Transform>> = if clip.frames() == 0 {
            vec![clip.skeleton().rest_world()]
        } else {
            (0..count).map(|index| clip.world(index * clip.frames() / count)).collect()
        };
        let rest = clip.skeleton().rest_world();
        let reference = if misfit(&rest, clip, humanoid).is_some_and(|misfit| misfit < 1.0) {
            rest
        } else {
            frames
                .iter()
                .filter_map(|world| Some((misfit(world, clip, humanoid)?, world)))
                .min_by(|a, b| a.0.total_cmp(&b.0))
                .map_or_else(|| frames[0].clone(), |(_, world)| world.clone())
        };
        Samples { frames, reference }
    }

    /// The sampled frames.
    pub(super) fn frames(&self) -> impl Iterator<Item = &[Transform]> {
        self.frames.iter().map(Vec::as_slice)
    }

    /// The mean over the frames of a vector measured in each.
    pub(super) fn mean(&self, measure: impl Fn(&[Transform]) -> Option<DVec3>) -> Option<DVec3> {
        let (mut sum, mut count) = (DVec3::ZERO, 0usize);
        for world in &self.frames {
            if let Some(value) = measure(world).filter(|value| value.is_finite()) {
                sum += value;
                count += 1;
            }
        }
        (count > 0).then(|| sum / count as f64)
    }
}

impl Samples {
    /// The mean over the frames of `joint_from_frame`, where `frame` is fixed to another joint.
    fn mean_rotation(&self, joint: usize, (other, other_from_frame): (usize, DQuat)) -> Option<DQuat> {
        let mut sum = DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0);
        for world in &self.frames {
            let rotation = world[joint].rotation.conjugate() * world[other].rotation * other_from_frame;
            sum = if sum.dot(rotation) < 0.0 { sum - rotation } else { sum + rotation };
        }
        (sum.length() > 1e-9).then(|| sum.normalize())
    }
}

/// Deviation of a pose from standing upright with straight legs, 1 at the limit of the plausible; `None` if it cannot
/// be measured.
fn misfit(world: &[Transform], clip: &Clip, humanoid: &Humanoid) -> Option<f64> {
    let at = |part| position(world, clip, humanoid, part);
    let hips = (at(Part::LeftUpperLeg)? + at(Part::RightUpperLeg)?) * 0.5;
    let top = at(Part::Neck).or_else(|| at(Part::Head))?;
    let angle =
        |vector: DVec3, from: DVec3| vector.try_normalize().map(|unit| libm::acos(unit.dot(from).clamp(-1.0, 1.0)));
    let left_leg = angle(at(Part::LeftFoot)? - at(Part::LeftUpperLeg)?, DVec3::NEG_Y)?;
    let right_leg = angle(at(Part::RightFoot)? - at(Part::RightUpperLeg)?, DVec3::NEG_Y)?;
    let trunk = angle(top - hips, DVec3::Y)?;
    let bend =
        |knee: Part, hip: Part, foot: Part| angle(at(knee)? - at(hip)?, (at(foot)? - at(knee)?).try_normalize()?);
    let knees = bend(Part::LeftLowerLeg, Part::LeftUpperLeg, Part::LeftFoot)?
        + bend(Part::RightLowerLeg, Part::RightUpperLeg, Part::RightFoot)?;
    let hip_line = (at(Part::LeftUpperLeg)? - at(Part::RightUpperLeg)?).try_normalize()?;
    let shoulder_line = (at(Part::LeftUpperArm)? - at(Part::RightUpperArm)?).try_normalize()?;
    let wring = libm::acos(hip_line.dot(shoulder_line).clamp(-1.0, 1.0)) + hip_line.y.abs();
    Some((trunk + 0.6 * (left_leg + right_leg) + 0.3 * knees + wring) / 1.2)
}

/// `joint_from_anatomical` for every node that a joint carries; `None` where the node has no joint of its own.
pub(super) fn frames(samples: &Samples, clip: &Clip, humanoid: &Humanoid) -> [Option<DQuat>; Node::COUNT] {
    let world = &samples.reference;
    let at = |part| position(world, clip, humanoid, part);
    let facing = facing(world, clip, humanoid);
    let mut anatomical = [facing; Node::COUNT];
    let line = |left: Part, right: Part| (at(left)? - at(right)?).try_normalize();
    if let Some(across) = line(Part::LeftUpperLeg, Part::RightUpperLeg) {
        anatomical[Node::Hips.index()] = from_x_up(across);
    }
    if let Some(across) = line(Part::LeftUpperArm, Part::RightUpperArm) {
        anatomical[Node::Chest.index()] = from_x_up(across);
    }
    for (upper, lower, end, bends_forward) in LIMBS {
        let turned = |base: DQuat, from: Part, to: Part| -> Option<DQuat> {
            let bone = (at(to)? - at(from)?).try_normalize()?;
            Some(DQuat::from_rotation_arc(base * DVec3::NEG_Y, bone) * base)
        };
        let (a, b) = (Node::of(upper).index(), Node::of(lower).index());
        if let Some(frame) = turned(facing, upper, lower) {
            anatomical[a] = hinge(samples, clip, humanoid, (upper, lower, end), upper, bends_forward)
                .and_then(|axis| from_x_and_down(world[humanoid.joint(upper)?].rotation * axis, frame * DVec3::NEG_Y))
                .unwrap_or(frame);
        }
        if let Some(frame) = turned(anatomical[a], lower, end) {
            anatomical[b] = hinge(samples, clip, humanoid, (upper, lower, end), lower, bends_forward)
                .and_then(|axis| from_x_and_down(world[humanoid.joint(lower)?].rotation * axis, frame * DVec3::NEG_Y))
                .unwrap_or(frame);
        }
        if bends_forward {
            anatomical[Node::of(end).index()] = anatomical[b];
        }
    }
    let joint_from_node = |node: Node| {
        let joint = carrier(humanoid, node)?;
        Some((world[joint].rotation.conjugate() * anatomical[node.index()]).normalize())
    };
    let chest = carrier(humanoid, Node::Chest).zip(joint_from_node(Node::Chest));
    Node::ALL.map(|node| match node {
        // Collar bones and heads move little, and rest poses tilt them arbitrarily: their mean orientation relative to
        // the chest is their neutral one.
        Node::LeftShoulder | Node::RightShoulder | Node::Neck | Node::Head => {
            samples.mean_rotation(carrier(humanoid, node)?, chest?)
        }
        Node::LeftFoot | Node::RightFoot => {
            let rest = joint_from_node(node)?;
            flat_foot(samples, clip, humanoid, node.part(), rest).or(Some(rest))
        }
        _ => joint_from_node(node),
    })
}

/// The joint that carries a node.
pub(super) fn carrier(humanoid: &Humanoid, node: Node) -> Option<usize> {
    match node {
        Node::Chest => humanoid.spine_chain().last().copied(),
        Node::Neck => match humanoid.neck_chain() {
            [first, _, ..] => Some(*first),
            _ => None,
        },
        Node::Head => humanoid.neck_chain().last().copied(),
        _ => humanoid.joint(node.part()),
    }
}

/// Limbs: upper, lower, end, and whether the lower one bends forward (an elbow) or back (a knee).
const LIMBS: [(Part, Part, Part, bool); 4] = [
    (Part::LeftUpperArm, Part::LeftLowerArm, Part::LeftHand, true),
    (Part::RightUpperArm, Part::RightLowerArm, Part::RightHand, true),
    (Part::LeftUpperLeg, Part::LeftLowerLeg, Part::LeftFoot, false),
    (Part::RightUpperLeg, Part::RightLowerLeg, Part::RightFoot, false),
];

/// The anatomical X axis of a limb's bone, in the frame of `of`'s joint, from how the limb is seen to bend.
fn hinge(
    samples: &Samples,
    clip: &Clip,
    humanoid: &Humanoid,
    (upper, lower, end): (Part, Part, Part),
    of: Part,
    bends_forward: bool,
) -> Option<DVec3> {
    let joint = humanoid.joint(of)?;
    let normal = |world: &[Transform]| {
        let at = |part| position(world, clip, humanoid, part);
        let first = (at(lower)? - at(upper)?).try_normalize()?;
        let second = (at(end)? - at(lower)?).try_normalize()?;
        Some(world[joint].rotation.conjugate() * first.cross(second))
    };
    let mean = samples.mean(normal)?;
    let length = samples.mean(|world| Some(DVec3::X * normal(world)?.length()))?.x;
    if length < MIN_BEND || mean.length() < MIN_AGREEMENT * length {
        return None;
    }
    Some(mean.normalize() * if bends_forward { -1.0 } else { 1.0 })
}

/// `world_from_facing`: Y up, X towards the character's left.
pub(super) fn facing(world: &[Transform], clip: &Clip, humanoid: &Humanoid) -> DQuat {
    let at = |part| position(world, clip, humanoid, part);
    let line = |left: Part, right: Part| Some((at(left)? - at(right)?).normalize_or_zero());
    let left = line(Part::LeftUpperLeg, Part::RightUpperLeg).unwrap_or(DVec3::ZERO)
        + line(Part::LeftUpperArm, Part::RightUpperArm).unwrap_or(DVec3::ZERO);
    let left = DVec3::new(left.x, 0.0, left.z);
    if left.length() < 1e-6 { DQuat::IDENTITY } else { from_x_up(left) }
}

/// The frame whose X is along `across` and whose Y is as close to up as that allows.
fn from_x_up(across: DVec3) -> DQuat {
    from_x_and_down(across, DVec3::NEG_Y).unwrap_or(DQuat::IDENTITY)
}

/// The frame whose −Y is along `down`, as far as `across`, kept exactly in the XY plane, allows: `down` wins for limbs
/// (a bone is where it is), and for across-lines the two are all but perpendicular anyway.
pub(super) fn from_x_and_down(across: DVec3, down: DVec3) -> Option<DQuat> {
    let y = -down.try_normalize()?;
    let x = (across - y * across.dot(y)).try_normalize()?;
    Some(DQuat::from_mat3(&DMat3::from_cols(x, y, x.cross(y))).normalize())
}
