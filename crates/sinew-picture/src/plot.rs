//! Values over time.

use crate::limits::{MAX_WIDTH_PX, MIN_WIDTH_PX};
use crate::{Colour, Error, Image, chart};

/// One line of a plot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// Its name in the legend.
    pub name: String,
    /// (x, y) in the units of the axes, in the order of drawing. A point that is not finite breaks the line.
    pub points: Vec<(f64, f64)>,
    /// Its colour; `None` takes the next of [`PALETTE`](crate::PALETTE).
    pub colour: Option<Colour>,
}

impl Series {
    /// A line in the next colour of the palette.
    pub fn new(name: impl Into<String>, points: Vec<(f64, f64)>) -> Series {
        Series { name: name.into(), points, colour: None }
    }
}

/// A shaded interval, such as the time of a push.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mark {
    /// Where it begins \[s, or the unit of the x axis\].
    pub from_secs: f64,
    /// Where it ends \[s, or the unit of the x axis\].
    pub to_secs: f64,
    /// Its name, written above it; may be empty.
    pub label: String,
}

/// A limit line to compare with, such as the 2° within which a body counts as recovered.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Limit {
    /// The level, in the unit of the y axis.
    pub value: f64,
    /// Its name, written at its right end; may be empty.
    pub label: String,
}

/// Lines over time, with a legend that gives the maximum of each.
///
/// Lines differ by colour and by dashes. It is drawn with the same strokes as the filmstrip: of the plot libraries
/// `plotters` was tried, whose bitmap strokes are uneven when steep and jagged when thick, whose dashes are not in its
/// legend, and whose fonts live in a global table.
///
/// ```
/// use sinew_picture::{Mark, Plot, Series};
///
/// let wave = (0..100).map(|step| 0.02 * f64::from(step)).map(|time| (time, 20.0 * libm::sin(3.0 * time)));
/// let plot = Plot {
///     title: "Deflection".to_owned(),
///     x_label: "time (s)".to_owned(),
///     y_label: "deflection (°)".to_owned(),
///     unit: "°".to_owned(),
///     series: vec![Series::new("leftHand", wave.collect())],
///     marks: vec![Mark { from_secs: 0.5, to_secs: 0.6, label: "push".to_owned() }],
///     ..Plot::default()
/// };
/// assert_eq!(&plot.to_png()?[1..4], b"PNG");
/// # Ok::<(), sinew_picture::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// The headline; may be empty.
    pub title: String,
    /// Name and unit of the x axis; may be empty.
    pub x_label: String,
    /// Name and unit of the y axis; may be empty.
    pub y_label: String,
    /// Unit of the y axis as it is written behind a number, such as "°" or " m/s"; may be empty.
    pub unit: String,
    /// The lines, at most [`MAX_SERIES`](crate::limits::MAX_SERIES). The legend lists those with the larger peaks first.
    pub series: Vec<Series>,
    /// Shaded intervals.
    pub marks: Vec<Mark>,
    /// Levels to compare with.
    pub limits: Vec<Limit>,
    /// Width of the picture \[px\], [`MIN_WIDTH_PX`] to [`MAX_WIDTH_PX`]; text and lines scale with it. Default 1800.
    pub width_px: u32,
    /// Height over width, 0.1 to 2; more where a long legend needs it. Default 0.24.
    pub aspect: f64,
}

impl Default for Plot {
    fn default() -> Plot {
        Plot {
            title: String::new(),
            x_label: String::new(),
            y_label: String::new(),
            unit: String::new(),
            series: Vec::new(),
            marks: Vec::new(),
            limits: Vec::new(),
            width_px: 1800,
            aspect: 0.24,
        }
    }
}

impl Plot {
    /// Draws the picture.
    ///
    /// # Errors
    /// Out of memory.
    pub fn draw(&self) -> Result<Image, Error> {
        let width = self.width_px.clamp(MIN_WIDTH_PX, MAX_WIDTH_PX);
        Ok(Image(chart::Chart::new(self, width as f32).draw()?.pixmap))
    }

    /// Draws the picture as the bytes of a PNG file.
    ///
    /// # Errors
    /// Out of memory, or the encoder fails.
    pub fn to_png(&self) -> Result<Vec<u8>, Error> {
        self.draw()?.to_png()
    }

    /// Position of a value in the drawn picture \[px\], x right, y down.
    pub fn spot(&self, x: f64, y: f64) -> (f32, f32) {
        let width = self.width_px.clamp(MIN_WIDTH_PX, MAX_WIDTH_PX);
        chart::Chart::new(self, width as f32).spot(x, y)
    }
}
