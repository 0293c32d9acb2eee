//! Captured motion as a performer, and how well a body follows it.
#![allow(dead_code, reason = "tests, example and benchmark use a part each")]

use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Person, Pose, Reduction, log};
use sinew_control::tracker::{KdSettings, KdTracker};
use sinew_motion::formats::{MotionFile, ReadOptions};
use sinew_motion::{moves_from, resample};
use sinew_world::{CharacterId, CharacterSpec, Entity, Surface, World, WorldSettings, hips_over_soles_m};
use std::path::Path;

pub const HZ: f64 = 60.0;

/// Walks in every style, each of another person or trial.
pub const WALKS: [&str; 17] = [
    "cmu_asfamc/02_01.amc",
    "cmu_asfamc/06_01.amc",
    "cmu_asfamc/07_01.amc",
    "cmu_asfamc/08_01.amc",
    "cmu_asfamc/16_15.amc",
    "cmu_asfamc/35_01.amc",
    "cmu_bvh_motionbuilder/08_11.bvh",
    "cmu_bvh_motionbuilder/09_12.bvh",
    "cmu_bvh_motionbuilder/12_01.bvh",
    "cmu_bvh_60hz_trimmed/120_08_sneak.bvh",
    "accad_bvh/Female1_B03_Walk1.bvh",
    "accad_bvh/Female1_B05_WalkBackwards.bvh",
    "accad_bvh/Female1_B20_WalkWithBox.bvh",
    "accad_bvh/Female1_B22_SideStepLeft.bvh",
    "accad_bvh/Female1_B24_WalkToCrouch.bvh",
    "dialects/bvhtoolbox_walk01.bvh",
    "dialects/gpmat_Swagger.bvh",
];

pub const RUNS: [&str; 4] = [
    "cmu_bvh_motionbuilder/02_03.bvh",
    "cmu_bvh_motionbuilder/09_01.bvh",
    "accad_bvh/Female1_C03_Run.bvh",
    "accad_bvh/Female1_C07_RunBackwards.bvh",
];

pub const BOXING: [&str; 4] = [
    "cmu_bvh_daz/13_18.bvh",
    "cmu_bvh_motionbuilder/02_05.bvh",
    "cmu_bvh_60hz_trimmed/143_23_punch.bvh",
    "accad_bvh/Male2_E1_JabLeft.bvh",
];

pub const BASKETBALL: [&str; 3] =
    ["cmu_bvh_motionbuilder/06_02.bvh", "cmu_bvh_motionbuilder/06_06.bvh", "cmu_bvh_motionbuilder/06_15.bvh"];

/// A motion at 60 Hz, and the body that performs it.
#[derive(Clone)]
pub struct Performer {
    pub body: Body,
    pub poses: Vec<Pose>,
}

impl Performer {
    /// The whole clip, by a person of 80 kg.
    pub fn read(path: &Path) -> Performer {
        Performer::scaled(path, 80.0, None)
    }

    /// By a person of another mass \[kg\] and height \[m\].
    pub fn scaled(path: &Path, mass_kg: f64, height_m: Option<f64>) -> Performer {
        let file = MotionFile::read(path, &ReadOptions::default()).expect("a clip");
        let humanoid = file.body_parts().expect("a body");
        let person = Person { mass_kg, height_m };
        let reduction = Reduction::new(&file.clip, humanoid, file.stature_m, person).expect("proportions");
        // Many files begin with a pose that is not part of the motion.
        let first = moves_from(&file.clip, humanoid) as f64 * file.clip.frame_time_secs();
        let clip = resample(&file.clip, HZ);
        let first = (first * HZ).ceil() as usize;
        let mut poses: Vec<Pose> = (first..clip.frames()).map(|frame| reduction.pose(&clip.world(frame))).collect();
        let mut body = reduction.body().clone();
        poses.iter().for_each(|pose| body.widen_limits(pose));
        let floor = floor_m(&body, &poses);
        poses.iter_mut().for_each(|pose| pose.hips_position.y -= floor);
        Performer { body, poses }
    }

    pub fn pose(&self, frame: usize) -> &Pose {
        &self.poses[frame.min(self.poses.len() - 1)]
    }

    pub fn centres(&self, pose: &Pose) -> [DVec3; Node::COUNT] {
        let joints = pose.positions(&self.body);
        Node::ALL.map(|node| joints[node.index()] + pose.world[node.index()] * self.body.link(node).centre)
    }
}

/// Where the soles stand: they come lower by some centimetres only as feet roll off.
fn floor_m(body: &Body, poses: &[Pose]) -> f64 {
    let mut lowest: Vec<f64> = poses.iter().map(|pose| pose.hips_position.y - hips_over_soles_m(body, pose)).collect();
    lowest.sort_by(f64::total_cmp);
    lowest[lowest.len() / 4]
}

