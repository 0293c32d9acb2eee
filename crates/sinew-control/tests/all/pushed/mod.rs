//! Standing characters that are pushed.

#![allow(dead_code, reason = "each user takes what it needs")]

use glam::{DQuat, DVec3};
use sinew_body::STANDARD_GRAVITY_M_S2;
use sinew_body::humanoid::{Body, LEGS, Node, Pose, exp, support_margin_m};
use sinew_control::reflex::{Balance, BalanceSettings, Reflex, Sense};
use sinew_control::tracker::{JointGain, PdTracker, Tracker as _};
use sinew_control::{JointTarget, Wanted};
use sinew_world::{CharacterId, CharacterSpec, Surface, World, WorldSettings, hips_over_soles_m};

/// When pushes begin \[s\]: the body has leant to where its weight rests.
pub const PUSH_AT_SECS: f64 = 2.0;

/// Where a push acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// On the hips, at the height of the whole body's centre of mass.
    Centre,
    /// On the trunk, at its own centre of mass.
    Chest,
}

/// A push in a horizontal direction, at [`PUSH_AT_SECS`].
#[derive(Clone, Copy, Debug)]
pub struct Push {
    /// From straight ahead towards the left \[degrees\].
    pub azimuth_deg: f64,
    /// Force times duration \[N s\].
    pub impulse_n_s: f64,
    pub for_secs: f64,
    pub place: Place,
}

impl Push {
    pub fn direction(&self) -> DVec3 {
        let (sin, cos) = libm::sincos(self.azimuth_deg.to_radians());
        DVec3::new(sin, 0.0, cos)
    }
}

/// A standing character.
pub struct Standing {
    pub world: World,
    pub body: Body,
    pub reflex: Balance,
    pub tracker: PdTracker,
    pub target: Wanted,
    /// What the pose wants.
    pub wanted: Wanted,
    start: [DVec3; 2],
}

/// Wanted turns of joints on top of standing straight \[degrees about X, Y, Z\].
pub type Turns<'a> = &'a [(Node, [f64; 3])];

impl Standing {
    /// At the origin, facing +Z.
    pub fn new(body: Body, turns: Turns, settings: BalanceSettings) -> Standing {
        Standing::placed(body, turns, settings, DVec3::ZERO, 0.0)
    }

    /// Elsewhere, its soles at the height of `place`, turned about +Y \[rad\].
    pub fn placed(body: Body, turns: Turns, settings: BalanceSettings, place: DVec3, heading_rad: f64) -> Standing {
        let mut locals = [DQuat::IDENTITY; Node::COUNT];
        for (node, degrees) in turns {
            locals[node.index()] = exp(DVec3::from_array(*degrees) * std::f64::consts::PI / 180.0);
        }
        // The pose as it stands on flat feet.
        let mut pose = Pose::from_locals(DVec3::ZERO, &locals);
        let (upper, lower, foot) = LEGS[0];
        let level = (locals[upper.index()] * locals[lower.index()] * locals[foot.index()]).conjugate();
        locals[0] = DQuat::from_rotation_y(heading_rad) * level;
        pose = Pose::from_locals(pose.hips_position, &locals);
        pose.hips_position = place + DVec3::Y * hips_over_soles_m(&body, &pose);
        let mut wanted = Wanted::STANDING;
        for node in Node::ALL.into_iter().skip(1) {
            *wanted.joint_mut(node) = JointTarget { rotation: locals[node.index()], ..JointTarget::REST };
        }
        let mut world = World::new(WorldSettings::default());
        let spec = CharacterSpec { body: body.clone(), pose, velocity: DVec3::ZERO, surface: Surface::BODY };
        world.add_character(spec).expect("a body");
        let reflex = Balance::new(&body, settings);
        let tracker = PdTracker::new(&body, &[JointGain::DEFAULT; Node::COUNT], STANDARD_GRAVITY_M_S2);
        let mut standing =
            Standing { world, body, reflex, tracker, target: wanted.clone(), wanted, start: [DVec3::ZERO; 2] };
        standing.start = standing.feet();
        standing
    }

    pub fn feet(&self) -> [DVec3; 2] {
        LEGS.map(|(_, _, foot)| self.world.frame().characters[0].part(foot).position)
    }

    /// One step; the push acts in its time.
    pub fn step(&mut self, push: Option<&Push>) {
        self.target.clone_from(&self.wanted);
        let step_secs = self.world.settings().step_secs();
        let sense = Sense {
            frame: self.world.frame(),
            own: CharacterId::first_in(0),
            body: &self.body,
            gains: self.tracker.gains(),
            step_secs,
            gravity_m_s2: self.world.settings().gravity_m_s2,
        };
        self.reflex.step(&sense, &mut self.target);
        self.tracker.follow(&self.target, &mut self.world, CharacterId::first_in(0));
        if let Some(push) = push {
            let (time, me) = (self.world.frame().time_secs, &self.world.frame().characters[0]);
            if time > PUSH_AT_SECS - 1e-9 && time < PUSH_AT_SECS + push.for_secs - 1e-9 {
                let (node, point) = match push.place {
                    Place::Centre => (Node::Hips, me.part(Node::Hips).centre.with_y(me.centre_of_mass.y)),
                    Place::Chest => (Node::Chest, me.part(Node::Chest).centre),
                };
                let force = push.direction() * (push.impulse_n_s / push.for_secs);
                self.world.push_part(CharacterId::first_in(0), node, force, Some(point));
            }
        }
        self.world.step();
    }

