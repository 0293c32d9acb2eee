//! Pictures of motion: filmstrips of bodies and plots over time, drawn without a GPU.
mod arrow;
mod body;
mod camera;
mod canvas;
mod colour;
mod error;
mod figure;
mod filmstrip;
mod floor;
mod lens;
pub mod limits;
mod strip;
mod text;

pub use arrow::Arrow;
pub use camera::{Camera, View};
pub use colour::{Colour, PALETTE};
pub use error::Error;
pub use figure::{Capsule, Figure, Shade};
pub use filmstrip::{Filmstrip, Panel, Style};
pub use tiny_skia::Pixmap;
