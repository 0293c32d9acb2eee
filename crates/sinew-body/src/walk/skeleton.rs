//! The skeleton of the sample, and its body to look at.

use crate::humanoid::{Body, Node, Shape};
use glam::{DQuat, DVec3};
use sinew_motion::{Joint, Part, Skeleton, Transform};

/// The method's tree, from the soles to the top of the head, at the stature that it is made for \[m of 1.70 m\].
const TREE_HEIGHT_M: f64 = 1.686;
/// Where the joints of spine and chest lie above the hips in a 1.70 m body \[m\]: as far below as above the method's
/// one joint, so that half the turn in each carries the neck to the same place.
const SPINE_HEIGHTS_M: [f64; 2] = [0.055, 0.167];
/// Top of the head above its joint in a 1.70 m body \[m\].
const HEAD_TOP_M: f64 = 0.230;

/// A foot: points in its own frame, level and pointing along +Z when flat \[m\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Foot {
    /// Ankle above the sole when flat \[m\].
    pub ankle_m: f64,
    /// Middle of the heel's ball, on which the foot lands and rolls \[m\].
    pub heel: DVec3,
    /// Radius of the heel's ball \[m\].
    pub heel_radius_m: f64,
    /// The joint of the toes, about which the heel rises \[m\].
    pub ball: DVec3,
    /// Tip of the toes from their joint, on the floor when flat \[m\].
    pub toe_tip: DVec3,
}

/// The sample's skeleton.
#[derive(Clone, Debug)]
pub(super) struct WalkSkeleton {
    /// The body whose bones it has.
    pub body: Body,
    /// Its left foot; the right one is the same, for all its points lie in the middle plane.
    pub foot: Foot,
    /// Lengths relative to a 1.70 m body's.
    pub scale: f64,
}

/// The parts that the skeleton has, parents before children: a joint each.
const PARTS: [Part; 21] = [
    Part::Hips,
    Part::Spine,
    Part::Chest,
    Part::Neck,
    Part::Head,
    Part::LeftShoulder,
    Part::LeftUpperArm,
    Part::LeftLowerArm,
    Part::LeftHand,
    Part::RightShoulder,
    Part::RightUpperArm,
    Part::RightLowerArm,
    Part::RightHand,
    Part::LeftUpperLeg,
    Part::LeftLowerLeg,
    Part::LeftFoot,
    Part::LeftToes,
    Part::RightUpperLeg,
    Part::RightLowerLeg,
    Part::RightFoot,
    Part::RightToes,
];

/// The part that a part hangs from in this skeleton.
fn parent(part: Part) -> Option<Part> {
    part.parent().map(|parent| if parent == Part::UpperChest { Part::Chest } else { parent })
}

/// `joint_from_node`: in the rest pose the arms are stretched out, in the anatomical one they hang.
fn joint_from_node(part: Part) -> DQuat {
    let quarter = std::f64::consts::FRAC_1_SQRT_2;
    match part {
        Part::LeftUpperArm | Part::LeftLowerArm | Part::LeftHand => DQuat::from_xyzw(0.0, 0.0, quarter, quarter),
        Part::RightUpperArm | Part::RightLowerArm | Part::RightHand => DQuat::from_xyzw(0.0, 0.0, -quarter, quarter),
        _ => DQuat::IDENTITY,
    }
}

impl WalkSkeleton {
    pub fn new(stature_m: f64) -> WalkSkeleton {
        let height_m = stature_m * 1.70 / TREE_HEIGHT_M;
        let scale = height_m / 1.70;
        let foot = Foot {
            ankle_m: 0.075 * scale,
            heel: DVec3::new(0.0, -0.047, -0.032) * scale,
            heel_radius_m: 0.028 * scale,
            ball: DVec3::new(0.0, -0.053, 0.126) * scale,
            toe_tip: DVec3::new(0.0, -0.022, 0.064) * scale,
        };
        // Mass sets nothing but breadth here: that of a person of 23.5 kg per square metre.
        WalkSkeleton { body: Body::standard(23.5 * stature_m * stature_m, height_m), foot, scale }
    }

    /// The skeleton in its rest pose: a T, facing +Z, hips at the origin.
    pub fn skeleton(&self) -> Skeleton {
        let mut skeleton = Skeleton::new();
        for part in PARTS {
            let parent = parent(part).and_then(|parent| PARTS.iter().position(|&other| other == parent));
            let rest = Transform::new(DQuat::IDENTITY, self.offset(part));
            skeleton.push(Joint { name: part.name().to_owned(), parent, rest, tip: self.tip(part) });
        }
        skeleton
    }

