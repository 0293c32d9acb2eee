//! Measures of a motion that was changed, against the motion that it was: what eyes see, as numbers.
//!
//! | question | measure |
//! |---|---|
//! | Does a joint snap? | [`deflections`] of two poses, their largest change over 1/60 s: [`Changed::largest_deflection_steps`] |
//! | Does the pelvis jump? | [`Changed::largest_hips_step_m`] |
//! | Is a segment flung? | [`largest_angular_acceleration`], beside that of the input |
//! | Does an arm pass through trunk, head, thighs or floor? | [`overlaps`] |
//! | Do hands that hold something come apart? | [`hands_apart_m`] |
//! | Where does the weight go? | [`centre_of_mass`] by Winter's shares, which no method here uses |
//!
//! Measures are independent of the masses and shapes with which a method computes: capsules and shares are those of the
//! literature, scaled by stature. All take poses of the 18 bodies; a clip's are [`Reduction::pose`](crate::humanoid::Reduction::pose).

mod change;
mod mass;
mod overlap;

pub use change::{Changed, deflections, largest_angular_acceleration};
pub use mass::centre_of_mass;
pub use overlap::{Overlaps, hands_apart_m, nearest_points, overlaps};

#[cfg(test)]
mod tests;
