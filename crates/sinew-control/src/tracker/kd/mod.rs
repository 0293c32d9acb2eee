//! A performer's motion as forces on a body (Nguyen et al. 2010, section 4).
//!
//! Two signals act on one simulated body. The kinematic one, the pin, holds every part to its position in the world,
//! u_K = k_p (p̂ − p) − d_p ṗ (EQ1); the dynamic one holds every joint to its angles, u_D = k_q I (q̂ − q) − d_q q̇
//! (EQ2), with I the outboard inertia of the joint. Each has a weight for each part, and the weights change over time.
//!
//! As printed the two do not suffice: see [`KdGains`] for the meaning of the numbers, [`KdDamping`] for the reference
//! of damping, and [`Pin`] for the integration. Feed-forward adds the forces that the wanted motion itself requires:
//! each part's m (â − g) in proportion to its pin's weight, and the torques I α̂ + ω̂ × I ω̂ of all parts below a
//! joint. So an undisturbed body follows without lag, and a disturbed one is no stiffer than its gains.

mod as_tracker;
mod carrier;
mod contact_support;
mod get_up;
mod impact_compliance;
mod inertial_blend;
mod ramp;
mod settings;
mod strength;
mod transition;

pub use settings::{KdDamping, KdGains, KdPreset, KdSettings, KdWeight};

use super::clock::Clock;
use super::instant::Instant;
use super::pose_interpolator::PoseInterpolator;
use super::self_collision::SelfCollision;
use carrier::{Carried, Carrier};
use contact_support::ContactSupport;
use glam::{DMat3, DVec3};
use impact_compliance::ImpactCompliance;
use inertial_blend::InertialBlend;
use ramp::Ramp;
use sinew_body::humanoid::{Body, Node, Pose, log};
use sinew_world::{CharacterId, Drive, Pin, PropId, World};
use strength::max_pin_forces_n;
use transition::Transition;

/// Follows wanted poses with forces on every part and torques in every joint.
///
/// Each step of physics: [`physics_step`](KdTracker::physics_step), then [`World::step`]. Where
/// [`wants_pose`](KdTracker::wants_pose) says so, that is at the start of each motion frame, pass the pose of the
/// frame's end first.
///
/// No input makes the body jump: weights and gains fade, and a discontinuity of the wanted motion (another source, a
/// stream that returns, pins that were off) is bridged by a transition from the body's present state.
///
/// ```
/// use glam::DVec3;
/// use sinew_body::humanoid::{Body, Pose};
/// use sinew_control::tracker::{KdSettings, KdTracker};
/// use sinew_world::{CharacterSpec, Surface, World, WorldSettings, hips_over_soles_m};
/// let body = Body::standard(80.0, 1.7);
/// let mut pose = Pose::STANDING;
/// pose.hips_position.y = hips_over_soles_m(&body, &pose);
/// let mut world = World::new(WorldSettings::default());
/// let spec = CharacterSpec { body: body.clone(), pose, velocity: DVec3::ZERO, surface: Surface::BODY };
/// let character = world.add_character(spec)?;
/// let mut tracker = KdTracker::new(&body, KdSettings::default(), 1.0 / 60.0, &pose);
/// for _ in 0..240 {
///     if tracker.wants_pose() {
///         tracker.wanted(&pose);
///     }
///     tracker.physics_step(&mut world, character);
///     world.step();
/// }
/// assert!((world.frame().characters[character.slot()].parts[0].position - pose.hips_position).length() < 1e-3);
/// # Ok::<(), sinew_world::SpecError>(())
/// ```
#[derive(Clone, Debug)]
pub struct KdTracker {
    /// An additional factor on each joint's stiffness, its root on the damping \[1\]; by [`Node::index`].
    pub joint_gain: [f64; Node::COUNT],
    /// An additional torque on each part relative to its parent, world axes \[N m\]; by [`Node::index`].
    pub torque: [DVec3; Node::COUNT],
    settings: KdSettings,
    gains: [Ramp; 4],
    /// 1 if pins carry weight, 0 if k_p is 0.
    carries: Ramp,
    /// Factor on all pins: the switch of the kinematic forces.
    pins: Ramp,
    pin_weights: [Ramp; Node::COUNT],
    joint_weights: [Ramp; Node::COUNT],
    clock: Clock,
    interpolator: PoseInterpolator,
    wanted: Pose,
    /// The wanted pose of the last step, before and after the transition.
    raw: Pose,
    posed: Pose,
    raw_velocity: DVec3,
    before: Instant,
    now: Instant,
    transition: Option<Transition>,
    start: Start,
    carrier: Option<Carrier>,
    self_collision: SelfCollision,
    impact_compliance: ImpactCompliance,
    contact_support: ContactSupport,
}

