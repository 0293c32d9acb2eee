//! Layout and painting of a filmstrip.

use glam::DVec3;

use crate::body::Painter;
use crate::canvas::{Canvas, Spot};
use crate::colour::{ARROW, HAIRLINE, INK, INK_SOFT, PAPER};
use crate::extent::arrows;
use crate::figure::is_drawable;
use crate::limits::{MAX_COLUMNS, MAX_PANELS};
use crate::shot::{EDGE, SKY, Shot};
use crate::text::{Anchor, Type};
use crate::{Colour, Error, Figure, Filmstrip, Panel, Shade, floor};

/// A standing body is at least this high, wherever its panels find room \[units\].
const BODY: f64 = 240.0;
/// Maximum height of a panel, and of a body in it \[units\].
const TALLEST: f64 = 760.0;
const TALLEST_BODY: f64 = 420.0;
/// Minimum width of a panel, for its words \[units\].
const MIN_PANEL: f32 = 150.0;
/// Space between panels \[units\].
const GAP: f32 = 8.0;
const MARGIN: f32 = 24.0;

/// Sizes of a filmstrip, in pixels unless said otherwise.
pub(crate) struct Layout<'a> {
    strip: &'a Filmstrip,
    shot: Shot,
    /// Pixels per unit: a picture 1800 px wide has 1.
    unit: f32,
    width: f32,
    columns: usize,
    left: f32,
    head: f32,
    panel_width: f32,
    panel_height: f32,
    row_height: f32,
    /// Top of the ruler in a panel.
    ruler: f32,
}

impl<'a> Layout<'a> {
    pub fn new(strip: &'a Filmstrip, width: f32) -> Layout<'a> {
        let unit = width / 1800.0;
        let panels = &strip.panels[..strip.panels.len().min(MAX_PANELS)];
        let mut shot = Shot::new(strip.camera, strip.style.floor_m, panels, unit);
        let extent = shot.extent;
        let pad = f64::from(14.0 * unit);
        let room = |columns: usize| width - (2.0 * MARGIN + (columns - 1) as f32 * GAP) * unit;
        let body_m =
            Some(strip.style.body_height_m).filter(|height| height.is_finite()).unwrap_or(1.7).clamp(0.2, 20.0);
        let scale_in = |columns: usize| {
            let across = (f64::from(room(columns) / columns as f32) - pad) / extent.width_m();
            let upright = (TALLEST * f64::from(unit) - pad) / extent.height_m();
            across.min(upright).min(TALLEST_BODY * f64::from(unit) / body_m).max(1.0)
        };
        let most = strip.style.columns.clamp(1, MAX_COLUMNS).min(panels.len().max(1));
        let least = BODY * f64::from(unit) / body_m;
        // What even a single column cannot show larger, because it is high, is not lost in several.
        let least = least.min(0.999 * scale_in(1));
        let columns = (1..=most).rev().find(|&columns| scale_in(columns) >= least).unwrap_or(1);
        // Rows of equal length: nine panels read better as five and four than as eight and one.
        let rows = panels.len().div_ceil(columns).max(1);
        let columns = panels.len().div_ceil(rows).max(1);
        let scale = scale_in(columns);
        let panel_width = (room(columns) / columns as f32).min((extent.width_m() * scale + pad) as f32);
        let panel_width = panel_width.max(MIN_PANEL * unit).floor().max(24.0);
        let used = panel_width * columns as f32 + (columns - 1) as f32 * GAP * unit;
        shot.look_at(panel_width, scale, pad as f32);
        let ruler = (shot.at.1 + (extent.below_m * scale) as f32).ceil();
        let captions = panels.iter().any(|panel| !panel.caption.trim().is_empty());
        let panel_height = (ruler + 24.0 * unit).ceil();
        let under = if captions { 74.0 } else { 36.0 };
        Layout {
            strip,
            unit,
            width,
            columns,
            left: ((width - used) / 2.0).floor(),
            head: head_height(&strip.title, &strip.subtitle, has_legend(panels), unit),
            panel_width,
            panel_height,
            row_height: panel_height + (under + GAP) * unit,
            ruler,
            shot,
        }
    }

    fn panels(&self) -> &'a [Panel] {
        &self.strip.panels[..self.strip.panels.len().min(MAX_PANELS)]
    }

    /// Height of the whole strip \[px\].
    pub fn height(&self) -> f32 {
        let rows = self.panels().len().div_ceil(self.columns).max(1) as f32;
        (self.head + rows * self.row_height + 8.0 * self.unit).ceil()
    }

    fn corner(&self, index: usize) -> (f32, f32) {
        let (row, column) = (index / self.columns, index % self.columns);
        let x = self.left + (column as f32 * (self.panel_width + GAP * self.unit)).round();
        (x, (self.head + row as f32 * self.row_height).round())
    }

    /// Position of a point of the world.
    pub fn spot(&self, index: usize, point: DVec3) -> Option<Spot> {
        let panel = self.panels().get(index).filter(|_| is_drawable(point))?;
        let (spot, corner) = (self.shot.lens(panel).spot(point), self.corner(index));
        Some((spot.0 + corner.0, spot.1 + corner.1))
    }

