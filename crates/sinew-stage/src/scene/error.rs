//! Errors of a scene: place, problem and remedy.

use super::{FileError, FileErrorKind};
use sinew_control::{OrderError, OrderErrorKind};

/// What kind of trouble a [`SceneError`] is, for a program to match on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum SceneErrorKind {
    /// A file or a name that is not there.
    NotFound,
    /// A number beyond its range, NaN or infinite.
    OutOfRange,
    /// A file, a text or a list beyond its limit.
    TooLarge,
    /// Another version of the format.
    WrongVersion,
    /// The text is no TOML, no UTF-8, or a file cannot be read.
    Unreadable,
    /// A key that is missing or not known, or a value of another type.
    Malformed,
    /// Values that make no sense, or not together.
    Invalid,
}

/// A scene that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneError {
    /// What kind of trouble it is.
    pub kind: SceneErrorKind,
    /// The file, as it was named.
    pub file: String,
    /// The line of the offending key, counted from 1.
    pub line: Option<usize>,
    /// The offending key's path, as `--set` would name it: `characters.left.mass_kg`. Empty for the whole file.
    pub path: String,
    /// What is wrong with it and what to do.
    pub problem: String,
}

impl std::error::Error for SceneError {}

impl std::fmt::Display for SceneError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.file)?;
        if let Some(line) = self.line {
            write!(f, ", line {line}")?;
        }
        if !self.path.is_empty() {
            write!(f, ": {}", self.path)?;
        }
        write!(f, ": {}", self.problem)
    }
}

impl From<FileErrorKind> for SceneErrorKind {
    fn from(kind: FileErrorKind) -> SceneErrorKind {
        match kind {
            FileErrorKind::NotFound => SceneErrorKind::NotFound,
            FileErrorKind::TooLarge => SceneErrorKind::TooLarge,
            FileErrorKind::NotAllowed => SceneErrorKind::Invalid,
            FileErrorKind::Unreadable | FileErrorKind::Changed => SceneErrorKind::Unreadable,
        }
    }
}

/// A problem at a key, before its file and line are looked up.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Fault {
    /// Keys and indices from the top of the scene.
    pub path: Vec<String>,
    /// What is wrong and what to do.
    pub problem: String,
    /// What kind of trouble it is.
    pub kind: SceneErrorKind,
}

impl Fault {
    pub(crate) fn at<S: ToString>(path: &[S], problem: impl Into<String>) -> Fault {
        let path = path.iter().map(S::to_string).collect();
        Fault { path, problem: problem.into(), kind: SceneErrorKind::Invalid }
    }

    /// The same of another kind.
    #[must_use]
    pub(crate) fn of_kind(self, kind: SceneErrorKind) -> Fault {
        Fault { kind, ..self }
    }

    /// What cannot be understood as a command, or as a name of one.
    pub(crate) fn of_order<S: ToString>(path: &[S], error: &OrderError) -> Fault {
        Fault::at(path, error.problem()).of_kind(match error.kind() {
            OrderErrorKind::NotFound => SceneErrorKind::NotFound,
            OrderErrorKind::OutOfRange => SceneErrorKind::OutOfRange,
            OrderErrorKind::TooLarge => SceneErrorKind::TooLarge,
            _ => SceneErrorKind::Invalid,
        })
    }

    /// A file that the scene does not get; `name` is how it names it.
    pub(crate) fn of_file<S: ToString>(path: &[S], name: &str, error: &FileError) -> Fault {
        Fault::at(path, format!("`{}`: {}", shortened(name), error.problem)).of_kind(error.kind.into())
    }

    /// The same fault, one level further out.
    #[must_use]
    pub(crate) fn below<S: ToString>(mut self, outer: &[S]) -> Fault {
        self.path.splice(0..0, outer.iter().map(S::to_string));
        self
    }
}

/// `known: a, b`, preceded by the nearest name where one is near.
pub(crate) fn known<'a>(wanted: &str, names: impl IntoIterator<Item = &'a str>) -> String {
    let names: Vec<&str> = names.into_iter().collect();
    if names.is_empty() {
        return "there is none".to_owned();
    }
    let near = names
        .iter()
        .map(|name| {
            (strsim::damerau_levenshtein(&clipped(wanted).to_lowercase(), &clipped(name).to_lowercase()), *name)
        })
        .min()
        .filter(|(distance, name)| *distance < name.chars().count() && *distance <= 1 + name.chars().count() / 4);
    let mut listed: Vec<String> = names.iter().take(LISTED).map(|name| shortened(name)).collect();
    if names.len() > LISTED {
        listed.push(format!("and {} more", names.len() - LISTED));
    }
    match near {
        Some((_, name)) => format!("did you mean `{}`? Known: {}", shortened(name), listed.join(", ")),
        None => format!("known: {}", listed.join(", ")),
    }
}

/// Names that a message lists.
const LISTED: usize = 30;

/// Characters of a name that are compared, so that a long one costs nothing.
const COMPARED: usize = 64;

fn clipped(name: &str) -> String {
    name.chars().take(COMPARED).collect()
}

/// A piece of a file, short enough for a message and on one line.
pub(crate) fn shortened(text: &str) -> String {
    let mut short: String = text.chars().take(COMPARED).map(|c| if c.is_control() { ' ' } else { c }).collect();
    if text.chars().nth(COMPARED).is_some() {
        short.push('…');
    }
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_name_finds_its_neighbour_and_a_foreign_one_does_not() {
        assert_eq!(known("gard", ["guard", "stand"]), "did you mean `guard`? Known: guard, stand");
        assert_eq!(known("fly", ["guard", "stand"]), "known: guard, stand");
        assert_eq!(known("z", ["a", "b"]), "known: a, b");
        assert_eq!(known("fly", []), "there is none");
    }

    #[test]
    fn a_long_name_is_cut_in_messages() {
        let long = "x".repeat(10_000);
        assert!(known(&long, [long.as_str()]).chars().count() < 200);
    }
}
