//! The reduction of any skeleton to the 18 bodies.

use super::anthropometry::{STANDARD_STATURE_M, standard_offset, standard_tip};
use super::calibration::{self, Samples, position};
use super::flat_foot::on_one_floor;
use super::{Body, Node, Pose, Shape};
use glam::{DQuat, DVec3};
use sinew_motion::{Clip, Humanoid, Part, Transform};

/// Where along the line from the hips to the base of the neck the chest's joint lies: 0.111 of 0.335 m in the
/// method's tree. Capture skeletons place their spine joints anywhere, some leave one out.
const CHEST_JOINT_FRACTION: f64 = 0.111 / 0.335;

/// The person that performs a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Person {
    /// Mass of the whole body \[kg\].
    pub mass_kg: f64,
    /// Standing height \[m\]; `None` takes the skeleton's own.
    pub height_m: Option<f64>,
}

impl Default for Person {
    /// 80 kg, as tall as the skeleton.
    fn default() -> Person {
        Person { mass_kg: 80.0, height_m: None }
    }
}

/// Why a skeleton cannot be reduced to a body.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReductionError {
    /// The person's mass or height is out of range.
    #[error("a body of {mass_kg} kg and {height_m:.2} m is out of range; mass is 1 to 1000 kg, height 0.2 to 10 m")]
    Person {
        /// The mass asked for \[kg\].
        mass_kg: f64,
        /// The height asked for or measured \[m\].
        height_m: f64,
    },
    /// The skeleton is too small or too large for a body, which most often means another unit.
    #[error("a skeleton of {stature_m:.2} m is out of range (0.2 to 10 m){}", unit_hint(*.stature_m))]
    Stature {
        /// Its stature \[m\].
        stature_m: f64,
    },
    /// A bone that needs a length has none.
    #[error("the {part} has no length in this skeleton; check the mapping that `sinew inspect` prints")]
    NoLength {
        /// The part whose bone is too short.
        part: Part,
    },
}

/// Factors between the units in which people mistake a file's: centimetres, millimetres, inches, feet.
const FACTORS: [f64; 8] = [0.01, 100.0, 0.001, 1000.0, 0.0254, 1.0 / 0.0254, 0.3048, 1.0 / 0.3048];

/// Which unit would make a person of a skeleton that was read as metres.
fn unit_hint(stature_m: f64) -> String {
    let person = FACTORS.into_iter().find(|factor| (1.2..=2.2).contains(&(factor * stature_m)));
    let factor = person.map(|factor| if factor > 1.0 { factor.round() } else { factor });
    factor.map_or(String::new(), |factor| {
        format!("; as metres per unit of the file, ReadOptions::unit_m {factor} gives {:.2} m", factor * stature_m)
    })
}

/// Which joint carries a node, and the constant rotation between their frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Carrier {
    pub joint: usize,
    pub joint_from_node: DQuat,
}

/// A mapping from a source skeleton to the 18 bodies of [`Node`], and the body measured on it.
#[derive(Clone, Debug)]
pub struct Reduction {
    body: Body,
    pub(super) carriers: [Option<Carrier>; Node::COUNT],
    /// Joints between hips and chest with the share of the chest's turn that each carries, the chest's joint last (1).
    pub(super) spine: Vec<(usize, f64)>,
    /// Likewise between chest and head.
    pub(super) neck: Vec<(usize, f64)>,
    pub(super) parents: Vec<Option<usize>>,
    reference: Vec<Transform>,
    body_metres_per_clip_metre: f64,
}

