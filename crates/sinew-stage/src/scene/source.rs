//! Where a character's wanted pose comes from.

use super::LiveSpec;
use super::error::Fault;
use super::range::number;
use schemars::JsonSchema;
use serde::Deserialize;
use sinew_control::ReachOrder;

/// One of `pose`, `graph`, `clip`, `live` and `reach`. A reach may stand beside a pose or a clip, and begins in it; a live performer
/// beside a pose, a graph or a clip, which act until the performer is first heard.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SourceSpec {
    /// A key pose to aim at.
    pub pose: Option<String>,
    /// A pose graph to run.
    pub graph: Option<String>,
    /// The graph's state to begin with; its first when left out.
    pub state: Option<String>,
    /// A motion file to play.
    pub clip: Option<String>,
    /// Where in the clip to begin \[s\].
    pub start_secs: Option<f64>,
    /// Whether the clip begins again at its end; `true` when left out. A clip with a gait cycle repeats the cycle.
    pub repeat: Option<bool>,
    /// A live performer.
    pub live: Option<LiveSpec>,
    /// Something to reach for from the start, out of the pose or the clip beside it, where there is one.
    pub reach: Option<ReachOrder>,
}

impl SourceSpec {
    /// Whether something of the scene's own acts until a live performer is heard.
    pub(crate) fn has_understudy(&self) -> bool {
        self.live.is_some() && (self.pose.is_some() || self.graph.is_some() || self.clip.is_some())
    }

    pub(super) fn check(&self, name: &str) -> Result<(), Fault> {
        let path = ["characters", name, "source"];
        let at = |key| ["characters", name, "source", key];
        let stated = [&self.pose, &self.graph, &self.clip].into_iter().flatten().count();
        if stated > 1 {
            return Err(Fault::at(&path, format!("{stated} of pose, graph and clip are stated; keep one")));
        }
        if stated == 0 && self.live.is_none() && self.reach.is_none() {
            return Err(Fault::at(&path, "it states no source; write one of pose, graph, clip, live and reach"));
        }
        if let Some(reach) = &self.reach {
            if self.graph.is_some() || self.live.is_some() {
                return Err(Fault::at(&at("reach"), "a reach begins in a pose or a clip; remove graph and live"));
            }
            reach.check().map_err(|error| Fault::of_order(&at("reach"), &error))?;
        }
        if self.state.is_some() && self.graph.is_none() {
            return Err(Fault::at(&at("state"), "only a graph has states; add graph, or remove this"));
        }
        for (key, is_stated) in [("start_secs", self.start_secs.is_some()), ("repeat", self.repeat.is_some())] {
            if is_stated && self.clip.is_none() {
                return Err(Fault::at(&at(key), "only a clip is played so; add clip, or remove this"));
            }
        }
        if let Some(live) = &self.live {
            live.check(name)?;
        }
        number(&at("start_secs"), self.start_secs.unwrap_or(0.0), 0.0..=86_400.0, "seconds into the clip are expected")
    }
}
