//! Body parts as pose and graph files name them.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserialize, Deserializer, Error};
use serde::{Serialize, Serializer};
use sinew_body::humanoid::Node;
use std::borrow::Cow;
use std::fmt;
use std::str::FromStr;

/// One of the 18 bodies by its VRM name: `leftUpperArm`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct PartName(pub Node);

/// A name that is not one of the 18 parts.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no body part is called {0:?}; the parts are {known}", known = PartName::list())]
pub struct UnknownPartName(pub String);

impl PartName {
    /// All names, for messages.
    pub fn list() -> String {
        Node::ALL.map(|node| node.part().name()).join(", ")
    }
}

impl FromStr for PartName {
    type Err = UnknownPartName;

    fn from_str(text: &str) -> Result<PartName, UnknownPartName> {
        let found = Node::ALL.into_iter().find(|node| node.part().name() == text);
        // Files are untrusted: a very long name would make a very long message.
        found.map(PartName).ok_or_else(|| UnknownPartName(text.chars().take(60).collect()))
    }
}

impl fmt::Display for PartName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0.part().name())
    }
}

impl<'de> Deserialize<'de> for PartName {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<PartName, D::Error> {
        String::deserialize(from)?.parse().map_err(D::Error::custom)
    }
}

impl Serialize for PartName {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(self.0.part().name())
    }
}

impl JsonSchema for PartName {
    fn schema_name() -> Cow<'static, str> {
        "PartName".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A body part, by its VRM 1.0 name.",
            "type": "string",
            "enum": Node::ALL.map(|node| node.part().name()),
        })
    }
}
