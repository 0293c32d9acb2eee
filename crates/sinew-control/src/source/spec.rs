//! A scene's `source` table, and the registry of the sources that it can state.

use super::{ClipFile, ClipPlay, ClipSource, GraphName, KeyPoses, PoseName, Source};
use crate::perform::LiveSpec;
use crate::{OrderError, OrderErrorKind as Kind, ReachOrder};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sinew_body::humanoid::Node;

/// What is wrong in a source's table: at which of its keys, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceFault {
    /// The keys from the table down.
    pub keys: Vec<String>,
    /// What is wrong and what to do.
    pub error: OrderError,
}

impl SourceFault {
    /// At a key, what belongs not together.
    pub fn at(key: &str, problem: impl Into<String>) -> SourceFault {
        SourceFault::of(key, OrderError::new(Kind::Contradiction, problem))
    }

    /// Of any kind, at a key.
    pub fn of(key: &str, error: OrderError) -> SourceFault {
        SourceFault { keys: vec![key.to_owned()], error }
    }

    /// The same, seen from the table around it.
    #[must_use]
    pub fn within(mut self, key: &str) -> SourceFault {
        self.keys.insert(0, key.to_owned());
        self
    }

    /// A number out of its range; `hint` says what is usual.
    pub(crate) fn range(
        key: &str,
        value: f64,
        range: std::ops::RangeInclusive<f64>,
        hint: &str,
    ) -> Result<(), SourceFault> {
        if range.contains(&value) {
            return Ok(());
        }
        let problem = format!("{value} is out of range {} to {}; {hint}", range.start(), range.end());
        Err(SourceFault::of(key, OrderError::new(Kind::OutOfRange, problem)))
    }
}

