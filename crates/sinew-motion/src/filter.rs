//! Low-pass filters for motion.
//!
//! The filter is the second-order Butterworth low-pass of biomechanics (Winter, *Biomechanics and Motor Control of
//! Human Movement*, section 3.4.4.2), made digital by the bilinear transform with its cut-off prewarped. One pass lags
//! and halves the power (-3 dB) at the cut-off; forward and backward ([`LowPass::zero_phase`]) the filter has zero
//! phase and halves the amplitude there (-6 dB). The cut-off is not corrected for the second pass.

use crate::{Clip, Transform};
use glam::{DQuat, DVec3};
use sinew_snapshot::{Reader, Snapshot, SnapshotError, Writer};

/// Cut-off that keeps human motion and drops capture noise \[Hz\].
pub const DEFAULT_CUTOFF_HZ: f64 = 6.0;

/// Coefficients of a second-order Butterworth low-pass.
///
/// ```
/// use sinew_motion::LowPass;
/// let filter = LowPass::new(6.0, 60.0);
/// let mut signal = vec![[2.5]; 20];
/// filter.zero_phase(&mut signal);
/// assert!(signal.iter().all(|&[value]| value == 2.5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LowPass {
    /// Numerator: b, 2 b, b.
    b: f64,
    a1: f64,
    a2: f64,
    /// Length of the filter's memory \[samples\].
    settle: usize,
}

impl LowPass {
    /// The filter for a cut-off \[Hz\] at a sampling rate \[Hz\]. A cut-off that is not below half the rate (or is not
    /// a positive number) leaves its input unchanged: there is nothing above it to remove.
    pub fn new(cutoff_hz: f64, fps: f64) -> LowPass {
        let usable = cutoff_hz > 0.0 && fps.is_finite() && cutoff_hz < 0.4999 * fps;
        if !usable {
            return LowPass { b: 1.0, a1: f64::NAN, a2: f64::NAN, settle: 0 };
        }
        let warped = libm::tan(std::f64::consts::PI * cutoff_hz / fps);
        let square = warped * warped;
        let scale = 1.0 / (1.0 + std::f64::consts::SQRT_2 * warped + square);
        LowPass {
            b: square * scale,
            a1: 2.0 * (square - 1.0) * scale,
            a2: (1.0 - std::f64::consts::SQRT_2 * warped + square) * scale,
            settle: (3.0 * fps / cutoff_hz).min(1e6) as usize,
        }
    }

    /// Whether the filter leaves its input unchanged.
    pub fn is_identity(&self) -> bool {
        self.a1.is_nan()
    }

    /// Filters forward and backward, in place: no lag. Both ends are continued by their point reflection, so that a ramp
    /// stays a ramp; a constant stays the same to the bit.
    pub fn zero_phase<const N: usize>(&self, signal: &mut [[f64; N]]) {
        if self.is_identity() || signal.len() < 2 {
            return;
        }
        let last = signal.len() - 1;
        let pad = self.settle.min(last);
        let reflect =
            |about: [f64; N], value: [f64; N]| std::array::from_fn(|axis| about[axis] + (about[axis] - value[axis]));
        let mut padded: Vec<[f64; N]> = Vec::with_capacity(signal.len() + 2 * pad);
        padded.extend((1..=pad).rev().map(|at| reflect(signal[0], signal[at])));
        padded.extend_from_slice(signal);
        padded.extend((1..=pad).map(|at| reflect(signal[last], signal[last - at])));
        for _ in 0..2 {
            let mut pass = LowPassStream::new(*self);
            for value in &mut padded {
                *value = pass.step(*value);
            }
            padded.reverse();
        }
        signal.copy_from_slice(&padded[pad..=pad + last]);
    }

    /// As [`LowPass::zero_phase`], for rotations: as quaternions whose signs are made to follow each other, component
    /// by component, and normalised. Accurate for rotations well below half a turn within the filter's memory, as in
    /// human motion.
    pub fn zero_phase_rotations(&self, rotations: &mut [DQuat]) {
        if self.is_identity() {
            return;
        }
        let mut signal: Vec<[f64; 4]> = Vec::with_capacity(rotations.len());
        let mut before: Option<DQuat> = None;
        for &rotation in rotations.iter() {
            let near = before.map_or(rotation, |before| toward(before, rotation));
            signal.push(near.to_array());
            before = Some(near);
        }
        self.zero_phase(&mut signal);
        for (rotation, value) in rotations.iter_mut().zip(signal) {
            *rotation = unit(DQuat::from_array(value), *rotation);
        }
    }
}

/// The same rotation with the sign that is nearer to `before`.
fn toward(before: DQuat, rotation: DQuat) -> DQuat {
    if before.dot(rotation) < 0.0 { -rotation } else { rotation }
}

/// The normalised quaternion, or the other one if it has no direction. One that is normalised already keeps its bits.
fn unit(rotation: DQuat, otherwise: DQuat) -> DQuat {
    let square = rotation.length_squared();
    if square.is_finite() && square > 1e-12 {
        if (square - 1.0).abs() < 1e-15 { rotation } else { rotation.normalize() }
    } else {
        otherwise
    }
}

