//! The rotation of one joint as a function of the swivel, and the swivels at which it is inside its limit.
//!
//! The limb swivels by the angle φ about its line. A joint's turn, seen from the middle of its range, is then
//! q(φ) = a cos(φ/2) + b sin(φ/2) with two fixed quaternions, and the bone's own axis runs round a circle on the sphere,
//! u(φ) = c + e cos φ + f sin φ. From that follows, in closed form,
//!
//! - where the *twist* is inside: it grows with φ all the way round, so that its range is one arc;
//! - where the *swing* is less than the longest half-axis of its ellipse: one arc about the swivel at which the bone is nearest
//!   to the middle. A round ellipse, as a shoulder's, is done with that.
//!
//! Inside an ellipse that is not round is where F = u_z²/r_x² + u_x²/r_z² − S(u_y) is not positive, S = sin²θ/θ² of the swing
//! θ = acos u_y. The second derivative of F has a lower bound −K, so that from a swivel outside one may go on by
//! (F' + √(F'² + 2KF))/K and pass no edge: a Newton step that never overshoots. It finds the narrowest range there is.

use super::super::Swing;
use glam::{DQuat, DVec3};
use std::f64::consts::{PI, TAU};

/// Margin by which a joint at its limit is moved inside, so that rounding leaves it inside \[rad\].
const INSIDE: f64 = 1e-9;

/// The same margin for F: how far it is brought below 0, and its tolerance.
const DEPTH: f64 = 2e-9;
const CLOSE: f64 = 1e-9;

/// Rounding of an arc's ends \[rad\].
const ROUNDING: f64 = 1e-12;

/// Swivels from one angle on \[rad\]: none if the width is negative.
#[derive(Clone, Copy, Debug)]
struct Arc {
    /// Where it begins when one swivels by positive angles, and where for negative ones, both from 0 to 2π.
    from: [f64; 2],
    width: f64,
}

impl Arc {
    const ALL: Arc = Arc { from: [0.0; 2], width: TAU };
    const NONE: Arc = Arc { from: [0.0; 2], width: -1.0 };

    fn new(from: f64, width: f64) -> Arc {
        Arc { from: [wrap(from), wrap(-from - width)], width }
    }

    /// The first swivel inside that is no sooner than `after`, from 0 to 2π, when one turns by angles of this sign.
    fn next(&self, sign: f64, after: f64) -> Option<f64> {
        if self.width < 0.0 {
            return None;
        }
        let offset = after - self.from[usize::from(sign < 0.0)];
        let offset = if offset < 0.0 { offset + TAU } else { offset };
        Some(if offset <= self.width || offset >= TAU - ROUNDING { after } else { after + (TAU - offset) })
    }
}

/// The same angle from 0 to 2π, of one from -4π to 4π.
fn wrap(angle: f64) -> f64 {
    let angle = if angle < 0.0 { angle + TAU } else { angle };
    let angle = if angle < 0.0 { angle + TAU } else { angle };
    if angle >= TAU { angle - TAU } else { angle }
}

/// One joint.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sweep {
    /// q(φ) = `begin` cos(φ/2) + `quarter` sin(φ/2).
    begin: DQuat,
    quarter: DQuat,
    /// u(φ) = `middle` + `cosine` cos φ + `sine` sin φ.
    middle: DVec3,
    cosine: DVec3,
    sine: DVec3,
    /// 1/r² of the half-axes about −X, +X, −Z, +Z \[1/rad²\].
    tight: [f64; 4],
    twist: (f64, f64),
    arcs: [Arc; 2],
    /// K, or `None` where the arcs say it all.
    curb: Option<f64>,
}