/// Something of a scene that a source names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Named<'a> {
    /// A key pose.
    Pose(&'a str),
    /// A pose graph.
    Graph(&'a str),
    /// A state of a graph.
    State {
        /// The graph.
        graph: &'a str,
        /// The state.
        state: &'a str,
    },
    /// A part or an alias of the character.
    Part(&'a str),
}

/// What a source is made from: the character, as its scene has it.
pub trait SourceContext {
    /// Its key poses, in the pose that it begins in.
    fn key_poses(&self) -> KeyPoses;

    /// A clip on its body, placed.
    ///
    /// # Errors
    /// When the file cannot be used.
    fn clip(&self, play: &ClipPlay) -> Result<ClipSource, OrderError>;

    /// A part by its name or alias.
    fn node(&self, name: &str) -> Option<Node>;

    /// The stage's time \[s\].
    fn now_secs(&self) -> f64;
}

/// A kind of source as a scene or a command states it.
pub trait SourceKind {
    /// Whether its numbers are in range and what it names exists. `exists` says what there is instead.
    ///
    /// # Errors
    /// What is wrong, at which key of the table.
    fn check(&self, spec: &SourceSpec, exists: &dyn Fn(Named) -> Result<(), OrderError>) -> Result<(), SourceFault>;

    /// The clips that it plays.
    fn clips(&self, spec: &SourceSpec) -> Vec<ClipPlay> {
        let _ = spec;
        Vec::new()
    }

    /// Makes it.
    ///
    /// # Errors
    /// What cannot be used, and why.
    fn build(&self, spec: &SourceSpec, context: &dyn SourceContext) -> Result<Box<dyn Source>, OrderError>;
}

/// Makes the table of the kinds that follow.
macro_rules! source_kinds {
    ($($(#[doc = $doc:literal])* $key:ident: $kind:ty,)*) => {
        /// Where a character's wanted pose comes from: one kind of source, or `live` or `reach` alone. A reach may stand beside a pose
        /// or a motion, and begins in it; a live performer beside any kind, which acts until the performer is first heard.
        #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(default, deny_unknown_fields)]
        pub struct SourceSpec {
            $($(#[doc = $doc])* #[serde(skip_serializing_if = "Option::is_none")] pub $key: Option<$kind>,)*
            /// The graph's state to begin with; its first when left out.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub state: Option<String>,
            /// Where in the clip to begin \[s\].
            #[serde(skip_serializing_if = "Option::is_none")]
            pub start_secs: Option<f64>,
            /// Whether the clip begins again at its end; `true` when left out. A clip with a gait cycle repeats the cycle.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub repeat: Option<bool>,
            /// A live performer.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub live: Option<LiveSpec>,
            /// Something to reach for from the start, out of what stands beside it.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub reach: Option<ReachOrder>,
        }

        /// The keys of the kinds, in the order of the registry.
        pub const SOURCE_KINDS: &[&str] = &[$(stringify!($key)),*];

        impl SourceSpec {
            /// The kinds that are stated, with their keys.
            fn stated(&self) -> Vec<(&'static str, &dyn SourceKind)> {
                let mut stated: Vec<(&'static str, &dyn SourceKind)> = Vec::new();
                $(if let Some(kind) = &self.$key {
                    stated.push((stringify!($key), kind));
                })*
                stated
            }
        }
    };
}

// The registry: a new kind of source is a file beside this one, and a line here.
source_kinds! {
    /// A key pose to aim at.
    pose: PoseName,
    /// A pose graph to run.
    graph: GraphName,
    /// A motion file to play.
    clip: ClipFile,
    /// Two sources layered with a weight over time.
    blend: super::blend::BlendSpec,
}

impl SourceSpec {
    /// The source that acts without a performer and a reach, if one is stated: its key and the kind.
    fn own(&self) -> Option<(&'static str, &dyn SourceKind)> {
        self.stated().into_iter().next()
    }

    /// The key of the kind that it states; `live` or `reach` when these are alone.
    pub fn kind(&self) -> &'static str {
        let alone = if self.live.is_some() { "live" } else { "reach" };
        self.own().map_or(alone, |(key, _)| key)
    }

    /// Whether something of the scene's own acts until a live performer is heard.
    pub fn has_understudy(&self) -> bool {
        self.live.is_some() && self.own().is_some()
    }

    /// The clips that it plays, first of all the one whose skeleton the body is made from.
    pub fn clips(&self) -> Vec<ClipPlay> {
        self.own().map_or_else(Vec::new, |(_, kind)| kind.clips(self))
    }

    /// Makes the source that acts without a performer and a reach; `None` when none is stated.
    ///
    /// # Errors
    /// What cannot be used, and why.
    pub fn build(&self, context: &dyn SourceContext) -> Result<Option<Box<dyn Source>>, OrderError> {
        self.own().map(|(_, kind)| kind.build(self, context)).transpose()
    }

    /// Whether it states what belongs together, with numbers in range and names that exist. `exists` says what there is instead.
    ///
    /// # Errors
    /// What is wrong, at which of its keys, and what to do.
    pub fn check(&self, exists: &dyn Fn(Named) -> Result<(), OrderError>) -> Result<(), SourceFault> {
        let stated = self.stated();
        let whole =
            |problem: String| SourceFault { keys: Vec::new(), error: OrderError::new(Kind::Contradiction, problem) };
        let all = SOURCE_KINDS.join(", ");
        if stated.len() > 1 {
            let keys: Vec<&str> = stated.iter().map(|(key, _)| *key).collect();
            return Err(whole(format!("{} are stated; keep one", keys.join(" and "))));
        }
        if stated.is_empty() && self.live.is_none() && self.reach.is_none() {
            return Err(whole(format!("it states no source; write one of {all}, live and reach")));
        }
        if let Some(reach) = &self.reach {
            if self.graph.is_some() || self.live.is_some() {
                return Err(SourceFault::at("reach", "a reach begins in a pose or a clip; remove graph and live"));
            }
            reach.check().map_err(|error| SourceFault::of("reach", error))?;
        }
        if self.state.is_some() && self.graph.is_none() {
            return Err(SourceFault::at("state", "only a graph has states; add graph, or remove this"));
        }
        for (key, is_stated) in [("start_secs", self.start_secs.is_some()), ("repeat", self.repeat.is_some())] {
            if is_stated && self.clip.is_none() {
                return Err(SourceFault::at(key, "only a clip is played so; add clip, or remove this"));
            }
        }
        if let Some(live) = &self.live {
            live.check().map_err(|fault| fault.within("live"))?;
        }
        for (_, kind) in stated {
            kind.check(self, exists)?;
        }
        Ok(())
    }
}