/// A world with the performer's body in it.
pub struct Act {
    pub performer: Performer,
    pub world: World,
    pub tracker: KdTracker,
    /// Motion frames done.
    pub frame: usize,
}

impl Act {
    pub fn new(performer: &Performer, settings: KdSettings) -> Act {
        Act::in_world(performer, settings, WorldSettings::default())
    }

    pub fn in_world(performer: &Performer, settings: KdSettings, world: WorldSettings) -> Act {
        let mut world = World::new(world);
        let (first, second) = (*performer.pose(0), *performer.pose(1));
        let spec =
            CharacterSpec { body: performer.body.clone(), pose: second, velocity: DVec3::ZERO, surface: Surface::BODY };
        world.add_character(spec).expect("a character");
        let mut tracker = KdTracker::new(&performer.body, settings, 1.0 / HZ, &first);
        tracker.restart(&performer.body, &first, &second, world.settings().step_secs());
        tracker.launch(&mut world, CharacterId::first_in(0));
        Act { performer: performer.clone(), world, tracker, frame: 1 }
    }

    /// One step of physics.
    pub fn step(&mut self) {
        self.track();
        self.world.step();
    }

    /// The tracker's part of a step.
    pub fn track(&mut self) {
        if self.tracker.wants_pose() {
            self.frame += 1;
            self.tracker.wanted(self.performer.pose(self.frame));
        }
        self.tracker.physics_step(&mut self.world, CharacterId::first_in(0));
    }

    /// Steps until a motion frame is over.
    pub fn frame(&mut self) {
        self.step();
        while !self.tracker.wants_pose() {
            self.step();
        }
    }

    /// The wanted pose of now, after [`Act::frame`].
    pub fn wanted(&self) -> &Pose {
        self.performer.pose(self.frame)
    }

    pub fn is_over(&self) -> bool {
        self.frame + 1 >= self.performer.poses.len()
    }
}

/// How well a body followed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Following {
    /// Mean angle between a joint and the performer's \[degrees\].
    pub joint_deg: f64,
    /// Root mean square distance of the hips from the performer's \[m\].
    pub root_m: f64,
    /// Root mean square distance of all body centres from the performer's \[m\].
    pub centres_m: f64,
    /// How long it is behind: the time shift that explains most of the distances \[s\].
    pub lag_secs: f64,
    /// Mean speed of the feet along the floor in which the performer's feet stand, and the performer's own \[m/s\].
    pub skate_m_s: [f64; 2],
    /// How far the hips came down below the performer's \[m\], and the chest tilted from the performer's \[degrees\].
    pub sunk_m: f64,
    pub tilted_deg: f64,
    /// Motion frames that were looked at.
    pub frames: usize,
}

impl Following {
    /// The whole performance.
    pub fn of(performer: &Performer, settings: KdSettings) -> Following {
        let mut act = Act::new(performer, settings);
        let mut found = Following::default();
        let (mut late, mut fast, mut stood) = (0.0, 0.0, 0.0);
        let mut before = performer.centres(act.wanted());
        let mut feet_before = feet(&act);
        while !act.is_over() {
            act.frame();
            let (wanted, pose) = (*act.wanted(), act.world.frame().characters[0].pose());
            let centres = performer.centres(&wanted);
            let parts = act.world.frame().characters[0].parts;
            let sole = feet(&act);
            for node in Node::ALL {
                let at = node.index();
                let off = parts[at].centre - centres[at];
                let velocity = (centres[at] - before[at]) * HZ;
                found.centres_m += off.length_squared() / Node::COUNT as f64;
                late -= off.dot(velocity);
                fast += velocity.length_squared();
                if node.parent().is_some() {
                    let turn = log((wanted.local(node).conjugate() * pose.local(node)).normalize());
                    found.joint_deg += turn.length().to_degrees() / (Node::COUNT - 1) as f64;
                }
            }
            for (side, node) in [Node::LeftFoot, Node::RightFoot].into_iter().enumerate() {
                let own = (centres[node.index()] - before[node.index()]).with_y(0.0).length() * HZ;
                let touches =
                    act.world.frame().are_touching(Entity::Floor, Entity::Part(CharacterId::first_in(0), node));
                if touches && own < 0.25 {
                    found.skate_m_s[0] += (sole[side] - feet_before[side]).with_y(0.0).length() * HZ;
                    found.skate_m_s[1] += own;
                    stood += 1.0;
                }
            }
            found.root_m += (pose.hips_position - wanted.hips_position).length_squared();
            found.sunk_m = found.sunk_m.max(wanted.hips_position.y - pose.hips_position.y);
            let up = |pose: &Pose| pose.world[Node::Chest.index()] * DVec3::Y;
            found.tilted_deg = found.tilted_deg.max(up(&wanted).angle_between(up(&pose)).to_degrees());
            found.frames += 1;
            (before, feet_before) = (centres, sole);
        }
        let frames = found.frames as f64;
        found.joint_deg /= frames;
        found.root_m = (found.root_m / frames).sqrt();
        found.centres_m = (found.centres_m / frames).sqrt();
        found.lag_secs = late / fast;
        found.skate_m_s = found.skate_m_s.map(|speed| speed / f64::max(stood, 1.0));
        found
    }

