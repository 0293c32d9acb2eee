//! The lines of an ASF, in sections.

use crate::Error;
use crate::formats::text::{Span, fault, next_line, number, words};

/// A line: its words up to a comment.
pub(super) struct Line<'a> {
    pub(super) bytes: &'a [u8],
    /// At least one.
    pub(super) words: Vec<Span>,
}

impl<'a> Line<'a> {
    /// The first word.
    pub(super) fn key(&self) -> &'a [u8] {
        self.words[0].of(self.bytes)
    }

    /// Whether the first word is this, in any case.
    pub(super) fn is(&self, key: &str) -> bool {
        self.key().eq_ignore_ascii_case(key.as_bytes())
    }

    /// The words after the first, as text.
    pub(super) fn rest(&self) -> impl Iterator<Item = &'a [u8]> + '_ {
        self.words[1..].iter().map(|word| word.of(self.bytes))
    }

    /// The word at an index, counted from the first.
    pub(super) fn word(&self, index: usize, what: &str) -> Result<&'a [u8], Error> {
        match self.words.get(index) {
            Some(word) => Ok(word.of(self.bytes)),
            None => Err(self.fault(format!("{what} is missing"), "complete the line")),
        }
    }

    /// The number at an index, counted from the first word.
    pub(super) fn number(&self, index: usize, what: &str) -> Result<f64, Error> {
        self.word(index, what)?;
        number(self.bytes, self.words[index], || what.to_owned())
    }

    /// Three numbers after the first word.
    pub(super) fn triple(&self, what: &str) -> Result<glam::DVec3, Error> {
        Ok(glam::DVec3::new(self.number(1, what)?, self.number(2, what)?, self.number(3, what)?))
    }

    /// An error at this line.
    pub(super) fn fault(&self, problem: impl Into<String>, remedy: impl Into<String>) -> Error {
        fault(self.bytes, self.words[0].start, problem, remedy)
    }
}

/// The lines of a file that hold words, without comments (from a `#` that starts a word to the end of the line).
pub(super) fn lines(bytes: &[u8], start: usize) -> impl Iterator<Item = Line<'_>> + '_ {
    let mut at = start;
    std::iter::from_fn(move || {
        while at < bytes.len() {
            let (line, next) = next_line(bytes, at);
            at = next;
            let words: Vec<Span> = words(bytes, line).take_while(|word| bytes[word.start] != b'#').collect();
            if !words.is_empty() {
                return Some(Line { bytes, words });
            }
        }
        None
    })
}
