//! Stability: whether small deviations decay.
//!
//! The response to a small deviation is linear, with coefficients that follow the motion. Over a stretch of motion it
//! is one matrix, and if the motion went on repeating that stretch, deviations would grow by the matrix's spectral
//! radius each time (Floquet's theory of periodic systems). Below 1 the body recovers from any small push by itself.

use crate::basis::Basis;
use crate::response::Response;
use crate::settings::Settings;
use nalgebra::DMatrix;
use sinew_body::humanoid::{Body, Limit, Node, Pose, UPPER_DOFS};

/// Deviation and its growth: the state of the linearised step.
const STATE: usize = 2 * UPPER_DOFS;

/// Size of the trial deviations \[rad\]: far below where the response bends, far above rounding.
const TRIAL: f64 = 1e-6;

/// Maximum growth of small deviations in a second at which a compliance is accepted: from 20 degrees to 2 in two and
/// a half seconds, so that what the stretches do not show of a long motion is covered.
const GROWTH_PER_SECOND: f64 = 0.3;

/// Poses in one stretch of a long motion: about a stride.
const STRETCH: usize = 72;

/// Number of stretches of a long motion that are examined.
const STRETCHES: usize = 6;

/// The compliance is searched in this many steps to a factor of two, then by bisection.
const STEPS_TO_HALF: f64 = 2.0;

/// Number of bisections: to two per cent.
const HALVINGS: usize = 4;

/// The compliance of `settings`, or the maximum below it at which small deviations decay on this motion within seconds;
/// if they never decay so fast, the one at which they decay fastest. Of a long motion that is not a cycle, six
/// stretches are examined, as if they followed each other.
pub(crate) fn stable_compliance(body: &Body, basis: &Basis, settings: &Settings, motion: &[Pose]) -> f64 {
    let stretches: Vec<&[Pose]> = if motion.len() <= STRETCHES * STRETCH {
        vec![motion]
    } else {
        let room = motion.len() - STRETCH;
        (0..STRETCHES).map(|index| index * room / (STRETCHES - 1)).map(|at| &motion[at..at + STRETCH]).collect()
    };
    let steps: usize = stretches.iter().map(|stretch| stretch.len().saturating_sub(2)).sum();
    let allowed = libm::pow(GROWTH_PER_SECOND, steps as f64 * settings.time_step_secs);
    let grows = |compliance: f64| growth_over(body, basis, &Settings { compliance, ..*settings }, &stretches);
    let asked = settings.compliance;
    let mut least = (asked, grows(asked));
    if least.1 <= allowed {
        return asked;
    }
    // The grid does not depend on the requested value, so that requesting more never gives less.
    let (mut above, mut step) = (Settings::MAX_COMPLIANCE, 0.0);
    while above > Settings::MIN_COMPLIANCE {
        step += 1.0;
        // Powers of two are exact, so that a dial at one of them is on the grid.
        let below = (Settings::MAX_COMPLIANCE * libm::exp2(-step / STEPS_TO_HALF)).max(Settings::MIN_COMPLIANCE);
        if below < asked {
            let growth = grows(below);
            if growth <= allowed {
                let (mut stable, mut unstable) = (below, above);
                for _ in 0..HALVINGS {
                    let middle = (stable * unstable).sqrt();
                    if grows(middle) <= allowed { stable = middle } else { unstable = middle }
                }
                return stable.min(asked);
            }
            if growth < least.1 {
                least = (below, growth);
            }
        }
        above = below;
    }
    least.0
}

/// By what factor the largest small deviation grows over stretches of motion, were they to repeat: the spectral radius of the
/// linearised steps' product. Joint limits are left out: they only ever stop a deviation. Stretches of fewer than three poses
/// have no growth to tell: 0.
fn growth_over(body: &Body, basis: &Basis, settings: &Settings, stretches: &[&[Pose]]) -> f64 {
    let Some(first) = stretches.first().and_then(|stretch| stretch.first()) else { return 0.0 };
    let mut body = body.clone();
    for node in Node::ALL {
        body.link_mut(node).limit = Limit::NONE;
    }
    // What stops an arm at the body is no linear part of a step, and for the first half second nobody knows what hands hold.
    let settings = Settings { arms_clear: false, hands_hold: false, ..*settings };
    let mut response = Response::new(body, basis.clone(), settings, first);
    let mut product = DMatrix::<f64>::identity(STATE, STATE);
    let mut any = false;
    for window in stretches.iter().flat_map(|stretch| stretch.windows(3)) {
        product = linearised(&mut response, [&window[0], &window[1], &window[2]]) * product;
        any = true;
    }
    if !any {
        return 0.0;
    }
    let eigenvalues = product.complex_eigenvalues();
    eigenvalues.iter().map(|value| (value.re * value.re + value.im * value.im).sqrt()).fold(0.0, f64::max)
}

/// The step from the middle pose to the last, as a matrix over deviation and growth.
fn linearised(response: &mut Response, [before, now, next]: [&Pose; 3]) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(STATE, STATE);
    for column in 0..STATE {
        let (mut deviation, mut growth) = ([0.0; UPPER_DOFS], [0.0; UPPER_DOFS]);
        if column < UPPER_DOFS {
            deviation[column] = TRIAL;
        } else {
            growth[column - UPPER_DOFS] = TRIAL;
        }
        response.restart(before, now);
        response.set_deviation(&deviation, &growth);
        response.step(next, &[]);
        let (deviation, growth) = response.deviation_and_growth();
        for row in 0..UPPER_DOFS {
            matrix[(row, column)] = deviation[row] / TRIAL;
            matrix[(UPPER_DOFS + row, column)] = growth[row] / TRIAL;
        }
    }
    matrix
}
