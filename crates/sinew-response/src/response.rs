//! The response: pose in, forces in, pose out.

use crate::basis::Basis;
use crate::clearance::{Alert, Clearance};
use crate::force::PointForce;
use crate::grip::Grip;
use crate::head::HeadReflex;
use crate::hips::HipsState;
use crate::input::{Input, posed};
use crate::limits::Limits;
use crate::objective::{Frame, Objective, Row, Weighing};
use crate::settings::{REFERENCE_MASS_KG, REFLEX_SECS, Settings, Weights};
use crate::task::{MAX_ROWS, Task, rows_of};
use crate::torque::{Differences, world_turn};
use crate::upper_body::{Coordinates24, DOFS, JointMotion, UpperBody, to_coordinates, to_vectors};
use glam::{DQuat, DVec3};
use sinew_body::STANDARD_GRAVITY_M_S2;
use sinew_body::humanoid::{Body, Deviation, HipsDeviation, Limit, Node, Pose, UPPER_DOFS, UPPER_NODES, exp, log};
use sinew_snapshot::{Reader, Snapshot, SnapshotError, Writer, snapshot};

/// A jump of the push's generalised force by more than this is a new perturbation \[N m for an 80 kg body\].
const STARTLE_N_M: f64 = 1.0;

/// ... beyond this share of the present generalised force: under a lasting push the lever arm of a force changes all
/// the time.
const STARTLE_SHARE: f64 = 0.3;

/// A jump of the ground's acceleration by more than this is one too \[m/s²\].
const STARTLE_M_PER_S2: f64 = 1.0;

/// Maximum angular speed of a joint relative to the input \[rad/s\]: about the fastest elbow of a thrown ball. It keeps
/// velocities, whose squares enter the dynamics, bounded under extreme forces.
const MAX_SPEED: f64 = 40.0;

/// Bisections to find where a joint meets its limit: to 1e-5 of the step.
const LIMIT_HALVINGS: usize = 17;

/// Solves of a step at most in which further arms are found to come too near to the body.
const CLEARINGS: usize = 3;

/// A deviation that is nowhere larger, and does not grow by more in a step, is set to zero \[rad\]: it is invisible,
/// and the body is exactly on its input again.
const FORGOTTEN: f64 = 1e-12;

/// A character that responds to pushes while it follows a motion: one [`step`](Response::step) a frame.
///
/// It keeps the two latest wanted poses and its deviation from them; it never looks ahead, so it runs on a live stream
/// as on a clip. A step does not allocate and never panics; any finite force gives a finite pose.
#[derive(Clone, Debug)]
pub struct Response {
    body: Body,
    mass_kg: f64,
    upper: UpperBody,
    limits: Limits,
    settings: Settings,
    weights: Weights,
    objective: Objective<f64>,
    rows: Vec<Row<f64>>,
    clearance: Clearance,
    state: State,
    report: Report,
}

/// What one step did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Report {
    /// Norm of the residual of the dynamic constraint after the solve, Êᵀ(u − ū + K(δ) + D(δ̇)) \[N m\].
    pub residual_n_m: f64,
    /// Weight of the reflex delay in this step, from 1 at a push to 0.
    pub reflex: f64,
    /// Number of joints that met their limit.
    pub limited: usize,
}

#[derive(Clone, Debug)]
struct State {
    /// The wanted pose of this frame.
    input: Input,
    /// This frame's returned pose.
    output: Pose,
    /// The returned hips of the frame before: their position without the ground's shift, and their rotation since then
    /// \[rad\].
    hips_before: DVec3,
    hips_turn: DVec3,
    /// Each joint's turn from the frame before to this one \[rad\], child's frame.
    step: [DVec3; UPPER_NODES],
    /// Deviation from the wanted pose \[rad\], and the rotations that it makes.
    deviation: Coordinates24,
    /// By how much the deviation grew in the last step \[rad\].
    growth: Coordinates24,
    turned: [DQuat; UPPER_NODES],
    hips: HipsState,
    head: HeadReflex,
    grip: Grip,
    alert: Alert,
    shown: HipsDeviation,
    /// The ground's shift in the frame before and in this one \[m\].
    ground_before: DVec3,
    ground: DVec3,
    ground_acceleration: DVec3,
    torque_before: Option<Coordinates24>,
    aim_before: Coordinates24,
    load_before: Coordinates24,
    /// Frames since the latest perturbation.
    since_push: Option<usize>,
}

