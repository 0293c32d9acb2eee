//! Moving pictures.

use crate::animation::{self, Frames};
use crate::body::Painter;
use crate::canvas::Canvas;
use crate::colour::{INK, INK_SOFT, PAPER};
use crate::limits::{MAX_MOVIE_FRAMES, MAX_WIDTH_PX};
use crate::shot::{SKY, Shot};
use crate::text::{Anchor, Type};
use crate::{Camera, Error, Image, Panel};

/// Layout of a movie.
#[derive(Clone, Debug, PartialEq)]
pub struct MovieStyle {
    /// Width of a frame \[px\], 64 to [`MAX_WIDTH_PX`]; odd ones become even, as video codecs need it. Default 480.
    pub width_px: u32,
    /// Height of a frame \[px\], likewise. Text grows with it. Default 360.
    pub height_px: u32,
    /// Height of the floor \[m\], world. Default 0.
    pub floor_m: f64,
}

impl Default for MovieStyle {
    fn default() -> MovieStyle {
        MovieStyle { width_px: 480, height_px: 360, floor_m: 0.0 }
    }
}

/// A motion as moving pictures, 25 a second ([`Movie::FRAMES_PER_SEC`]): one panel is one frame, and all have one scale.
///
/// GIF and APNG loop for ever. Both have one palette of 127 colours for all frames and no dithering; the frames of
/// [`Movie::frame`] have all colours.
///
/// ```
/// use glam::DVec3;
/// use sinew_picture::{Capsule, Figure, Movie, Panel, Shade};
/// let panels = (0..3).map(|step| {
///     let ball = Capsule::ball(DVec3::new(0.0, 0.5 + 0.1 * f64::from(step), 0.0), 0.2, Shade::Object);
///     Panel { time_secs: f64::from(step) / 25.0, figure: Figure::new(vec![ball]), ..Panel::default() }
/// });
/// let movie = Movie { title: "A ball, rising".to_owned(), panels: panels.collect(), ..Movie::default() };
/// assert!(movie.to_gif()?.starts_with(b"GIF89a"));
/// # Ok::<(), sinew_picture::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Movie {
    /// The headline; may be empty.
    pub title: String,
    /// The frames, at most [`MAX_MOVIE_FRAMES`](crate::limits::MAX_MOVIE_FRAMES). Their captions stand below the headline.
    pub panels: Vec<Panel>,
    /// The camera, the same for all frames.
    pub camera: Camera,
    /// Its layout.
    pub style: MovieStyle,
}

/// Sizes of text follow the height: at this one a unit is a pixel.
const UNIT_HEIGHT_PX: f32 = 360.0;
/// Above the body for text, beside it, and below the floor's near edge \[units\].
const HEAD: f32 = 46.0;
const PAD: f32 = 10.0;
/// Steps of light on a body.
const LIGHT_STEPS: f32 = 6.0;

impl Movie {
    /// Frames a second \[Hz\]. GIF counts hundredths of a second, so that of common rates only 20, 25 and 50 play at their true
    /// pace.
    pub const FRAMES_PER_SEC: u32 = 25;

    /// How many frames show so many seconds: one each 1/25 s, at least one.
    pub fn frames_in(secs: f64) -> usize {
        let frames = (secs * f64::from(Movie::FRAMES_PER_SEC)).round();
        if frames.is_finite() { frames.clamp(1.0, 1e9) as usize } else { 1 }
    }

    /// Width and height of a frame \[px\].
    pub fn size_px(&self) -> (u32, u32) {
        let even = |size: u32| size.clamp(64, MAX_WIDTH_PX) / 2 * 2;
        (even(self.style.width_px), even(self.style.height_px))
    }

