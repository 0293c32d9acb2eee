//! The actuation coordinates of a motion: principal components of its joint torques.

use crate::settings::{Coordinates, Preset, Settings};
use crate::torque::torques;
use crate::upper_body::{Coordinates24, Matrix24, UpperBody};
use nalgebra::{SMatrix, SymmetricEigen};
use sinew_body::humanoid::{Body, Pose, UPPER_DOFS};
use sinew_motion::LowPass;

/// Cut-off of the torques' own low-pass \[Hz\]: three strides' harmonics. What is above it in a torque is noise twice
/// differentiated: half a millimetre of jitter is a newton metre at the chest.
const TORQUE_CUTOFF_HZ: f64 = 3.0;

/// Angular accelerations \[rad/s²\] that capture does not tell from rest. A direction in which the motion uses no more torque than
/// they would need is as little used as any: without them noise decides which of two idle joints is the idler.
const UNTOLD_RAD_PER_S2: f64 = 6.0;

/// Over how many neighbours on each side of the k-th direction its place in the spectrum is averaged.
const EDGE: usize = 3;

/// How steeply the weight of a direction falls with the logarithm of its mean square torque.
const STEEP: f64 = 3.0;

/// How many directions beyond the k-th still have a weight.
const FURTHER: usize = 4;

/// Why a basis cannot be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BasisError {
    /// Too little motion.
    #[error("a basis needs at least 3 frames of motion, this has {0}; give a longer clip or a wider Excerpt::cycle")]
    TooShort(usize),
    /// The motion holds a value that is NaN or infinite.
    #[error("the motion is not finite; check the clip with `sinew inspect`")]
    NotFinite,
}

/// The actuation space of one motion: orthonormal directions of joint torque, from the most used to the least, and the
/// inertia behind each coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct Basis {
    spectrum: Spectrum,
    /// The same of the torques as they are, noise and all: that of the paper's presets.
    printed: Spectrum,
    /// Mean of the mass matrix's diagonal over the motion \[kg m²\].
    inertia: Coordinates24,
}

#[derive(Clone, Debug, PartialEq)]
struct Spectrum {
    /// Mean square torque along each direction \[(N m)²\], descending: the spectrum of actuation.
    eigenvalues: Coordinates24,
    /// The directions, a row each, over the 24 coordinates.
    directions: Matrix24,
}

type SquareMatrix = SMatrix<f64, UPPER_DOFS, UPPER_DOFS>;

impl Spectrum {
    fn of(moment: SquareMatrix) -> Spectrum {
        let eigen = SymmetricEigen::new(moment);
        let mut order: Vec<usize> = (0..UPPER_DOFS).collect();
        order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
        let directions = std::array::from_fn(|rank| {
            let column = eigen.eigenvectors.column(order[rank]);
            // An eigenvector's sign is arbitrary: the largest component is made positive.
            let largest = (0..UPPER_DOFS).max_by(|&a, &b| column[a].abs().total_cmp(&column[b].abs()));
            let sign = largest.map_or(1.0, |at| column[at].signum());
            std::array::from_fn(|dof| sign * column[dof])
        });
        Spectrum { eigenvalues: std::array::from_fn(|rank| eigen.eigenvalues[order[rank]].max(0.0)), directions }
    }
}

impl Basis {
    /// Inverse dynamics and principal components of a motion (section 4.1). The second moment is *uncentred*: centred, as
    /// principal components usually are, a joint under constant load would look free.
    ///
    /// # Errors
    /// The motion has fewer than three frames or is not finite.
    pub fn of_motion(body: &Body, motion: &[Pose], settings: &Settings) -> Result<Basis, BasisError> {
        if motion.len() < 3 {
            return Err(BasisError::TooShort(motion.len()));
        }
        if !motion.iter().all(Pose::is_finite) {
            return Err(BasisError::NotFinite);
        }
        let mut torques = torques(body, motion, settings);
        let printed = Spectrum::of(second_moment(&torques));
        LowPass::new(TORQUE_CUTOFF_HZ, 1.0 / settings.time_step_secs).zero_phase(&mut torques);
        let mass = mean_mass(body, motion);
        // Accelerations that cannot be told from noise, in every direction alike.
        let untold = mass * mass * (UNTOLD_RAD_PER_S2 * UNTOLD_RAD_PER_S2);
        Ok(Basis {
            spectrum: Spectrum::of(second_moment(&torques) + untold),
            printed,
            inertia: std::array::from_fn(|dof| mass[(dof, dof)]),
        })
    }