/// A causal low-pass for a live signal: it lags (about 37 ms at 6 Hz) and does not allocate. It starts at rest at the
/// first sample.
///
/// ```
/// use sinew_motion::{LowPass, LowPassStream};
/// let mut live = LowPassStream::new(LowPass::new(6.0, 60.0));
/// assert_eq!(live.step([1.0, 2.0, 3.0]), [1.0, 2.0, 3.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LowPassStream<const N: usize> {
    filter: LowPass,
    /// The first value: the filter works on differences to it, so that a constant stays the same to the bit.
    origin: Option<[f64; N]>,
    state: [[f64; 2]; N],
    last: [f64; N],
}

/// All but the filter itself.
impl<const N: usize> Snapshot for LowPassStream<N> {
    fn save(&self, to: &mut Writer) {
        self.origin.is_some().save(to);
        self.origin.unwrap_or([0.0; N]).save(to);
        self.state.save(to);
        self.last.save(to);
    }
    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        let (mut has_origin, mut origin) = (false, [0.0; N]);
        has_origin.restore(from)?;
        origin.restore(from)?;
        self.origin = has_origin.then_some(origin);
        self.state.restore(from)?;
        self.last.restore(from)
    }
}

impl<const N: usize> LowPassStream<N> {
    /// A filter before its first sample.
    pub fn new(filter: LowPass) -> LowPassStream<N> {
        LowPassStream { filter, origin: None, state: [[0.0; 2]; N], last: [0.0; N] }
    }

    /// Takes the next sample and gives the filtered one (direct form II transposed).
    pub fn step(&mut self, value: [f64; N]) -> [f64; N] {
        let LowPass { b, a1, a2, .. } = self.filter;
        if self.filter.is_identity() {
            self.last = value;
            return value;
        }
        let origin = *self.origin.get_or_insert(value);
        self.last = std::array::from_fn(|axis| {
            let input = value[axis] - origin[axis];
            let [first, second] = self.state[axis];
            let output = b * input + first;
            self.state[axis] = [2.0 * b * input - a1 * output + second, b * input - a2 * output];
            origin[axis] + output
        });
        self.last
    }

    /// Resets the filter: the next sample is the first.
    pub fn reset(&mut self) {
        *self = LowPassStream::new(self.filter);
    }
}

impl LowPassStream<4> {
    /// As [`LowPassStream::step`] for a rotation.
    pub fn step_rotation(&mut self, rotation: DQuat) -> DQuat {
        let near = if self.origin.is_some() { toward(DQuat::from_array(self.last), rotation) } else { rotation };
        unit(DQuat::from_array(self.step(near.to_array())), rotation)
    }
}

impl LowPassStream<3> {
    /// As [`LowPassStream::step`] for a vector.
    pub fn step_vector(&mut self, vector: DVec3) -> DVec3 {
        DVec3::from_array(self.step(vector.to_array()))
    }
}

/// The clip with every rotation and every animated translation filtered without lag at a cut-off \[Hz\], see
/// [`DEFAULT_CUTOFF_HZ`].
pub fn filter(clip: &Clip, cutoff_hz: f64) -> Clip {
    let pass = LowPass::new(cutoff_hz, clip.fps());
    let joints = clip.skeleton().len();
    let mut filtered = clip.clone();
    let mut rotations = Vec::with_capacity(clip.frames());
    for joint in 0..joints {
        rotations.clear();
        rotations.extend((0..clip.frames()).map(|frame| clip.rotation(frame, joint)));
        pass.zero_phase_rotations(&mut rotations);
        for (frame, &rotation) in rotations.iter().enumerate() {
            filtered.set_rotation(frame, joint, rotation);
        }
    }
    for &joint in clip.moving() {
        let mut positions: Vec<[f64; 3]> =
            (0..clip.frames()).map(|frame| clip.translation(frame, joint).to_array()).collect();
        pass.zero_phase(&mut positions);
        for (frame, position) in positions.into_iter().enumerate() {
            filtered.set_translation(frame, joint, DVec3::from_array(position));
        }
    }
    filtered
}

/// One causal filter per joint of a pose, for live motion: [`LowPassStream`] for all rotations and translations.
#[derive(Clone, Debug, PartialEq)]
pub struct PoseStream {
    rotations: Vec<LowPassStream<4>>,
    translations: Vec<LowPassStream<3>>,
}

impl PoseStream {
    /// A filter for poses of `joints` joints.
    pub fn new(filter: LowPass, joints: usize) -> PoseStream {
        PoseStream {
            rotations: vec![LowPassStream::new(filter); joints],
            translations: vec![LowPassStream::new(filter); joints],
        }
    }

    /// Filters the next pose in place; transforms beyond the number of joints are left alone.
    pub fn step(&mut self, locals: &mut [Transform]) {
        for ((local, rotation), translation) in locals.iter_mut().zip(&mut self.rotations).zip(&mut self.translations) {
            local.rotation = rotation.step_rotation(local.rotation);
            local.translation = translation.step_vector(local.translation);
        }
    }

    /// Resets the filter, for a stream that restarts.
    pub fn reset(&mut self) {
        self.rotations.iter_mut().for_each(LowPassStream::reset);
        self.translations.iter_mut().for_each(LowPassStream::reset);
    }
}