impl Sweep {
    /// The joint whose turn from the middle of its range is `left` × (turn about `axis` by φ) × `right`.
    pub fn new(left: DQuat, axis: DVec3, right: DQuat, swing: &Swing, twist: (f64, f64)) -> Sweep {
        let begin = left * right;
        let quarter = left * (DQuat::from_xyzw(axis.x, axis.y, axis.z, 0.0) * right);
        let bone = right * DVec3::Y;
        let along = axis * axis.dot(bone);
        let middle = left * along;
        let cosine = left * (bone - along);
        let sine = left * axis.cross(bone);
        let axes = [swing.x_negative, swing.x_positive, swing.z_negative, swing.z_positive].map(|axis| axis.max(1e-6));
        let (widest, narrowest) = axes.iter().fold((0.0f64, f64::INFINITY), |(w, n), &axis| (w.max(axis), n.min(axis)));
        let tight = axes.map(|axis| 1.0 / (axis * axis));
        let reach = libm::hypot(cosine.y, sine.y);
        let curb = (widest - narrowest > 1e-9 && narrowest < PI).then(|| {
            let bound = |middle: f64, cosine: f64, sine: f64, tight: f64| {
                let swing = (cosine * cosine + sine * sine).sqrt();
                2.0 * swing * (middle.abs() + swing) * tight
            };
            bound(middle.z, cosine.z, sine.z, tight[0].max(tight[1]))
                + bound(middle.x, cosine.x, sine.x, tight[2].max(tight[3]))
                + MAX_OF_S * reach
        });
        let mut sweep = Sweep { begin, quarter, middle, cosine, sine, tight, twist, arcs: [Arc::ALL, Arc::ALL], curb };
        sweep.arcs = [sweep.twist_arc(), sweep.swing_arc(widest, reach)];
        sweep
    }

    fn twist_arc(&self) -> Arc {
        let (low, high) = (self.twist.0.max(-PI) + INSIDE, self.twist.1.min(PI) - INSIDE);
        if low > high {
            return Arc::NONE;
        }
        if high - low >= TAU - 4.0 * INSIDE {
            return Arc::ALL;
        }
        let (a, b) = (self.begin, self.quarter);
        let rate = self.twist_rate();
        if rate.abs() < 1e-9 {
            // The bone lies across the line so that swivelling does not twist it: the twist is one and the same all round.
            let q = if a.w * a.w + a.y * a.y >= b.w * b.w + b.y * b.y { a } else { b };
            let twist = twist_of(q.w, q.y);
            return if twist >= low && twist <= high { Arc::ALL } else { Arc::NONE };
        }
        let at = |twist: f64| {
            let (sin, cos) = libm::sincos(0.5 * twist);
            2.0 * libm::atan2(a.w * sin - a.y * cos, b.y * cos - b.w * sin)
        };
        let (first, last) = if rate > 0.0 { (at(low), at(high)) } else { (at(high), at(low)) };
        Arc::new(first, wrap(last - first))
    }

    /// The twist's derivative by the swivel is this over w² + y².
    fn twist_rate(&self) -> f64 {
        self.begin.w * self.quarter.y - self.begin.y * self.quarter.w
    }

    fn swing_arc(&self, widest: f64, reach: f64) -> Arc {
        if widest >= PI {
            return Arc::ALL;
        }
        let least = libm::cos((widest - INSIDE).max(0.0)) - self.middle.y;
        if least <= -reach {
            return Arc::ALL;
        }
        if least >= reach {
            return Arc::NONE;
        }
        let half = libm::acos(least / reach);
        Arc::new(libm::atan2(self.sine.y, self.cosine.y) - half, 2.0 * half)
    }

    /// The first swivel no sooner than `at` that is inside the joint's arcs, for angles of this sign.
    pub fn next(&self, sign: f64, at: f64) -> Option<f64> {
        self.arcs[1].next(sign, self.arcs[0].next(sign, at)?)
    }

    /// Whether the arcs say it all.
    pub fn is_round(&self) -> bool {
        self.curb.is_none()
    }

    /// How much further one may swivel, by angles of this sign, without passing into the ellipse: 0 inside it. `turn` is the
    /// swivel's sine and cosine.
    pub fn ahead(&self, sign: f64, (sin, cos): (f64, f64)) -> f64 {
        let Some(curb) = self.curb else { return 0.0 };
        let u = self.middle + self.cosine * cos + self.sine * sin;
        let du = (self.sine * cos - self.cosine * sin) * sign;
        let (x, z) = self.tightness(u);
        let (s, ds) = s(u.y);
        let f = u.z * u.z * x + u.x * u.x * z - s + DEPTH;
        if f <= CLOSE {
            return 0.0;
        }
        let df = 2.0 * (u.z * du.z * x + u.x * du.x * z) - ds * du.y;
        // Of the two ways to write the root, the one that does not cancel.
        let root = (df * df + 2.0 * curb * f).sqrt();
        if df > 0.0 { (df + root) / curb } else { 2.0 * f / (root - df) }
    }