    /// This basis with the directions and spectrum of another motion's: another person's or style's actuation on this body.
    pub fn with_directions_of(&self, other: &Basis) -> Basis {
        Basis { inertia: self.inertia, ..other.clone() }
    }

    /// Mean square torque along each direction \[(N m)²\], descending, of torques below 3 Hz; what accelerations too small to be told
    /// from noise would need is in it.
    pub fn eigenvalues(&self) -> &[f64; UPPER_DOFS] {
        &self.spectrum.eigenvalues
    }

    /// The directions in which the motion uses most torque first, unit vectors over the 24 coordinates.
    pub fn directions(&self) -> &[[f64; UPPER_DOFS]; UPPER_DOFS] {
        &self.spectrum.directions
    }

    /// Mean inertia behind each coordinate over the motion \[kg m²\].
    pub fn inertia(&self) -> &[f64; UPPER_DOFS] {
        &self.inertia
    }

    /// The k directions under dynamics: Ê of the paper (or, for the counter-experiment, the other end). Of the robust preset
    /// they fade in over the spectrum, see [`Basis::faded`].
    pub(crate) fn dynamic(&self, settings: &Settings) -> Vec<Coordinates24> {
        let k = settings.k.min(UPPER_DOFS);
        match (settings.preset, settings.coordinates) {
            (Preset::Robust, _) => self.faded(k),
            (_, Coordinates::Low) => self.printed.directions[UPPER_DOFS - k..].to_vec(),
            (_, Coordinates::High) => self.printed.directions[..k].to_vec(),
        }
    }

    /// The least used directions, each times a weight that falls from 1 to nearly 0 about the k-th. Neighbours in the spectrum
    /// are all but alike, those of the two arms above all: which of them is the k-th is noise, and with a sharp end an arm
    /// came under dynamics or did not by the last digit of a file.
    fn faded(&self, k: usize) -> Vec<Coordinates24> {
        if k == 0 {
            return Vec::new();
        }
        let first = UPPER_DOFS - k;
        let logs = self.spectrum.eigenvalues.map(|value| libm::log(value.max(1e-12)));
        let around = first.saturating_sub(EDGE)..(first + EDGE).min(UPPER_DOFS);
        let edge = logs[around.clone()].iter().sum::<f64>() / around.len() as f64;
        let weigh =
            |rank: usize| if first == 0 { 1.0 } else { (1.0 / (1.0 + libm::exp(STEEP * (logs[rank] - edge)))).sqrt() };
        let rows = first.saturating_sub(FURTHER)..UPPER_DOFS;
        rows.map(|rank| self.spectrum.directions[rank].map(|along| along * weigh(rank))).collect()
    }
}

/// Mean of the torques' products, uncentred.
fn second_moment(torques: &[Coordinates24]) -> SquareMatrix {
    let mut moment = SquareMatrix::zeros();
    for torque in torques {
        let torque = nalgebra::SVector::from(*torque);
        moment += torque * torque.transpose();
    }
    moment / torques.len() as f64
}

/// Mean of the mass matrix over a motion \[kg m²\].
fn mean_mass(body: &Body, motion: &[Pose]) -> SquareMatrix {
    // Gravity has no part in it.
    let mut upper = UpperBody::of(body, 0.0);
    let mut sum = [[0.0; UPPER_DOFS]; UPPER_DOFS];
    for pose in motion {
        for (sum, row) in sum.as_flattened_mut().iter_mut().zip(upper.mass(pose).as_flattened()) {
            *sum += row;
        }
    }
    SquareMatrix::from_fn(|row, column| sum[row][column] / motion.len() as f64)
}
