//! A captured reach, and the method's for the same target in the same time.
#![allow(
    dead_code,
    clippy::disallowed_methods,
    reason = "each user needs its own part, and may use the platform's mathematics"
)]

use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Person, Pose, Reduction};
use sinew_motion::formats::{MotionFile, ReadOptions};
use sinew_motion::resample;
use sinew_reach::{Goal, Reacher, Start, Style};
use std::path::Path;

pub const HZ: f64 = 60.0;

/// Which clip, and what of it.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    pub file: &'static str,
    pub name: &'static str,
    /// From when to look for the extreme, until when [s].
    pub within: (f64, f64),
    /// Up, or down.
    pub up: bool,
    /// Which hands.
    pub hands: [bool; 2],
}

pub const CASES: [Case; 3] = [
    Case {
        file: "accad_bvh/Female1_A05_PickUpBox.bvh",
        name: "picks a box up from the floor",
        within: (0.0, 9.0),
        up: false,
        hands: [true, true],
    },
    Case {
        file: "cmu_bvh_motionbuilder/02_06.bvh",
        name: "bends over and scoops up",
        within: (0.5, 9.0),
        up: false,
        hands: [false, true],
    },
    Case {
        file: "accad_bvh/Female1_A06_LiftBox.bvh",
        name: "lifts a box high",
        within: (0.0, 9.0),
        up: true,
        hands: [true, true],
    },
];

/// Trunk and knees of a pose.
#[derive(Clone, Copy, Debug, Default)]
pub struct Angles {
    /// Of the line from the hip joints to the shoulders against the vertical [deg].
    pub trunk_deg: f64,
    /// Mean flexion of the knees [deg].
    pub knee_deg: f64,
    /// Height of the hips [m].
    pub hips_m: f64,
}

pub fn angles(body: &Body, pose: &Pose) -> Angles {
    let at = pose.positions(body);
    let place = |node: Node| at[node.index()];
    let hips = (place(Node::LeftUpperLeg) + place(Node::RightUpperLeg)) * 0.5;
    let shoulders = (place(Node::LeftUpperArm) + place(Node::RightUpperArm)) * 0.5;
    let trunk_deg = (shoulders - hips).angle_between(DVec3::Y).to_degrees();
    let knee = |upper: Node, lower: Node, foot: Node| {
        (place(lower) - place(upper)).angle_between(place(foot) - place(lower)).to_degrees()
    };
    let knee_deg = 0.5
        * (knee(Node::LeftUpperLeg, Node::LeftLowerLeg, Node::LeftFoot)
            + knee(Node::RightUpperLeg, Node::RightLowerLeg, Node::RightFoot));
    Angles { trunk_deg, knee_deg, hips_m: hips.y }
}

pub fn hands(body: &Body, pose: &Pose) -> [DVec3; 2] {
    let at = pose.positions(body);
    [Node::LeftHand, Node::RightHand].map(|node| at[node.index()] + pose.world[node.index()] * body.link(node).centre)
}

/// Both motions.
pub struct Compared {
    pub name: &'static str,
    pub body: Body,
    pub theirs: Vec<Pose>,
    pub ours: Vec<Pose>,
    pub targets: [Option<DVec3>; 2],
    pub reached: bool,
}

/// What a motion is like.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    pub end: Angles,
    pub start: Angles,
    /// Fastest that the hand goes [m/s].
    pub peak_m_s: f64,
    /// When that is [1 of the whole time].
    pub peak_at: f64,
    /// How far the hand's way leaves the straight line [1 of its length].
    pub bow: f64,
}

impl Compared {
    pub fn shape(&self, poses: &[Pose]) -> Shape {
        let side = usize::from(self.targets[0].is_none());
        let way: Vec<DVec3> = poses.iter().map(|pose| hands(&self.body, pose)[side]).collect();
        let line = way[way.len() - 1] - way[0];
        let bow = way
            .iter()
            .map(|place| {
                let out = *place - way[0];
                (out - line * (out.dot(line) / line.length_squared())).length() / line.length()
            })
            .fold(0.0, f64::max);
        let speeds: Vec<f64> = way.windows(6).map(|pair| (pair[5] - pair[0]).length() * HZ / 5.0).collect();
        let (at, peak_m_s) = speeds.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default();
        Shape {
            start: angles(&self.body, &poses[0]),
            end: angles(&self.body, &poses[poses.len() - 1]),
            peak_m_s,
            peak_at: at as f64 / speeds.len().max(1) as f64,
            bow,
        }
    }

