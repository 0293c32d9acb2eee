//! The response itself: pose in, forces in, pose out.

use crate::basis::Basis;
use crate::force::PointForce;
use crate::hips::{HipsDeviation, HipsState};
use crate::objective::{Problem, dot};
use crate::settings::{REFERENCE_MASS_KG, REFLEX_SECS, Settings, Weights};
use crate::torque::{hips_motion, steps, torque};
use crate::upper_body::{Coordinates24, DOFS, Matrix24, UpperBody, to_coordinates, to_vectors};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Deviation, LegPose, Limit, Node, Pose, UPPER_DOFS, UPPER_NODES, exp, log, solve_leg};

/// A jump of the push's generalised force by more than this is a new perturbation \[N m for an 80 kg body\].
const STARTLE_N_M: f64 = 1.0;

/// A jump of the ground's acceleration by more than this is one too \[m/s²\].
const STARTLE_M_PER_S2: f64 = 1.0;

/// No joint leaves the input faster than this \[rad/s\]: about the fastest elbow of a thrown ball. It keeps velocities, whose
/// squares enter the dynamics, from running away under forces beyond all reason.
const FASTEST: f64 = 40.0;

/// Halvings that find where a joint meets its limit: to 1e-5 of the way.
const LIMIT_HALVINGS: usize = 17;

/// A character that answers to pushes while it follows a motion: one [`step`](Response::step) a frame.
///
/// It keeps the two latest wanted poses and how far it is from them; nothing of the future, so it runs on a live stream as
/// it does on a clip. A step allocates nothing and never panics; any finite force gives a finite pose.
#[derive(Clone, Debug)]
pub struct Response {
    body: Body,
    upper: UpperBody,
    settings: Settings,
    weights: Weights,
    dynamic: Vec<Coordinates24>,
    stiffness: Coordinates24,
    damping: Coordinates24,
    state: State,
    report: Report,
}

/// What one step did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Report {
    /// Length of what is left of the dynamic constraint after the solve, Êᵀ(u − ū + K(δ) + D(δ̇)) \[N m\].
    pub residual_n_m: f64,
    /// Weight of the reflex delay in this step, from 1 at a push to 0.
    pub reflex: f64,
    /// How many joints met their limit.
    pub limited: usize,
}

#[derive(Clone, Debug)]
struct State {
    /// The wanted poses of the frame before and of this one.
    before: Pose,
    now: Pose,
    /// This frame's pose as given out.
    output: Pose,
    /// The hips as given out in the frame before: position without the ground's shift, and orientation.
    hips_before: (DVec3, DQuat),
    /// Each joint's turn from the frame before to this one \[rad\], child's frame.
    step: [DVec3; UPPER_NODES],
    /// Deviation from the wanted pose \[rad\].
    deviation: Coordinates24,
    hips: HipsState,
    shown: HipsDeviation,
    /// The ground's shift in the frame before and in this one \[m\].
    ground_before: DVec3,
    ground: DVec3,
    ground_acceleration: DVec3,
    torque_before: Option<Coordinates24>,
    load_before: Coordinates24,
    /// Frames since the latest perturbation.
    since_push: Option<usize>,
}

impl State {
    fn at(before: &Pose, now: &Pose) -> State {
        State {
            before: *before,
            now: *now,
            output: *now,
            hips_before: (before.hips_position, before.world[0]),
            step: steps(before, now),
            deviation: [0.0; UPPER_DOFS],
            hips: HipsState::default(),
            shown: HipsDeviation::default(),
            ground_before: DVec3::ZERO,
            ground: DVec3::ZERO,
            ground_acceleration: DVec3::ZERO,
            torque_before: None,
            load_before: [0.0; UPPER_DOFS],
            since_push: None,
        }
    }
}

impl Response {
    /// A response that starts at rest in `first`.
    pub fn new(body: Body, basis: Basis, settings: Settings, first: &Pose) -> Response {
        let weights = Weights::of(&settings, body.mass_kg());
        let spring = weights.passive_frequency;
        let stiffness = basis.inertia().map(|inertia| spring * spring * inertia);
        let damping = basis.inertia().map(|inertia| 2.0 * weights.passive_damping * spring * inertia);
        Response {
            upper: UpperBody::of(&body),
            dynamic: basis.dynamic(&settings).to_vec(),
            body,
            settings,
            weights,
            stiffness,
            damping,
            state: State::at(first, first),
            report: Report::default(),
        }
    }