impl Reduction {
    /// Measures the body on a clip's skeleton and motion. `stature_m` is the skeleton's own.
    ///
    /// # Errors
    /// When the person is out of range or a limb has no length.
    pub fn new(clip: &Clip, humanoid: &Humanoid, stature_m: f64, person: Person) -> Result<Reduction, ReductionError> {
        let height_m = person.height_m.unwrap_or(stature_m);
        if !(0.2..=10.0).contains(&stature_m) {
            return Err(ReductionError::Stature { stature_m });
        }
        if !(1.0..=1000.0).contains(&person.mass_kg) || !(0.2..=10.0).contains(&height_m) {
            return Err(ReductionError::Person { mass_kg: person.mass_kg, height_m });
        }
        let samples = Samples::of(clip, humanoid);
        let joint_from_node = calibration::frames(&samples, clip, humanoid);
        let carriers = Node::ALL.map(|node| {
            Some(Carrier {
                joint: calibration::carrier(humanoid, node)?,
                joint_from_node: joint_from_node[node.index()]?,
            })
        });
        let scale = height_m / stature_m;
        let bones = Bones::measure(&samples, clip, humanoid, &carriers, stature_m);
        for node in Node::ALL {
            let limb = matches!(
                node.part(),
                Part::LeftUpperArm
                    | Part::RightUpperArm
                    | Part::LeftLowerArm
                    | Part::RightLowerArm
                    | Part::LeftUpperLeg
                    | Part::RightUpperLeg
                    | Part::LeftLowerLeg
                    | Part::RightLowerLeg
            );
            if limb && bones.tips[node.index()].length() < 0.02 * stature_m {
                return Err(ReductionError::NoLength { part: node.part() });
            }
        }
        let offsets = bones.offsets.map(|offset| offset * scale);
        let tips = bones.tips.map(|tip| tip * scale);
        let body = Body::shaped(person.mass_kg, height_m, &offsets, &tips);
        let shares = |chain: &[usize]| -> Vec<(usize, f64)> {
            let count = chain.len() as f64;
            chain.iter().enumerate().map(|(index, &joint)| (joint, (index + 1) as f64 / count)).collect()
        };
        Ok(Reduction {
            body,
            carriers,
            spine: shares(humanoid.spine_chain()),
            neck: shares(humanoid.neck_chain()),
            parents: clip.skeleton().joints().iter().map(|joint| joint.parent).collect(),
            reference: samples.reference,
            body_metres_per_clip_metre: scale,
        })
    }

    /// The body, its limits not yet widened to any motion.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// Metres of the body per metre of the clip: 1 unless a height was asked for that is not the skeleton's own.
    pub fn scale(&self) -> f64 {
        self.body_metres_per_clip_metre
    }

    /// The joint that carries a node; `None` where the skeleton has none (then the node turns with its parent).
    pub fn joint(&self, node: Node) -> Option<usize> {
        self.carriers[node.index()].map(|carrier| carrier.joint)
    }

    /// The body's shapes on the skeleton's own joints: for each node the joint that carries it (or its parent) and its
    /// capsule in that joint's frame, in metres of the clip.
    pub fn shapes(&self) -> Vec<(Node, usize, Shape)> {
        let scale = self.body_metres_per_clip_metre;
        let pose = self.pose(&self.reference);
        let positions = pose.positions(&self.body);
        Node::ALL
            .into_iter()
            .filter_map(|node| {
                let mut carrying = node;
                while self.joint(carrying).is_none() {
                    carrying = carrying.parent()?;
                }
                let joint = self.joint(carrying)?;
                let joint_from_world = self.reference[joint].inverse();
                let place = |point: DVec3| {
                    let in_world = positions[node.index()] + pose.world[node.index()] * point;
                    joint_from_world.point(in_world / scale)
                };
                let shape = self.body.link(node).shape;
                let shape = Shape {
                    from: place(shape.from),
                    to: place(shape.to),
                    from_radius_m: shape.from_radius_m / scale,
                    to_radius_m: shape.to_radius_m / scale,
                };
                Some((node, joint, shape))
            })
            .collect()
    }

    /// `world_from_node` of all nodes from the `world_from_joint` of all joints; positions in the clip's own metres.
    pub(super) fn orientations(&self, world: &[Transform]) -> [DQuat; Node::COUNT] {
        let mut orientations = [DQuat::IDENTITY; Node::COUNT];
        for node in Node::ALL {
            orientations[node.index()] = match (&self.carriers[node.index()], node.parent()) {
                (Some(carrier), _) => (world[carrier.joint].rotation * carrier.joint_from_node).normalize(),
                (None, Some(parent)) => orientations[parent.index()],
                (None, None) => DQuat::IDENTITY,
            };
        }
        orientations
    }

    /// The 18 bodies' pose from the `world_from_joint` of all joints. Lengths are the body's, see [`Reduction::scale`].
    pub fn pose(&self, world: &[Transform]) -> Pose {
        let hips = self.carriers[0].map_or(DVec3::ZERO, |carrier| world[carrier.joint].translation);
        Pose { hips_position: hips * self.body_metres_per_clip_metre, world: self.orientations(world) }
    }
}

/// Lengths measured on the skeleton, in anatomical frames and clip metres.
struct Bones {
    offsets: [DVec3; Node::COUNT],
    tips: [DVec3; Node::COUNT],
}

