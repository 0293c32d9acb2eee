//! The lines of a take file.

use serde::{Deserialize, Serialize};
use sinew_control::Command;

/// The first line.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Header {
    /// Always `take`: tells the file from other JSON.
    pub sinew: String,
    pub format: u32,
    pub version: String,
    pub scene: String,
    pub seed: u64,
    pub physics_hz: u32,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sets: Vec<(String, String)>,
}

/// The part of a header that every version has.
#[derive(Deserialize)]
pub(super) struct AnyHeader {
    pub sinew: String,
    pub format: u32,
    #[serde(default)]
    pub version: String,
}

/// A file: as text, as base64, or only its hash.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileLine {
    pub file: String,
    pub hash: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub text: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base64: Option<String>,
}

/// A command.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CommandLine {
    pub step: u64,
    pub command: Command,
}

/// The last line.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct EndLine {
    pub steps: u64,
    pub hash: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub every_steps: Option<u64>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub hashes: Vec<String>,
}

/// 16 hexadecimal digits: JSON's numbers have only 53 bits for many readers.
pub(super) fn hex(hash: u64) -> String {
    format!("{hash:016x}")
}

pub(super) fn from_hex(text: &str) -> Option<u64> {
    let sound = text.len() == 16 && text.bytes().all(|byte| byte.is_ascii_digit() || (b'a'..=b'f').contains(&byte));
    if sound { u64::from_str_radix(text, 16).ok() } else { None }
}
