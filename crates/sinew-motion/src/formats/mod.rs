//! Readers and writers of motion files.
//!
//! A reader turns bytes into a [`Parsed`]: the motion in the file's own units and axes, and a [`Document`] from which
//! the file can be written again with only the motion's values changed.

pub mod amc;
mod body_shape;
pub mod bvh;
mod contents;
mod document;
pub mod fbx;
mod file;
pub mod gltf;
mod rate;
mod scene_file;
mod text;

pub use body_shape::BodyShape;
pub use contents::{AnimationInfo, Contents};
pub use document::{Document, Format, Parsed, Source, WriteJob};
pub use file::{MotionFile, ReadOptions, bytes_of, write, write_scene, write_whole};
pub use scene_file::{JointShape, SceneCharacter, SceneFile, SceneForm, SceneMaterial, SceneThing};
