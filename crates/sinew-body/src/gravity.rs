//! Gravity: the one default, and what is measured in body weights.

/// Standard gravity \[m/s²\], rounded from 9.80665: the default wherever gravity can be chosen.
///
/// Everything whose size follows from weight (limit springs, joint gains, largest pin forces, the torques that a motion uses)
/// takes the gravity of its own world, never this constant.
pub const STANDARD_GRAVITY_M_S2: f64 = 9.81;

/// Gravity below which a body's strength no longer sinks \[m/s²\]: a tenth of [`STANDARD_GRAVITY_M_S2`].
const MIN_STRENGTH_GRAVITY_M_S2: f64 = 0.1 * STANDARD_GRAVITY_M_S2;

/// The gravity by which strengths that are stated in body weights are measured \[m/s²\], in a world of this gravity.
///
/// It is the gravity's size, but at least a tenth of the standard one: a weightless body keeps joint limits that push back
/// and can still be held to its place.
///
/// ```
/// use sinew_body::{STANDARD_GRAVITY_M_S2, strength_gravity_m_s2};
/// assert_eq!(strength_gravity_m_s2(STANDARD_GRAVITY_M_S2), STANDARD_GRAVITY_M_S2);
/// assert_eq!(strength_gravity_m_s2(1.62), 1.62); // on the Moon
/// assert!(strength_gravity_m_s2(0.0) > 0.9);
/// ```
pub fn strength_gravity_m_s2(gravity_m_s2: f64) -> f64 {
    gravity_m_s2.abs().max(MIN_STRENGTH_GRAVITY_M_S2)
}
