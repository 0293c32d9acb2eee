//! The wanted pose: the output of every [`Source`](crate::source::Source), the input of every
//! [`Tracker`](crate::tracker::Tracker).

use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Node, Pose, log};

/// The target of one joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointTarget {
    /// Wanted `parent_from_node`.
    pub rotation: DQuat,
    /// Wanted angular velocity relative to the parent, in the node's frame \[rad/s\].
    pub velocity: DVec3,
    /// Factor on the joint's own stiffness, the pose's gain k_sp (Shapiro et al. 2007, EQ3); 0 leaves it limp.
    pub gain: f64,
    /// Factor on the joint's own damping.
    pub damping: f64,
    /// Additional torque on the node relative to its parent (feed-forward), in world axes \[N m\].
    pub torque: DVec3,
}

/// Whether the wanted pose has root motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Root {
    /// No root motion: angles only, as of key poses; [`FreeRoot`](crate::FreeRoot) places it for trackers that follow
    /// poses.
    #[default]
    Free,
    /// Root motion: the hips are wanted where [`Wanted::pose`] has them, as in a clip.
    Placed,
}

/// The wanted pose of the whole body.
///
/// Trackers that drive joints read [`joints`](Wanted::joints), trackers that hold parts to positions read
/// [`pose`](Wanted::pose); both describe the same pose.
///
/// ```
/// use sinew_body::humanoid::{Node, exp};
/// use sinew_control::{Root, Wanted};
/// let mut wanted = Wanted::STANDING;
/// wanted.joint_mut(Node::LeftLowerArm).rotation = exp(glam::DVec3::X * -0.5);
/// assert_eq!(wanted.root, Root::Free);
/// assert_eq!(wanted.joint(Node::LeftLowerArm).gain, 1.0);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// By [`Node::index`]; the hips' entry is unused.
    pub joints: [JointTarget; Node::COUNT],
    /// The whole pose, world. With a free [`root`](Wanted::root) it is undefined until [`FreeRoot`](crate::FreeRoot)
    /// has placed it.
    pub pose: Pose,
    /// The same pose low-passed without delay, where the source knows its motion beforehand: what the response finds the motion's
    /// torques in. `None` where [`pose`](Wanted::pose) is all that is known.
    pub smooth: Option<Pose>,
    /// Whether the pose's hips are where they are wanted.
    pub root: Root,
}

sinew_snapshot::snapshot!(JointTarget { rotation, velocity, gain, damping, torque });
sinew_snapshot::snapshot!(enum Root { 0: Free, 1: Placed });
sinew_snapshot::snapshot!(Wanted { joints, pose, smooth, root });

impl JointTarget {
    /// Straight, with the joint's own gains.
    pub const REST: JointTarget =
        JointTarget { rotation: DQuat::IDENTITY, velocity: DVec3::ZERO, gain: 1.0, damping: 1.0, torque: DVec3::ZERO };
}

impl Wanted {
    /// Standing, arms hanging, with the joints' own gains.
    pub const STANDING: Wanted =
        Wanted { joints: [JointTarget::REST; Node::COUNT], pose: Pose::STANDING, smooth: None, root: Root::Free };

    /// One joint.
    pub fn joint(&self, node: Node) -> &JointTarget {
        &self.joints[node.index()]
    }

    /// One joint, to change it.
    pub fn joint_mut(&mut self, node: Node) -> &mut JointTarget {
        &mut self.joints[node.index()]
    }

    /// Follows a motion: the pose now, with the velocity of its joints from the one that comes so much later \[s\].
    pub fn follow_poses(&mut self, now: &Pose, next: &Pose, ahead_secs: f64) {
        for node in Node::ALL.into_iter().skip(1) {
            let joint = self.joint_mut(node);
            let (local, after) = (now.local(node), next.local(node));
            joint.rotation = local.normalize();
            joint.velocity = log((local.conjugate() * after).normalize()) / ahead_secs;
        }
        (self.pose, self.smooth, self.root) = (*now, None, Root::Placed);
    }

    /// The pose of these joints with the hips somewhere: position \[m\] and `world_from_hips`.
    pub fn pose_with_hips(&self, position: DVec3, rotation: DQuat) -> Pose {
        let mut locals = self.joints.map(|joint| joint.rotation);
        locals[0] = rotation;
        Pose::from_locals(position, &locals)
    }
}
