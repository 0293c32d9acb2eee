//! Layout and painting of a plot.

use crate::canvas::{Canvas, Spot};
use crate::colour::{ARROW, HAIRLINE, INK, INK_SOFT, PAPER};
use crate::limits::{MAX_MARKS, MAX_PLOT_VALUE, MAX_SERIES};
use crate::strip::head_height;
use crate::text::{Anchor, Type};
use crate::ticks::{Ticks, widened};
use crate::{Colour, Error, Limit, Mark, PALETTE, Plot, Series};

/// Dashes \[units\]: lines stay apart where colours do not, as in a photocopy.
const DASHES: [&[f32]; 5] = [&[], &[9.0, 4.0], &[2.6, 3.2], &[12.0, 4.0, 2.6, 4.0], &[18.0, 5.0]];
const LINE: f32 = 2.4;
const LEGEND_ROW: f32 = 23.0;

/// Sizes of a plot, in pixels unless said otherwise.
pub(crate) struct Chart<'a> {
    plot: &'a Plot,
    unit: f32,
    width: f32,
    height: f32,
    /// Left, top, right, bottom of the field.
    field: [f32; 4],
    x: (f64, f64),
    y: (f64, f64),
    x_ticks: Ticks,
    y_ticks: Ticks,
    /// Lines in the order of the legend: index and peak.
    order: Vec<(usize, Option<f64>)>,
    /// Row of each mark's label above the field.
    mark_rows: Vec<(&'a Mark, usize)>,
}

