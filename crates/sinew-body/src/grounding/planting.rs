//! The rest: each foot by itself, until its standing points rest on the floor.

use super::banded::Banded;
use super::stance::Feet;
use glam::DVec3;

/// Spectral density of the acceleration of a foot's shift \[m²/s³\].
const BEND: f64 = 0.2;

/// Spectral density of the velocity of a foot that stands, after planting \[m²/s\].
const SLIDE: f64 = 2e-8;

/// Variance of a foot's shift, times time \[m² s\]: 1 cm, 0.1 s.
const FREE: f64 = 1e-5;

/// Variance of the height of a sole that stands flat, times time \[m² s\].
const HEIGHT: f64 = 1e-8;

/// Standard deviation of the height of a point that is lifted out of the floor \[m\].
const LIFT_M: f64 = 1e-4;

/// Depth in the floor that is left \[m\]: a heel that strikes is pressed.
const LEFT_M: f64 = 0.004;

/// Rounds in which points that would be in the floor are lifted.
const ROUNDS: usize = 4;

/// The shift of one foot in every frame \[m\]; `feet` are where they are without it, `standing_m` the heights of heel and toes that stand.
pub(super) fn planted(feet: &Feet, stands: &[f64], foot: usize, standing_m: [f64; 2]) -> Vec<DVec3> {
    let frames = feet.frames();
    let mut lifted = [(); 2].map(|()| vec![false; frames]);
    let shift = |axis: usize, lifted: &[Vec<bool>; 2]| shift(feet, stands, foot, axis, standing_m, lifted);
    let level = [0, 2].map(|axis| shift(axis, &lifted));
    let mut up = shift(1, &lifted);
    for _ in 0..ROUNDS {
        let mut is_new = false;
        for (point, lifted) in lifted.iter_mut().enumerate() {
            for (frame, lifted) in lifted.iter_mut().enumerate() {
                if !*lifted && feet.depth_m(foot, point, frame, standing_m) - up[frame] > LEFT_M + LIFT_M {
                    (*lifted, is_new) = (true, true);
                }
            }
        }
        if !is_new {
            break;
        }
        up = shift(1, &lifted);
    }
    (0..frames).map(|frame| DVec3::new(level[0][frame], up[frame], level[1][frame])).collect()
}

/// Weight of a foot in planting: only what surely stands is held.
fn surely(stands: f64) -> f64 {
    ((stands - 0.3) / 0.4).clamp(0.0, 1.0)
}

fn shift(
    feet: &Feet,
    stands: &[f64],
    foot: usize,
    axis: usize,
    standing_m: [f64; 2],
    lifted: &[Vec<bool>; 2],
) -> Vec<f64> {
    let frames = feet.frames();
    let step = 1.0 / feet.fps;
    let mut sum = Banded::new(frames, 2);
    for (frame, stands) in stands.iter().enumerate() {
        sum.add(&[(frame, 1.0)], 0.0, step / FREE);
        if frame + 2 < frames {
            let bend = [(frame, 1.0), (frame + 1, -2.0), (frame + 2, 1.0)];
            sum.add(&bend, 0.0, 1.0 / (BEND * step * step * step));
        }
        let at = feet.middle(foot, frame);
        if frame + 1 < frames {
            let slid = feet.middle(foot, frame + 1)[axis] - at[axis];
            sum.add(&[(frame, -1.0), (frame + 1, 1.0)], -slid, surely(*stands) / (SLIDE * step));
        }
        if axis == 1 {
            let height = at.y - 0.5 * (standing_m[0] + standing_m[1]);
            sum.add(&[(frame, 1.0)], -height, surely(*stands) * step / HEIGHT);
            for point in (0..2).filter(|point| lifted[*point][frame]) {
                let height = feet.points[foot][point][frame].y - (standing_m[point] - LEFT_M);
                sum.add(&[(frame, 1.0)], -height, 1.0 / (LIFT_M * LIFT_M));
            }
        }
    }
    sum.solve()
}
