//! glTF 2.0, `.gltf` and `.glb`: read, written anew, and written again with another motion.
//!
//! The skeleton is made of the joints of the first skin (and of the skins of the same body), with the nodes above them
//! that turn or move; without a skin, of the animated nodes; and of the nodes that VRM calls bones. The motion is one animation's, the first with keys of the
//! skeleton unless another is told, sampled at the rate
//! of its keys. glTF is metres and Y up by definition; this reader does not correct files that use other units (a fox
//! of 150 units). Scales are multiplied into offsets; animated scales, morph targets and further animations are left
//! out, and noted.
//!
//! The JSON is read with our own few types, not those of the `gltf` crate: that crate treats out-of-range accessors as
//! empty, accepts nodes that are their own ancestors, opens files anywhere on the disk, and refuses files for oddities
//! in parts that have nothing to do with motion.

mod animation;
mod animation_list;
mod append;
mod capsule;
mod companions;
mod container;
mod data;
mod document;
mod fuzz;
mod keys;
mod reader;
mod rewrite;
mod rig;
mod scene;
mod scene_mesh;
mod schema;
mod track;
mod tree;
mod uri;
mod vrm;
mod writer;

pub use document::GltfDocument;
pub use fuzz::fuzz;
pub use reader::{read, read_slice};
pub(crate) use reader::{read_chosen, read_slice_chosen};
pub use scene::write_scene;
pub use writer::write;

use crate::{Error, Place};

/// An error in an element of the file.
fn element(name: impl Into<String>, problem: impl Into<String>, remedy: impl Into<String>) -> Error {
    Error::new(Place::Element(name.into()), problem, remedy)
}