impl<'a> Chart<'a> {
    pub fn new(plot: &'a Plot, width: f32) -> Chart<'a> {
        let unit = width / 1800.0;
        let aspect = if plot.aspect.is_finite() { plot.aspect.clamp(0.1, 2.0) as f32 } else { 0.24 };
        let series = &plot.series[..plot.series.len().min(MAX_SERIES)];
        let mut order: Vec<(usize, Option<f64>)> = series.iter().map(peak).enumerate().collect();
        order.sort_by(|a, b| {
            b.1.map(f64::abs).partial_cmp(&a.1.map(f64::abs)).unwrap_or(std::cmp::Ordering::Equal).then(a.0.cmp(&b.0))
        });

        let (x, y) = (x_span(plot), y_span(plot));
        let rows = order.len() + usize::from(plot.series.len() > series.len());
        let head = head_height(&plot.title, "", false, unit);
        let height = (aspect * width).max(head + (rows as f32 * LEGEND_ROW + 70.0) * unit);
        let bottom = height - if plot.x_label.trim().is_empty() { 40.0 } else { 62.0 } * unit;

        let y_ticks = Ticks::within(y.0, y.1, f64::from((bottom - head) / (52.0 * unit)));
        let font = Type::plain(14.0 * unit, INK_SOFT);
        let widest = y_ticks.values().map(|value| font.width(&y_ticks.label(value))).fold(0.0, f32::max);
        let left = (if plot.y_label.trim().is_empty() { 24.0 } else { 52.0 } * unit + widest + 10.0 * unit).ceil();
        let names = series.iter().map(|series| font.width(&font.fit(&series.name, 230.0 * unit)));
        let legend = if series.is_empty() { 0.0 } else { names.fold(0.0, f32::max) + 170.0 * unit };
        let right = (width - 24.0 * unit - legend).floor();
        let x_ticks = Ticks::within(x.0, x.1, f64::from((right - left) / (120.0 * unit)));

        let mut chart = Chart {
            plot,
            unit,
            width,
            height,
            field: [left, head, right, bottom.floor()],
            x,
            y,
            x_ticks,
            y_ticks,
            order,
            mark_rows: Vec::new(),
        };
        chart.place_marks();
        chart
    }

    pub fn height(&self) -> f32 {
        self.height.ceil()
    }

    /// Position of a value in the picture.
    pub fn spot(&self, x: f64, y: f64) -> Spot {
        let [left, top, right, bottom] = self.field;
        let across = ((x - self.x.0) / (self.x.1 - self.x.0)).clamp(-50.0, 50.0) as f32;
        let up = ((y - self.y.0) / (self.y.1 - self.y.0)).clamp(-50.0, 50.0) as f32;
        (left + across * (right - left), bottom + up * (top - bottom))
    }

    /// Gives each mark's label a row above the field where it meets no other, and lowers the field under them.
    fn place_marks(&mut self) {
        let font = Type::strong(13.0 * self.unit, ARROW);
        let mut ends: Vec<f32> = Vec::new();
        for mark in self.plot.marks.iter().take(MAX_MARKS) {
            let inside = mark.from_secs.is_finite() && mark.to_secs.is_finite() && mark.from_secs <= mark.to_secs;
            if !inside || mark.to_secs < self.x.0 || mark.from_secs > self.x.1 {
                continue;
            }
            let start = self.mark_ends(mark).0;
            let row = ends.iter().position(|&end| end < start).unwrap_or(ends.len());
            let end = start + font.width(&mark.label) + 12.0 * self.unit;
            if row < ends.len() {
                ends[row] = end
            } else if row < 4 {
                ends.push(end)
            }
            self.mark_rows.push((mark, row));
        }
        self.field[1] += 18.0 * self.unit * ends.len() as f32 + 4.0 * self.unit;
    }

    fn mark_ends(&self, mark: &Mark) -> (f32, f32) {
        let [left, _, right, _] = self.field;
        let clip = |x: f64| self.spot(x, self.y.0).0.clamp(left, right.max(left));
        (clip(mark.from_secs), clip(mark.to_secs))
    }

    pub fn draw(&self) -> Result<Canvas, Error> {
        let mut sheet = Canvas::new(self.width as u32, self.height() as u32, PAPER)?;
        let canvas = &mut sheet;
        let font = Type::strong(19.0 * self.unit, INK);
        let title = font.fit(self.plot.title.trim(), self.width - 48.0 * self.unit);
        canvas.text((24.0 * self.unit, 34.0 * self.unit), Anchor::Start, font, &title);
        self.paint_grid(canvas);
        self.paint_marks(canvas);
        self.paint_limits(canvas);
        // The smallest peaks first: the line that matters most lies on top.
        for &(index, _) in self.order.iter().rev() {
            self.paint_series(canvas, index);
        }
        self.paint_limit_names(canvas);
        self.paint_legend(canvas);
        Ok(sheet)
    }

    fn paint_grid(&self, canvas: &mut Canvas) {
        let unit = self.unit;
        let [left, top, right, bottom] = self.field;
        let hair = unit.max(1.0).round();
        let font = Type::plain(14.0 * unit, INK_SOFT);
        for value in self.y_ticks.values() {
            let y = (self.spot(self.x.0, value).1).round();
            let axis = value.abs() < self.y_ticks.step() * 1e-6;
            canvas.rect(left, y, right - left, hair, if axis { INK_SOFT } else { HAIRLINE });
            canvas.text((left - 9.0 * unit, y + 5.0 * unit), Anchor::End, font, &self.y_ticks.label(value));
        }
        for value in self.x_ticks.values() {
            let x = self.spot(value, self.y.0).0.round();
            canvas.rect(x, top, hair, bottom - top, HAIRLINE);
            canvas.rect(x, bottom, hair, 5.0 * unit, INK_SOFT);
            canvas.text((x, bottom + 21.0 * unit), Anchor::Middle, font, &self.x_ticks.label(value));
        }
        canvas.rect(left, bottom, right - left, hair, INK_SOFT);
        let name = Type::plain(15.0 * unit, INK);
        let label = name.fit(self.plot.x_label.trim(), right - left);
        canvas.text(((left + right) / 2.0, bottom + 45.0 * unit), Anchor::Middle, name, &label);
        let label = name.fit(self.plot.y_label.trim(), bottom - top + 30.0 * unit);
        canvas.text_upwards((38.0 * unit, (top + bottom) / 2.0), Anchor::Middle, name, &label);
    }

    fn paint_marks(&self, canvas: &mut Canvas) {
        let unit = self.unit;
        let font = Type::strong(13.0 * unit, ARROW);
        let (top, bottom) = (self.field[1], self.field[3]);
        for &(mark, row) in &self.mark_rows {
            let (start, end) = self.mark_ends(mark);
            canvas.rect(start, top, (end - start).max(unit), bottom - top, ARROW.with_alpha(34));
            if row < 4 {
                let y = top - 6.0 * unit - 18.0 * unit * row as f32;
                let room = (self.width - start - 8.0 * unit).max(0.0);
                canvas.text((start, y), Anchor::Start, font, &font.fit(mark.label.trim(), room));
            }
        }
    }

    fn paint_limits(&self, canvas: &mut Canvas) {
        let unit = self.unit;
        let [left, _, right, _] = self.field;
        for limit in limits(self.plot) {
            let y = self.spot(self.x.0, limit.value).1;
            let dash = [6.0 * unit, 5.0 * unit];
            canvas.polyline(&[(left, y), (right, y)], 1.4 * unit, INK_SOFT, &dash);
        }
    }

    /// Over the lines, so that none runs through the words.
    fn paint_limit_names(&self, canvas: &mut Canvas) {
        let unit = self.unit;
        let [left, _, right, _] = self.field;
        let font = Type::plain(13.0 * unit, INK_SOFT);
        for limit in limits(self.plot) {
            let y = self.spot(self.x.0, limit.value).1;
            let label = font.fit(limit.label.trim(), (right - left) / 2.0);
            canvas.text_with_rim((right - 6.0 * unit, y - 6.0 * unit), Anchor::End, font, PAPER, &label);
        }
    }

    fn paint_series(&self, canvas: &mut Canvas, index: usize) {
        for run in self.runs(&self.plot.series[index]) {
            if let [only] = run[..] {
                canvas.disc(only, LINE * self.unit, colour(self.plot, index));
            } else {
                canvas.polyline(&run, LINE * self.unit, colour(self.plot, index), &self.dash(index));
            }
        }
    }

    /// The unbroken stretches of a line, decimated to what its pixels can show: of those within half a pixel column the
    /// first, lowest, highest and last are kept.
    fn runs(&self, series: &Series) -> Vec<Vec<Spot>> {
        let mut runs: Vec<Vec<Spot>> = Vec::new();
        for stretch in series.points.split(|&point| !is_plottable(point)) {
            let mut run: Vec<Spot> = Vec::new();
            let mut bin: Vec<Spot> = Vec::new();
            for &(x, y) in stretch {
                let spot = self.spot(x, y);
                if bin.first().is_some_and(|first| (first.0 * 2.0).floor() != (spot.0 * 2.0).floor()) {
                    run.append(&mut bin);
                }
                if bin.len() < 4 {
                    bin.push(spot);
                } else {
                    let inner = [bin[1], bin[2], bin[3]];
                    let low = inner.iter().copied().fold(bin[3], |low, spot| if spot.1 > low.1 { spot } else { low });
                    let high =
                        inner.iter().copied().fold(bin[3], |high, spot| if spot.1 < high.1 { spot } else { high });
                    (bin[1], bin[2], bin[3]) = (low, high, spot);
                }
            }
            run.append(&mut bin);
            if !run.is_empty() {
                runs.push(run);
            }
        }
        runs
    }

    fn dash(&self, index: usize) -> Vec<f32> {
        DASHES[index % DASHES.len()].iter().map(|length| length * self.unit).collect()
    }

    fn paint_legend(&self, canvas: &mut Canvas) {
        let unit = self.unit;
        let font = Type::plain(14.0 * unit, INK);
        let soft = Type::plain(14.0 * unit, INK_SOFT);
        let left = self.field[2] + 18.0 * unit;
        let right = self.width - 24.0 * unit;
        let mut y = self.field[1] + 14.0 * unit;
        if !self.order.is_empty() {
            canvas.text((right, y - 20.0 * unit), Anchor::End, Type::plain(12.0 * unit, INK_SOFT), "peak");
        }
        let largest = self.order.iter().filter_map(|(_, peak)| *peak).map(f64::abs).fold(0.0, f64::max);
        for &(index, peak) in &self.order {
            let line = [(left, y - 5.0 * unit), (left + 38.0 * unit, y - 5.0 * unit)];
            canvas.polyline(&line, LINE * unit, colour(self.plot, index), &self.dash(index));
            let name = font.fit(&self.plot.series[index].name, 230.0 * unit);
            canvas.text((left + 46.0 * unit, y), Anchor::Start, font, &name);
            // What is nothing beside the rest is a rounding error.
            let digits = |peak: f64| if peak.abs() < largest * 1e-6 { 0.0 } else { peak };
            let peak = peak.map_or("no data".to_owned(), |peak| three_digits(digits(peak)) + &self.plot.unit);
            canvas.text((right, y), Anchor::End, soft, &peak);
            y += LEGEND_ROW * unit;
        }
        let rest = self.plot.series.len() - self.order.len();
        if rest > 0 {
            canvas.text((left + 46.0 * unit, y), Anchor::Start, soft, &format!("{rest} more left out"));
        }
    }
}

fn colour(plot: &Plot, index: usize) -> Colour {
    plot.series[index].colour.unwrap_or(PALETTE[index % PALETTE.len()])
}

fn is_plottable(point: (f64, f64)) -> bool {
    let fits = |value: f64| value.is_finite() && value.abs() <= MAX_PLOT_VALUE;
    fits(point.0) && fits(point.1)
}

fn points(plot: &Plot) -> impl Iterator<Item = (f64, f64)> + '_ {
    let series = plot.series.iter().take(MAX_SERIES);
    series.flat_map(|series| series.points.iter().copied()).filter(|&point| is_plottable(point))
}

