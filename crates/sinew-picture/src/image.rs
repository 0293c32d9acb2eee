//! A finished picture.

use crate::Error;
use tiny_skia::Pixmap;

/// A finished picture: opaque pixels in sRGB, row by row from the top left.
///
/// ```
/// use sinew_picture::Filmstrip;
/// let image = Filmstrip::default().draw()?;
/// assert_eq!(image.rgba().len(), 4 * image.width() as usize * image.height() as usize);
/// # Ok::<(), sinew_picture::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Image(pub(crate) Pixmap);

impl Image {
    /// Pixels from left to right, 1 to [`MAX_WIDTH_PX`](crate::limits::MAX_WIDTH_PX).
    pub fn width(&self) -> u32 {
        self.0.width()
    }

    /// Pixels from top to bottom, 1 to [`MAX_HEIGHT_PX`](crate::limits::MAX_HEIGHT_PX).
    pub fn height(&self) -> u32 {
        self.0.height()
    }

    /// All pixels: red, green, blue and alpha, 0 to 255 each; alpha is always 255.
    pub fn rgba(&self) -> &[u8] {
        self.0.data()
    }

    /// Red, green and blue of a pixel; `None` outside the picture.
    pub fn pixel(&self, x: u32, y: u32) -> Option<[u8; 3]> {
        self.0.pixel(x, y).map(|pixel| [pixel.red(), pixel.green(), pixel.blue()])
    }

    /// The bytes of a PNG file.
    ///
    /// # Errors
    /// When the encoder fails.
    pub fn to_png(&self) -> Result<Vec<u8>, Error> {
        self.0.encode_png().map_err(|error| Error::Encode(error.to_string()))
    }
}