    /// A performer who stays up stays up here.
    pub fn fell(&self) -> bool {
        self.sunk_m > 0.2 || self.tilted_deg > 40.0
    }
}

fn feet(act: &Act) -> [DVec3; 2] {
    let parts = &act.world.frame().characters[0].parts;
    [Node::LeftFoot, Node::RightFoot].map(|node| parts[node.index()].centre)
}

/// A performer who stands at ease.
pub fn standing(secs: f64) -> Performer {
    let body = Body::standard(80.0, 1.7);
    let mut pose = Pose::STANDING;
    pose.hips_position.y = hips_over_soles_m(&body, &pose);
    Performer { body, poses: vec![pose; (secs * HZ) as usize] }
}

/// What a hit does to a body, against the same performance without it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Hit {
    /// How far the part that was hit goes at most \[m\].
    pub own_m: f64,
    /// How far the part of the upper body goes at most that goes farthest \[m\], and when, from the hit's beginning \[s\].
    pub peak_m: f64,
    pub peak_secs: f64,
    /// When every part is back within 1 cm for good, from the hit's end \[s\].
    pub back_secs: f64,
    /// How far a foot goes at most, and the hips sink \[m\].
    pub feet_m: f64,
    pub sunk_m: f64,
    /// What the pins did on top until then: the largest force and power, all parts together \[N, W\], and the work \[J\].
    pub force_n: f64,
    pub power_w: f64,
    pub work_j: f64,
}

/// A hit lasts so long \[s\].
pub const HIT_SECS: f64 = 0.1;

impl Hit {
    /// Of an impulse \[N s\] on a part's centre at a time.
    pub fn of(performer: &Performer, settings: &KdSettings, node: Node, impulse: DVec3, at_secs: f64) -> Hit {
        let mut acts = [Act::new(performer, settings.clone()), Act::new(performer, settings.clone())];
        let step_secs = acts[0].world.settings().step_secs();
        let steps = |secs: f64| (secs / step_secs).round() as usize;
        let (begin, end) = (steps(at_secs), steps(at_secs + HIT_SECS));
        let mut hit = Hit::default();
        for step in 0..end + steps(4.0) {
            if (begin..end).contains(&step) {
                acts[0].world.push_part(CharacterId::first_in(0), node, impulse / HIT_SECS, None);
            }
            acts.iter_mut().for_each(Act::step);
            if step < begin {
                continue;
            }
            let [was_hit, was_not] = &acts;
            let (a, b) = (&was_hit.world.frame().characters[0], &was_not.world.frame().characters[0]);
            let off = |node: Node| (a.part(node).centre - b.part(node).centre).length();
            hit.own_m = hit.own_m.max(off(node));
            let farthest = Node::ALL.into_iter().filter(|node| !node.is_leg()).map(off).fold(0.0, f64::max);
            if farthest > hit.peak_m {
                (hit.peak_m, hit.peak_secs) = (farthest, (step - begin + 1) as f64 * step_secs);
            }
            if step >= end && Node::ALL.into_iter().any(|node| off(node) > 0.01) {
                hit.back_secs = (step - end + 1) as f64 * step_secs;
            }
            hit.feet_m = hit.feet_m.max(off(Node::LeftFoot)).max(off(Node::RightFoot));
            hit.sunk_m = hit.sunk_m.max(b.part(Node::Hips).position.y - a.part(Node::Hips).position.y);
            let (mut force_n, mut power_w) = (0.0, 0.0);
            for (hit, not) in a.external.iter().zip(&b.external) {
                force_n += (hit.pin.force - not.pin.force).length();
                power_w += hit.pin.power_w - not.pin.power_w;
            }
            hit.force_n = hit.force_n.max(force_n);
            hit.power_w = hit.power_w.max(power_w.abs());
            hit.work_j += power_w * step_secs;
        }
        hit
    }
}
