//! Pictures of motion: filmstrips of bodies and plots over time, drawn without a GPU.
mod arrow;
mod body;
mod camera;
mod canvas;
mod chart;
mod colour;
mod cone;
mod error;
mod figure;
mod filmstrip;
mod floor;
mod lens;
pub mod limits;
mod plot;
mod sheet;
mod strip;
mod text;
mod ticks;

pub use arrow::Arrow;
pub use camera::{Camera, View};
pub use colour::{Colour, PALETTE};
pub use error::Error;
pub use figure::{Capsule, Figure, Shade};
pub use filmstrip::{Filmstrip, Panel, Style};
pub use plot::{Limit, Mark, Plot, Series};
pub use sheet::{Piece, Sheet};
pub use tiny_skia::Pixmap;