    pub fn row(&self) -> String {
        let (theirs, ours) = (self.shape(&self.theirs), self.shape(&self.ours));
        let pair = |one: f64, other: f64, digits: usize| format!("{one:.digits$} / {other:.digits$}");
        format!(
            "| {} | {:.2} | {} | {} | {} | {} | {} | {} |",
            self.name,
            (self.theirs.len() - 1) as f64 / HZ,
            pair(theirs.end.trunk_deg, ours.end.trunk_deg, 0),
            pair(theirs.end.knee_deg, ours.end.knee_deg, 0),
            pair(theirs.end.hips_m - theirs.start.hips_m, ours.end.hips_m - ours.start.hips_m, 2),
            pair(theirs.peak_m_s, ours.peak_m_s, 2),
            pair(theirs.peak_at, ours.peak_at, 2),
            pair(theirs.bow, ours.bow, 2)
        )
    }
}

pub const HEADER: &str = "| person / method | time (s) | trunk (°) | knees (°) | hips (m) | peak speed (m/s) | when (of the time) | bow of the way |\n|---|---|---|---|---|---|---|---|";

pub fn compare(folder: &Path, case: &Case) -> Result<Compared, String> {
    let file = MotionFile::read(&folder.join(case.file), &ReadOptions::default()).map_err(|error| error.to_string())?;
    let parts = file.body_parts().map_err(|error| error.to_string())?;
    let reduction =
        Reduction::new(&file.clip, parts, file.stature_m, Person::default()).map_err(|error| error.to_string())?;
    let clip = resample(&file.clip, HZ);
    let mut body = reduction.body().clone();
    let mut poses: Vec<Pose> = (1..clip.frames()).map(|frame| reduction.pose(&clip.world(frame))).collect();
    // The floor at height 0.
    let sole = |pose: &Pose| {
        [Node::LeftFoot, Node::RightFoot]
            .into_iter()
            .flat_map(|foot| sinew_body::humanoid::Sole::world_corners(&body, pose, foot))
            .map(|corner| corner.y)
            .fold(f64::INFINITY, f64::min)
    };
    let mut floors: Vec<f64> = poses.iter().map(sole).collect();
    floors.sort_by(f64::total_cmp);
    let floor = floors[floors.len() / 4];
    for pose in &mut poses {
        pose.hips_position.y -= floor;
    }
    let height = |pose: &Pose| {
        let both = hands(&body, pose);
        let used: Vec<f64> = (0..2).filter(|side| case.hands[*side]).map(|side| both[side].y).collect();
        used.iter().sum::<f64>() / used.len() as f64 * if case.up { 1.0 } else { -1.0 }
    };
    let heights: Vec<f64> = poses.iter().map(height).collect();
    let (from, to) = ((case.within.0 * HZ) as usize, ((case.within.1 * HZ) as usize).min(poses.len()));
    let end = (from..to).max_by(|a, b| heights[*a].total_cmp(&heights[*b])).unwrap_or(0);
    // Back to where the hands were when they last did not yet rise or sink.
    let slope = |frame: usize| (heights[frame] - heights[frame.saturating_sub(3)]) * HZ / 3.0;
    let mut fastest = end;
    for frame in (from.max(3)..=end).rev() {
        if slope(frame) > slope(fastest) {
            fastest = frame;
        }
        if heights[end] - heights[frame] > 0.35 && slope(frame) < 0.05 {
            break;
        }
    }
    let mut begin = fastest;
    while begin > 3 && slope(begin) > 0.05 {
        begin -= 1;
    }
    let theirs = poses[begin..=end].to_vec();
    for pose in &theirs {
        body.widen_limits(pose);
    }
    let target = hands(&body, &theirs[theirs.len() - 1]);
    let targets = [0, 1].map(|side| case.hands[side].then_some(target[side]));
    let secs = (end - begin) as f64 / HZ;
    let style = Style { time_secs: Some(secs.max(0.3)), ..Style::default() };
    let start = Start { pose: theirs[0], before: None };
    let mut reacher = Reacher::new(&body, &style, &start).map_err(|error| error.to_string())?;
    let outcome = reacher.reach(&Goal { left: targets[0], right: targets[1] }).clone();
    let ours = (0..theirs.len()).map(|frame| reacher.pose_at(frame as f64 / HZ)).collect();
    Ok(Compared { name: case.name, body, theirs, ours, targets, reached: outcome.is_reached() })
}