sinew_snapshot::snapshot!(KdTracker {
    joint_gain,
    torque,
    settings,
    gains,
    carries,
    pins,
    pin_weights,
    joint_weights,
    clock,
    interpolator,
    wanted,
    raw,
    posed,
    raw_velocity,
    before,
    now,
    transition,
    start,
    carrier,
    self_collision,
    impact_compliance,
    contact_support,
});
sinew_snapshot::snapshot!(enum Start { 0: No, 1: FromBody(over_secs) });

/// What the next motion frame begins with.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Start {
    /// Goes on.
    No,
    /// A transition from the body's present pose, of this duration \[s\].
    FromBody(f64),
}

/// Wanted hips that move farther than this within a motion frame have jumped \[m\]: 15 m/s at 60 Hz.
const JUMP_M: f64 = 0.25;

/// Joints that turn by more than this within a motion frame have jumped \[rad\]: 72 rad/s at 60 Hz.
const JUMP_RAD: f64 = 1.2;

/// Duration of the inertial blend over a jump \[s\].
const JUMP_SECS: f64 = 0.5;

/// Friction of a joint without a spring, relative to its outboard inertia \[1/s\].
const LIMP_DAMPING: f64 = 1.0;

impl KdTracker {
    /// At rest in a pose; wanted poses come every `time_step_secs`. `body` is the one that the world's character was made of.
    pub fn new(body: &Body, settings: KdSettings, time_step_secs: f64, first: &Pose) -> KdTracker {
        let gains = settings.gains;
        let now = Instant::of(body, first);
        KdTracker {
            joint_gain: [1.0; Node::COUNT],
            torque: [DVec3::ZERO; Node::COUNT],
            gains: [gains.k_p, gains.d_p, gains.k_q, gains.d_q].map(Ramp::at),
            carries: Ramp::at(carries(&gains)),
            pins: Ramp::at(1.0),
            pin_weights: settings.weights.map(|weight| Ramp::at(weight.pin)),
            joint_weights: settings.weights.map(|weight| Ramp::at(weight.joint)),
            settings,
            clock: Clock::new(time_step_secs),
            interpolator: PoseInterpolator::rest(first),
            wanted: *first,
            raw: *first,
            posed: *first,
            raw_velocity: DVec3::ZERO,
            before: now,
            now,
            transition: None,
            start: Start::No,
            carrier: None,
            self_collision: SelfCollision::new(body),
            impact_compliance: ImpactCompliance::default(),
            contact_support: ContactSupport::default(),
        }
    }

    /// Continues from a motion that went from `before` to `now`, one motion frame apart, with steps of physics of this
    /// length \[s\].
    pub fn restart(&mut self, body: &Body, before: &Pose, now: &Pose, step_secs: f64) {
        self.interpolator = PoseInterpolator::rest(before);
        self.interpolator.next(now);
        self.clock = Clock::new(self.clock.time_step_secs());
        (self.wanted, self.raw, self.posed) = (*now, *now, *now);
        self.now = Instant::of(body, now);
        let share = 1.0 - step_secs / self.clock.time_step_secs();
        self.before = Instant::of(body, &self.interpolator.at(share));
        self.raw_velocity = (now.hips_position - before.hips_position) / self.clock.time_step_secs();
        (self.transition, self.start) = (None, Start::No);
    }

    /// Starts with the body's present pose and velocity, with a transition of this duration to the wanted motion \[s\].
    pub fn begin_where_it_is(&mut self, over_secs: f64) {
        self.start = Start::FromBody(over_secs.max(0.0));
    }

    /// Whether the next step of physics begins a motion frame.
    pub fn wants_pose(&self) -> bool {
        self.clock.is_due()
    }

    /// Sets the pose for the end of the motion frame that begins. One that is not finite is ignored.
    pub fn wanted(&mut self, pose: &Pose) {
        if pose.is_finite() {
            self.wanted = *pose;
        }
    }

    /// Sets the prop that carries the wanted motion along, such as a car's floor, or the ground. A dynamic prop is the
    /// reaction body of the pins.
    pub fn stand_on(&mut self, world: &World, prop: Option<PropId>) {
        self.carrier = prop.and_then(|prop| Carrier::new(world, prop));
    }

