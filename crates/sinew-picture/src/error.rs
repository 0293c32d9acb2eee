//! Errors of drawing a picture.

/// Why a picture cannot be drawn. Invalid shapes are not an error: they are skipped or clamped (see
/// [`limits`](crate::limits)).
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Out of memory.
    #[error("no room for a picture of {width_px} × {height_px} pixels; ask for a smaller width or fewer panels")]
    TooLarge {
        /// Requested width \[px\].
        width_px: u32,
        /// Requested height \[px\].
        height_px: u32,
    },
    /// The PNG encoder failed.
    #[error("the picture cannot be written as PNG: {0}; try a smaller width")]
    Encode(String),
}
