//! Pictures of motion: filmstrips of bodies and plots over time, drawn without a GPU.
//!
//! A [`Filmstrip`] shows moments of a motion side by side: the body as shaded capsules, its left blue and its right
//! orange, what it is compared with as a pale ghost behind it, forces as arrows, over a floor fixed to the world. A
//! [`Plot`] shows values over time. A [`Sheet`] stacks both into one picture.
//!
//! How to read a filmstrip: all panels have one scale and follow the body; the tiles and the ruler below stay with the
//! world, half a metre apart. A foot that skates moves against them while it is down; a foot that floats parts from its
//! shadow; what sinks into the floor turns pale.
//!
//! Same input, same bytes. Nothing that is put in panics: shapes with coordinates that are not finite are skipped, and
//! sizes are clamped to [`limits`].
//!
//! This crate knows nothing of methods, formats or skeletons: plain shapes in metres come in, pixels go out.

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
mod image;
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
pub use image::Image;
pub use plot::{Limit, Mark, Plot, Series};
pub use sheet::{Piece, Sheet};