    /// Sets the gains, reached smoothly within a time \[s\].
    pub fn set_gains(&mut self, gains: KdGains, fade_secs: f64) {
        self.before_pins(carries(&gains) * self.pins.end(), fade_secs);
        for (ramp, to) in self.gains.iter_mut().zip([gains.k_p, gains.d_p, gains.k_q, gains.d_q]) {
            ramp.aim(to, fade_secs);
        }
        self.carries.aim(carries(&gains), fade_secs);
        self.settings.gains = gains;
    }

    /// What it follows with now: gains and weights are those that it goes to.
    pub fn settings(&self) -> &KdSettings {
        &self.settings
    }

    /// The target gains.
    pub fn gains(&self) -> KdGains {
        self.settings.gains
    }

    /// Sets the reference of damping.
    pub fn set_damping(&mut self, damping: KdDamping) {
        self.settings.damping = damping;
    }

    /// Switches feed-forward.
    pub fn set_feed_forward(&mut self, on: bool) {
        self.settings.feed_forward = on;
    }

    /// Switches contact support.
    pub fn set_leans(&mut self, on: bool) {
        self.settings.leans = on;
    }

    /// Switches impact compliance of the trunk.
    pub fn set_yields(&mut self, on: bool) {
        self.settings.yields = on;
    }

    /// Sets the weights of a part, reached smoothly within a time \[s\]; `None` leaves one unchanged.
    pub fn set_weight(&mut self, node: Node, pin: Option<f64>, joint: Option<f64>, fade_secs: f64) {
        let weight = &mut self.settings.weights[node.index()];
        if let Some(pin) = pin {
            weight.pin = pin;
            self.before_pins(pin * self.carries.end() * self.pins.end(), fade_secs);
            self.pin_weights[node.index()].aim(pin, fade_secs);
        }
        let weight = &mut self.settings.weights[node.index()];
        if let Some(joint) = joint {
            weight.joint = joint;
            self.joint_weights[node.index()].aim(joint, fade_secs);
        }
    }

    /// The target weights of a part.
    pub fn weight(&self, node: Node) -> KdWeight {
        self.settings.weights[node.index()]
    }

    /// Switches the kinematic forces off (free fall) or on again, smoothly within a time \[s\]. When they come on
    /// again, the transition starts at the body's present pose.
    pub fn set_pins(&mut self, on: bool, fade_secs: f64) {
        self.before_pins(if on { self.carries.end() } else { 0.0 }, fade_secs);
        self.pins.aim(if on { 1.0 } else { 0.0 }, fade_secs);
    }

    /// Whether the kinematic forces are on, or are being switched on.
    pub fn has_pins(&self) -> bool {
        self.pins.end() > 0.0
    }

    /// Pins that come on after all were off start a transition.
    fn before_pins(&mut self, will_hold: f64, fade_secs: f64) {
        let common = self.pins.value() * self.carries.value();
        let held = self.pin_weights.iter().any(|weight| weight.value() > 0.0);
        if will_hold > 0.0 && !(held && common > 0.0) && self.start == Start::No {
            self.start = Start::FromBody(fade_secs);
        }
    }

    /// Sets pins and drives of a character for the world's next step.
    pub fn physics_step(&mut self, world: &mut World, character: CharacterId) {
        let step_secs = world.settings().step_secs();
        let begins = self.clock.is_due();
        if begins {
            self.clock.begin_frame();
            let Some(body) = world.body(character) else { return };
            let hips = world.frame().character(character).map(|frame| frame.part(Node::Hips).position);
            self.begin_frame(body, hips);
        }
        let raw = self.interpolator.at(self.clock.advance(step_secs));
        if let Start::FromBody(secs) = std::mem::replace(&mut self.start, Start::No) {
            self.slide_from_body(world, character, secs, step_secs);
        }
        let mut posed = raw;
        let Some(body) = world.body(character) else { return };
        let mut progress = 1.0;
        if let Some(transition) = &mut self.transition {
            posed = transition.step(body, &raw, step_secs);
            progress = transition.progress();
            if transition.is_over() {
                self.transition = None;
            }
        }
        self.raw_velocity = (raw.hips_position - self.raw.hips_position) / step_secs;
        (self.raw, self.posed) = (raw, posed);
        for ramp in self.gains.iter_mut().chain([&mut self.carries, &mut self.pins]) {
            ramp.advance(step_secs);
        }
        for ramp in self.pin_weights.iter_mut().chain(&mut self.joint_weights) {
            ramp.advance(step_secs);
        }
        let next = Instant::of(body, &posed);
        if begins && let Some(frame) = world.frame().character(character) {
            let masks = self.self_collision.look(&next, frame);
            world.set_passes_own(character, masks);
        }
        self.measure_contacts(world, character, step_secs);
        world.set_reaction_body(character, self.carrier.map(|carrier| carrier.prop()));
        self.hold(world, character, &next, progress, step_secs);
        self.before = self.now;
        self.now = next;
    }