snapshot!(Report { residual_n_m, reflex, limited });

snapshot!(State {
    input,
    output,
    hips_before,
    hips_turn,
    step,
    deviation,
    growth,
    turned,
    hips,
    head,
    grip,
    alert,
    shown,
    ground_before,
    ground,
    ground_acceleration,
    torque_before,
    aim_before,
    load_before,
    since_push,
});

/// What changes with the steps, and the limits as far as the input has widened them; the rest follows from body, basis and
/// settings, which are those that it was made with.
impl Snapshot for Response {
    fn save(&self, to: &mut Writer) {
        self.state.save(to);
        self.report.save(to);
        Node::ALL.iter().for_each(|node| self.body.link(*node).limit.save(to));
    }
    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        self.state.restore(from)?;
        self.report.restore(from)?;
        Node::ALL.iter().try_for_each(|node| self.body.link_mut(*node).limit.restore(from))?;
        self.limits = Limits::of(&self.body);
        Ok(())
    }
}

impl State {
    fn at(before: &Pose, now: &Pose) -> State {
        let input = Input::at(before, now);
        State {
            output: *now,
            hips_before: input.hips_before,
            hips_turn: input.hips_turn,
            step: input.step,
            input,
            deviation: [0.0; UPPER_DOFS],
            growth: [0.0; UPPER_DOFS],
            turned: [DQuat::IDENTITY; UPPER_NODES],
            hips: HipsState::default(),
            head: HeadReflex::default(),
            grip: Grip::default(),
            alert: Alert::default(),
            shown: HipsDeviation::default(),
            ground_before: DVec3::ZERO,
            ground: DVec3::ZERO,
            ground_acceleration: DVec3::ZERO,
            torque_before: None,
            aim_before: [0.0; UPPER_DOFS],
            load_before: [0.0; UPPER_DOFS],
            since_push: None,
        }
    }
}

impl Response {
    /// A response that starts at rest in `first`.
    pub fn new(body: Body, basis: Basis, settings: Settings, first: &Pose) -> Response {
        let mass_kg = body.mass_kg();
        let weights = Weights::of(&settings, mass_kg);
        let spring = weights.passive_frequency;
        let upper = UpperBody::of(&body, settings.gravity_m_s2);
        let weighing = Weighing {
            time_step_secs: settings.time_step_secs,
            track: weights.track,
            damp: weights.damp,
            dynamics: weights.dynamics,
            stiffness: basis.inertia().map(|inertia| spring * spring * inertia),
            damping: basis.inertia().map(|inertia| 2.0 * weights.passive_damping * spring * inertia),
        };
        Response {
            objective: Objective::new(upper.tree(), &basis.dynamic(&settings), &weighing),
            limits: Limits::of(&body),
            mass_kg,
            upper,
            body,
            settings,
            weights,
            rows: Vec::with_capacity(MAX_ROWS),
            clearance: Clearance::new(),
            state: State::at(first, first),
            report: Report::default(),
        }
    }

    /// Resets the state and continues from a motion that went from `before` to `now`, one time step apart.
    pub fn restart(&mut self, before: &Pose, now: &Pose) {
        self.state = State::at(before, now);
    }

    /// Advances one frame. `wanted` is the input's next pose; `forces` act now, on the last returned pose, and take
    /// effect in the pose that is returned.
    ///
    /// A wanted pose with NaN or infinite values is refused: the last valid one is kept.
    pub fn step(&mut self, wanted: &Pose, forces: &[PointForce]) -> Pose {
        self.step_on_moving_ground(wanted, forces, DVec3::ZERO)
    }

