//! Sine and cosine without branches, so that they vectorise, and without the platform's C library, so that they give
//! the same bits everywhere.

use super::Real;

/// Maximum angle \[rad\] whose reduction below is exact to rounding: quarter turns counted up to 2¹⁷ times a 36-bit
/// part of π/2 fit a 53-bit product. Beyond it [`Real::sincos`] asks `libm`.
pub(super) const REDUCIBLE: f64 = 1.0e5;

/// π/2 = `HALF_PI[0] + HALF_PI[1] + HALF_PI[2]` (Cody, Waite 1980): the first two parts have 33 bits each.
const HALF_PI: [f64; 3] = [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];

/// Adding and subtracting 1.5 × 2⁵² rounds to the nearest integer, ties to even.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// 1/3!, 1/5!, … 1/17! with their signs: below π/4 the next term of the series is under 1e-19.
const SINE: [f64; 8] = [
    -1.0 / 6.0,
    1.0 / 120.0,
    -1.0 / 5_040.0,
    1.0 / 362_880.0,
    -1.0 / 39_916_800.0,
    1.0 / 6_227_020_800.0,
    -1.0 / 1_307_674_368_000.0,
    1.0 / 355_687_428_096_000.0,
];

/// 1/4!, 1/6!, … 1/16! with their signs; the next term is under 3e-18.
const COSINE: [f64; 7] = [
    1.0 / 24.0,
    -1.0 / 720.0,
    1.0 / 40_320.0,
    -1.0 / 3_628_800.0,
    1.0 / 479_001_600.0,
    -1.0 / 87_178_291_200.0,
    1.0 / 20_922_789_888_000.0,
];

/// Sine and cosine of |angle| ≤ [`REDUCIBLE`] \[rad\].
#[inline(always)]
pub(super) fn sin_cos<S: Real>(angle: S) -> (S, S) {
    let round = |x: S| (x + S::splat(ROUNDER)) - S::splat(ROUNDER);
    // angle = quarters · π/2 + rest, |rest| ≤ π/4.
    let quarters = round(angle * S::splat(std::f64::consts::FRAC_2_PI));
    let rest = angle - quarters * S::splat(HALF_PI[0]);
    let rest = rest - quarters * S::splat(HALF_PI[1]);
    let rest = rest - quarters * S::splat(HALF_PI[2]);
    let square = rest * rest;
    let series = |terms: &[f64]| {
        let mut sum = S::ZERO;
        for &term in terms.iter().rev() {
            sum = sum * square + S::splat(term);
        }
        sum
    };
    let sine = rest + rest * square * series(&SINE);
    let cosine = (S::ONE - S::splat(0.5) * square) + square * square * series(&COSINE);
    // The quarter turns modulo 4 as −2 … 2; their own sine and cosine are 0 or ±1, exactly.
    let turn = quarters - S::splat(4.0) * round(quarters * S::splat(0.25));
    let turn_cosine = S::ONE - turn.abs();
    let turn_sine = turn * (S::splat(2.0) - turn.abs());
    (sine * turn_cosine + cosine * turn_sine, cosine * turn_cosine - sine * turn_sine)
}

/// Sine and cosine of many angles \[rad\], as [[`Real::sincos`]]: one loop that the compiler vectorises.
///
/// # Panics
/// If the three slices differ in length.
pub(super) fn sin_cos_all<S: Real>(angles: &[S], sines: &mut [S], cosines: &mut [S]) {
    assert!(angles.len() == sines.len() && angles.len() == cosines.len(), "one sine and one cosine per angle");
    let largest = angles.iter().fold(S::ZERO, |largest, angle| largest.larger(angle.abs()));
    if (0..S::LANES).all(|lane| largest.lane(lane) <= REDUCIBLE) {
        for ((&angle, sine), cosine) in angles.iter().zip(sines).zip(cosines) {
            (*sine, *cosine) = sin_cos(angle);
        }
    } else {
        for ((&angle, sine), cosine) in angles.iter().zip(sines).zip(cosines) {
            (*sine, *cosine) = angle.sincos();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sine_and_cosine_agree_with_libm_over_the_whole_range() {
        let mut angle = -REDUCIBLE;
        while angle < REDUCIBLE {
            let (sine, cosine) = angle.sincos();
            // Rounding of the result and of the reduced angle: two units in the last place of 1.
            assert!((sine - libm::sin(angle)).abs() < 4.5e-16, "sin {angle}: {sine}");
            assert!((cosine - libm::cos(angle)).abs() < 4.5e-16, "cos {angle}: {cosine}");
            angle += 0.737_19;
        }
    }
}
