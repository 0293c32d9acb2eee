//! Errors of motion files: the place, the problem and the remedy.

use std::fmt;
use std::path::{Path, PathBuf};

/// Where in a file something is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// The file as a whole.
    File,
    /// A line, from 1.
    Line(usize),
    /// A byte, from 0, of a binary file.
    Byte(u64),
    /// An element of a structured file, such as `animations[0].channels[3]`.
    Element(String),
}

/// A motion file that cannot be read or written: the file, the place, what is wrong, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    file: Option<PathBuf>,
    place: Place,
    problem: String,
    remedy: String,
}

impl Error {
    /// An error at a place, with its remedy.
    pub fn new(place: Place, problem: impl Into<String>, remedy: impl Into<String>) -> Error {
        Error { file: None, place, problem: problem.into(), remedy: remedy.into() }
    }

    /// The same error, naming its file if none is named yet.
    #[must_use]
    pub fn in_file(mut self, file: &Path) -> Error {
        self.file.get_or_insert_with(|| file.to_owned());
        self
    }

    /// An input or output error of the operating system.
    pub fn io(file: &Path, error: &std::io::Error) -> Error {
        Error::new(Place::File, error.to_string(), "check the path and its permissions").in_file(file)
    }

    /// Where it is wrong.
    pub fn place(&self) -> &Place {
        &self.place
    }

    /// What is wrong.
    pub fn problem(&self) -> &str {
        &self.problem
    }

    /// What to do about it.
    pub fn remedy(&self) -> &str {
        &self.remedy
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{}", file.display())?;
        }
        match &self.place {
            Place::File if self.file.is_some() => write!(f, ": ")?,
            Place::File => {}
            Place::Line(line) if self.file.is_some() => write!(f, ":{line}: ")?,
            Place::Line(line) => write!(f, "line {line}: ")?,
            Place::Byte(byte) => write!(f, " at byte {byte}: ")?,
            Place::Element(element) => write!(f, " in {element}: ")?,
        }
        write!(f, "{}; {}", self.problem, self.remedy)
    }
}

impl std::error::Error for Error {}
