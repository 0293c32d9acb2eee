//! The sample walk, again and again, followed by a character in a world.
#![allow(dead_code, reason = "tests and example use a part each")]

use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Person, Pose, Reduction, log};
use sinew_control::tracker::ResponseTracker;
use sinew_motion::formats::{MotionFile, ReadOptions};
use sinew_response::{Basis, Excerpt, PreparedClip, Settings};
use sinew_world::{
    CharacterId, CharacterSpec, Form, PropSpec, Solid, Surface, World, WorldSettings, hips_over_soles_m,
};

/// A walk of a given number of strides.
#[derive(Clone)]
pub struct Walk {
    pub body: Body,
    pub basis: Basis,
    pub settings: Settings,
    pub poses: Vec<Pose>,
    /// Poses of one stride.
    pub stride: usize,
}

impl Walk {
    /// Along +Z; `on_the_spot` takes the progress away, as on a treadmill.
    pub fn new(strides: usize, on_the_spot: bool) -> Walk {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../samples/walk.bvh");
        let file = MotionFile::read(file.as_ref(), &ReadOptions::default()).expect("the sample");
        let humanoid = file.body_parts().expect("a body");
        let person = Person { mass_kg: 80.0, height_m: Some(1.7) };
        let reduction = Reduction::new(&file.clip, humanoid, file.stature_m, person).expect("proportions");
        let excerpt = Excerpt { cycle: None, repeat: strides };
        let clip = PreparedClip::new(&file.clip, humanoid, reduction, excerpt, Settings::default()).expect("a walk");
        let prepared = clip.motion();
        let (body, stride) = (prepared.body().clone(), prepared.measured().len() - 1);
        let mut poses = prepared.motion().poses().to_vec();
        // The soles touch the floor where they come lowest; the walk goes along +Z from the origin.
        let lowest = poses.iter().map(|pose| sole_height(&body, pose)).fold(f64::INFINITY, f64::min);
        let last = poses.len() - 1;
        let across = poses[last].hips_position - poses[0].hips_position;
        let turn = DQuat::from_rotation_y(-libm::atan2(across.x, across.z));
        let start = poses[0].hips_position.with_y(lowest);
        let speed = across.with_y(0.0).length() / last as f64;
        for (frame, pose) in poses.iter_mut().enumerate() {
            pose.hips_position = turn * (pose.hips_position - start);
            pose.world = pose.world.map(|rotation| (turn * rotation).normalize());
            if on_the_spot {
                pose.hips_position.z -= frame as f64 * speed;
            }
        }
        Walk { body, basis: prepared.basis().clone(), settings: *prepared.settings(), poses, stride }
    }

    pub fn pose(&self, frame: usize) -> &Pose {
        &self.poses[frame.min(self.poses.len() - 1)]
    }

    pub fn centres(&self, pose: &Pose) -> [DVec3; Node::COUNT] {
        let joints = pose.positions(&self.body);
        Node::ALL.map(|node| joints[node.index()] + pose.world[node.index()] * self.body.link(node).centre)
    }
}

fn sole_height(body: &Body, pose: &Pose) -> f64 {
    pose.hips_position.y - hips_over_soles_m(body, pose)
}

/// A world with the walker as its only character.
pub struct Scene {
    pub walk: Walk,
    pub world: World,
    pub tracker: ResponseTracker,
    /// Motion frames done.
    pub frame: usize,
}

impl Scene {
    pub fn new(walk: &Walk) -> Scene {
        Scene::in_world(walk, WorldSettings::default())
    }

    pub fn in_world(walk: &Walk, settings: WorldSettings) -> Scene {
        let mut world = World::new(settings);
        let first = *walk.pose(0);
        let velocity = (walk.pose(6).hips_position - first.hips_position).with_y(0.0) * 10.0;
        let spec = CharacterSpec { body: walk.body.clone(), pose: first, velocity, surface: Surface::BODY };
        world.add_character(spec).expect("a character");
        let tracker = ResponseTracker::new(walk.body.clone(), walk.basis.clone(), walk.settings, &first);
        Scene { walk: walk.clone(), world, tracker, frame: 0 }
    }

    /// One step of physics.
    pub fn step(&mut self) {
        if self.tracker.wants_pose() {
            self.frame += 1;
            self.tracker.wanted(self.walk.pose(self.frame));
        }
        self.tracker.physics_step(&mut self.world, CharacterId::first_in(0));
        self.world.step();
    }

    /// Steps until a motion frame is over.
    pub fn frame(&mut self) {
        self.step();
        while !self.tracker.wants_pose() {
            self.step();
        }
    }

    /// Motion frames until one is reached.
    pub fn frames_until(&mut self, frame: usize) {
        while self.frame < frame {
            self.frame();
        }
    }

    /// The wanted pose of now, after [`Scene::frame`].
    pub fn wanted(&self) -> &Pose {
        self.walk.pose(self.frame)
    }

    pub fn pose(&self) -> Pose {
        self.world.frame().characters[0].pose()
    }

    /// Root mean square of the distances of all parts' centres from where a pose has them \[m\].
    pub fn error_m(&self, pose: &Pose) -> f64 {
        let parts = &self.world.frame().characters[0].parts;
        let squares = self.walk.centres(pose).into_iter().zip(parts).map(|(a, b)| (a - b.centre).length_squared());
        (squares.sum::<f64>() / Node::COUNT as f64).sqrt()
    }
}

/// How far a joint is from where a pose has it \[degrees\].
pub fn angle_deg(ours: &Pose, theirs: &Pose, node: Node) -> f64 {
    log(theirs.local(node).conjugate() * ours.local(node)).length().to_degrees()
}

/// A ball that flies straight.
pub fn ball(mass_kg: f64, radius_m: f64, bounce: f64, position: DVec3, velocity: DVec3) -> PropSpec {
    let solid = Solid::new(Form::Ball { radius_m });
    let mut spec = PropSpec::new(solid, sinew_world::Motion::Dynamic { mass_kg }, position);
    spec.surface.bounce = bounce;
    spec.velocity = velocity;
    spec.gravity_scale = 0.0;
    spec
}