    /// From the parent's joint to the part's own in the rest pose \[m\].
    fn offset(&self, part: Part) -> DVec3 {
        let [spine, chest] = SPINE_HEIGHTS_M.map(|height| height * self.scale);
        let node = Node::of(part);
        let own = self.body.link(node).offset;
        let chest_from_node = DVec3::Y * (self.body.link(Node::Chest).offset.y - chest);
        match part {
            Part::Hips => DVec3::ZERO,
            Part::Spine => DVec3::Y * spine,
            Part::Chest => DVec3::Y * (chest - spine),
            Part::Neck | Part::LeftShoulder | Part::RightShoulder => own + chest_from_node,
            Part::LeftToes | Part::RightToes => self.foot.ball,
            _ => parent(part).map_or(DQuat::IDENTITY, joint_from_node) * own,
        }
    }

    fn tip(&self, part: Part) -> Option<DVec3> {
        match part {
            Part::Head => Some(DVec3::Y * HEAD_TOP_M * self.scale),
            Part::LeftHand | Part::RightHand => Some(joint_from_node(part) * self.body.link(Node::of(part)).tip),
            Part::LeftToes | Part::RightToes => Some(self.foot.toe_tip),
            _ => None,
        }
    }

    /// The `parent_from_joint` of every joint, from the nodes' `parent_from_node` and the toes' bend.
    pub fn locals(&self, hips_position: DVec3, nodes: &[DQuat; Node::COUNT], toes: [DQuat; 2]) -> Vec<Transform> {
        let half = nodes[Node::Chest.index()];
        // Half of a turn: halfway from no turn.
        let half = if half.w < 0.0 { -half } else { half };
        let half = DQuat::from_xyzw(half.x, half.y, half.z, half.w + 1.0).normalize();
        PARTS
            .iter()
            .map(|&part| {
                let rotation = match part {
                    Part::Spine | Part::Chest => half,
                    Part::LeftToes => toes[0],
                    Part::RightToes => toes[1],
                    _ => {
                        let parent_from_node = nodes[Node::of(part).index()];
                        let parent_turn = parent(part).map_or(DQuat::IDENTITY, joint_from_node);
                        parent_turn * parent_from_node * joint_from_node(part).conjugate()
                    }
                };
                let translation = if part == Part::Hips { hips_position } else { self.offset(part) };
                Transform::new(rotation.normalize(), translation)
            })
            .collect()
    }

    /// Capsules to look at, one or two to a part, each with the joint in whose frame it is.
    pub fn shapes(&self) -> Vec<(usize, Shape)> {
        let mut shapes = Vec::new();
        for (joint, &part) in PARTS.iter().enumerate() {
            let link = self.body.link(Node::of(part));
            let mut push = |from: DVec3, to: DVec3, radius_m: f64| {
                shapes.push((joint, Shape { from, to, from_radius_m: radius_m, to_radius_m: radius_m }));
            };
            let metres = |x: f64, y: f64, z: f64| DVec3::new(x, y, z) * self.scale;
            match part {
                Part::Spine => {}
                Part::Chest => {
                    let lower = DVec3::Y * (link.offset.y - SPINE_HEIGHTS_M[1] * self.scale);
                    let radius = 0.5 * (link.shape.from_radius_m + link.shape.to_radius_m);
                    push(link.shape.from + lower, link.shape.to + lower, radius);
                }
                Part::LeftFoot | Part::RightFoot => {
                    let foot = &self.foot;
                    push(foot.heel, foot.ball + metres(0.0, 0.006, -0.010), foot.heel_radius_m);
                    push(metres(0.0, -0.01, 0.0), foot.ball + metres(0.0, 0.008, -0.030), 0.030 * self.scale);
                }
                Part::LeftToes | Part::RightToes => {
                    push(metres(0.0, -0.001, 0.0), metres(0.0, -0.003, 0.045), 0.019 * self.scale);
                }
                Part::Head => push(metres(0.0, 0.078, 0.008), metres(0.0, 0.142, 0.008), 0.088 * self.scale),
                _ => {
                    let turn = joint_from_node(part);
                    let shape = &link.shape;
                    // Closer to the radius at knee and elbow, where two capsules meet.
                    let share = match part {
                        Part::LeftUpperLeg | Part::RightUpperLeg => 0.65,
                        Part::LeftLowerLeg | Part::RightLowerLeg => 0.35,
                        _ => 0.5,
                    };
                    let radius = shape.from_radius_m + share * (shape.to_radius_m - shape.from_radius_m);
                    push(turn * shape.from, turn * shape.to, radius);
                }
            }
        }
        shapes
    }
}
