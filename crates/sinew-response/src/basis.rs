//! The actuation coordinates of a motion: principal components of its joint torques.

use crate::settings::{Coordinates, Settings};
use crate::torque::torques;
use crate::upper_body::{Coordinates24, Matrix24, UpperBody};
use nalgebra::{SMatrix, SymmetricEigen};
use sinew_body::humanoid::{Body, Pose, UPPER_DOFS};

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
    /// Mean square torque along each direction \[(N m)²\], descending: the spectrum of actuation.
    eigenvalues: Coordinates24,
    /// The directions, a row each, over the 24 coordinates.
    directions: Matrix24,
    /// Mean of the mass matrix's diagonal over the motion \[kg m²\].
    inertia: Coordinates24,
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
        let torques = torques(body, motion, settings);
        let mut moment = SMatrix::<f64, UPPER_DOFS, UPPER_DOFS>::zeros();
        for torque in &torques {
            let torque = nalgebra::SVector::from(*torque);
            moment += torque * torque.transpose();
        }
        moment /= torques.len() as f64;
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
        Ok(Basis {
            eigenvalues: std::array::from_fn(|rank| eigen.eigenvalues[order[rank]].max(0.0)),
            directions,
            inertia: mean_inertia(body, motion),
        })
    }

    /// This basis with the directions and spectrum of another motion's: another person's or style's actuation on this body.
    pub fn with_directions_of(&self, other: &Basis) -> Basis {
        Basis { inertia: self.inertia, ..other.clone() }
    }

    /// Mean square torque along each direction \[(N m)²\], descending.
    pub fn eigenvalues(&self) -> &[f64; UPPER_DOFS] {
        &self.eigenvalues
    }

    /// The directions in which the motion uses most torque first, unit vectors over the 24 coordinates.
    pub fn directions(&self) -> &[[f64; UPPER_DOFS]; UPPER_DOFS] {
        &self.directions
    }

    /// Mean inertia behind each coordinate over the motion \[kg m²\].
    pub fn inertia(&self) -> &[f64; UPPER_DOFS] {
        &self.inertia
    }

    /// The k directions under dynamics: Ê of the paper (or, for the counter-experiment, the other end).
    pub(crate) fn dynamic(&self, settings: &Settings) -> &[Coordinates24] {
        let k = settings.k.min(UPPER_DOFS);
        match settings.coordinates {
            Coordinates::Low => &self.directions[UPPER_DOFS - k..],
            Coordinates::High => &self.directions[..k],
        }
    }
}

fn mean_inertia(body: &Body, motion: &[Pose]) -> Coordinates24 {
    // Gravity has no part in it.
    let mut upper = UpperBody::of(body, 0.0);
    let mut sum = [0.0; UPPER_DOFS];
    for pose in motion {
        for (sum, inertia) in sum.iter_mut().zip(upper.inertia(pose)) {
            *sum += inertia;
        }
    }
    sum.map(|sum| sum / motion.len() as f64)
}
