//! One sample of a performer.

use super::tpose::{pose_of, turns_of};
use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_motion::Part;
use sinew_snapshot::snapshot;

/// A capture system's measurement of a performer at one instant, in our axes: right-handed, Y up, +Z forward, +X to the
/// left.
///
/// Numbers are integers in millionths, so that a sample has the same bits in memory, in a take and on the wire, and
/// cannot be NaN or infinite.
///
/// ```
/// use sinew_body::humanoid::{Body, Pose};
/// use sinew_control::perform::PerformerSample;
/// let body = Body::standard(80.0, 1.7);
/// let sample = PerformerSample::of_pose(0.5, &Pose::STANDING, &body);
/// assert_eq!(sample.time_secs, 0.5);
/// assert!(sample.pose().world[0].is_near_identity());
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PerformerSample {
    /// Time by the sender's own clock, with an arbitrary zero \[s\].
    pub time_secs: f64,
    /// Sequence number, from senders that number their samples.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub number: Option<u64>,
    /// Its validity.
    #[serde(default, skip_serializing_if = "SampleStatus::is_tracked")]
    pub status: SampleStatus,
    /// Position of the hips in the performer's space, Y from the floor \[µm\].
    pub hips_um: [i32; 3],
    /// `parent_from_part` of every part in the order of [`Part::ALL`], quaternions x, y, z, w \[millionths\]. All are the
    /// identity in the T-pose, facing +Z; the hips' is `space_from_hips`. A part that the sender does not know is the identity.
    pub turns_e6: [[i32; 4]; Part::COUNT],
    /// Proportions of the performer; not in every sample.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub build: Option<BodyProportions>,
}

/// Whether a sample can be used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SampleStatus {
    /// The performer is tracked.
    #[default]
    Tracked,
    /// The sender does not track its performer.
    Untracked,
    /// The sender sent NaN or infinite numbers.
    NonFinite,
}

/// The lengths of a performer that place a character's hips.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BodyProportions {
    /// From the hips to the middle between the hip joints, in the hips' frame \[µm\].
    pub hips_to_legs_um: [i32; 3],
    /// Upper and lower leg together \[µm\].
    pub leg_um: i32,
}

snapshot!(BodyProportions { hips_to_legs_um, leg_um });

/// Millionths in one.
const E6: f64 = 1e6;

fn millionths(value: f64) -> i32 {
    // `as` saturates, and converts NaN to 0.
    (value * E6).round() as i32
}

fn whole(value: i32) -> f64 {
    f64::from(value) / E6
}

impl SampleStatus {
    fn is_tracked(&self) -> bool {
        *self == SampleStatus::Tracked
    }
}

impl BodyProportions {
    /// From lengths in metres.
    pub fn new(hips_to_legs_m: DVec3, leg_m: f64) -> BodyProportions {
        BodyProportions { hips_to_legs_um: hips_to_legs_m.to_array().map(millionths), leg_um: millionths(leg_m) }
    }

    /// A body's own.
    pub fn of(body: &Body) -> BodyProportions {
        let offset = |node: Node| body.link(node).offset;
        let hips_to_legs = (offset(Node::LeftUpperLeg) + offset(Node::RightUpperLeg)) / 2.0;
        let bones = [Node::LeftLowerLeg, Node::LeftFoot, Node::RightLowerLeg, Node::RightFoot];
        let leg: f64 = bones.into_iter().map(|node| offset(node).length()).sum();
        BodyProportions::new(hips_to_legs, leg / 2.0)
    }

    /// From the hips to the middle between the hip joints, in the hips' frame \[m\].
    pub fn hips_to_legs_m(&self) -> DVec3 {
        DVec3::from(self.hips_to_legs_um.map(whole))
    }

    /// Upper and lower leg together \[m\].
    pub fn leg_m(&self) -> f64 {
        whole(self.leg_um)
    }
}

/// In the T-pose with the hips at the origin, at time 0.
impl Default for PerformerSample {
    fn default() -> PerformerSample {
        PerformerSample {
            time_secs: 0.0,
            number: None,
            status: SampleStatus::Tracked,
            hips_um: [0; 3],
            turns_e6: [[0, 0, 0, E6 as i32]; Part::COUNT],
            build: None,
        }
    }
}

impl PerformerSample {
    /// A sample from the position of the hips \[m\] and `parent_from_part` rotations in the order of [`Part::ALL`].
    /// Numbers that are not finite give the status [`SampleStatus::NonFinite`].
    pub fn new(time_secs: f64, hips_m: DVec3, turns: &[DQuat; Part::COUNT]) -> PerformerSample {
        let is_finite = hips_m.is_finite() && turns.iter().all(|turn| turn.is_finite());
        PerformerSample {
            time_secs: if time_secs.is_finite() { time_secs } else { 0.0 },
            number: None,
            status: if is_finite && time_secs.is_finite() { SampleStatus::Tracked } else { SampleStatus::NonFinite },
            hips_um: hips_m.to_array().map(millionths),
            turns_e6: turns.map(|turn| turn.to_array().map(millionths)),
            build: None,
        }
    }

    /// The sample of a performer with this body and pose, proportions included.
    pub fn of_pose(time_secs: f64, pose: &Pose, body: &Body) -> PerformerSample {
        let sample = PerformerSample::new(time_secs, pose.hips_position, &turns_of(pose));
        PerformerSample { build: Some(BodyProportions::of(body)), ..sample }
    }

    /// Position of the hips in the performer's space \[m\].
    pub fn hips_m(&self) -> DVec3 {
        DVec3::from(self.hips_um.map(whole))
    }

    /// `parent_from_part` as received, of about unit length in a valid sample.
    pub fn turn(&self, part: Part) -> DQuat {
        DQuat::from_array(self.turns_e6[part as usize].map(whole))
    }

    /// Largest deviation of a quaternion's length from 1.
    pub fn unit_error(&self) -> f64 {
        self.turns_e6.iter().map(|turn| (DQuat::from_array(turn.map(whole)).length() - 1.0).abs()).fold(0.0, f64::max)
    }

    /// The pose of the 18 bodies in the performer's space; quaternions are normalised.
    pub fn pose(&self) -> Pose {
        let turns = std::array::from_fn(|at| self.turn(Part::ALL[at]).normalize());
        pose_of(self.hips_m(), &turns)
    }
}
