//! Layout and painting of a filmstrip.

use glam::DVec3;

use crate::arrow::Arrow;
use crate::body::{Floor, Look, Painter};
use crate::canvas::{Canvas, Spot};
use crate::colour::{ARROW, HAIRLINE, INK, INK_SOFT, PAPER};
use crate::figure::is_drawable;
use crate::lens::Lens;
use crate::limits::{MAX_ARROWS, MAX_COLUMNS, MAX_COORDINATE_M, MAX_PANELS, MAX_VIEW_M};
use crate::text::{Anchor, Type};
use crate::{Colour, Error, Figure, Filmstrip, Panel, Shade, View, floor};

const GHOST: Colour = Colour::hex(0x7B8AA3);
const SKY: Colour = Colour::hex(0xF7F9FB);
const EDGE: Colour = Colour::hex(0x222A36);
/// Space between panels \[units\].
const GAP: f32 = 8.0;
const MARGIN: f32 = 24.0;

/// Sizes of a filmstrip, in pixels unless said otherwise.
pub(crate) struct Layout<'a> {
    strip: &'a Filmstrip,
    view: View,
    floor_m: f64,
    /// Pixels per unit: a picture 1800 px wide has 1.
    unit: f32,
    width: f32,
    columns: usize,
    left: f32,
    head: f32,
    panel_width: f32,
    panel_height: f32,
    row_height: f32,
    /// Pixels per metre.
    scale: f64,
    /// Position of the followed point on the floor in a panel.
    at: Spot,
    /// Top of the ruler in a panel.
    ruler: f32,
    strongest_n: f64,
}