    pub fn run(&mut self, for_secs: f64, push: Option<&Push>) {
        for _ in 0..(for_secs * 240.0).round() as usize {
            self.step(push);
        }
    }

    /// How far the feet have gone \[m\].
    pub fn slid_m(&self) -> f64 {
        let feet = self.feet();
        (0..2).map(|side| (feet[side] - self.start[side]).length()).fold(0.0, f64::max)
    }

    /// From the centre of mass to the edge of the ground under the soles, in a direction \[m\].
    pub fn reach_m(&self, direction: DVec3) -> f64 {
        let me = &self.world.frame().characters[0];
        // Bisection: the polygon is convex.
        let (mut inside, mut outside) = (0.0, 2.0);
        for _ in 0..60 {
            let middle = 0.5 * (inside + outside);
            if support_margin_m(&me.support, me.centre_of_mass + direction * middle) > 0.0 {
                inside = middle;
            } else {
                outside = middle;
            }
        }
        inside
    }

    /// What it could stand without a step: m √(g/h) times that distance \[N s\].
    pub fn bound_n_s(&self, direction: DVec3) -> f64 {
        let me = &self.world.frame().characters[0];
        self.body.mass_kg() * (9.81 / me.centre_of_mass.y).sqrt() * self.reach_m(direction)
    }

    pub fn is_up(&self, height_m: f64) -> bool {
        self.world.frame().characters[0].centre_of_mass.y > 0.9 * height_m
    }
}

/// What a push came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    /// Up, quiet, and on its spot.
    Stands,
    Fell,
    /// It stands, but a foot is elsewhere.
    Stepped,
    /// It stands on its spot, but moves or leans elsewhere than before.
    Unquiet,
}

/// What has become of a character six seconds after a push.
pub fn outcome(make: &dyn Fn() -> Standing, push: &Push) -> Outcome {
    let mut standing = make();
    standing.run(PUSH_AT_SECS, None);
    standing.start = standing.feet();
    let before = standing.world.frame().characters[0].centre_of_mass;
    for _ in 0..24 {
        standing.run(0.25, Some(push));
        if !standing.is_up(before.y) {
            return Outcome::Fell;
        }
    }
    let me = &standing.world.frame().characters[0];
    if standing.slid_m() > 0.05 {
        Outcome::Stepped
    } else if me.centre_velocity.length() > 0.03 || (me.centre_of_mass - before).length() > 0.03 {
        Outcome::Unquiet
    } else {
        Outcome::Stands
    }
}

/// The impulse up to which a character stands, found by halving \[N s\].
pub fn stood_n_s(make: &dyn Fn() -> Standing, push: Push, bound_n_s: f64, halvings: usize) -> (f64, Outcome) {
    let (mut stood, mut fell, mut end) = (0.0, 2.0 * bound_n_s, Outcome::Fell);
    for _ in 0..halvings {
        let impulse_n_s = 0.5 * (stood + fell);
        match outcome(make, &Push { impulse_n_s, ..push }) {
            Outcome::Stands => stood = impulse_n_s,
            other => (fell, end) = (impulse_n_s, other),
        }
    }
    (stood, end)
}

pub const KNEES_BENT: Turns = &[
    (Node::LeftUpperLeg, [-20.0, 0.0, 0.0]),
    (Node::RightUpperLeg, [-20.0, 0.0, 0.0]),
    (Node::LeftLowerLeg, [40.0, 0.0, 0.0]),
    (Node::RightLowerLeg, [40.0, 0.0, 0.0]),
    (Node::LeftFoot, [-20.0, 0.0, 0.0]),
    (Node::RightFoot, [-20.0, 0.0, 0.0]),
];

pub const GUARD: Turns = &[
    (Node::LeftUpperLeg, [-30.0, 0.0, 8.0]),
    (Node::RightUpperLeg, [-2.0, 0.0, -8.0]),
    (Node::LeftLowerLeg, [30.0, 0.0, 0.0]),
    (Node::RightLowerLeg, [22.0, 0.0, 0.0]),
    (Node::LeftFoot, [0.0, 0.0, -8.0]),
    (Node::RightFoot, [-20.0, 0.0, 8.0]),
    (Node::LeftUpperArm, [-40.0, 0.0, 10.0]),
    (Node::RightUpperArm, [-40.0, 0.0, -10.0]),
    (Node::LeftLowerArm, [-110.0, 0.0, 0.0]),
    (Node::RightLowerArm, [-110.0, 0.0, 0.0]),
];

pub const STRIDE: Turns = &[
    (Node::LeftUpperLeg, [-10.0, 0.0, 0.0]),
    (Node::RightUpperLeg, [6.0, 0.0, 0.0]),
    (Node::LeftLowerLeg, [8.0, 0.0, 0.0]),
    (Node::RightLowerLeg, [4.0, 0.0, 0.0]),
    (Node::LeftFoot, [2.0, 0.0, 0.0]),
    (Node::RightFoot, [-10.0, 0.0, 0.0]),
];
