//! Limits that keep any input drawable: larger values are clamped, never an error and never a panic.

/// Maximum width of a picture \[px\]; clamped. A 4K screen is 3840.
pub const MAX_WIDTH_PX: u32 = 4_000;
/// Minimum width of a picture \[px\]; below it no caption fits.
pub const MIN_WIDTH_PX: u32 = 480;
/// Maximum height of a picture \[px\]; the rest is cut off. With the width, at most 200 MB.
pub const MAX_HEIGHT_PX: u32 = 12_000;
/// Maximum number of panels of one filmstrip; later ones are left out, and the subtitle says so.
pub const MAX_PANELS: usize = 160;
/// Maximum number of panels side by side.
pub const MAX_COLUMNS: usize = 16;
/// Maximum number of capsules, and of boxes, of one figure; a full hand-and-face rig has about 200. Later ones are left out,
/// and the subtitle says so.
pub const MAX_SHAPES: usize = 10_000;
/// Maximum number of arrows of one panel; later ones are left out.
pub const MAX_ARROWS: usize = 64;
/// Maximum number of marked impacts of one panel; later ones are left out.
pub const MAX_HITS: usize = 32;
/// Maximum radius of a capsule \[m\].
pub const MAX_RADIUS_M: f64 = 5.0;
/// Maximum width and height of a panel's view \[m\], enough for a body of 10 m with its arms up. Anything farther from the
/// followed point is cut off, so that one stray limb does not shrink every figure to a dot.
pub const MAX_VIEW_M: f64 = 14.0;
/// Maximum coordinate in the world \[m\]; a shape beyond it is skipped like one with NaN or infinite coordinates.
pub const MAX_COORDINATE_M: f64 = 1e7;
/// Maximum number of frames of a movie: ten minutes. More are an error.
pub const MAX_MOVIE_FRAMES: usize = 15_000;
/// Maximum number of lines of one plot; later ones are left out, and the legend says so.
pub const MAX_SERIES: usize = 40;
/// Maximum number of shaded intervals, and of limit lines, of one plot.
pub const MAX_MARKS: usize = 64;
/// Maximum magnitude in a plot; points beyond it are skipped like NaN or infinite ones.
pub const MAX_PLOT_VALUE: f64 = 1e12;
/// Maximum length of a text \[characters\]; the rest becomes an ellipsis.
pub const MAX_TEXT_CHARS: usize = 300;
/// Maximum number of filmstrips and plots on one sheet; later ones are left out, and the footer says so.
pub const MAX_PIECES: usize = 64;