    pub fn draw(&self) -> Result<Canvas, Error> {
        let mut sheet = Canvas::new(self.width as u32, self.height() as u32, PAPER)?;
        let canvas = &mut sheet;
        let mut subtitle = self.strip.subtitle.clone();
        let rest = self.strip.panels.len() - self.panels().len();
        if rest > 0 {
            subtitle += &format!(" (the last {rest} panels are left out)");
        }
        let figures = |panel: &'a Panel| [&panel.figure, &panel.objects].into_iter().chain(&panel.ghost);
        let shapes = self.panels().iter().map(|panel| figures(panel).map(Figure::left_out).sum::<usize>()).max();
        if let Some(rest) = shapes.filter(|rest| *rest > 0) {
            subtitle += &format!(" ({rest} shapes too many are left out)");
        }
        let legend = self.paint_legend(canvas);
        paint_head(canvas, &self.strip.title, &subtitle, self.unit, legend);
        let mut painter = Painter::default();
        for (index, panel) in self.panels().iter().enumerate() {
            let (x, y) = self.corner(index);
            let picture = self.paint_panel(panel, &mut painter)?;
            canvas.paste(x as usize, y as usize, &picture);
            self.paint_words(canvas, panel, x, y + self.panel_height);
        }
        if self.panels().is_empty() {
            let font = Type::plain(16.0 * self.unit, INK_SOFT);
            let spot = (MARGIN * self.unit, self.head + 24.0 * self.unit);
            canvas.text(spot, Anchor::Start, font, "no panels");
        }
        Ok(sheet)
    }

    fn paint_panel(&self, panel: &Panel, painter: &mut Painter) -> Result<Canvas, Error> {
        let unit = self.unit;
        let mut canvas = Canvas::new(self.panel_width as u32, self.panel_height as u32, SKY)?;
        self.shot.paint(&mut canvas, panel, painter, self.ruler);
        canvas.rect(0.0, self.ruler, self.panel_width, self.panel_height - self.ruler, Colour::hex(0xFFFFFF));
        floor::ruler(&mut canvas, &self.shot.lens(panel), self.ruler, unit);
        self.shot.paint_marks(&mut canvas, panel);
        let pushed = arrows(panel).next().is_some();
        let (line, colour) = if pushed { (2.0 * unit, ARROW) } else { (1.0, HAIRLINE) };
        canvas.frame(0.0, 0.0, self.panel_width, self.panel_height, line.max(1.0).round(), colour);
        Ok(canvas)
    }

    fn paint_words(&self, canvas: &mut Canvas, panel: &Panel, left: f32, top: f32) {
        let unit = self.unit;
        if panel.time_secs.is_finite() {
            let time = format!("{:.2} s", panel.time_secs.clamp(-1e9, 1e9)).replace('-', "−");
            let font = Type::strong(16.0 * unit, INK);
            canvas.text((left + 1.0, top + 21.0 * unit), Anchor::Start, font, &font.fit(&time, self.panel_width));
        }
        let font = Type::plain(14.0 * unit, INK_SOFT);
        let (first, second) = font.in_two_lines(panel.caption.trim(), self.panel_width);
        canvas.text((left + 1.0, top + 40.0 * unit), Anchor::Start, font, &first);
        canvas.text((left + 1.0, top + 58.0 * unit), Anchor::Start, font, &second);
    }

    /// The legend at the upper right; returns its left end.
    fn paint_legend(&self, canvas: &mut Canvas) -> f32 {
        let unit = self.unit;
        let font = Type::plain(14.0 * unit, INK_SOFT);
        let ghost = self.panels().iter().any(|panel| panel.ghost.is_some());
        let has = |shade: Shade| shades(self.panels()).any(|found| found == shade);
        let mut rows: Vec<(&str, Colour)> = Vec::new();
        if has(Shade::Left) {
            rows.push(("its left", Shade::Left.colour()));
        }
        if has(Shade::Right) {
            rows.push(("its right", Shade::Right.colour()));
        }
        let name = font.fit(self.strip.style.ghost_name.trim(), 300.0 * unit);
        if ghost && !name.is_empty() {
            rows.push((&name, Colour::hex(0xC6CDD8)));
        }
        let mut right = canvas.width() - MARGIN * unit;
        let y = if self.strip.title.trim().is_empty() { 24.0 } else { 42.0 } * unit;
        for (name, colour) in rows.into_iter().rev() {
            right -= font.width(name);
            canvas.text((right, y), Anchor::Start, font, name);
            right -= 14.0 * unit;
            let centre = (right, y - 5.0 * unit);
            canvas.disc(centre, 7.0 * unit, EDGE.with_alpha(170));
            canvas.disc(centre, 6.0 * unit, colour);
            right -= 28.0 * unit;
        }
        right
    }
}

/// Height of title, subtitle and legend \[px\].
pub(crate) fn head_height(title: &str, subtitle: &str, legend: bool, unit: f32) -> f32 {
    let title = if title.trim().is_empty() { if legend { 26.0 } else { 0.0 } } else { 34.0 };
    let subtitle = if subtitle.trim().is_empty() { 0.0 } else { 24.0 };
    ((16.0 + title + subtitle + 8.0) * unit).ceil()
}

/// Writes title and subtitle, left of `right`.
pub(crate) fn paint_head(canvas: &mut Canvas, title: &str, subtitle: &str, unit: f32, right: f32) {
    let left = MARGIN * unit;
    let mut y = 16.0 * unit;
    if !title.trim().is_empty() {
        let font = Type::strong(24.0 * unit, INK);
        canvas.text((left, y + 26.0 * unit), Anchor::Start, font, &font.fit(title.trim(), right - left));
        y += 34.0 * unit;
    }
    let font = Type::plain(16.0 * unit, INK_SOFT);
    let room = canvas.width() - 2.0 * left;
    canvas.text((left, y + 17.0 * unit), Anchor::Start, font, &font.fit(subtitle.trim(), room));
}

fn shades(panels: &[Panel]) -> impl Iterator<Item = Shade> + '_ {
    panels.iter().flat_map(|panel| panel.figure.drawable().map(|capsule| capsule.shade))
}

fn has_legend(panels: &[Panel]) -> bool {
    panels.iter().any(|panel| panel.ghost.is_some())
        || shades(panels).any(|shade| matches!(shade, Shade::Left | Shade::Right))
}
