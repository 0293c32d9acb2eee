//! Bounds that keep any input drawable: what is larger is clamped, never an error and never a panic.

/// Widest picture \[px\]; wider is clamped. A 4K screen is 3840.
pub const MAX_WIDTH_PX: u32 = 4_000;
/// Narrowest picture \[px\]; below it no caption fits.
pub const MIN_WIDTH_PX: u32 = 480;
/// Tallest picture \[px\]; what would stand below it is cut off. With the width, at most 200 MB.
pub const MAX_HEIGHT_PX: u32 = 12_000;
/// Most panels of one filmstrip; later ones are left out, and the subtitle says so.
pub const MAX_PANELS: usize = 160;
/// Most panels side by side.
pub const MAX_COLUMNS: usize = 16;
/// Most capsules of one figure; a full hand-and-face rig has about 200. Later ones are left out.
pub const MAX_CAPSULES: usize = 1_000;
/// Most arrows of one panel; later ones are left out.
pub const MAX_ARROWS: usize = 64;
/// Thickest capsule \[m\], radius.
pub const MAX_RADIUS_M: f64 = 5.0;
/// Widest and highest view of a panel \[m\]. Whatever lies farther from the followed point is cut off, so that one
/// stray limb does not shrink every figure to a dot.
pub const MAX_VIEW_M: f64 = 8.0;
/// Farthest coordinate from the world's origin \[m\]; beyond it a shape is skipped like one that is not finite.
pub const MAX_COORDINATE_M: f64 = 1e7;
/// Most lines of one plot; later ones are left out, and the legend says so.
pub const MAX_SERIES: usize = 40;
/// Most shaded intervals and most limit lines of one plot.
pub const MAX_MARKS: usize = 64;
/// Largest magnitude in a plot; points beyond it are skipped like those that are not finite.
pub const MAX_PLOT_VALUE: f64 = 1e12;
/// Longest text drawn \[characters\]; the rest becomes an ellipsis.
pub const MAX_TEXT_CHARS: usize = 300;
/// Most filmstrips and plots on one sheet; later ones are left out, and the footer says so.
pub const MAX_PIECES: usize = 64;
