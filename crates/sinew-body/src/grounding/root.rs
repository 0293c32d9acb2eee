//! The error of the root, from what feet on the ground cannot have done.
//!
//! Captured legs and trunk fit together; what video, inertial suits and retargeting get wrong is where the whole body is. So
//! one shift of the whole body is sought for every frame, with which standing points of the soles rest and lie at the height of
//! the floor, by least squares over the whole clip. It is a slow part (drift and float: a random walk of its velocity) plus
//! noise (jitter, of the size that the clip shows), and the corrected root may not jerk. In flight nothing holds it but
//! its smoothness, so that flight stays what it was.

use super::banded::Banded;
use super::stance::{Feet, Stands};
use glam::DVec3;

/// Spectral density of the acceleration of drift over the ground \[m²/s³\]: its velocity wanders by 3 mm/s in a second.
const DRIFT: f64 = 1e-5;

/// The same of float and sinking: by 6 cm/s in a second.
const FLOAT: f64 = 4e-3;

/// Spectral density of the jerk of real hips \[m²/s⁵\].
const JERK: f64 = 300.0;

/// Spectral density of the velocity of a foot that stands \[m²/s\]: it wanders by 2 mm in 0.3 s.
const SLIDE: f64 = 1.3e-5;

/// The same of toes about which a foot rolls: 5 mm in 0.2 s.
const ROLL: f64 = 1.2e-4;

/// Noise from which on the root counts as shaking \[m\].
const SHAKES_M: f64 = 1e-3;

/// A drift of the root by less than its shaking in so many parts of a second cannot be told from that \[1/s\].
const HIDDEN_PER_SEC: f64 = 1.0;

/// Variance of the height of a foot that stands, times the time over which it is the same error \[m² s\]: 1.6 mm, 0.1 s.
const HEIGHT: f64 = 2.5e-7;

/// Height from the floor at which a sole counts less as one that stands on it \[m\], for a stature of 1.7 m.
const FLOAT_M: f64 = 0.06;

/// Least standard deviation of the root's noise \[m\].
const LEAST_NOISE_M: f64 = 1e-4;

/// By how much the start may be shifted over the ground \[m\]: not at all.
const START_M: f64 = 1e-4;

/// What is known beside the soles.
pub(super) struct RootErrors {
    /// The hips' path \[m\].
    hips: Vec<DVec3>,
    /// Standard deviation of its noise, per axis \[m\].
    noise_m: DVec3,
    step_secs: f64,
}

impl RootErrors {
    pub fn of(hips: Vec<DVec3>, fps: f64) -> RootErrors {
        let noise_m = noise(&hips, fps).max(DVec3::splat(LEAST_NOISE_M));
        RootErrors { hips, noise_m, step_secs: 1.0 / fps }
    }

    /// Estimated jitter of the root, as a standard deviation per axis \[m\].
    pub fn noise_m(&self) -> DVec3 {
        self.noise_m
    }

    /// The shift of the whole body in every frame. `standing_m` is the height of the middle of a foot that stands; `shift` is the
    /// one by which it is judged whether a foot is too far from it to stand on the floor.
    pub fn shifts(&self, feet: &Feet, stands: &Stands, rolls: &Stands, standing_m: f64, shift: &[DVec3]) -> Vec<DVec3> {
        let axis = |axis: usize, drifts: bool| self.axis(axis, drifts, feet, stands, rolls, standing_m, shift);
        let [x, y, z] = [0, 1, 2].map(|number| {
            let whole = axis(number, true);
            let is_hidden = number != 1
                && self.noise_m[number] > SHAKES_M
                && trend(&whole).abs() < self.noise_m[number] * self.step_secs * HIDDEN_PER_SEC;
            if is_hidden { axis(number, false) } else { whole }
        });
        (0..self.hips.len()).map(|frame| DVec3::new(x[frame], y[frame], z[frame])).collect()
    }