    /// As [`Response::step`], on ground that accelerates \[m/s², world\]: the body is carried along and its upper part lags.
    pub fn step_on_moving_ground(&mut self, wanted: &Pose, forces: &[PointForce], ground: DVec3) -> Pose {
        self.step_with_tasks(wanted, forces, ground, &[])
    }

    /// As [`Response::step_on_moving_ground`], with further objectives: those of this step, at most 24 rows of them (an aim has two).
    pub fn step_with_tasks(&mut self, wanted: &Pose, forces: &[PointForce], ground: DVec3, tasks: &[Task]) -> Pose {
        let state = &mut self.state;
        let next = state.input.followed_by(if wanted.is_finite() { wanted } else { &state.input.pose });
        let ground = if ground.is_finite() { ground.clamp_length_max(1e3) } else { DVec3::ZERO };
        self.limits.widen(&mut self.body, &next.local);
        let dt = self.settings.time_step_secs;

        state.hips.advance(&self.body, &state.output, forces, dt);
        state.head.advance(forces, self.mass_kg * STANDARD_GRAVITY_M_S2, dt);
        let shown = state.hips.shown(&self.body, &next.pose);
        if self.weights.hands_hold {
            state.grip.advance(&self.body, &next.pose, dt);
        }
        // The input's torque now.
        let aim =
            if self.weights.aims_at_input { state.input.torque(&next, &mut self.upper, dt) } else { [0.0; UPPER_DOFS] };

        self.report = self.respond(next, forces, ground, shown, &aim, tasks);
        self.state.output
    }

