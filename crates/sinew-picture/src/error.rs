//! What can go wrong with a picture.

/// A picture that cannot be made. Odd shapes are not an error: they are skipped or clamped (see [`limits`](crate::limits)).
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// No memory for the picture.
    #[error("no room for a picture of {width_px} × {height_px} pixels; ask for a smaller width or fewer panels")]
    TooLarge {
        /// Width asked for \[px\].
        width_px: u32,
        /// Height asked for \[px\].
        height_px: u32,
    },
    /// The PNG encoder failed.
    #[error("the picture cannot be written as PNG: {0}; try a smaller width")]
    Encode(String),
}
