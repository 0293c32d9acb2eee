//! The canvas: a pixmap with the few strokes that pictures need.

use tiny_skia::{
    FillRule, LineCap, LineJoin, Paint, PathBuilder, Pixmap, PremultipliedColorU8, Rect, Stroke, StrokeDash, Transform,
};

use crate::limits::{MAX_HEIGHT_PX, MAX_WIDTH_PX};
use crate::{Colour, Error};

/// A point of the picture \[px\]: x to the right, y down.
pub(crate) type Spot = (f32, f32);

/// An opaque pixmap. Strokes with coordinates that are not finite are left out.
pub(crate) struct Canvas {
    pub pixmap: Pixmap,
}

impl Canvas {
    pub fn new(width_px: u32, height_px: u32, ground: Colour) -> Result<Canvas, Error> {
        let (width_px, height_px) = (width_px.clamp(1, MAX_WIDTH_PX), height_px.clamp(1, MAX_HEIGHT_PX));
        let mut pixmap = Pixmap::new(width_px, height_px).ok_or(Error::TooLarge { width_px, height_px })?;
        let [red, green, blue] = [ground.red, ground.green, ground.blue];
        pixmap.fill(tiny_skia::Color::from_rgba8(red, green, blue, 255));
        Ok(Canvas { pixmap })
    }

    pub fn width(&self) -> f32 {
        self.pixmap.width() as f32
    }

    pub fn height(&self) -> f32 {
        self.pixmap.height() as f32
    }

    /// Blends `colour` over one pixel, `cover` 0 to 1. Outside the canvas nothing happens.
    pub fn blend(&mut self, x: i32, y: i32, colour: [f32; 3], cover: f32) {
        let (width, height) = (self.pixmap.width() as i32, self.pixmap.height() as i32);
        if x < 0 || y < 0 || x >= width || y >= height {
            return;
        }
        let cover = cover.clamp(0.0, 1.0);
        let pixel = &mut self.pixmap.pixels_mut()[(y * width + x) as usize];
        let mix = |under: u8, over: f32| {
            let value = f32::from(under) + (over.clamp(0.0, 1.0) * 255.0 - f32::from(under)) * cover;
            (value + 0.5) as u8
        };
        let [red, green, blue] =
            [mix(pixel.red(), colour[0]), mix(pixel.green(), colour[1]), mix(pixel.blue(), colour[2])];
        if let Some(mixed) = PremultipliedColorU8::from_rgba(red, green, blue, 255) {
            *pixel = mixed;
        }
    }

    pub fn rect(&mut self, left: f32, top: f32, width: f32, height: f32, colour: Colour) {
        if let Some(rect) = Rect::from_xywh(left, top, width, height) {
            self.pixmap.fill_rect(rect, &colour.paint(), Transform::identity(), None);
        }
    }

    /// A line of one pixel or more along the edge of a rectangle, inside it.
    pub fn frame(&mut self, left: f32, top: f32, width: f32, height: f32, line: f32, colour: Colour) {
        self.rect(left, top, width, line, colour);
        self.rect(left, top + height - line, width, line, colour);
        self.rect(left, top + line, line, height - 2.0 * line, colour);
        self.rect(left + width - line, top + line, line, height - 2.0 * line, colour);
    }

    pub fn polygon(&mut self, corners: &[Spot], colour: Colour) {
        self.fill(path(corners, true), &colour.paint());
    }

    pub fn disc(&mut self, centre: Spot, radius: f32, colour: Colour) {
        self.fill(PathBuilder::from_circle(centre.0, centre.1, radius), &colour.paint());
    }

    fn fill(&mut self, path: Option<tiny_skia::Path>, paint: &Paint) {
        if let Some(path) = path {
            self.pixmap.fill_path(&path, paint, FillRule::Winding, Transform::identity(), None);
        }
    }

    /// An open line through the spots. `dash` is empty for a solid line, else lengths on and off \[px\].
    pub fn polyline(&mut self, spots: &[Spot], width: f32, colour: Colour, dash: &[f32]) {
        self.stroke(path(spots, false), width, colour, dash);
    }

    pub fn outline(&mut self, corners: &[Spot], width: f32, colour: Colour) {
        self.stroke(path(corners, true), width, colour, &[]);
    }

    pub fn ring(&mut self, centre: Spot, radius: f32, width: f32, colour: Colour) {
        self.stroke(PathBuilder::from_circle(centre.0, centre.1, radius), width, colour, &[]);
    }

    fn stroke(&mut self, path: Option<tiny_skia::Path>, width: f32, colour: Colour, dash: &[f32]) {
        let Some(path) = path else { return };
        let cap = if dash.is_empty() { LineCap::Round } else { LineCap::Butt };
        let dash = if dash.is_empty() { None } else { StrokeDash::new(dash.to_vec(), 0.0) };
        let stroke = Stroke { width, dash, line_cap: cap, line_join: LineJoin::Round, ..Stroke::default() };
        self.pixmap.stroke_path(&path, &colour.paint(), &stroke, Transform::identity(), None);
    }

    /// Copies another opaque picture onto this one, its corner at whole pixels; clipped at the edges.
    pub fn paste(&mut self, left: usize, top: usize, picture: &Canvas) {
        let (width, height) = (self.pixmap.width() as usize, self.pixmap.height() as usize);
        let own = picture.pixmap.width() as usize;
        let wide = own.min(width.saturating_sub(left));
        if wide == 0 {
            return;
        }
        let pixels = self.pixmap.pixels_mut();
        for (row, line) in picture.pixmap.pixels().chunks_exact(own).enumerate().take(height.saturating_sub(top)) {
            let at = (top + row) * width + left;
            pixels[at..at + wide].copy_from_slice(&line[..wide]);
        }
    }
}

/// A path through the spots, or `None` when it has no extent or is not finite.
fn path(spots: &[Spot], closed: bool) -> Option<tiny_skia::Path> {
    // tiny-skia works in fixed point beyond this; no shape of ours lies so far outside the canvas on purpose.
    const FAR_PX: f32 = 30_000.0;
    let mut builder = PathBuilder::new();
    for &(x, y) in spots {
        if !(x.is_finite() && y.is_finite()) {
            continue;
        }
        let (x, y) = (x.clamp(-FAR_PX, FAR_PX), y.clamp(-FAR_PX, FAR_PX));
        if builder.is_empty() { builder.move_to(x, y) } else { builder.line_to(x, y) }
    }
    if closed && !builder.is_empty() {
        builder.close();
    }
    builder.finish()
}
