//! The names that a script can use, sent once.

use serde::{Deserialize, Serialize};

/// A script and its constant data.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct StartInfo {
    /// The text, at most 1 MiB.
    pub source: String,
    /// The file that it is from, for the lines of errors.
    pub file: String,
    /// The class in it that is the controller.
    pub class: String,
    /// The character that it controls, one of [`Names::characters`], or the prop, one of [`Names::objects`].
    pub own: String,
    /// Seed of the script's `random` numbers.
    pub seed: u64,
    /// The names that it can use.
    pub names: Names,
}

/// The names that a script can use.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct Names {
    /// The parts of every character, in the order of [`CharacterState::parts`](crate::CharacterState::parts).
    pub parts: Vec<String>,
    /// Characters, in the order of [`Snapshot::characters`](crate::Snapshot::characters).
    pub characters: Vec<CharacterNames>,
    /// Props, in the order of [`Snapshot::objects`](crate::Snapshot::objects).
    pub objects: Vec<String>,
    /// Joints of props, in the order of [`Snapshot::joints`](crate::Snapshot::joints).
    pub joints: Vec<JointName>,
    /// Key poses.
    pub poses: Vec<String>,
    /// Pose graphs.
    pub graphs: Vec<String>,
    /// Collision shapes, with `own` and `none`.
    pub shapes: Vec<String>,
    /// Reflexes.
    pub reflexes: Vec<String>,
    /// Trackers.
    pub trackers: Vec<String>,
}

/// A joint's name.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct JointName {
    /// Its name in the scene.
    pub name: String,
    /// It is a hinge, and not a slider or another joint.
    pub turns: bool,
}

/// A character's own names.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct CharacterNames {
    /// Its name in the scene.
    pub name: String,
    /// Other names of its parts: alias, part.
    pub aliases: Vec<(String, String)>,
}
