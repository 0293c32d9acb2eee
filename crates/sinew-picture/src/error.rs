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
    /// A movie with more frames than [`MAX_MOVIE_FRAMES`](crate::limits::MAX_MOVIE_FRAMES).
    #[error("a movie of {frames} frames is too long; show at most ten minutes, which are 15,000 frames")]
    TooLong {
        /// Requested frames.
        frames: usize,
    },
    /// The encoder of a movie failed.
    #[error("the movie cannot be written: {0}; try a shorter or smaller one")]
    EncodeMovie(String),
    /// The PNG encoder failed.
    #[error("the picture cannot be written as PNG: {0}; try a smaller width")]
    Encode(String),
}
