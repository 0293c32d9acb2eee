//! Scenes: a TOML file with the characters and props on the stage, and the commands that happen there.
//!
//! [`SceneSpec`] is the file as it is written; [`Scene`] is one that was read and validated, with all files that it
//! names. `docs/scenes.md` explains the file key by key.

mod character;
mod check;
mod controller;
mod document;
mod edit;
mod error;
mod files;
mod honours;
mod kd;
mod lines;
mod prop;
mod prop_joint;
mod range;
mod read;
mod response;
mod rope;
mod shape;
mod spec;
mod stage;
mod timeline;
mod wording;

pub use character::{CharacterSpec, JointSpec, PlaneFacing, PlaneSpec, REFLEXES};
pub use check::STAND;
pub use controller::ControllerSpec;
pub(crate) use document::NAMED;
pub use edit::SceneDocument;
pub use error::{SceneError, SceneErrorKind};
pub(crate) use error::{known, shortened};
pub(crate) use files::allowed;
pub use files::{DiskFiles, FileError, FileErrorKind, Files, HeldFile};
pub use kd::{KdSpec, WeightSpec};
pub use prop::PropSpec;
pub(crate) use prop_joint::aim;
pub use prop_joint::{JointKind, MotorSpec, PropJointSpec};
pub(crate) use read::MAX_PYTHON_BYTES;
pub use read::{Scene, Touchable};
pub use response::ResponseSpec;
pub use rope::RopeSpec;
pub use shape::{AxisName, CapsuleSpec, MeshSpec, RingSpec, ShapeSpec};
pub use spec::{SCENE_FORMAT, SceneSpec, scene_schema};
pub use stage::{CameraSpec, FloorSpec, FloorSurface, StageSpec};
pub use timeline::{KeyBinding, Reaction, Timed};
