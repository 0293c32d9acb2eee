//! Filmstrips and plots on one page.

use crate::canvas::Canvas;
use crate::chart::Chart;
use crate::colour::{HAIRLINE, INK_SOFT, PAPER};
use crate::limits::{MAX_HEIGHT_PX, MAX_PIECES, MAX_WIDTH_PX, MIN_WIDTH_PX};
use crate::strip::{self, paint_head};
use crate::text::{Anchor, Type};
use crate::{Error, Filmstrip, Image, Plot};

/// A part of a [`Sheet`].
#[derive(Clone, Debug, PartialEq)]
pub enum Piece {
    /// A filmstrip; the sheet sets its width.
    Filmstrip(Filmstrip),
    /// A plot; the sheet sets its width.
    Plot(Plot),
}

impl From<Filmstrip> for Piece {
    fn from(strip: Filmstrip) -> Piece {
        Piece::Filmstrip(strip)
    }
}

impl From<Plot> for Piece {
    fn from(plot: Plot) -> Piece {
        Piece::Plot(plot)
    }
}

/// Filmstrips and plots from top to bottom, with a headline and a last line.
///
/// ```
/// use sinew_picture::{Filmstrip, Plot, Sheet};
/// let sheet = Sheet {
///     title: "What the push did".to_owned(),
///     pieces: vec![Filmstrip::default().into(), Plot::default().into()],
///     ..Sheet::default()
/// };
/// assert_eq!(sheet.draw()?.width(), 1800);
/// # Ok::<(), sinew_picture::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// The headline; may be empty.
    pub title: String,
    /// A line under the headline; may be empty.
    pub subtitle: String,
    /// The pieces, top first; at most [`MAX_PIECES`] are drawn.
    pub pieces: Vec<Piece>,
    /// The last line, such as how the picture was made; may be empty.
    pub footer: String,
    /// Width of the picture \[px\], [`MIN_WIDTH_PX`] to [`MAX_WIDTH_PX`]; text and lines scale with it. Default 1800.
    pub width_px: u32,
}

impl Default for Sheet {
    fn default() -> Sheet {
        Sheet {
            title: String::new(),
            subtitle: String::new(),
            pieces: Vec::new(),
            footer: String::new(),
            width_px: 1800,
        }
    }
}

enum Laid<'a> {
    Strip(strip::Layout<'a>),
    Chart(Chart<'a>),
}

impl<'a> Laid<'a> {
    fn new(piece: &'a Piece, width: f32) -> Laid<'a> {
        match piece {
            Piece::Filmstrip(strip) => Laid::Strip(strip::Layout::new(strip, width)),
            Piece::Plot(plot) => Laid::Chart(Chart::new(plot, width)),
        }
    }

    fn height(&self) -> f32 {
        match self {
            Laid::Strip(strip) => strip.height(),
            Laid::Chart(chart) => chart.height(),
        }
    }

    fn draw(&self) -> Result<Canvas, Error> {
        match self {
            Laid::Strip(strip) => strip.draw(),
            Laid::Chart(chart) => chart.draw(),
        }
    }
}

impl Sheet {
    /// Draws the picture. Anything below [`MAX_HEIGHT_PX`] is cut off.
    ///
    /// # Errors
    /// Out of memory.
    pub fn draw(&self) -> Result<Image, Error> {
        let width = self.width_px.clamp(MIN_WIDTH_PX, MAX_WIDTH_PX);
        let unit = width as f32 / 1800.0;
        let laid: Vec<Laid> = self.pieces.iter().take(MAX_PIECES).map(|piece| Laid::new(piece, width as f32)).collect();
        let headed = !(self.title.trim().is_empty() && self.subtitle.trim().is_empty());
        let head = if headed { strip::head_height(&self.title, &self.subtitle, false, unit) } else { 0.0 };
        let foot = (44.0 * unit).ceil();
        let height = head + foot + laid.iter().map(Laid::height).sum::<f32>();
        let mut canvas = Canvas::new(width, height.ceil().min(MAX_HEIGHT_PX as f32) as u32, PAPER)?;
        paint_head(&mut canvas, &self.title, &self.subtitle, unit, width as f32 - 24.0 * unit);
        let mut top = head;
        for piece in &laid {
            if top >= canvas.height() {
                break;
            }
            canvas.paste(0, top as usize, &piece.draw()?);
            top += piece.height();
        }
        self.paint_footer(&mut canvas, unit);
        Ok(Image(canvas.pixmap))
    }

    fn paint_footer(&self, canvas: &mut Canvas, unit: f32) {
        let bottom = canvas.height();
        let room = canvas.width() - 48.0 * unit;
        let footer = match self.pieces.len().saturating_sub(MAX_PIECES) {
            0 => self.footer.trim().to_owned(),
            rest => format!("{rest} more pieces are left out. {}", self.footer.trim()),
        };
        if footer.is_empty() {
            return;
        }
        canvas.rect(24.0 * unit, bottom - 36.0 * unit, room, unit.max(1.0), HAIRLINE);
        let font = Type::plain(13.0 * unit, INK_SOFT);
        canvas.text((24.0 * unit, bottom - 14.0 * unit), Anchor::Start, font, &font.fit(&footer, room));
    }

    /// Draws the picture as the bytes of a PNG file.
    ///
    /// # Errors
    /// Out of memory, or the encoder fails.
    pub fn to_png(&self) -> Result<Vec<u8>, Error> {
        self.draw()?.to_png()
    }
}
