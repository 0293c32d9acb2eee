//! How a reach moves, frame by frame at 60 Hz: what an animator would see.
#![allow(
    dead_code,
    clippy::disallowed_methods,
    reason = "each test uses its own part, and may use the platform's mathematics"
)]

use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Pose, Sole, log};
use sinew_reach::Reacher;

pub const HZ: f64 = 60.0;

/// The frames of a plan, from the reacher's present time until a moment after its end.
pub fn frames(reacher: &Reacher, from_secs: f64) -> Vec<Pose> {
    let count = ((reacher.done_secs() + 0.2 - from_secs) * HZ).ceil() as usize;
    (0..=count).map(|frame| reacher.pose_at(from_secs + frame as f64 / HZ)).collect()
}

/// The worst of a motion.
#[derive(Clone, Copy, Debug, Default)]
pub struct Roughness {
    /// Acceleration of the hips \[m/s²\], by second differences.
    pub hips_m_s2: f64,
    /// Speed of the hips \[m/s\].
    pub hips_m_s: f64,
    /// Turning speed of the head in the world \[degrees a second\].
    pub head_deg_s: f64,
    /// Step of a knee's angle in a frame \[degrees\].
    pub knee_deg: f64,
    /// Turn of the head against the chest \[degrees\].
    pub neck_deg: f64,
    /// When the hips, the head and the knees were worst \[s\].
    pub when_secs: [f64; 3],
}

pub fn knees(pose: &Pose) -> [f64; 2] {
    [Node::LeftLowerLeg, Node::RightLowerLeg].map(|node| log(pose.local(node)).length().to_degrees())
}

pub fn roughness(poses: &[Pose]) -> Roughness {
    let mut worst = Roughness::default();
    let keep = |most: &mut f64, when: &mut f64, value: f64, at: usize| {
        if value > *most {
            (*most, *when) = (value, at as f64 / HZ);
        }
    };
    for (at, three) in poses.windows(3).enumerate() {
        let [before, here, after] = [0, 1, 2].map(|index: usize| three[index].hips_position);
        let acceleration = (after - here * 2.0 + before).length() * HZ * HZ;
        keep(&mut worst.hips_m_s2, &mut worst.when_secs[0], acceleration, at);
    }
    for (at, pair) in poses.windows(2).enumerate() {
        worst.hips_m_s = worst.hips_m_s.max((pair[1].hips_position - pair[0].hips_position).length() * HZ);
        let head = |pose: &Pose| pose.world[Node::Head.index()];
        let turn = log(head(&pair[0]).conjugate() * head(&pair[1])).length().to_degrees() * HZ;
        keep(&mut worst.head_deg_s, &mut worst.when_secs[1], turn, at);
        let (before, after) = (knees(&pair[0]), knees(&pair[1]));
        for side in 0..2 {
            keep(&mut worst.knee_deg, &mut worst.when_secs[2], (after[side] - before[side]).abs(), at);
        }
    }
    for pose in poses {
        let chest = pose.world[Node::Chest.index()];
        let turn = log(chest.conjugate() * pose.world[Node::Head.index()]).length().to_degrees();
        worst.neck_deg = worst.neck_deg.max(turn);
    }
    worst
}

/// Largest turn of a joint between two poses \[degrees\].
pub fn apart_deg(one: &Pose, other: &Pose) -> f64 {
    let turn = |node: Node| log(one.local(node).conjugate() * other.local(node)).length().to_degrees();
    Node::ALL.into_iter().map(turn).fold(0.0, f64::max)
}

/// Least speed of the hips between two times, as a share of their mean speed there \[1\].
pub fn slowest_share(poses: &[Pose], from_secs: f64, to_secs: f64) -> f64 {
    let (from, to) = ((from_secs * HZ).ceil() as usize, (to_secs * HZ).floor() as usize);
    let flat: Vec<DVec3> = poses.iter().map(|pose| pose.hips_position.with_y(0.0)).collect();
    let speeds: Vec<f64> = (from..to.min(flat.len() - 1)).map(|at| (flat[at + 1] - flat[at]).length()).collect();
    let mean = speeds.iter().sum::<f64>() / speeds.len().max(1) as f64;
    speeds.iter().copied().fold(f64::INFINITY, f64::min) / mean
}

/// Distance between two segments \[m\].
fn segments(p: [DVec3; 2], q: [DVec3; 2]) -> f64 {
    let mut least = f64::INFINITY;
    for index in 0..=20 {
        let at = p[0].lerp(p[1], f64::from(index) / 20.0);
        let line = q[1] - q[0];
        let share = ((at - q[0]).dot(line) / line.length_squared().max(1e-12)).clamp(0.0, 1.0);
        least = least.min((q[0] + line * share - at).length());
    }
    least
}

/// How deep each forearm with its hand is in trunk, head, thighs and floor \[m\]; below 0 clear of it. Capsules of 12, 9, 7.5 and
/// 3.5 cm for 1.7 m.
pub fn overlaps(body: &Body, pose: &Pose) -> [[f64; 4]; 2] {
    let at = pose.positions(body);
    let scale = body.stature_m() / 1.7;
    let place = |node: Node| at[node.index()];
    let tip = |node: Node| place(node) + pose.world[node.index()] * body.link(node).tip;
    let floor = [Node::LeftFoot, Node::RightFoot]
        .into_iter()
        .flat_map(|foot| Sole::world_corners(body, pose, foot))
        .map(|corner| corner.y)
        .fold(f64::INFINITY, f64::min);
    [[Node::LeftLowerArm, Node::LeftHand], [Node::RightLowerArm, Node::RightHand]].map(|[lower, hand]| {
        let arm = [[place(lower), place(hand)], [place(hand), tip(hand)]];
        let deep = |other: [DVec3; 2], radius: f64| {
            (radius + 0.035) * scale - segments(arm[0], other).min(segments(arm[1], other))
        };
        let thighs = [[Node::LeftUpperLeg, Node::LeftLowerLeg], [Node::RightUpperLeg, Node::RightLowerLeg]];
        [
            deep([place(Node::Hips), place(Node::Neck)], 0.12),
            deep([place(Node::Head), tip(Node::Head)], 0.09),
            thighs
                .map(|[hip, knee]| deep([place(hip), place(knee)], 0.075))
                .into_iter()
                .fold(f64::NEG_INFINITY, f64::max),
            floor - tip(hand).y,
        ]
    })
}

/// Angle of an upper arm from hanging straight down \[degrees\].
pub fn hangs_deg(pose: &Pose, right: bool) -> f64 {
    let node = if right { Node::RightUpperArm } else { Node::LeftUpperArm };
    (pose.world[node.index()] * -DVec3::Y).angle_between(-DVec3::Y).to_degrees()
}