    /// `hips_at` is where the body's are \[m\].
    fn begin_frame(&mut self, body: &Body, hips_at: Option<DVec3>) {
        let pose = self.wanted;
        if has_jumped(self.interpolator.end(), &pose) {
            let velocity = self.raw_velocity;
            let off = |pose: &Pose| hips_at.map_or(0.0, |hips| hips.distance(pose.hips_position));
            if self.carrier.is_none() && off(&pose) + JUMP_M < off(&self.posed) {
                // The body was kept from its motion, which comes to it.
                self.begin_where_it_is(JUMP_SECS);
            } else {
                let blend = InertialBlend::between(body, &self.posed, &pose, velocity, JUMP_SECS);
                self.transition = Some(Transition::InertialBlend(blend));
            }
            self.interpolator = PoseInterpolator::rest(&pose);
            (self.raw, self.raw_velocity) = (pose, DVec3::ZERO);
        }
        self.interpolator.next(&pose);
    }

    /// The transition starts with the body's present pose and velocity.
    fn slide_from_body(&mut self, world: &World, character: CharacterId, over_secs: f64, step_secs: f64) {
        let Some(frame) = world.frame().character(character) else { return };
        let (mut pose, hips) = (frame.pose(), frame.part(Node::Hips));
        let mut velocity = hips.velocity_at(hips.position);
        if let Some(carried) = self.carrier.and_then(|carrier| carrier.now(world)) {
            velocity = carried.without(velocity, pose.hips_position);
            pose.hips_position = carried.place_back(pose.hips_position);
            pose.world = pose.world.map(|rotation| carried.rotation_back(rotation));
        }
        let Some(body) = world.body(character) else { return };
        self.transition =
            Some(Transition::from_body(body, [&pose, &self.raw], [velocity, self.raw_velocity], over_secs));
        self.now = Instant::of(body, &pose);
        // Its previous pose is extrapolated from its velocity, so that feed-forward does not accelerate it to the speed
        // that it has.
        let mut before = pose;
        before.hips_position -= velocity * step_secs;
        self.before = Instant::of(body, &before);
    }

    /// Updates impact compliance and contact support.
    fn measure_contacts(&mut self, world: &World, character: CharacterId, step_secs: f64) {
        let is_held = self.pins.value() * self.carries.value() >= 1.0;
        match world.body(character).filter(|_| self.settings.yields && is_held) {
            Some(body) => self.impact_compliance.measure(world, character, body.mass_kg(), step_secs),
            None => self.impact_compliance.forget(),
        }
        if self.settings.leans {
            let ground = self.carrier.map(|carrier| carrier.prop());
            self.contact_support.measure(world, character, ground, self.posed.hips_position.y);
        } else {
            self.contact_support.forget();
        }
    }