    /// The response's own step, given the input and the hips.
    fn respond(
        &mut self,
        next: Input,
        forces: &[PointForce],
        ground: DVec3,
        shown: HipsDeviation,
        aim: &Coordinates24,
        tasks: &[Task],
    ) -> Report {
        let Response { body, upper, limits, weights, objective, state, rows, clearance, .. } = self;
        let dt = self.settings.time_step_secs;
        let ground_next = state.ground * 2.0 - state.ground_before + ground * (dt * dt);
        let hips_position = state.output.hips_position - state.ground;
        let hips_next = exp(shown.turn) * next.pose.world[0];
        let hips_turn = world_turn(state.output.world[0], hips_next);

        // The response with an unchanged deviation.
        let mut kept = next.step;
        let mut local = state.input.local;
        for node in 1..UPPER_NODES {
            kept[node] = state.turned[node].conjugate() * kept[node];
            local[node] *= state.turned[node];
        }
        let differences = Differences {
            time_step_secs: dt,
            rotation: state.output.world[0],
            positions: [state.hips_before, hips_position, next.pose.hips_position + shown.shift],
            turns: [state.hips_turn, hips_turn],
            local: &local,
            steps: [&state.step, &kept],
        };
        let mut hips = differences.hips();
        hips.acceleration += ground;
        let [rate, change] = &differences.joints();
        upper.inverse(&hips, JointMotion { local: &local, rate, change });
        let load = upper.load(forces);
        let mut torque = *upper.found_torques();
        for (torque, load) in torque.iter_mut().zip(&load) {
            *torque -= load;
        }

        let reflex = state.reflex(&load, ground, self.mass_kg, dt);
        // Muscles go on with the input's own torque: what it changes by from frame to frame is noise, twice differentiated.
        let torque_before = state
            .torque_before
            .map_or(torque, |before| std::array::from_fn(|dof| before[dof] + (aim[dof] - state.aim_before[dof])));
        rows.clear();
        clearance.clear();
        let is_off = !forces.is_empty() || !shown.is_none() || state.deviation.iter().any(|turn| *turn != 0.0);
        state.alert.advance(!forces.is_empty(), dt);
        let (looks, holds) = (is_off && weights.arms_clear && state.alert.is_on(), is_off && state.grip.holds());
        if looks || holds || !tasks.is_empty() {
            // On ground at rest, the frame of the tasks.
            let kept = posed(body, &next, &state.turned, &shown, DVec3::ZERO);
            rows_of(tasks, &kept, body, dt, rows);
            if holds {
                state.grip.add_rows(body, &kept, &next.pose, dt, rows);
            }
            if looks {
                clearance.look(body, [&state.output, &state.input.pose], [&kept, &next.pose], state.alert.share(), dt);
            }
        }
        let coast = if weights.damps_relative {
            let kept = if weights.swing_secs > 0.0 { libm::exp(-dt / weights.swing_secs) } else { 0.0 };
            state.growth.map(|growth| growth * kept)
        } else {
            to_coordinates(&kept).map(|step| -step)
        };
        let chest = hips_next * next.local[1] * state.turned[1];
        let draws = if weights.levels_head { state.head.draws(chest, &next.pose, &state.deviation, dt) } else { None };
        let (mut held, mut stops) = draws.unwrap_or(([0.0; UPPER_DOFS], [0.0; UPPER_DOFS]));
        let (drawn, drawn_to) = (held, stops);
        let mut frame = Frame {
            mass: upper.found_mass(),
            deviation: &state.deviation,
            coast: &coast,
            torque: &torque,
            aim,
            reflex: (reflex > 0.0 && weights.reflex > 0.0).then_some((&torque_before, weights.reflex * reflex)),
            held: draws.is_some().then_some((&drawn, &drawn_to)),
            rows: &[],
        };
        let mut step = slowed(objective.solve(&Frame { rows, ..frame }), dt);
        for _ in 0..CLEARINGS {
            if !clearance.add_missed(&step, rows) {
                break;
            }
            step = slowed(objective.solve(&Frame { rows, ..frame }), dt);
        }
        frame.rows = rows;
        let mut limited = 0;
        let (mut turns, mut turned) = grown(&state.turned, &step);
        for node in 1..UPPER_NODES {
            if !limits.contains(body, node, next.local[node] * turned[node]) {
                limited += 1;
                let stop = reined_in(&body.link(Node::ALL[node]).limit, next.local[node], turns[node]);
                hold(node, log(state.turned[node].conjugate() * exp(stop)), &mut stops);
                hold(node, DVec3::ONE, &mut held);
            }
        }
        if limited > 0 {
            // The joint stops there, which affects the others through the next solve.
            frame.held = Some((&held, &stops));
            step = slowed(objective.solve(&frame), dt);
            (turns, turned) = grown(&state.turned, &step);
            for node in 1..UPPER_NODES {
                if !limits.contains(body, node, next.local[node] * turned[node]) {
                    turns[node] = reined_in(&body.link(Node::ALL[node]).limit, next.local[node], turns[node]);
                    turned[node] = exp(turns[node]);
                    hold(node, log(state.turned[node].conjugate() * turned[node]), &mut step);
                }
            }
        }
        let torque_now = objective.torque_after(&frame, &step);
        let left = objective.left(&frame, &step, &torque_now);
        let report = Report { residual_n_m: left.iter().map(|left| left * left).sum::<f64>().sqrt(), reflex, limited };

        let growth = to_vectors(&step);
        state.deviation = to_coordinates(&turns);
        state.step = std::array::from_fn(|node| kept[node] + growth[node]);
        state.turned = turned;
        state.growth = step;
        let unseen = |value: &f64| value.abs() < FORGOTTEN;
        if state.deviation.iter().all(unseen) && step.iter().all(unseen) {
            state.deviation = [0.0; UPPER_DOFS];
            state.growth = [0.0; UPPER_DOFS];
            state.turned = [DQuat::IDENTITY; UPPER_NODES];
            state.step = next.step;
        }
        (state.hips_before, state.hips_turn) = (hips_position, hips_turn);
        (state.ground_before, state.ground) = (state.ground, ground_next);
        state.shown = shown;
        (state.torque_before, state.aim_before) = (Some(torque_now), *aim);
        state.output = posed(body, &next, &state.turned, &shown, ground_next);
        state.input = next;
        report
    }

