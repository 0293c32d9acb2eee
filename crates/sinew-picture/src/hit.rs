//! Impacts, marked where they happen.

use glam::DVec3;

use crate::Colour;
use crate::canvas::Canvas;
use crate::colour::PAPER;
use crate::lens::Lens;
use crate::text::Type;

const HIT: Colour = Colour::hex(0xD9480F);
/// Rays of a mark, and where they begin and end \[units\].
const RAYS: usize = 8;
const FROM: f32 = 5.0;
const TO: f32 = 14.0;

/// An impact: a star of short rays about a point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hit {
    /// Where \[m\], world.
    pub at: DVec3,
    /// What is written beside it, such as "12 N s"; may be empty.
    pub label: String,
}

impl Hit {
    /// Draws it; `taken` holds the boxes of existing labels (left, top, right, bottom).
    pub(crate) fn paint(&self, canvas: &mut Canvas, lens: &Lens, unit: f32, taken: &mut Vec<[f32; 4]>) {
        let (x, y) = lens.spot(self.at);
        if !(-50.0..canvas.width() + 50.0).contains(&x) || !(-50.0..canvas.height() + 50.0).contains(&y) {
            return;
        }
        for (width, colour) in [(5.0, PAPER.with_alpha(230)), (2.6, HIT)] {
            for ray in 0..RAYS {
                let turn = ray as f32 / RAYS as f32 * std::f32::consts::TAU;
                let (right, down) = (libm::cosf(turn) * unit, libm::sinf(turn) * unit);
                let line = [(x + right * FROM, y + down * FROM), (x + right * TO, y + down * TO)];
                canvas.polyline(&line, width * unit, colour, &[]);
            }
        }
        taken.push([x - TO * unit, y - TO * unit, x + TO * unit, y + TO * unit]);
        let font = Type::strong(13.0 * unit, HIT);
        canvas.label((x, y - (TO + 4.0) * unit), true, font, PAPER, &self.label, unit, taken);
    }
}
