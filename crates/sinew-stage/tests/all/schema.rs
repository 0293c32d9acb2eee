//! The committed schema is that of the code, and is closed against unknown keys.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use sinew_stage::scene_schema;
use std::path::{Path, PathBuf};

fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

#[test]
fn the_committed_schema_is_that_of_the_types() {
    let path = scenes().join("scene.schema.json");
    if std::env::var_os("UPDATE_SCHEMA").is_some() {
        std::fs::write(&path, scene_schema()).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(committed == scene_schema(), "run the tests of sinew-stage once with UPDATE_SCHEMA=1");
}

/// Schemars joins a timed entry with its command in a way that a misspelt key could slip through.
#[test]
fn the_schema_closes_entries_of_the_time_line() {
    let schema: serde_json::Value = serde_json::from_str(&scene_schema()).unwrap();
    for entry in ["Timed", "Reaction", "KeyBinding"] {
        let entry = &schema["$defs"][entry];
        assert_eq!(entry["unevaluatedProperties"], false, "{entry}");
        let variants = entry["oneOf"].as_array().unwrap();
        assert!(variants.len() > 20 && variants.iter().all(|variant| variant["additionalProperties"] != false));
        assert!(entry["properties"].get("character").is_some());
    }
    for table in ["CharacterSpec", "PropSpec", "StageSpec", "PoseSpec", "GraphSpec"] {
        assert_eq!(schema["$defs"][table]["additionalProperties"], false, "{table}");
    }
}