impl<'a> Layout<'a> {
    pub fn new(strip: &'a Filmstrip, width: f32) -> Layout<'a> {
        let unit = width / 1800.0;
        let view = strip.camera.view();
        let floor_m = strip.style.floor_m;
        let floor_m = if floor_m.is_finite() { floor_m.clamp(-MAX_COORDINATE_M, MAX_COORDINATE_M) } else { 0.0 };
        let panels = &strip.panels[..strip.panels.len().min(MAX_PANELS)];
        // Rows of equal length: nine panels read better as five and four than as eight and one.
        let most = strip.style.columns.clamp(1, MAX_COLUMNS);
        let rows = panels.len().div_ceil(most).max(1);
        let columns = panels.len().div_ceil(rows).max(1);
        let room = width - (2.0 * MARGIN + (columns - 1) as f32 * GAP) * unit;
        let panel_width = (room / columns as f32).min(460.0 * unit).floor().max(24.0);
        let used = panel_width * columns as f32 + (columns - 1) as f32 * GAP * unit;

        let strongest_n = panels.iter().flat_map(arrows).map(|arrow| arrow.force_n.length()).fold(0.0, f64::max);
        let reach = Reach::of(panels, &view, floor_m, strongest_n);
        let tallest = f64::from((panel_width * 2.1).min(760.0 * unit));
        let pad = f64::from(14.0 * unit);
        let scale = ((f64::from(panel_width) - pad) / (2.0 * reach.side_m))
            .min((tallest - pad) / (reach.above_m + reach.below_m))
            .max(1.0);
        let below = (reach.below_m * scale) as f32;
        let above = (reach.above_m * scale) as f32 + pad as f32;
        let ruler = (above + below).ceil();
        let panel_height = (ruler + 24.0 * unit).ceil();
        let captions = panels.iter().any(|panel| !panel.caption.trim().is_empty());
        let under = if captions { 56.0 } else { 36.0 };
        Layout {
            strip,
            view,
            floor_m,
            unit,
            width,
            columns,
            left: ((width - used) / 2.0).floor(),
            head: head_height(&strip.title, &strip.subtitle, has_legend(panels), unit),
            panel_width,
            panel_height,
            row_height: panel_height + (under + GAP) * unit,
            scale,
            at: (panel_width / 2.0, above),
            ruler,
            strongest_n,
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

    fn lens(&self, panel: &Panel) -> Lens {
        let origin = DVec3 { y: self.floor_m, ..followed(panel) };
        Lens { view: self.view, origin, scale: self.scale, at: self.at }
    }

    /// Position of a point of the world.
    pub fn spot(&self, index: usize, point: DVec3) -> Option<Spot> {
        let panel = self.panels().get(index).filter(|_| is_drawable(point))?;
        let (spot, corner) = (self.lens(panel).spot(point), self.corner(index));
        Some((spot.0 + corner.0, spot.1 + corner.1))
    }

    pub fn draw(&self) -> Result<Canvas, Error> {
        let mut sheet = Canvas::new(self.width as u32, self.height() as u32, PAPER)?;
        let canvas = &mut sheet;
        let subtitle = match self.strip.panels.len() - self.panels().len() {
            0 => self.strip.subtitle.clone(),
            rest => format!("{} (the last {rest} panels are left out)", self.strip.subtitle),
        };
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
        let lens = self.lens(panel);
        floor::paint(&mut canvas, &lens, &panel.figure, self.ruler);
        if let Some(ghost) = &panel.ghost {
            painter.paint(&mut canvas, &lens.solids(ghost), &self.ghost_look());
        }
        painter.paint(&mut canvas, &lens.solids(&panel.figure), &self.body_look());
        canvas.rect(0.0, self.ruler, self.panel_width, self.panel_height - self.ruler, Colour::hex(0xFFFFFF));
        floor::ruler(&mut canvas, &lens, self.ruler, unit);
        let mut taken: Vec<[f32; 4]> = arrows(panel).map(|arrow| arrow.tip_box(&lens, unit)).collect();
        for arrow in arrows(panel) {
            arrow.paint(&mut canvas, &lens, self.strongest_n, unit, &mut taken);
        }
        let pushed = arrows(panel).next().is_some();
        let (line, colour) = if pushed { (2.0 * unit, ARROW) } else { (1.0, HAIRLINE) };
        canvas.frame(0.0, 0.0, self.panel_width, self.panel_height, line.max(1.0).round(), colour);
        Ok(canvas)
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

    fn paint_words(&self, canvas: &mut Canvas, panel: &Panel, left: f32, top: f32) {
        let unit = self.unit;
        if panel.time_secs.is_finite() {
            let time = format!("{:.2} s", panel.time_secs.clamp(-1e9, 1e9)).replace('-', "−");
            let font = Type::strong(16.0 * unit, INK);
            canvas.text((left + 1.0, top + 21.0 * unit), Anchor::Start, font, &font.fit(&time, self.panel_width));
        }
        let font = Type::plain(14.0 * unit, INK_SOFT);
        let caption = font.fit(panel.caption.trim(), self.panel_width);
        canvas.text((left + 1.0, top + 40.0 * unit), Anchor::Start, font, &caption);
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

fn arrows(panel: &Panel) -> impl Iterator<Item = &Arrow> {
    panel.arrows.iter().take(MAX_ARROWS).filter(|arrow| arrow.is_drawable())
}

fn followed(panel: &Panel) -> DVec3 {
    let ghost = || panel.ghost.as_ref().and_then(Figure::middle);
    panel
        .follow
        .filter(|&point| is_drawable(point))
        .or_else(|| panel.figure.middle())
        .or_else(ghost)
        .unwrap_or_default()
}

/// Extent of all figures from the followed point, over all panels \[m\].
struct Reach {
    side_m: f64,
    above_m: f64,
    below_m: f64,
}

impl Reach {
    fn of(panels: &[Panel], view: &View, floor_m: f64, strongest_n: f64) -> Reach {
        let near = floor::near_drop_m(view.toward.y);
        let mut reach = Reach { side_m: 0.36, above_m: 0.5, below_m: near.max(0.02) };
        for panel in panels {
            let origin = DVec3 { y: floor_m, ..followed(panel) };
            let mut hold = |point: DVec3, radius_m: f64, most_m: f64| {
                let seen = view.view_from_world(point - origin);
                reach.side_m = reach.side_m.max((seen.x.abs() + radius_m).min(most_m));
                reach.above_m = reach.above_m.max((seen.y + radius_m).min(MAX_VIEW_M));
                reach.below_m = reach.below_m.max((radius_m - seen.y).min(MAX_VIEW_M / 4.0));
            };
            for capsule in panel.figure.drawable() {
                hold(capsule.from, capsule.radius_from_m, MAX_VIEW_M / 2.0);
                hold(capsule.to, capsule.radius_to_m, MAX_VIEW_M / 2.0);
            }
            for arrow in arrows(panel) {
                hold(arrow.at, 0.02, MAX_VIEW_M / 2.0);
                hold(arrow.tail(strongest_n), 0.06, MAX_VIEW_M / 2.0);
            }
            // A ghost far away may leave the panel, so that the body stays large.
            for capsule in panel.ghost.iter().flat_map(|ghost| ghost.drawable()) {
                hold(capsule.from, capsule.radius_from_m, 0.85);
                hold(capsule.to, capsule.radius_to_m, 0.85);
            }
        }
        reach
    }
}