    /// Unknowns by turns: the slow error, and all of it.
    #[allow(clippy::too_many_arguments, reason = "what a frame's terms are made from")]
    fn axis(
        &self,
        axis: usize,
        drifts: bool,
        feet: &Feet,
        stands: &Stands,
        rolls: &Stands,
        standing_m: f64,
        shift: &[DVec3],
    ) -> Vec<f64> {
        let frames = self.hips.len();
        let step = self.step_secs;
        let (slow, whole) = (|frame: usize| 2 * frame, |frame: usize| 2 * frame + 1);
        let mut sum = Banded::new(2 * frames, 6);
        let (noise, wander) = (self.noise_m[axis], if axis == 1 { FLOAT } else { DRIFT });
        if !drifts {
            (1..frames).for_each(|frame| {
                sum.add(&[(slow(frame - 1), -1.0), (slow(frame), 1.0)], 0.0, 1.0 / (START_M * START_M))
            });
        }
        for frame in 0..frames {
            sum.add(&[(slow(frame), -1.0), (whole(frame), 1.0)], 0.0, 1.0 / (noise * noise));
            if frame + 2 < frames {
                let bend = [(slow(frame), 1.0), (slow(frame + 1), -2.0), (slow(frame + 2), 1.0)];
                sum.add(&bend, 0.0, 1.0 / (wander * step * step * step));
            }
            if frame + 3 < frames {
                let at = |ahead: usize| self.hips[frame + ahead][axis];
                let jerk =
                    [(whole(frame), -1.0), (whole(frame + 1), 3.0), (whole(frame + 2), -3.0), (whole(frame + 3), 1.0)];
                let own = at(3) - 3.0 * at(2) + 3.0 * at(1) - at(0);
                sum.add(&jerk, -own, 1.0 / (JERK * (step * step) * (step * step) * step));
            }
        }
        // A clip tells where it is by where it begins.
        sum.add(&[(slow(0), 1.0)], 0.0, if axis == 1 { 1.0 } else { 1.0 / (START_M * START_M) });
        // Toes about which a foot rolls rest less well than a flat foot. They bridge what shaking leaves open.
        let shaking = noise * noise / (noise * noise + SHAKES_M * SHAKES_M);
        for (foot, rolls) in rolls.iter().enumerate() {
            for (frame, (two, rolls)) in feet.points[foot][1].windows(2).zip(rolls).enumerate() {
                let rests = [(whole(frame), -1.0), (whole(frame + 1), 1.0)];
                sum.add(&rests, two[0][axis] - two[1][axis], shaking * rolls / (ROLL * step));
            }
        }
        for (foot, stands) in stands.iter().enumerate() {
            for (frame, stands) in stands.iter().enumerate() {
                let at = feet.middle(foot, frame);
                if frame + 1 < frames {
                    let slid = feet.middle(foot, frame + 1)[axis] - at[axis];
                    sum.add(&[(whole(frame), -1.0), (whole(frame + 1), 1.0)], -slid, stands / (SLIDE * step));
                }
                if axis == 1 {
                    let height = at.y - standing_m;
                    let off = (height + shift[frame].y) / (FLOAT_M * feet.scale);
                    let weight = stands / ((1.0 + off * off) * (1.0 + off * off));
                    sum.add(&[(whole(frame), 1.0)], -height, weight * step / HEIGHT);
                }
            }
        }
        let unknowns = sum.solve();
        (0..frames).map(|frame| unknowns[whole(frame)]).collect()
    }
}

/// Slope of the line through a path \[m per frame\].
fn trend(path: &[f64]) -> f64 {
    let middle = 0.5 * (path.len() as f64 - 1.0);
    let centred = |frame: usize| frame as f64 - middle;
    let squares: f64 = (0..path.len()).map(|frame| centred(frame) * centred(frame)).sum();
    path.iter().enumerate().map(|(frame, at)| at * centred(frame)).sum::<f64>() / squares.max(1e-9)
}

/// Standard deviation of white noise on a path, per axis \[m\]. In third differences noise changes its sign from one to the next (their
/// covariance is −15 times its variance), and real motion does not.
fn noise(path: &[DVec3], fps: f64) -> DVec3 {
    let squared = path.windows(2).map(|two| two[1].distance_squared(two[0])).sum::<f64>() * fps * fps;
    let jerk = STEP_JERK * squared / path.len().max(2) as f64 / (fps * fps * fps);
    let jumps: Vec<DVec3> = path.windows(4).map(|at| at[3] - 3.0 * at[2] + 3.0 * at[1] - at[0]).collect();
    let of_axis = |axis: usize| {
        let mut products: Vec<f64> = jumps.windows(2).map(|two| -two[0][axis] * two[1][axis]).collect();
        products.sort_by(f64::total_cmp);
        // Single blows of feet are not noise.
        let kept = &products[products.len() / 20..products.len() - products.len() / 20];
        let mean = kept.iter().sum::<f64>() / kept.len().max(1) as f64;
        (mean / (15.0 * KEPT_SHARE) - jerk * jerk / 20.0).max(0.0).sqrt()
    };
    DVec3::new(of_axis(0), of_axis(1), of_axis(2))
}

/// Mean of the middle nine tenths of such products, relative to the mean of all, for normal noise.
const KEPT_SHARE: f64 = 0.792;

/// Jerk of real hips per square of their speed \[1/(m s)\]: the faster a body goes, the harder its steps.
const STEP_JERK: f64 = 100.0;
