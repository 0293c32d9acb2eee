//! Errors of a scene: place, problem and remedy.

/// An invalid scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneError {
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

/// A problem at a key, before its file and line are looked up.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Fault {
    /// Keys and indices from the top of the scene.
    pub path: Vec<String>,
    /// What is wrong and what to do.
    pub problem: String,
}

impl Fault {
    pub(crate) fn at<S: ToString>(path: &[S], problem: impl Into<String>) -> Fault {
        Fault { path: path.iter().map(S::to_string).collect(), problem: problem.into() }
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
