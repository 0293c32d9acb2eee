//! Translates serde's errors for authors of scenes.

use super::SceneErrorKind;
use super::error::{Fault, known, shortened};

/// A fault from an error of serde at a path.
pub(super) fn fault(error: serde_path_to_error::Error<toml::de::Error>) -> Fault {
    use serde_path_to_error::Segment;
    let mut path: Vec<String> = error
        .path()
        .iter()
        .filter_map(|segment| match segment {
            Segment::Seq { index } => Some(index.to_string()),
            Segment::Map { key } => Some(key.clone()),
            Segment::Enum { .. } | Segment::Unknown => None,
        })
        .collect();
    let message = error.inner().message().trim().to_owned();
    let problem = problem(&message, &mut path);
    Fault { path, problem, kind: SceneErrorKind::Malformed }
}

/// The message in our words; an unknown key is added to the path where it is not its end yet.
fn problem(message: &str, path: &mut Vec<String>) -> String {
    let (first, rest) = message.split_once('\n').unwrap_or((message, ""));
    let message = if rest.is_empty() { first } else { message };
    if let Some(rest) = message.strip_prefix("unknown field ") {
        let (key, others) = quoted(rest);
        if path.last() != Some(&key) {
            path.push(key.clone());
        }
        return format!("unknown key; {}", known(&key, others.iter().map(String::as_str)));
    }
    if let Some(rest) = message.strip_prefix("unknown variant ") {
        let (word, others) = quoted(rest);
        return format!(
            "`{}` is not known here; {}",
            shortened(&word),
            known(&word, others.iter().map(String::as_str))
        );
    }
    if let Some(rest) = message.strip_prefix("missing field ") {
        let (key, _) = quoted(rest);
        return format!("the key `{key}` is missing; add it");
    }
    let plain = message
        .replace("floating point", "number")
        .replace("expected f64", "expected a number")
        .replace("expected u32", "expected a whole number from 0")
        .replace("expected u64", "expected a whole number from 0")
        .replace("expected an array of length", "expected a list of length")
        .replace("expected a sequence", "expected a list")
        .replace("expected a map", "expected a table")
        .replace("invalid type: map", "invalid type: table")
        .replace("invalid type: sequence", "invalid type: list");
    match plain.strip_prefix("invalid type: ").or_else(|| plain.strip_prefix("invalid value: ")) {
        Some(rest) => format!("this is {}", limited(rest)),
        None => limited(&plain),
    }
}

/// The pieces between backticks: the first, and the others.
fn quoted(text: &str) -> (String, Vec<String>) {
    let mut pieces = text.split('`').skip(1).step_by(2).map(str::to_owned);
    let first = pieces.next().unwrap_or_default();
    (first, pieces.collect())
}

fn limited(text: &str) -> String {
    let mut short: String = text.chars().take(400).map(|c| if c.is_control() { ' ' } else { c }).collect();
    if text.chars().nth(400).is_some() {
        short.push('…');
    }
    short
}
