//! Pictures of motion: filmstrips of bodies, plots over time and movies, drawn without a GPU.
//!
//! A [`Filmstrip`] shows moments of a motion side by side: the body as shaded capsules, its left blue and its right
//! orange, a reference motion as a pale ghost behind it, forces as arrows, over a floor fixed to the world. A [`Plot`]
//! shows values over time. A [`Sheet`] stacks both into one picture. A [`Movie`] shows the same bodies in motion, as GIF or APNG.
//!
//! How to read a filmstrip: all panels have one scale and follow the body; the tiles and the ruler below stay with the
//! world, half a metre apart. A sliding foot moves relative to them during contact; a floating foot is apart from its
//! shadow; parts below the floor are pale.
//!
//! Same input, same bytes. No input panics: shapes with NaN or infinite coordinates are skipped, and sizes are clamped
//! to [`limits`].
//!
//! ```
//! use glam::DVec3;
//! use sinew_picture::{Capsule, Figure, Filmstrip, Panel, Shade};
//!
//! let trunk = Capsule::new(DVec3::new(0.0, 0.6, 0.0), DVec3::new(0.0, 1.5, 0.0), 0.15, Shade::Midline);
//! let panel = Panel { figure: Figure::new(vec![trunk]), follow: Some(DVec3::ZERO), ..Panel::default() };
//! let png = Filmstrip { panels: vec![panel], ..Filmstrip::default() }.to_png()?;
//! assert!(png.starts_with(b"\x89PNG"));
//! # Ok::<(), sinew_picture::Error>(())
//! ```
//!
//! It has no feature, and brings along fewer than 35 crates. The fonts in it are under the SIL Open Font License 1.1.
//!
//! What it does not do: methods, formats, skeletons. Plain shapes in metres come in, pixels go out.

mod animation;
mod arrow;
mod body;
mod camera;
mod canvas;
mod chart;
mod colour;
mod cone;
mod error;
mod extent;
mod figure;
mod filmstrip;
mod floor;
mod hit;
mod image;
mod lens;
pub mod limits;
mod movie;
mod palette;
mod plot;
mod shadow;
mod sheet;
mod shot;
mod slabs;
mod solid;
mod strip;
mod text;
mod ticks;

pub use arrow::Arrow;
pub use camera::{Camera, View};
pub use colour::{Colour, PALETTE};
pub use error::Error;
pub use figure::{Capsule, Cuboid, Figure, Shade};
pub use filmstrip::{Filmstrip, Panel, Style};
pub use hit::Hit;
pub use image::Image;
pub use movie::{Movie, MovieStyle};
pub use plot::{Limit, Mark, Plot, Series};
pub use sheet::{Piece, Sheet};
