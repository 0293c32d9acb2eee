//! The whole scene file as it is written.

use super::{
    CameraSpec, CharacterSpec, ControllerSpec, KeyBinding, PropJointSpec, PropSpec, Reaction, RopeSpec, ShapeSpec,
    StageSpec, Timed,
};
use schemars::JsonSchema;
use serde::Deserialize;
use sinew_control::{GraphSpec, PoseSpec};
use std::collections::BTreeMap;

/// A scene: the characters and props on the stage, and the commands that happen there.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SceneSpec {
    /// Version of the format: 1.
    #[schemars(range(min = 1, max = 1))]
    pub format: u32,
    /// A title.
    #[serde(default)]
    pub name: Option<String>,
    /// Rates, gravity, floor.
    #[serde(default)]
    pub stage: StageSpec,
    /// The camera: when and from where pictures are taken.
    #[serde(default)]
    pub camera: CameraSpec,
    /// Shapes that the command `shape` gives to parts.
    #[serde(default)]
    pub shapes: BTreeMap<String, ShapeSpec>,
    /// Characters by name.
    #[serde(default)]
    pub characters: BTreeMap<String, CharacterSpec>,
    /// Props by name.
    #[serde(default)]
    pub props: BTreeMap<String, PropSpec>,
    /// Ropes by name; their pieces are props.
    #[serde(default)]
    pub ropes: BTreeMap<String, RopeSpec>,
    /// Joints of props by name.
    #[serde(default)]
    pub joints: BTreeMap<String, PropJointSpec>,
    /// Key poses by name, those of `stage.pose_files` included.
    #[serde(default)]
    pub poses: BTreeMap<String, PoseSpec>,
    /// Pose graphs by name, those of `stage.pose_files` included.
    #[serde(default)]
    pub graphs: BTreeMap<String, GraphSpec>,
    /// Python controllers by name.
    #[serde(default)]
    pub controllers: BTreeMap<String, ControllerSpec>,
    /// Commands at a time, in the order of the file.
    #[serde(default)]
    pub at: Vec<Timed>,
    /// Commands at contacts.
    #[serde(default)]
    pub when: Vec<Reaction>,
    /// Commands when a key is pressed.
    #[serde(default)]
    pub keys: Vec<KeyBinding>,
}

/// The version of the format that this code reads.
pub const SCENE_FORMAT: u32 = 1;

/// The scene file's JSON schema, for editors.
pub fn scene_schema() -> String {
    let schema = schemars::schema_for!(SceneSpec);
    // A map of strings and numbers always prints.
    let mut text = serde_json::to_string_pretty(&schema).unwrap_or_default();
    text.push('\n');
    text
}
