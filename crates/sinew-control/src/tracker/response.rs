//! The response tracker: the response gets the forces of contacts in the world, and its body pushes with its own mass.
//!
//! All parts stay dynamic bodies. Implicit springs of limited force hold them to the pose that the response returns, so
//! that at the instant of a contact a part has its own mass and not more. The contact forces on the parts over a motion
//! frame are passed to the response; its next pose is the target of the springs. So a part that is hit first moves by
//! its own inertia and then yields in the style of the response. Pushes go to the response alone, which answers them as it
//! does without a world.
//!
//! The motion stands on its ground already: legs pass through floor and platform and through each other, and so do other parts
//! that the motion brings close, because the body's shapes are wider than the performer's.

use super::clock::Clock;
use super::contact_forces::ContactForces;
use super::hold::{Grip, GroundMotion, Hold};
use super::instant::Instant;
use super::pose_interpolator::{PoseInterpolator, led_to};
use super::self_collision::SelfCollision;
use super::tasks::Tasks;
use super::{Honours, Tracker, TrackerKind, TrackerStart, Wants};
use crate::Wanted;
use glam::DVec3;
use sinew_body::humanoid::{Body, Deviation, Node, Pose};
use sinew_response::{Basis, PointForce, Response, Settings};
use sinew_world::{CharacterId, PropId, World};

/// Follows wanted poses with the response of [`sinew_response`], in a world.
///
/// Each step of physics: [`physics_step`](ResponseTracker::physics_step), then [`World::step`]. Where
/// [`wants_pose`](ResponseTracker::wants_pose) says so, that is at the start of each motion frame, pass the pose of the
/// frame's end first. Contacts of a motion frame take effect in the pose of the next one.
///
/// Wanted poses are taken as on ground at rest. On a moving platform say so with
/// [`stand_on`](ResponseTracker::stand_on): body and wanted poses are carried along, and the upper body lags.
#[derive(Clone, Debug)]
pub struct ResponseTracker {
    response: Response,
    clock: Clock,
    interpolator: PoseInterpolator,
    hold: Hold,
    wanted: Pose,
    /// What the response follows: the same, low-passed where that is known.
    smooth: Pose,
    felt: ContactForces,
    forces: Vec<PointForce>,
    tasks: Tasks,
    platform: Option<Platform>,
    self_collision: SelfCollision,
    /// The prop that the legs pass through.
    passed: Option<PropId>,
}

// The forces are computed anew in every frame.
sinew_snapshot::snapshot!(ResponseTracker { response, clock, interpolator, hold, wanted, smooth, felt, tasks, platform, self_collision, passed } fixed { forces });
sinew_snapshot::snapshot!(Platform { prop, origin, step_velocity, frame_velocity });

/// A moving prop that the character stands on.
#[derive(Clone, Copy, Debug, Default)]
struct Platform {
    prop: PropId,
    /// Its position when the character stepped on it \[m\].
    origin: DVec3,
    /// Its velocity one step of physics ago, and one motion frame ago \[m/s\].
    step_velocity: DVec3,
    frame_velocity: DVec3,
}

impl Grip {
    /// Stiff enough that body and pose look the same, soft enough that an impact is visible.
    pub const RESPONSE: Grip = Grip { frequency_hz: 6.0, max_acceleration: 150.0 };
}

impl ResponseTracker {
    /// Starts at rest in `first`. `body` is the one that the world's character was made of, its limits widened to the motion;
    /// wanted poses come every [`Settings::time_step_secs`].
    pub fn new(body: Body, basis: Basis, settings: Settings, first: &Pose) -> ResponseTracker {
        ResponseTracker {
            hold: Hold::new(Grip::RESPONSE, &body, first),
            self_collision: SelfCollision::new(&body),
            response: Response::new(body, basis, settings, first),
            clock: Clock::new(settings.time_step_secs),
            interpolator: PoseInterpolator::rest(first),
            wanted: *first,
            smooth: *first,
            felt: ContactForces::default(),
            forces: Vec::with_capacity(Node::COUNT),
            tasks: Tasks::none(),
            platform: None,
            passed: None,
        }
    }

