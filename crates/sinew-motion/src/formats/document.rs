//! What a reader returns, and what a writer takes.

use super::Contents;
use super::amc::AmcDocument;
use super::bvh::BvhDocument;
use crate::{Clip, Note, SourceSpace};
use std::fmt;
use std::path::Path;

/// A motion file format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Biovision hierarchy, `.bvh`.
    Bvh,
    /// Acclaim motion `.amc` with its skeleton `.asf`.
    Amc,
    /// glTF 2.0 as JSON, `.gltf`.
    Gltf,
    /// glTF 2.0 in one binary file, `.glb`.
    Glb,
    /// VRM, a character in a binary glTF, `.vrm` (read, and written again).
    Vrm,
    /// VRM Animation, a motion in a binary glTF, `.vrma` (read, and written again).
    Vrma,
    /// Autodesk FBX, `.fbx` (read only).
    Fbx,
}

impl Format {
    /// The format that a path's extension names, in any case.
    pub fn of(path: &Path) -> Option<Format> {
        let extension = path.extension()?.to_str()?.to_ascii_lowercase();
        match extension.as_str() {
            "bvh" => Some(Format::Bvh),
            "amc" | "asf" => Some(Format::Amc),
            "gltf" => Some(Format::Gltf),
            "glb" => Some(Format::Glb),
            "vrm" => Some(Format::Vrm),
            "vrma" => Some(Format::Vrma),
            "fbx" => Some(Format::Fbx),
            _ => None,
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Format::Bvh => "bvh",
            Format::Amc => "amc",
            Format::Gltf => "gltf",
            Format::Glb => "glb",
            Format::Vrm => "vrm",
            Format::Vrma => "vrma",
            Format::Fbx => "fbx",
        })
    }
}

/// A parsed file.
#[derive(Clone, Debug)]
pub struct Parsed {
    /// The motion in the file's own units and axes: its translations are *not* metres yet.
    pub clip: Clip,
    /// The file's unit \[m\], where the format states it.
    pub unit_m: Option<f64>,
    /// The file's space when the format states its axes (glTF, FBX, ASF); `None` lets Sinew find the up axis.
    pub world_from_source: Option<glam::DQuat>,
    /// The file, kept for writing it again.
    pub document: Document,
    /// What else is in the file.
    pub contents: Contents,
    /// What was guessed, repaired or lost.
    pub notes: Vec<Note>,
}

/// The source document of a file, kept so that it can be written again with only the motion's values changed.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Document {
    /// Nothing is kept: the file can only be written anew.
    None,
    /// A BVH file.
    Bvh(Box<BvhDocument>),
    /// An AMC file with its ASF skeleton.
    Amc(Box<AmcDocument>),
    /// A glTF file: its meshes, materials and other nodes stay, the animation that was read is replaced.
    Gltf(Box<super::gltf::GltfDocument>),
}

/// What a writer takes.
#[derive(Clone, Copy, Debug)]
pub struct WriteJob<'a> {
    /// The motion to write, in metres and Y up.
    pub clip: &'a Clip,
    /// The file that the motion came from, where it came from one: the file's document, the clip as it was read (in
    /// metres and Y up) and its space. A writer of the same format writes that file again and replaces only the
    /// values that differ, bit for bit, from the clip as it was read.
    pub source: Option<Source<'a>>,
}

/// The file behind a [`WriteJob`].
#[derive(Clone, Copy, Debug)]
pub struct Source<'a> {
    /// The file.
    pub document: &'a Document,
    /// The motion as it was read, in metres and Y up.
    pub clip: &'a Clip,
    /// The file's unit and axes.
    pub space: SourceSpace,
    /// For each frame of the clip to write, the frame of the file that it came from.
    pub rows: &'a [usize],
}
