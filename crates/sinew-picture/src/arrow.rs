//! Forces as arrows.

use glam::DVec3;

use crate::canvas::{Canvas, Spot};
use crate::colour::{ARROW, PAPER};
use crate::figure::is_drawable;
use crate::lens::Lens;
use crate::text::Type;

/// An arrow whose projection is shorter than this \[units\] is drawn as a ring.
const SHORT: f32 = 20.0;

/// A force on a body. Its tip is drawn at the point of application; along the line of sight it becomes a ring, with a
/// dot when it comes toward the viewer and a cross when it goes away.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Arrow {
    /// Point of application \[m\], world.
    pub at: DVec3,
    /// Force \[N\], world. Lengths are to one scale within a filmstrip.
    pub force_n: DVec3,
    /// Its label; if empty, the newtons.
    pub label: String,
}

impl Arrow {
    pub(crate) fn is_drawable(&self) -> bool {
        let newtons = self.force_n.length();
        is_drawable(self.at) && newtons.is_finite() && newtons > 0.0
    }

    /// Where it starts \[m\], world, when the strongest force of the picture is `strongest_n`.
    pub(crate) fn tail(&self, strongest_n: f64) -> DVec3 {
        let newtons = self.force_n.length();
        let length_m = 0.24 + 0.26 * (newtons / strongest_n.max(1e-12)).min(1.0);
        self.at - self.force_n * (length_m / newtons)
    }

    fn text(&self) -> String {
        if self.label.is_empty() { format!("{:.0} N", self.force_n.length().min(1e9)) } else { self.label.clone() }
    }

    /// Draws it; `taken` holds the boxes of existing labels (left, top, right, bottom).
    pub(crate) fn paint(
        &self,
        canvas: &mut Canvas,
        lens: &Lens,
        strongest_n: f64,
        unit: f32,
        taken: &mut Vec<[f32; 4]>,
    ) {
        let (tip, tail) = (lens.spot(self.at), lens.spot(self.tail(strongest_n)));
        let (right, down) = (tip.0 - tail.0, tip.1 - tail.1);
        let length = (right * right + down * down).sqrt();
        if length > SHORT * unit {
            shaft(canvas, tip, (right / length, down / length), length, unit);
            self.write(canvas, tail, down > -0.5 * length, unit, taken);
        } else {
            sight_line(canvas, tip, self.force_n.dot(lens.view.toward) > 0.0, unit);
            self.write(canvas, (tip.0, tip.1 - 10.0 * unit), true, unit, taken);
        }
    }

    /// The box around its tip, which labels keep clear of.
    pub(crate) fn tip_box(&self, lens: &Lens, unit: f32) -> [f32; 4] {
        let (x, y) = lens.spot(self.at);
        let reach = 10.0 * unit;
        [x - reach, y - reach, x + reach, y + reach]
    }

    fn write(&self, canvas: &mut Canvas, root: Spot, above: bool, unit: f32, taken: &mut Vec<[f32; 4]>) {
        let font = Type::strong(14.0 * unit, ARROW);
        let at = if above { (root.0, root.1 - 7.0 * unit) } else { (root.0, root.1 + 16.0 * unit) };
        canvas.label(at, above, font, PAPER, &self.text(), unit, taken);
    }
}

fn shaft(canvas: &mut Canvas, tip: Spot, direction: Spot, length: f32, unit: f32) {
    let head = (15.0 * unit).min(length * 0.5);
    let at = |back: f32, aside: f32| {
        (tip.0 - direction.0 * back - direction.1 * aside, tip.1 - direction.1 * back + direction.0 * aside)
    };
    let (thin, wide) = (2.3 * unit, 7.5 * unit);
    let corners = [
        at(0.0, 0.0),
        at(head, wide),
        at(head * 0.86, thin),
        at(length, thin),
        at(length, -thin),
        at(head * 0.86, -thin),
        at(head, -wide),
    ];
    canvas.outline(&corners, 3.0 * unit, PAPER.with_alpha(235));
    canvas.polygon(&corners, ARROW);
}

fn sight_line(canvas: &mut Canvas, at: Spot, toward: bool, unit: f32) {
    let radius = 9.0 * unit;
    canvas.disc(at, radius + 2.0 * unit, PAPER.with_alpha(220));
    canvas.ring(at, radius, 2.5 * unit, ARROW);
    if toward {
        canvas.disc(at, 3.5 * unit, ARROW);
    } else {
        let arm = radius * 0.62;
        canvas.polyline(&[(at.0 - arm, at.1 - arm), (at.0 + arm, at.1 + arm)], 2.5 * unit, ARROW, &[]);
        canvas.polyline(&[(at.0 - arm, at.1 + arm), (at.0 + arm, at.1 - arm)], 2.5 * unit, ARROW, &[]);
    }
}