    /// Forgets everything and continues from a motion that went from `before` to `now`, one time step apart.
    pub fn restart(&mut self, before: &Pose, now: &Pose) {
        self.state = State::at(before, now);
    }

    /// Advances one frame. `wanted` is the input's next pose; `forces` act now, on the pose given out last, and show in the
    /// pose that is returned.
    ///
    /// A wanted pose that is not finite is refused: the last good one is kept.
    pub fn step(&mut self, wanted: &Pose, forces: &[PointForce]) -> Pose {
        self.step_on_moving_ground(wanted, forces, DVec3::ZERO)
    }

    /// As [`Response::step`], on ground that accelerates \[m/s², world\]: the body is carried along and its upper part lags.
    pub fn step_on_moving_ground(&mut self, wanted: &Pose, forces: &[PointForce], ground: DVec3) -> Pose {
        let wanted = if wanted.is_finite() { *wanted } else { self.state.now };
        let ground = if ground.is_finite() { ground.clamp_length_max(1e3) } else { DVec3::ZERO };
        self.widen_limits(&wanted);
        let dt = self.settings.time_step_secs;
        let state = &mut self.state;

        state.hips.advance(&self.body, &state.output, forces, dt);
        let shown = state.hips.shown(&self.body, &wanted);
        let hips_now = (state.output.hips_position, state.output.world[0]);
        let ground_next = state.ground * 2.0 - state.ground_before + ground * (dt * dt);
        let unshifted = wanted.hips_position + shown.shift;
        let hips_next = (unshifted, exp(shown.turn) * wanted.world[0]);

        // The input: what it does next, and the torque that it uses now.
        let input_steps = steps(&state.now, &wanted);
        let aim = if self.weights.aims_at_input {
            torque(&self.upper, [&state.before, &state.now, &wanted], dt)
        } else {
            [0.0; UPPER_DOFS]
        };

        // The response, were its deviation to stay as it is.
        let deviation = to_vectors(&state.deviation);
        let kept: [DVec3; UPPER_NODES] =
            std::array::from_fn(|node| exp(deviation[node]).conjugate() * input_steps[node]);
        let placement = self.upper.place(&state.output.world[..UPPER_NODES]);
        let mut hips = hips_motion([state.hips_before, (hips_now.0 - state.ground, hips_now.1), hips_next], dt);
        hips.acceleration += ground;
        let rate = state.step.map(|step| step / dt);
        let change = std::array::from_fn(|node| (kept[node] - state.step[node]) / (dt * dt));
        let mut torque_kept = self.upper.torques(&placement, &hips, &rate, &change);
        let load = self.upper.load(&placement, forces);
        for (torque, load) in torque_kept.iter_mut().zip(&load) {
            *torque -= load;
        }
        let mut torque_per_step: Matrix24 = [[0.0; UPPER_DOFS]; UPPER_DOFS];
        self.upper.mass_matrix(&placement, &mut torque_per_step);
        for row in &mut torque_per_step {
            for value in row {
                *value /= dt * dt;
            }
        }

        let reflex = state.reflex(&load, ground, self.body.mass_kg(), dt);
        let torque_before = state.torque_before.unwrap_or(torque_kept);
        let mut problem = Problem {
            weights: &self.weights,
            dynamic: &self.dynamic,
            time_step_secs: dt,
            torque_per_step: &torque_per_step,
            deviation: &state.deviation,
            input_step: &to_coordinates(&kept),
            torque: &torque_kept,
            aim: &aim,
            torque_before: &torque_before,
            reflex: self.weights.reflex * reflex,
            stiffness: &self.stiffness,
            damping: &self.damping,
            held: &[None; UPPER_DOFS],
        };
        let mut step = slowed(problem.solve(), dt);
        let mut limited = 0;
        let mut next = grown(&deviation, &step);
        let mut held = [None; UPPER_DOFS];
        for node in 1..UPPER_NODES {
            let limit = &self.body.link(Node::ALL[node]).limit;
            let local = wanted.local(Node::ALL[node]);
            if !limit.contains(local * exp(next[node])) {
                limited += 1;
                let stop = reined_in(limit, local, next[node]);
                let stop_step = log(exp(deviation[node]).conjugate() * exp(stop));
                for (dof, held) in held.iter_mut().enumerate() {
                    if DOFS[dof].node.index() == node {
                        *held = Some(stop_step[DOFS[dof].axis as usize]);
                    }
                }
            }
        }
        if limited > 0 {
            // The joint stops there, and the others feel it stop.
            problem.held = &held;
            step = slowed(problem.solve(), dt);
            next = grown(&deviation, &step);
            for node in 1..UPPER_NODES {
                let limit = &self.body.link(Node::ALL[node]).limit;
                let local = wanted.local(Node::ALL[node]);
                if !limit.contains(local * exp(next[node])) {
                    next[node] = reined_in(limit, local, next[node]);
                    let stop_step = log(exp(deviation[node]).conjugate() * exp(next[node]));
                    for (dof, step) in step.iter_mut().enumerate() {
                        if DOFS[dof].node.index() == node {
                            *step = stop_step[DOFS[dof].axis as usize];
                        }
                    }
                }
            }
        }
        let torque_now: Coordinates24 = std::array::from_fn(|dof| torque_kept[dof] + dot(&torque_per_step[dof], &step));
        self.report = Report { residual_n_m: problem.residual(&step), reflex, limited };

        let growth = to_vectors(&step);
        state.step = std::array::from_fn(|node| kept[node] + growth[node]);
        state.deviation = to_coordinates(&next);
        state.hips_before = (hips_now.0 - state.ground, hips_now.1);
        state.ground_before = state.ground;
        state.ground = ground_next;
        state.shown = shown;
        state.torque_before = Some(torque_now);
        state.before = state.now;
        state.now = wanted;
        let deviation = self.deviation();
        self.state.output = posed(&self.body, &wanted, &deviation);
        self.state.output
    }