    /// The drawing of single frames.
    fn reel(&self) -> Reel<'_> {
        let (width, height) = self.size_px();
        let unit = height as f32 / UNIT_HEIGHT_PX;
        let mut shot = Shot::new(self.camera, self.style.floor_m, &self.panels, unit);
        let across = f64::from(width as f32 - 2.0 * PAD * unit) / shot.extent.width_m();
        let upright = f64::from(height as f32 - (HEAD + PAD) * unit) / shot.extent.height_m();
        let scale = across.min(upright).max(1.0);
        let below = (shot.extent.below_m * scale) as f32 + PAD * unit;
        shot.steps = Some(LIGHT_STEPS);
        shot.look_at(width as f32, scale, HEAD * unit);
        shot.at.1 = (height as f32 - below).round();
        Reel { movie: self, shot, unit }
    }

    /// One frame; a blank one where there is no panel.
    ///
    /// # Errors
    /// Out of memory.
    pub fn frame(&self, index: usize) -> Result<Image, Error> {
        self.reel().frame(index)
    }

    /// The bytes of an animated GIF.
    ///
    /// # Errors
    /// Too many frames, out of memory, or the encoder fails.
    pub fn to_gif(&self) -> Result<Vec<u8>, Error> {
        animation::gif(&self.checked()?)
    }

    /// The bytes of an animated PNG: a PNG that shows its first frame where animation is not understood.
    ///
    /// # Errors
    /// As [`Movie::to_gif`].
    pub fn to_apng(&self) -> Result<Vec<u8>, Error> {
        animation::apng(&self.checked()?)
    }

    /// Calls `each` with every frame in turn, until it fails.
    ///
    /// # Errors
    /// Too many frames, out of memory, or what `each` says.
    pub fn each_frame<E: From<Error>>(&self, mut each: impl FnMut(&Image) -> Result<(), E>) -> Result<(), E> {
        let reel = self.checked()?;
        (0..reel.count()).try_for_each(|index| each(&reel.frame(index)?))
    }

    fn checked(&self) -> Result<Reel<'_>, Error> {
        if self.panels.len() > MAX_MOVIE_FRAMES {
            return Err(Error::TooLong { frames: self.panels.len() });
        }
        Ok(self.reel())
    }
}

/// A movie with its view.
struct Reel<'a> {
    movie: &'a Movie,
    shot: Shot,
    unit: f32,
}

impl Frames for Reel<'_> {
    fn size_px(&self) -> (u32, u32) {
        self.movie.size_px()
    }

    fn count(&self) -> usize {
        self.movie.panels.len().max(1)
    }

    fn frame(&self, index: usize) -> Result<Image, Error> {
        let (width, height) = self.movie.size_px();
        let mut canvas = Canvas::new(width, height, SKY)?;
        if let Some(panel) = self.movie.panels.get(index) {
            self.shot.paint(&mut canvas, panel, &mut Painter::default(), height as f32);
            self.shot.paint_marks(&mut canvas, panel);
            self.paint_words(&mut canvas, panel);
        }
        Ok(Image(canvas.pixmap))
    }
}

impl Reel<'_> {
    fn paint_words(&self, canvas: &mut Canvas, panel: &Panel) {
        let unit = self.unit;
        let (left, right) = (10.0 * unit, canvas.width() - 10.0 * unit);
        let font = Type::strong(15.0 * unit, INK);
        if panel.time_secs.is_finite() {
            let time = format!("{:.1} s", panel.time_secs.clamp(-1e9, 1e9)).replace('-', "−");
            canvas.text_with_rim((right - font.width("00.0 s"), 20.0 * unit), Anchor::Start, font, PAPER, &time);
        }
        let room = right - left - font.width("00.0 s") - 12.0 * unit;
        canvas.text_with_rim((left, 20.0 * unit), Anchor::Start, font, PAPER, &font.fit(self.movie.title.trim(), room));
        let soft = Type::plain(13.0 * unit, INK_SOFT);
        let caption = soft.fit(panel.caption.trim(), right - left);
        canvas.text_with_rim((left, 37.0 * unit), Anchor::Start, soft, PAPER, &caption);
    }
}
