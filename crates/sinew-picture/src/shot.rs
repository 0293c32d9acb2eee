//! What all panels of a picture share: camera, scale, and the place of the followed point.

use glam::DVec3;

use crate::body::{Floor, Look, Painter};
use crate::canvas::{Canvas, Spot};
use crate::extent::{Extent, arrows, followed, hits};
use crate::lens::Lens;
use crate::limits::MAX_COORDINATE_M;
use crate::{Camera, Colour, Panel, View, floor};

const GHOST: Colour = Colour::hex(0x7B8AA3);
pub(crate) const SKY: Colour = Colour::hex(0xF7F9FB);
pub(crate) const EDGE: Colour = Colour::hex(0x222A36);

/// View and scale of the panels of a picture.
pub(crate) struct Shot {
    view: View,
    floor_m: f64,
    /// Pixels per unit: a picture 1800 px wide has 1.
    unit: f32,
    /// Extent of what is to be seen.
    pub extent: Extent,
    /// Pixels per metre.
    pub scale: f64,
    /// Position of the followed point on the floor in a panel \[px\].
    pub at: Spot,
    strongest_n: f64,
    /// Light and shadow in so many steps, see [`Look::steps`].
    pub steps: Option<f32>,
}

impl Shot {
    /// A view of these panels; [`Shot::look_at`] sets its scale.
    pub fn new(camera: Camera, floor_m: f64, panels: &[Panel], unit: f32) -> Shot {
        let view = camera.view();
        let floor_m = if floor_m.is_finite() { floor_m.clamp(-MAX_COORDINATE_M, MAX_COORDINATE_M) } else { 0.0 };
        let strongest_n = panels.iter().flat_map(arrows).map(|arrow| arrow.force_n.length()).fold(0.0, f64::max);
        let extent = Extent::of(panels, &view, floor_m, strongest_n);
        Shot { view, floor_m, unit, extent, scale: 1.0, at: (0.0, 0.0), strongest_n, steps: None }
    }

    /// Sets the scale for panels of this width, with the extent in their middle and `pad` free above it \[px\].
    pub fn look_at(&mut self, width: f32, scale: f64, pad: f32) {
        self.scale = scale;
        let spare = f64::from(width) - self.extent.width_m() * scale;
        // Whole pixels: what else is in a panel does not change how a body is sampled.
        let left = (self.extent.left_m * scale + spare / 2.0).round() as f32;
        self.at = (left, ((self.extent.above_m * scale) as f32 + pad).round());
    }

    pub fn lens(&self, panel: &Panel) -> Lens {
        let origin = DVec3 { y: self.floor_m, ..followed(panel) };
        Lens { view: self.view, origin, scale: self.scale, at: self.at }
    }

    /// Paints floor, ghost, body and objects; the floor ends at `bottom` \[px\].
    pub fn paint(&self, canvas: &mut Canvas, panel: &Panel, painter: &mut Painter, bottom: f32) {
        let lens = self.lens(panel);
        floor::paint(canvas, &lens, [&panel.figure, &panel.objects], bottom, self.steps);
        if let Some(ghost) = &panel.ghost {
            painter.paint(canvas, &lens.solids([ghost]), &self.ghost_look());
        }
        painter.paint(canvas, &lens.solids([&panel.figure, &panel.objects]), &self.body_look());
    }

    /// Paints forces and impacts over it.
    pub fn paint_marks(&self, canvas: &mut Canvas, panel: &Panel) {
        let (lens, unit) = (self.lens(panel), self.unit);
        let mut taken: Vec<[f32; 4]> = arrows(panel).map(|arrow| arrow.tip_box(&lens, unit)).collect();
        for hit in hits(panel) {
            hit.paint(canvas, &lens, unit, &mut taken);
        }
        for arrow in arrows(panel) {
            arrow.paint(canvas, &lens, self.strongest_n, unit, &mut taken);
        }
    }

    fn body_look(&self) -> Look {
        // A centimetre below the floor counts as contact: soles are soft and radii are estimates.
        let level = -(0.01 * self.scale) as f32 - self.at.1 * self.view.up.y as f32;
        Look {
            single: None,
            opacity: 1.0,
            edge: EDGE,
            edge_opacity: 0.82,
            edge_px: (1.25 * self.unit).max(0.7),
            edge_jump_px: (0.035 * self.scale) as f32,
            haze: SKY,
            steps: self.steps,
            floor: Some(Floor { rise: (self.view.up.y as f32, self.view.toward.y as f32), level }),
        }
    }

    fn ghost_look(&self) -> Look {
        Look {
            single: Some(GHOST),
            opacity: 0.34,
            edge: GHOST,
            edge_opacity: 0.75,
            edge_px: (1.0 * self.unit).max(0.7),
            floor: None,
            ..self.body_look()
        }
    }
}