    /// How far the pose given out last is from the wanted one, for [`Overlay`](sinew_body::humanoid::Overlay). Shifts are in
    /// metres of the body.
    pub fn deviation(&self) -> Deviation {
        Deviation {
            hips_shift: self.state.shown.shift,
            hips_turn: self.state.shown.turn,
            ground_shift: self.state.ground,
            turns: to_vectors(&self.state.deviation),
        }
    }

    /// What the last step did.
    pub fn report(&self) -> Report {
        self.report
    }

    /// The body, its limits widened to all that the input has done so far.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// The settings.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Sets the deviation and its rate as they are, to study how it grows or dies.
    pub(crate) fn set_deviation(&mut self, deviation: &Coordinates24, last_growth: &Coordinates24) {
        let turns = to_vectors(deviation);
        let growth = to_vectors(last_growth);
        let input = steps(&self.state.before, &self.state.now);
        self.state.step = std::array::from_fn(|node| exp(turns[node]).conjugate() * input[node] + growth[node]);
        self.state.deviation = *deviation;
        self.state.output = posed(&self.body, &self.state.now, &Deviation { turns, ..Deviation::NONE });
        self.state.torque_before = None;
    }

    /// The deviation's coordinates, and by how much the last step grew them.
    pub(crate) fn deviation_and_growth(&self) -> (Coordinates24, Coordinates24) {
        let turns = to_vectors(&self.state.deviation);
        let input = steps(&self.state.before, &self.state.now);
        let growth = std::array::from_fn(|node| self.state.step[node] - exp(turns[node]).conjugate() * input[node]);
        (self.state.deviation, to_coordinates(&growth))
    }

    fn widen_limits(&mut self, wanted: &Pose) {
        for node in Node::ALL.into_iter().take(UPPER_NODES).skip(1) {
            let local = wanted.local(node);
            let limit = &mut self.body.link_mut(node).limit;
            if !limit.contains(local) {
                limit.widen(local);
            }
        }
    }
}