    /// `progress` of the transition: legs are stiffer than the rest when they stand, not during it.
    fn hold(&self, world: &mut World, character: CharacterId, next: &Instant, progress: f64, step_secs: f64) {
        let Some(outboard) = world.outboard_inertias(character).copied() else { return };
        let Some(body) = world.body(character) else { return };
        let max_forces_n = max_pin_forces_n(body, world.settings().gravity_m_s2, self.settings.strength);
        let carried = self.carrier.and_then(|carrier| carrier.now(world));
        let [k_p, d_p, k_q, d_q] = self.gains.map(|gain| gain.value());
        let (pins, carries) = (self.pins.value() * self.contact_support.factor(), self.carries.value());
        let is_relative = self.settings.damping == KdDamping::Relative;
        let mut spins = [DVec3::ZERO; Node::COUNT];
        let mut torques = [DVec3::ZERO; Node::COUNT];
        // The torque that a part's rotation requires, passed on to its parent: children come after their parents.
        for node in Node::ALL.into_iter().rev() {
            let at = node.index();
            let (back, on) = (self.before.turn(&self.now, at), self.now.turn(next, at));
            let turning = (on - back) / (step_secs * step_secs);
            let spin = on / step_secs + turning * (step_secs * 0.5);
            spins[at] = spin;
            if self.settings.feed_forward {
                let rotation = DMat3::from_quat(self.now.rotations[at]);
                let inertia = DMat3::from_diagonal(world.part_inertia(character, node));
                let inertia = rotation * inertia * rotation.transpose();
                torques[at] += inertia * turning + spin.cross(inertia * spin);
                if let Some(parent) = node.parent() {
                    let own = torques[at];
                    torques[parent.index()] += own;
                }
            }
        }
        for node in Node::ALL {
            let at = node.index();
            let weight = pins * self.pin_weights[at].value();
            let (given_pin, given_joint) = self.impact_compliance.factors(node);
            let multiple = 1.0 + (KdGains::multiple(node) - 1.0) * progress;
            let factor = multiple * weight * given_pin;
            let (stiffness, damping) = (k_p * factor, d_p * factor.max(0.0).sqrt());
            let pin = (stiffness + damping > 0.0).then(|| {
                let (behind, ahead) =
                    (self.now.centres[at] - self.before.centres[at], next.centres[at] - self.now.centres[at]);
                let mut acceleration = (ahead - behind) / (step_secs * step_secs);
                let mut velocity = ahead / step_secs + acceleration * (step_secs * 0.5);
                let (mut position, mut rotation) = (self.now.joints[at], self.now.rotations[at]);
                if let Some(carried) = &carried {
                    velocity = carried.velocity(velocity, carried.place(self.now.centres[at]));
                    acceleration = carried.direction(acceleration);
                    (position, rotation) = (carried.place(position), carried.rotation(rotation));
                }
                if !is_relative {
                    // Of k (x̂ + h v̂) − d ẋ as k h v̂ + d v̂ with a slower v̂.
                    let spring = stiffness * step_secs;
                    velocity *= spring / (spring + damping);
                }
                let share = carries * weight.min(1.0);
                let fed = if self.settings.feed_forward { share } else { 0.0 };
                Pin {
                    position,
                    rotation,
                    velocity,
                    acceleration: acceleration * fed,
                    torque: if node == Node::Hips { turned(&carried, torques[0]) * fed } else { DVec3::ZERO },
                    stiffness,
                    damping,
                    gravity_share: share,
                    max_force_n: max_forces_n[at],
                    ..Pin::LOOSE
                }
            });
            world.set_pin(character, node, pin);
            let Some(parent) = node.parent().map(Node::index) else { continue };
            let weight = self.joint_weights[at].value() * self.joint_gain[at].max(0.0);
            let fed = weight.min(1.0);
            let weight = weight * given_joint;
            let (rotation, above) = (next.rotations[at], next.rotations[parent]);
            let velocity = rotation.conjugate() * (spins[at] - spins[parent]);
            let damping = (d_q * weight.sqrt()).max(LIMP_DAMPING);
            world.set_drive(
                character,
                node,
                Drive {
                    rotation: (above.conjugate() * rotation).normalize(),
                    velocity: if is_relative { velocity } else { DVec3::ZERO },
                    stiffness: outboard[at] * k_q * weight,
                    damping: outboard[at] * damping,
                    torque: self.torque[at] + turned(&carried, torques[at]) * fed,
                },
            );
        }
    }

    /// The target pose at the end of the last step, before a carrier moves it.
    pub fn pose(&self) -> &Pose {
        &self.posed
    }

    /// Gives the body the velocities of the wanted motion, for a body that starts in it.
    pub fn launch(&self, world: &mut World, character: CharacterId) {
        let step_secs = world.settings().step_secs();
        let velocities: [(DVec3, DVec3); Node::COUNT] = std::array::from_fn(|at| {
            let shift = self.now.centres[at] - self.before.centres[at];
            (shift / step_secs, self.before.turn(&self.now, at) / step_secs)
        });
        world.set_velocities(character, &velocities);
    }
}

fn turned(carried: &Option<Carried>, vector: DVec3) -> DVec3 {
    carried.as_ref().map_or(vector, |carried| carried.direction(vector))
}

fn carries(gains: &KdGains) -> f64 {
    if gains.k_p > 0.0 { 1.0 } else { 0.0 }
}

/// Whether a wanted pose is discontinuous with the motion.
fn has_jumped(before: &Pose, after: &Pose) -> bool {
    let turn = |node: Node| log((before.local(node).conjugate() * after.local(node)).normalize()).length();
    (after.hips_position - before.hips_position).length() > JUMP_M
        || log((before.world[0].conjugate() * after.world[0]).normalize()).length() > JUMP_RAD
        || Node::ALL.into_iter().skip(1).any(|node| turn(node) > JUMP_RAD)
}
