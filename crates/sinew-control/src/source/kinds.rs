//! Key poses, pose graphs and clips as a scene or a command states them.

use super::Source;
use super::spec::{Named, SourceContext, SourceFault, SourceKind, SourceSpec};
use crate::OrderError;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A key pose by its name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
#[schemars(inline)]
pub struct PoseName(pub String);

/// A pose graph by its name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
#[schemars(inline)]
pub struct GraphName(pub String);

/// A motion file by the name that the scene uses for it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
#[schemars(inline)]
pub struct ClipFile(pub String);

/// A clip, and how it is played.
#[derive(Clone, Debug, PartialEq)]
pub struct ClipPlay {
    /// The file, by the name that the scene uses for it.
    pub file: String,
    /// Where in the clip to begin \[s\].
    pub start_secs: f64,
    /// Whether it begins again at its end.
    pub repeats: bool,
}

impl SourceKind for PoseName {
    fn check(&self, _: &SourceSpec, exists: &dyn Fn(Named) -> Result<(), OrderError>) -> Result<(), SourceFault> {
        exists(Named::Pose(&self.0)).map_err(|error| SourceFault::of("pose", error))
    }

    fn build(&self, _: &SourceSpec, context: &dyn SourceContext) -> Result<Box<dyn Source>, OrderError> {
        let mut poses = context.key_poses();
        if !poses.is_at(&self.0) {
            poses.aim(&self.0)?;
        }
        Ok(Box::new(poses))
    }
}

impl SourceKind for GraphName {
    fn check(&self, spec: &SourceSpec, exists: &dyn Fn(Named) -> Result<(), OrderError>) -> Result<(), SourceFault> {
        exists(Named::Graph(&self.0)).map_err(|error| SourceFault::of("graph", error))?;
        let Some(state) = &spec.state else { return Ok(()) };
        exists(Named::State { graph: &self.0, state }).map_err(|error| SourceFault::of("state", error))
    }

    fn build(&self, spec: &SourceSpec, context: &dyn SourceContext) -> Result<Box<dyn Source>, OrderError> {
        let mut poses = context.key_poses();
        poses.start_graph(&self.0, spec.state.as_deref())?;
        Ok(Box::new(poses))
    }
}

impl ClipFile {
    fn play(&self, spec: &SourceSpec) -> ClipPlay {
        ClipPlay {
            file: self.0.clone(),
            start_secs: spec.start_secs.unwrap_or(0.0),
            repeats: spec.repeat.unwrap_or(true),
        }
    }
}

impl SourceKind for ClipFile {
    fn check(&self, spec: &SourceSpec, _: &dyn Fn(Named) -> Result<(), OrderError>) -> Result<(), SourceFault> {
        let start_secs = spec.start_secs.unwrap_or(0.0);
        SourceFault::range("start_secs", start_secs, 0.0..=86_400.0, "seconds into the clip are expected")
    }

    fn clips(&self, spec: &SourceSpec) -> Vec<ClipPlay> {
        vec![self.play(spec)]
    }

    fn build(&self, spec: &SourceSpec, context: &dyn SourceContext) -> Result<Box<dyn Source>, OrderError> {
        Ok(Box::new(context.clip(&self.play(spec))?))
    }
}
