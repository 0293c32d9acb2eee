//! State as bytes: a simulation is saved, and restored bit for bit.
//!
//! A type that changes while a simulation runs implements [`Snapshot`]. It saves its *state* only. What does not change while it
//! runs (bodies, clips, settings, names) stays where it is: [`Snapshot::restore`] writes into a value that already has it. So a
//! snapshot is small, and is restored into the thing that it was taken from or into one that was built in the same way.
//!
//! [`snapshot!`] writes both directions from one list of fields, and the compiler insists that the list is complete: a field
//! that is added later is either state or named as fixed.
//!
//! ```
//! use sinew_snapshot::{FrameKind, Snapshot, SnapshotError, snapshot};
//!
//! struct Pendulum {
//!     length_m: f64,
//!     angle_rad: f64,
//!     speed_rad_s: f64,
//! }
//! snapshot!(Pendulum { angle_rad, speed_rad_s } fixed { length_m });
//!
//! const KIND: FrameKind = FrameKind { magic: *b"PEND", version: 1 };
//! let mut pendulum = Pendulum { length_m: 1.0, angle_rad: 0.3, speed_rad_s: 0.0 };
//! let bytes = KIND.save(&pendulum);
//!
//! pendulum.angle_rad = 2.0;
//! KIND.restore(&mut pendulum, &bytes)?;
//! assert_eq!(pendulum.angle_rad, 0.3);
//!
//! // Bytes that were changed, cut or made by another version are an error, and change nothing.
//! let mut changed = bytes.clone();
//! changed[10] ^= 1;
//! assert!(matches!(KIND.restore(&mut pendulum, &changed), Err(SnapshotError::Corrupt)));
//! # Ok::<(), SnapshotError>(())
//! ```
//!
//! **Layout.** Everything is little-endian and unpadded. A `bool` is one byte, an integer its own size, `usize` 8 bytes, `f64`
//! its 8 bytes bit for bit (a NaN keeps its payload). A length is a `u32`, followed by the elements. `Option` is a byte, 0 or 1,
//! followed by the value. Arrays and structs are their elements, nothing else. [`FrameKind`] documents what stands around it.
//!
//! **Limits.** A reader never allocates more than the bytes that are left can justify, and never panics.
//!
//! It has no feature, and brings along fewer than 15 crates.
//!
//! What it does not do: data that does not change while a simulation runs; files.

mod collections;
mod error;
mod frame;
mod macros;
mod reader;
mod values;
mod writer;

pub use error::SnapshotError;
pub use frame::FrameKind;
pub use reader::Reader;
pub use writer::Writer;

/// What can be saved and restored in place, bit for bit.
///
/// The trait is object safe: a `Box<dyn Source>` whose trait has `Snapshot` above it is saved through the box.
pub trait Snapshot {
    /// Appends the state to `to`. The same state gives the same bytes.
    fn save(&self, to: &mut Writer);

    /// Replaces the state by what `from` holds, and reads exactly as many bytes as [`Snapshot::save`] wrote.
    ///
    /// # Errors
    /// When the bytes end too early, hold a value that the type cannot have, or were saved by something of another
    /// shape. The value is then partly restored and must not be used before something else was restored into it: code
    /// that restores a whole out of parts keeps the old state until all of the new one is in.
    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError>;
}
