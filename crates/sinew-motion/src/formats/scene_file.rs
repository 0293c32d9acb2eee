//! A whole scene for a file: characters, things, colours.

use crate::{Clip, Transform};
use glam::{DQuat, DVec3};

/// A scene: every character with a skeleton of its own, every thing as an object.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneFile {
    /// The colours, by the index that shapes name.
    pub materials: Vec<SceneMaterial>,
    /// The characters; their clips have one rate and number of frames.
    pub characters: Vec<SceneCharacter>,
    /// The things.
    pub things: Vec<SceneThing>,
    /// From one frame to the next \[s\].
    pub frame_time_secs: f64,
}

/// A colour with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneMaterial {
    /// Its name.
    pub name: String,
    /// Red, green and blue, sRGB.
    pub rgb: [u8; 3],
}

/// A character.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneCharacter {
    /// Its name.
    pub name: String,
    /// Its motion, metres, Y up.
    pub clip: Clip,
    /// What it looks like: shapes in the frames of its joints, each rigid to one.
    pub shapes: Vec<JointShape>,
}

/// A shape that a joint carries.
#[derive(Clone, Debug, PartialEq)]
pub struct JointShape {
    /// Index of the joint.
    pub joint: usize,
    /// The shape, in the joint's frame.
    pub form: SceneForm,
    /// Index of its material.
    pub material: usize,
}

/// A thing: one object with one mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneThing {
    /// Its name.
    pub name: String,
    /// Its shapes, in its own frame.
    pub forms: Vec<SceneForm>,
    /// Index of its material.
    pub material: usize,
    /// `world_from_thing` in every frame.
    pub places: Vec<Transform>,
}

/// A shape, metres.
#[derive(Clone, Debug, PartialEq)]
pub enum SceneForm {
    /// A capsule; a ball where both ends are one point.
    Capsule {
        /// Centre of one end.
        from: DVec3,
        /// Centre of the other.
        to: DVec3,
        /// Its radius, above 0.
        radius_m: f64,
    },
    /// A box.
    Box {
        /// Its middle.
        centre: DVec3,
        /// How its edges are turned.
        rotation: DQuat,
        /// Lengths of its edges, above 0.
        size_m: DVec3,
    },
    /// Flat triangles, counter-clockwise from outside.
    Triangles {
        /// Corners.
        points_m: Vec<DVec3>,
        /// Three indices each; one that does not exist leaves its triangle out.
        triangles: Vec<[u32; 3]>,
    },
}