fn limits(plot: &Plot) -> impl Iterator<Item = &Limit> {
    plot.limits.iter().take(MAX_MARKS).filter(|limit| is_plottable((0.0, limit.value)))
}

/// The value farthest from zero.
fn peak(series: &Series) -> Option<f64> {
    let values = series.points.iter().copied().filter(|&point| is_plottable(point)).map(|point| point.1);
    values.fold(None, |peak, value| match peak {
        Some(peak) if f64::abs(peak) >= value.abs() => Some(peak),
        _ => Some(value),
    })
}

fn three_digits(value: f64) -> String {
    let text = match value.abs() {
        0.0 => "0".to_owned(),
        size if !(1e-3..1e6).contains(&size) => format!("{value:.1e}"),
        size if size < 1.0 => format!("{value:.3}"),
        size if size < 10.0 => format!("{value:.2}"),
        size if size < 100.0 => format!("{value:.1}"),
        _ => format!("{value:.0}"),
    };
    text.replace('-', "−")
}

fn span(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)))
}

fn x_span(plot: &Plot) -> (f64, f64) {
    let (low, high) = span(points(plot).map(|point| point.0));
    widened(low, high)
}

/// Range of the data and the limit lines, extended to zero if it is near, with a margin.
fn y_span(plot: &Plot) -> (f64, f64) {
    let (low, high) = span(points(plot).map(|point| point.1).chain(limits(plot).map(|limit| limit.value)));
    let (mut low, mut high) = widened(low, high);
    let size = high - low;
    let air = size * 0.06;
    if low >= 0.0 && low < size {
        low = 0.0;
        high += air;
    } else if high <= 0.0 && -high < size {
        high = 0.0;
        low -= air;
    } else {
        (low, high) = (low - air, high + air);
    }
    (low, high)
}