    /// 1/r_x² and 1/r_z² on the side to which the bone's axis is swung.
    fn tightness(&self, u: DVec3) -> (f64, f64) {
        (if u.z < 0.0 { self.tight[0] } else { self.tight[1] }, if u.x > 0.0 { self.tight[2] } else { self.tight[3] })
    }

    /// Excess of the joint over its limit, as [`super::super::Limit::excess`]. `half` and `turn` are sine and cosine of
    /// half the swivel, and of the swivel.
    #[inline(always)]
    pub fn excess(&self, half: (f64, f64), turn: (f64, f64)) -> Excess {
        let w = self.begin.w * half.1 + self.quarter.w * half.0;
        let y = self.begin.y * half.1 + self.quarter.y * half.0;
        let u = self.middle + self.cosine * turn.1 + self.sine * turn.0;
        let du = self.sine * turn.1 - self.cosine * turn.0;
        let twist = twist_of(w, y);
        let above = twist - self.twist.1;
        let below = self.twist.0 - twist;
        let across_squared = u.x * u.x + u.z * u.z;
        let (x, z) = self.tightness(u);
        let tight_squared = u.z * u.z * x + u.x * u.x * z;
        // Beside the middle's pole and the one opposite the slope has no direction.
        let (swing, swing_slope) = if across_squared < 1e-18 {
            (if u.y > 0.0 { -1.0 } else { PI - 1.0 / x.max(z).sqrt() }, 0.0)
        } else {
            let across = across_squared.sqrt();
            let room = (across_squared / tight_squared).sqrt();
            let d_across = (u.x * du.x + u.z * du.z) / across;
            let d_room = room * (d_across / across - (u.z * du.z * x + u.x * du.x * z) / tight_squared);
            (libm::acos(u.y.clamp(-1.0, 1.0)) - room, -du.y / across - d_room)
        };
        let twist_slope = self.twist_rate() / (w * w + y * y).max(1e-18);
        if swing <= 0.0 && above <= 0.0 && below <= 0.0 {
            Excess { rad: 0.0, slope: 0.0, which: 0 }
        } else if swing >= above && swing >= below {
            Excess { rad: swing, slope: swing_slope, which: 1 }
        } else if above >= below {
            Excess { rad: above, slope: twist_slope, which: 2 }
        } else {
            Excess { rad: below, slope: -twist_slope, which: 3 }
        }
    }
}

/// Excess of a joint over its limit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Excess {
    /// \[rad\], 0 inside.
    pub rad: f64,
    /// Its derivative by the swivel.
    pub slope: f64,
    /// Which limit is exceeded: none, the swing, or the twist to either side; the slope jumps between them.
    pub which: u8,
}

fn twist_of(w: f64, y: f64) -> f64 {
    if w < 0.0 { 2.0 * libm::atan2(-y, -w) } else { 2.0 * libm::atan2(y, w) }
}

/// Bound of (S(u_y))'' over the amplitude of u_y: S' is at most 2/3, and what S'' adds is largest near the far pole. A test tries
/// it.
const MAX_OF_S: f64 = 1.1;

/// S = sin²θ/θ² and its derivative by cos θ.
fn s(cosine: f64) -> (f64, f64) {
    let off = 1.0 - cosine;
    if off < 1e-4 {
        // The next terms are under 1e-13.
        return (1.0 - off * (2.0 / 3.0 - off / 15.0), 2.0 / 3.0 - off * (2.0 / 15.0));
    }
    let sine = (off * (1.0 + cosine)).max(0.0).sqrt();
    let angle = libm::acos(cosine.max(-1.0));
    let square = angle * angle;
    (sine * sine / square, 2.0 * (sine - angle * cosine) / (square * angle))
}