    /// Resets and continues from a motion that went from `before` to `now`, one motion frame apart: after a cut, or
    /// when the body was moved by something else. Tasks and platform stay.
    pub fn restart(&mut self, before: &Pose, now: &Pose) {
        self.response.restart(before, now);
        self.interpolator = PoseInterpolator::moving(before, now);
        self.hold.restart(self.response.body(), now, now);
        self.clock = Clock::new(self.clock.time_step_secs());
        self.felt = ContactForces::default();
        (self.wanted, self.smooth) = (*now, *now);
    }

    /// Whether the next step of physics begins a motion frame.
    pub fn wants_pose(&self) -> bool {
        self.clock.is_due()
    }

    /// Sets the pose for the end of the motion frame that begins. One that is not finite is ignored.
    pub fn wanted(&mut self, pose: &Pose) {
        self.wanted_with_smooth(pose, pose);
    }

    /// As [`wanted`](ResponseTracker::wanted), where the same pose is known low-passed too: the response follows that one, and its
    /// deviations are added to the pose itself. So a body that nothing disturbs shows its motion with all its detail.
    pub fn wanted_with_smooth(&mut self, pose: &Pose, smooth: &Pose) {
        if pose.is_finite() && smooth.is_finite() {
            (self.wanted, self.smooth) = (*pose, *smooth);
        }
    }

    /// Sets the moving prop on which it stands, or ground at rest.
    pub fn stand_on(&mut self, world: &World, prop: Option<PropId>) {
        self.platform = prop.and_then(|prop| {
            let state = world.frame().prop(prop)?;
            let (origin, velocity) = (state.position, state.velocity);
            Some(Platform { prop, origin, step_velocity: velocity, frame_velocity: velocity })
        });
    }

    /// Keeps the present vertical axis of a part vertical, such as a cup in a hand, as well as the joints allow. `None`
    /// switches it off.
    pub fn keep_upright(&mut self, node: Option<Node>) {
        self.tasks.keep_upright(node, self.interpolator.end());
    }

    /// The part that is kept upright, and which of its axes points up.
    pub fn upright(&self) -> Option<(Node, DVec3)> {
        self.tasks.upright()
    }

    /// Sets props as obstacles of trunk, head and arms. They are avoided as far as the motion allows; legs and hips
    /// follow the motion.
    pub fn avoid(&mut self, props: &[PropId]) {
        self.tasks.avoid(props);
    }

    /// Reads the contacts of the world's last step, and sets the targets of all parts for its next one.
    pub fn physics_step(&mut self, world: &mut World, character: CharacterId) {
        self.felt.add(world, character, self.platform.map(|platform| platform.prop));
        let step_secs = world.settings().step_secs();
        let ground = self.ground(world, step_secs);
        let begins = self.clock.is_due();
        if begins {
            self.clock.begin_frame();
            self.begin_frame(&ground, world);
            self.pass_ground(world, character);
        }
        self.felt.take_pushes(world, character);
        let next = self.interpolator.at(self.clock.advance(step_secs));
        if begins && let Some(frame) = world.frame().character(character) {
            let mut masks = self.self_collision.look(&Instant::of(self.response.body(), &next), frame);
            // The motion decides where both legs are; soles of a box each would catch on the other leg.
            for leg in LEGS {
                masks[leg.index()] |= LEGS_MASK;
            }
            world.set_passes_own(character, masks);
        }
        self.hold.carry_to(&next, &ground, world, character);
    }

    fn begin_frame(&mut self, ground: &GroundMotion, world: &World) {
        let frame_secs = self.clock.time_step_secs();
        self.felt.take(frame_secs, &mut self.forces);
        let mut acceleration = DVec3::ZERO;
        if let Some(platform) = &mut self.platform {
            acceleration = (ground.velocity - platform.frame_velocity) / frame_secs;
            platform.frame_velocity = ground.velocity;
        }
        let tasks = self.tasks.of(self.interpolator.end(), self.response.body(), ground.shift, world);
        self.response.step_with_tasks(&self.smooth, &self.forces, acceleration, tasks);
        // The world has the actual position of its platform.
        let deviation = Deviation { ground_shift: DVec3::ZERO, ..self.response.deviation() };
        self.interpolator.next(&self.wanted.deviated(self.response.body(), &deviation));
    }