    /// The deviation of the last returned pose from the wanted one, for [`Overlay`](sinew_body::humanoid::Overlay).
    /// Shifts are in metres of the body.
    pub fn deviation(&self) -> Deviation {
        Deviation {
            hips_shift: self.state.shown.shift,
            hips_turn: self.state.shown.turn,
            ground_shift: self.state.ground,
            foot_shifts: [DVec3::ZERO; 2],
            turns: to_vectors(&self.state.deviation),
        }
    }

    /// Report of the last step.
    pub fn report(&self) -> Report {
        self.report
    }

    /// The body, its limits widened to contain all input so far.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// The settings.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Sets the deviation and its rate, to study its growth or decay.
    pub(crate) fn set_deviation(&mut self, deviation: &Coordinates24, last_growth: &Coordinates24) {
        let state = &mut self.state;
        let growth = to_vectors(last_growth);
        state.turned = to_vectors(deviation).map(exp);
        state.step = std::array::from_fn(|node| state.turned[node].conjugate() * state.input.step[node] + growth[node]);
        state.deviation = *deviation;
        state.growth = *last_growth;
        state.output = posed(&self.body, &state.input, &state.turned, &HipsDeviation::default(), DVec3::ZERO);
        state.torque_before = None;
    }

    /// The deviation's coordinates, and their change in the last step.
    pub(crate) fn deviation_and_growth(&self) -> (Coordinates24, Coordinates24) {
        (self.state.deviation, self.state.growth)
    }
}

impl State {
    /// The fading weight of the reflex delay (EQ5), counted in whole frames: 1 in the frame of a perturbation. A new
    /// perturbation counts only after the old one's delay; a lasting contact is one perturbation.
    fn reflex(&mut self, load: &Coordinates24, ground: DVec3, mass_kg: f64, dt: f64) -> f64 {
        let frames = reflex_frames(dt);
        let jump: f64 = load.iter().zip(&self.load_before).map(|(now, before)| (now - before) * (now - before)).sum();
        let before = self.load_before.iter().map(|before| before * before).sum::<f64>().sqrt();
        let startled = jump.sqrt() > STARTLE_N_M * mass_kg / REFERENCE_MASS_KG + STARTLE_SHARE * before
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

fn reflex_frames(dt: f64) -> usize {
    (REFLEX_SECS / dt).round().max(1.0) as usize
}

/// The nodes' deviations after a step, and the rotations that they make; only the coordinates' axes count.
fn grown(turned: &[DQuat; UPPER_NODES], step: &Coordinates24) -> ([DVec3; UPPER_NODES], [DQuat; UPPER_NODES]) {
    let growth = to_vectors(step);
    let mut turns = [DVec3::ZERO; UPPER_NODES];
    for node in 1..UPPER_NODES {
        turns[node] = log(turned[node] * exp(growth[node]));
    }
    let turns = to_vectors(&to_coordinates(&turns));
    (turns, turns.map(exp))
}

/// Sets the coordinates of one node from its rotation vector.
fn hold(node: usize, turn: DVec3, coordinates: &mut Coordinates24) {
    for (value, dof) in coordinates.iter_mut().zip(DOFS) {
        if dof.node.index() == node {
            *value = turn[dof.axis as usize];
        }
    }
}

/// The step with every joint's rotation clamped to [`MAX_SPEED`]; a NaN step becomes zero.
fn slowed(step: Coordinates24, dt: f64) -> Coordinates24 {
    let largest = MAX_SPEED * dt;
    step.map(|turn| if turn.is_finite() { turn.clamp(-largest, largest) } else { 0.0 })
}

/// The largest part of a deviation that stays inside a limit; the wanted rotation itself is inside.
fn reined_in(limit: &Limit, local: DQuat, deviation: DVec3) -> DVec3 {
    let (mut inside, mut outside) = (0.0, 1.0);
    for _ in 0..LIMIT_HALVINGS {
        let middle = 0.5 * (inside + outside);
        if limit.contains(local * exp(deviation * middle)) { inside = middle } else { outside = middle }
    }
    deviation * inside
}
