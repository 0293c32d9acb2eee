//! Filmstrips: motion as a row of frames.

use glam::DVec3;

use crate::arrow::Arrow;
use crate::limits::{MAX_WIDTH_PX, MIN_WIDTH_PX};
use crate::{Camera, Error, Figure, Hit, Image, strip};

/// One moment of a motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Panel {
    /// Its time \[s\]; written under the panel if finite.
    pub time_secs: f64,
    /// The body, or all bodies; the whole of it is in the picture.
    pub figure: Figure,
    /// Things around it. One far from every body may leave the picture, so that bodies stay large.
    pub objects: Figure,
    /// The ghost that it is compared with, as a rule the input motion: drawn pale, behind the body.
    pub ghost: Option<Figure>,
    /// Forces at this moment.
    pub arrows: Vec<Arrow>,
    /// Impacts at this moment.
    pub hits: Vec<Hit>,
    /// The point that the panel keeps in its middle \[m\], world, as a rule the pelvis; only its horizontal position
    /// counts. `None` takes the middle of the figure, which sways with the arms.
    pub follow: Option<DVec3>,
    /// A caption under the time, two lines at most; may be empty.
    pub caption: String,
}

/// Layout of a filmstrip.
#[derive(Clone, Debug, PartialEq)]
pub struct Style {
    /// Width of the picture \[px\], [`MIN_WIDTH_PX`] to [`MAX_WIDTH_PX`]; text and lines scale with it. Default 1800.
    pub width_px: u32,
    /// Maximum number of panels in a row; more wrap into rows of equal length. There are fewer where a body would be lower
    /// than 240 px (of a picture 1800 px wide). Default 8.
    pub columns: usize,
    /// Height of a standing body \[m\]. Default 1.7.
    pub body_height_m: f64,
    /// Height of the floor \[m\], world. Default 0.
    pub floor_m: f64,
    /// Name of the ghost, for the legend. Default "input motion".
    pub ghost_name: String,
}

impl Default for Style {
    fn default() -> Style {
        Style { width_px: 1800, columns: 8, body_height_m: 1.7, floor_m: 0.0, ghost_name: "input motion".to_owned() }
    }
}

/// Moments of a motion side by side, all at one scale. Each panel follows the body, over a floor fixed to the world.
///
/// ```
/// use glam::DVec3;
/// use sinew_picture::{Capsule, Figure, Filmstrip, Panel, Shade};
///
/// let panels = (0..4).map(|step| {
///     let hips = DVec3::new(0.0, 1.0, 0.3 * f64::from(step));
///     let trunk = Capsule::tapered(hips, hips + DVec3::Y * 0.5, 0.13, 0.16, Shade::Midline);
///     Panel { time_secs: 0.25 * f64::from(step), figure: Figure::new(vec![trunk]), ..Panel::default() }
/// });
/// let strip = Filmstrip { title: "A trunk, gliding".to_owned(), panels: panels.collect(), ..Filmstrip::default() };
/// let png = strip.to_png()?;
/// assert_eq!(&png[1..4], b"PNG");
/// # Ok::<(), sinew_picture::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Filmstrip {
    /// The headline; may be empty.
    pub title: String,
    /// A line under the headline; may be empty.
    pub subtitle: String,
    /// The moments, in the order of reading; at most [`MAX_PANELS`](crate::limits::MAX_PANELS) are drawn.
    pub panels: Vec<Panel>,
    /// The camera, the same for all panels.
    pub camera: Camera,
    /// Its layout.
    pub style: Style,
}

impl Filmstrip {
    /// Draws the picture.
    ///
    /// # Errors
    /// Out of memory.
    pub fn draw(&self) -> Result<Image, Error> {
        let width = self.style.width_px.clamp(MIN_WIDTH_PX, MAX_WIDTH_PX);
        Ok(Image(strip::Layout::new(self, width as f32).draw()?.pixmap))
    }

    /// Draws the picture as the bytes of a PNG file.
    ///
    /// # Errors
    /// Out of memory, or the encoder fails.
    pub fn to_png(&self) -> Result<Vec<u8>, Error> {
        self.draw()?.to_png()
    }

    /// Position of a point of the world in panel `index` of the drawn picture \[px\], x right, y down; `None` for a
    /// panel that is not drawn or a point that is not finite. The point may lie outside the panel.
    pub fn spot(&self, index: usize, point: DVec3) -> Option<(f32, f32)> {
        let width = self.style.width_px.clamp(MIN_WIDTH_PX, MAX_WIDTH_PX);
        strip::Layout::new(self, width as f32).spot(index, point)
    }
}