impl Bones {
    fn measure(
        samples: &Samples,
        clip: &Clip,
        humanoid: &Humanoid,
        carriers: &[Option<Carrier>; Node::COUNT],
        stature_m: f64,
    ) -> Bones {
        let standard_scale = stature_m / STANDARD_STATURE_M;
        // A point's mean position in a node's frame.
        let place = |node: Node, from: Part, to: Part| -> Option<DVec3> {
            let carrier = carriers[node.index()]?;
            samples.mean(|world| {
                let between = position(world, clip, humanoid, to)? - position(world, clip, humanoid, from)?;
                let world_from_node = world[carrier.joint].rotation * carrier.joint_from_node;
                Some(world_from_node.conjugate() * between)
            })
        };
        let neck_base = if humanoid.joint(Part::Neck).is_some() { Part::Neck } else { Part::Head };
        let mut offsets = Node::ALL.map(|node| standard_offset(node) * standard_scale);
        let mut tips = Node::ALL.map(|node| standard_tip(node) * standard_scale);
        let mut set = |node: Node, offset: Option<DVec3>| {
            if let Some(offset) = offset {
                offsets[node.index()] = offset;
            }
        };
        let trunk = place(Node::Hips, Part::Hips, neck_base);
        let chest = trunk.map(|trunk| trunk * CHEST_JOINT_FRACTION);
        set(Node::Chest, chest);
        // From the chest's joint, a point fixed in the hips, to something fixed in the chest.
        let from_chest = |to: Part| -> Option<DVec3> {
            let (hips, carrier) = (carriers[0]?, carriers[Node::Chest.index()]?);
            let chest = chest?;
            samples.mean(|world| {
                let world_from_hips = world[hips.joint].rotation * hips.joint_from_node;
                let joint = world[hips.joint].translation + world_from_hips * chest;
                let world_from_chest = world[carrier.joint].rotation * carrier.joint_from_node;
                Some(world_from_chest.conjugate() * (position(world, clip, humanoid, to)? - joint))
            })
        };
        set(Node::Neck, from_chest(neck_base));
        if neck_base == Part::Neck && carriers[Node::Neck.index()].is_some() {
            set(Node::Head, place(Node::Neck, Part::Neck, Part::Head));
        }
        for (shoulder, upper, lower, hand) in [
            (Node::LeftShoulder, Node::LeftUpperArm, Node::LeftLowerArm, Node::LeftHand),
            (Node::RightShoulder, Node::RightUpperArm, Node::RightLowerArm, Node::RightHand),
        ] {
            if carriers[shoulder.index()].is_some() {
                set(shoulder, from_chest(shoulder.part()));
                set(upper, place(shoulder, shoulder.part(), upper.part()));
            } else if let Some(arm) = from_chest(upper.part()) {
                // No collar bone: one is assumed between the breastbone and the arm, and rotates with the chest.
                let start = DVec3::new(arm.x * 0.133, arm.y, arm.z);
                set(shoulder, Some(start));
                set(upper, Some(arm - start));
            }
            set(lower, place(upper, upper.part(), lower.part()));
            set(hand, place(lower, lower.part(), hand.part()));
        }
        for (upper, lower, foot) in [
            (Node::LeftUpperLeg, Node::LeftLowerLeg, Node::LeftFoot),
            (Node::RightUpperLeg, Node::RightLowerLeg, Node::RightFoot),
        ] {
            set(upper, place(Node::Hips, Part::Hips, upper.part()));
            set(lower, place(upper, upper.part(), lower.part()));
            set(foot, place(lower, lower.part(), foot.part()));
        }
        for node in Node::ALL {
            let child = match node {
                Node::Hips => Some(Node::Chest),
                Node::Chest => Some(Node::Neck),
                Node::Neck => Some(Node::Head),
                Node::Head | Node::LeftHand | Node::RightHand | Node::LeftFoot | Node::RightFoot => None,
                other => Node::ALL.into_iter().find(|child| child.parent() == Some(other)),
            };
            if let Some(child) = child {
                tips[node.index()] = offsets[child.index()];
            }
        }
        for (foot, toes) in [(Node::LeftFoot, Part::LeftToes), (Node::RightFoot, Part::RightToes)] {
            if humanoid.joint(toes).is_some()
                && let Some(ball) = place(foot, foot.part(), toes)
            {
                // The toes add about a third to the length from ankle to ball.
                tips[foot.index()] = ball * 1.35;
            }
        }
        let feet = [Node::LeftFoot, Node::RightFoot].map(Node::index);
        if let Some(leveled) = on_one_floor(samples, clip, humanoid, feet.map(|foot| tips[foot])) {
            feet.into_iter().zip(leveled).for_each(|(foot, tip)| tips[foot] = tip);
        }
        Bones { offsets, tips }
    }
}