impl State {
    /// The fading weight of the reflex delay (EQ5), counted in whole frames: 1 in the frame of a perturbation. A new
    /// perturbation counts once the old one's delay is over; a lasting contact is only one.
    fn reflex(&mut self, load: &Coordinates24, ground: DVec3, mass_kg: f64, dt: f64) -> f64 {
        let frames = (REFLEX_SECS / dt).round().max(1.0) as usize;
        let jump: f64 = load.iter().zip(&self.load_before).map(|(now, before)| (now - before) * (now - before)).sum();
        let startled = jump.sqrt() > STARTLE_N_M * mass_kg / REFERENCE_MASS_KG
            || (ground - self.ground_acceleration).length() > STARTLE_M_PER_S2;
        self.load_before = *load;
        self.ground_acceleration = ground;
        let over = self.since_push.is_none_or(|since| since + 1 >= frames);
        self.since_push = if startled && over { Some(0) } else { self.since_push.map(|since| since + 1) };
        match self.since_push {
            Some(since) if since < frames => {
                let left = 1.0 - since as f64 / frames as f64;
                left * left * (3.0 - 2.0 * left)
            }
            _ => 0.0,
        }
    }
}

/// The nodes' deviations after a step.
fn grown(deviation: &[DVec3; UPPER_NODES], step: &Coordinates24) -> [DVec3; UPPER_NODES] {
    let growth = to_vectors(step);
    let mut next = [DVec3::ZERO; UPPER_NODES];
    for node in 1..UPPER_NODES {
        next[node] = log(exp(deviation[node]) * exp(growth[node]));
    }
    to_vectors(&to_coordinates(&next))
}

/// The step with every joint's turn within [`FASTEST`]; what is not a number stays where it is.
fn slowed(step: Coordinates24, dt: f64) -> Coordinates24 {
    let largest = FASTEST * dt;
    step.map(|turn| if turn.is_finite() { turn.clamp(-largest, largest) } else { 0.0 })
}

/// The furthest part of a deviation that stays inside a limit; the wanted rotation itself is inside.
fn reined_in(limit: &Limit, local: DQuat, deviation: DVec3) -> DVec3 {
    let (mut inside, mut outside) = (0.0, 1.0);
    for _ in 0..LIMIT_HALVINGS {
        let middle = 0.5 * (inside + outside);
        if limit.contains(local * exp(deviation * middle)) { inside = middle } else { outside = middle }
    }
    deviation * inside
}

/// The wanted pose with a deviation on it, feet where the wanted pose has them.
pub(crate) fn posed(body: &Body, wanted: &Pose, deviation: &Deviation) -> Pose {
    let Deviation { hips_shift, hips_turn, ground_shift, turns } = *deviation;
    let mut pose = *wanted;
    pose.hips_position += hips_shift + ground_shift;
    pose.world[0] = exp(hips_turn) * wanted.world[0];
    let mut turned = [false; UPPER_NODES];
    turned[0] = hips_turn != DVec3::ZERO;
    for node in Node::ALL.into_iter().take(UPPER_NODES).skip(1) {
        let (at, parent) = (node.index(), node.parent().map_or(0, Node::index));
        turned[at] = turned[parent] || turns[at] != DVec3::ZERO;
        if turned[at] {
            pose.world[at] = (pose.world[parent] * (wanted.local(node) * exp(turns[at]))).normalize();
        }
    }
    if hips_turn != DVec3::ZERO || hips_shift != DVec3::ZERO {
        let positions = wanted.positions(body);
        for (upper, lower, foot) in [
            (Node::LeftUpperLeg, Node::LeftLowerLeg, Node::LeftFoot),
            (Node::RightUpperLeg, Node::RightLowerLeg, Node::RightFoot),
        ] {
            let [hip, knee, ankle] = [upper, lower, foot].map(|node| positions[node.index()]);
            let leg = LegPose { hip, knee, ankle, knee_axis: wanted.world[lower.index()] * DVec3::X };
            let new_hip = positions[0] + hips_shift + exp(hips_turn) * (hip - positions[0]);
            let (thigh, shank) = solve_leg(&leg, new_hip, ankle);
            pose.world[upper.index()] = (thigh * wanted.world[upper.index()]).normalize();
            pose.world[lower.index()] = (shank * wanted.world[lower.index()]).normalize();
        }
    }
    pose
}
