//! What the rigid-body library serialises, as bytes of our snapshots.
//!
//! The library's sets are opaque, but implement serde. Formats of others were looked at and do not fit: postcard's integers have a
//! variable length, so that a counter that grows moves all that follows and two states of one world cannot be compared place by
//! place; bincode is no longer kept. And no format leaves out collision shapes, which are by far the largest part, do not change,
//! and nest without end in bytes that were made on purpose. Here they are not in the bytes: who loads passes them in.
//!
//! Numbers have their own size, little-endian; a length is a `u32`, the number of a variant a byte.

mod load;
mod save;

pub(crate) use load::{Colliders, load};
pub(crate) use save::save;

use rapier3d_f64::prelude::Pose;
use sinew_snapshot::SnapshotError;
use std::fmt;

/// Why the library's state cannot be saved or loaded.
#[derive(Debug)]
struct Fault(SnapshotError);

/// What is not in the bytes beside collision shapes, or is shorter there.
#[derive(Default)]
pub(crate) struct LeftOut<'a> {
    /// Bodies: forces of the last step and velocities of its continuous collision detection, which the next step finds before it
    /// reads them.
    pub has_bodies: bool,
    /// Joints, in the library's order, whose rows are written anew before the next step: their targets, gains and frames on the
    /// second body.
    pub rewritten_joints: &'a [bool],
    /// Where colliders are expected, one after the other: where their bodies are.
    pub poses: Option<&'a mut dyn Iterator<Item = Pose>>,
}

/// What serde names the library's collision shapes, as they are saved and as they are loaded.
const SHAPE: [&str; 2] = ["TypedShape", "DeserializableTypedShape"];

/// What serde names the place of a collider, and a joint.
const POSE: &str = "ColliderPosition";
const JOINT: &str = "GenericJoint";

impl Fault {
    fn of(what: &'static str) -> Fault {
        Fault(SnapshotError::invalid(what))
    }
}

impl From<SnapshotError> for Fault {
    fn from(error: SnapshotError) -> Fault {
        Fault(error)
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl std::error::Error for Fault {}

impl serde::ser::Error for Fault {
    fn custom<T: fmt::Display>(_: T) -> Fault {
        Fault::of("value of the rigid-body library")
    }
}

impl serde::de::Error for Fault {
    fn custom<T: fmt::Display>(_: T) -> Fault {
        Fault::of("value of the rigid-body library")
    }
}