    /// Legs pass through the ground.
    fn pass_ground(&mut self, world: &mut World, character: CharacterId) {
        let ground = self.platform.map(|platform| platform.prop);
        for leg in LEGS {
            world.set_passes_floor(character, leg, true);
            if self.passed != ground
                && let Some(before) = self.passed
            {
                world.set_passes_prop(character, leg, before, false);
            }
            if let Some(prop) = ground {
                world.set_passes_prop(character, leg, prop, true);
            }
        }
        self.passed = ground;
    }

    fn ground(&mut self, world: &World, step_secs: f64) -> GroundMotion {
        let Some(platform) = &mut self.platform else { return GroundMotion::default() };
        let Some(state) = world.frame().prop(platform.prop) else { return GroundMotion::default() };
        let acceleration = (state.velocity - platform.step_velocity) / step_secs;
        platform.step_velocity = state.velocity;
        GroundMotion { shift: state.position - platform.origin, velocity: state.velocity, acceleration }
    }

    /// The last forces on the response: the mean over the previous motion frame.
    pub fn forces(&self) -> &[PointForce] {
        &self.forces
    }

    /// The pose that the body is held to at the end of this motion frame, on ground at rest.
    pub fn pose(&self) -> &Pose {
        self.interpolator.end()
    }

    /// The response, read only.
    pub fn response(&self) -> &Response {
        &self.response
    }

    /// Sets another stiffness than [`Grip::RESPONSE`].
    pub fn set_grip(&mut self, grip: Grip) {
        self.hold.set_grip(grip);
    }

    /// See [`Tracker::honours`].
    pub const HONOURS: Honours = Honours::NOTHING;
}

impl Tracker for ResponseTracker {
    fn cloned(&self) -> Box<dyn Tracker> {
        Box::new(self.clone())
    }

    fn kind(&self) -> TrackerKind {
        TrackerKind::Response
    }

    fn honours(&self) -> Honours {
        ResponseTracker::HONOURS
    }

    fn wants(&self) -> Wants {
        if self.wants_pose() { Wants::Pose } else { Wants::Nothing }
    }

    /// Continues in the middle of a motion that is known beforehand; at the world's start the body has its velocity.
    fn start(&mut self, start: &TrackerStart, world: &mut World, character: CharacterId) {
        let Some(motion) = start.motion else { return };
        let (now_secs, frame_secs) = (world.frame().time_secs, self.clock.time_step_secs());
        let now = motion(now_secs);
        let is_start = world.frame().step == 0;
        let before = if is_start { led_to(&now, &motion(frame_secs)) } else { motion(now_secs - frame_secs) };
        self.restart(&before, &now);
        self.keep_upright(self.upright().map(|(node, _)| node));
        if is_start {
            let share = 1.0 - world.settings().step_secs() / frame_secs;
            self.hold.restart(self.response.body(), &self.interpolator.at(share), &now);
            self.hold.launch(world, character);
        }
    }

    fn follow(&mut self, wanted: &Wanted, world: &mut World, character: CharacterId) {
        if self.wants_pose() {
            self.wanted_with_smooth(&wanted.pose, wanted.smooth.as_ref().unwrap_or(&wanted.pose));
        }
        self.physics_step(world, character);
    }

    fn release(&mut self, world: &mut World, character: CharacterId) {
        world.set_limp(character);
        world.set_passes_own(character, [0; Node::COUNT]);
        for leg in LEGS {
            world.set_passes_floor(character, leg, false);
            if let Some(prop) = self.passed {
                world.set_passes_prop(character, leg, prop, false);
            }
        }
        self.passed = None;
    }
}

/// The parts of both legs.
const LEGS: [Node; 6] =
    [Node::LeftUpperLeg, Node::LeftLowerLeg, Node::LeftFoot, Node::RightUpperLeg, Node::RightLowerLeg, Node::RightFoot];

/// A bit for each of them.
const LEGS_MASK: u32 = {
    let (mut mask, mut at) = (0, 0);
    while at < LEGS.len() {
        mask |= 1 << LEGS[at].index();
        at += 1;
    }
    mask
};
