//! A key pose on a body: EQ1's (ψ, σ, δ) of Shapiro et al. 2007.

use super::{FullJointSpec, JointSpec, PartName, PoseSpec};
use crate::Wanted;
use glam::{DMat3, DQuat, DVec3};
use sinew_body::humanoid::{Node, exp, log};
use sinew_snapshot::snapshot;
use std::collections::BTreeMap;

/// A target rotation of every joint except the root, with gains.
#[derive(Clone, Debug, PartialEq)]
pub struct KeyPose {
    /// `parent_from_node` by [`Node::index`]; the hips' is unused and the identity.
    pub rotations: [DQuat; Node::COUNT],
    /// Factor on each joint's stiffness: the pose's times the joint's own.
    pub gains: [f64; Node::COUNT],
    /// Factor on each joint's damping, likewise.
    pub dampings: [f64; Node::COUNT],
    /// Duration of the blend from the previous pose \[s\].
    pub blend_secs: f64,
    /// Damp against the velocity of the blend instead of against rest.
    pub follow_velocity: bool,
}

snapshot!(KeyPose { rotations, gains, dampings, blend_secs, follow_velocity });

/// Default of [`KeyPose::blend_secs`] \[s\].
pub const BLEND_SECS: f64 = 0.25;

impl KeyPose {
    /// Standing, arms hanging: the pose `stand`.
    pub const STAND: KeyPose = KeyPose {
        rotations: [DQuat::IDENTITY; Node::COUNT],
        gains: [1.0; Node::COUNT],
        dampings: [1.0; Node::COUNT],
        blend_secs: BLEND_SECS,
        follow_velocity: false,
    };

    /// The turns that are wanted now, as a pose to be saved.
    pub fn of_wanted(wanted: &Wanted) -> KeyPose {
        let mut pose = KeyPose::STAND;
        for node in Node::ALL.into_iter().skip(1) {
            let (at, joint) = (node.index(), wanted.joint(node));
            pose.rotations[at] = joint.rotation;
            pose.gains[at] = joint.gain;
            pose.dampings[at] = joint.damping;
        }
        pose
    }

    /// The pose as a file states it, on `stand`: the solution of an IK handle can be saved.
    pub fn to_spec(&self) -> PoseSpec {
        let (gain, damping) = (common(&self.gains), common(&self.dampings));
        let mut joints = BTreeMap::new();
        for node in Node::ALL.into_iter().skip(1) {
            let at = node.index();
            // Below a millionth of a degree it is rounding.
            let turned = log(self.rotations[at]).length() > 2e-8;
            let own = |factor: f64, common: f64| (factor != common).then_some(factor);
            let spec = FullJointSpec {
                turn_deg: turned.then(|| angles_deg(self.rotations[at])),
                gain: own(self.gains[at], gain),
                damping: own(self.dampings[at], damping),
            };
            let spec = match spec {
                FullJointSpec { turn_deg: None, gain: None, damping: None } => continue,
                FullJointSpec { turn_deg: Some(turn), gain: None, damping: None } => JointSpec::Turn(turn),
                full => JointSpec::Full(full),
            };
            joints.insert(PartName(node), spec);
        }
        PoseSpec {
            blend_secs: Some(self.blend_secs),
            gain: (gain != 1.0).then_some(gain),
            damping: (damping != 1.0).then_some(damping),
            follow_velocity: self.follow_velocity.then_some(true),
            joints,
            ..PoseSpec::default()
        }
    }
}

/// The factor of all joints, if they have one; else 1, on which each states its own.
fn common(factors: &[f64; Node::COUNT]) -> f64 {
    let first = factors[1];
    if factors[1..].iter().all(|factor| *factor == first) { first } else { 1.0 }
}

/// The angles \[degrees\] about X, Y and Z whose X·Y·Z is the rotation. Where Y is a quarter turn, X and Z turn about one axis
/// and Z is taken as 0.
pub fn angles_deg(rotation: DQuat) -> [f64; 3] {
    let m = DMat3::from_quat(rotation.normalize());
    // X·Y·Z has sin y in the first row's last place.
    let sin = m.z_axis.x.clamp(-1.0, 1.0);
    let cos = (m.x_axis.x * m.x_axis.x + m.y_axis.x * m.y_axis.x).sqrt();
    let y = libm::atan2(sin, cos);
    let (x, z) = if cos > 1e-9 {
        (libm::atan2(-m.z_axis.y, m.z_axis.z), libm::atan2(-m.y_axis.x, m.x_axis.x))
    } else {
        (libm::atan2(m.y_axis.z, m.y_axis.y), 0.0)
    };
    [x, y, z].map(f64::to_degrees)
}

/// The rotation X·Y·Z of three angles \[degrees\].
pub fn rotation_of(degrees: [f64; 3]) -> DQuat {
    let [x, y, z] = degrees.map(f64::to_radians);
    (exp(DVec3::X * x) * exp(DVec3::Y * y) * exp(DVec3::Z * z)).normalize()
}

/// The rotation seen in a mirror that exchanges left and right.
pub(super) fn mirrored(rotation: DQuat) -> DQuat {
    DQuat::from_xyzw(rotation.x, -rotation.y, -rotation.z, rotation.w)
}
