//! Lines and words of a text file, as byte ranges: any line end, any encoding that holds ASCII.

use crate::{Error, Limits, Place};

/// A range of a file's bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Span {
    /// First byte.
    pub(crate) start: usize,
    /// One past the last byte.
    pub(crate) end: usize,
}

impl Span {
    /// The range from `start` up to `end`.
    pub(crate) fn new(start: usize, end: usize) -> Span {
        Span { start, end }
    }

    /// The bytes in this range.
    pub(crate) fn of(self, bytes: &[u8]) -> &[u8] {
        &bytes[self.start..self.end]
    }
}

/// Whether the byte ends a line: LF, CR, or both as CRLF.
pub(crate) fn is_break(byte: u8) -> bool {
    byte == b'\n' || byte == b'\r'
}

/// Whether the byte separates words.
pub(crate) fn is_space(byte: u8) -> bool {
    is_break(byte) || matches!(byte, b' ' | b'\t' | 0x0b | 0x0c)
}

/// The number of the line (from 1) that holds the byte at `at`; linear, so for messages only.
pub(crate) fn line_at(bytes: &[u8], at: usize) -> usize {
    let mut line = 1;
    for (index, &byte) in bytes.iter().enumerate().take(at) {
        if byte == b'\n' || (byte == b'\r' && bytes.get(index + 1) != Some(&b'\n')) {
            line += 1;
        }
    }
    line
}

/// An error at the line that holds the byte at `at`.
pub(crate) fn fault(bytes: &[u8], at: usize, problem: impl Into<String>, remedy: impl Into<String>) -> Error {
    Error::new(Place::Line(line_at(bytes, at)), problem, remedy)
}

/// A piece of a file for a message: quoted, and truncated if it is long.
pub(crate) fn show(piece: &[u8]) -> String {
    const MAX_SHOWN: usize = 40;
    let cut = &piece[..piece.len().min(MAX_SHOWN)];
    let dots = if piece.len() > MAX_SHOWN { "..." } else { "" };
    format!("{:?}{dots}", String::from_utf8_lossy(cut))
}

/// The line from `at` on, without its end, and where the next line starts.
pub(crate) fn next_line(bytes: &[u8], at: usize) -> (Span, usize) {
    let length = bytes[at..].iter().position(|&byte| is_break(byte));
    let Some(end) = length.map(|length| at + length) else {
        return (Span::new(at, bytes.len()), bytes.len());
    };
    let next = if bytes[end] == b'\r' && bytes.get(end + 1) == Some(&b'\n') { end + 2 } else { end + 1 };
    (Span::new(at, end), next)
}

/// The file's first line end, for lines that are new in it.
pub(crate) fn line_end(bytes: &[u8]) -> &[u8] {
    match bytes.iter().position(|&byte| is_break(byte)) {
        Some(at) if bytes[at..].starts_with(b"\r\n") => b"\r\n",
        Some(at) => &bytes[at..at + 1],
        None => b"\n",
    }
}

/// The words in a range, in order.
pub(crate) fn words(bytes: &[u8], range: Span) -> impl Iterator<Item = Span> + '_ {
    let mut at = range.start;
    std::iter::from_fn(move || {
        while at < range.end && is_space(bytes[at]) {
            at += 1;
        }
        let start = at;
        while at < range.end && !is_space(bytes[at]) {
            at += 1;
        }
        (start < at).then_some(Span::new(start, at))
    })
}

/// Where the text starts: after a UTF-8 byte order mark, if there is one.
///
/// # Errors
/// A file that is empty, exceeds the maximum size, or is UTF-16.
pub(crate) fn text_start(bytes: &[u8], limits: &Limits, format: &str) -> Result<usize, Error> {
    if bytes.len() as u64 > limits.file_bytes {
        return Err(Error::new(
            Place::File,
            format!("the file has {} bytes, the limit is {}", bytes.len(), limits.file_bytes),
            "cut the motion into shorter files or raise the limit `file_bytes`",
        ));
    }
    match bytes {
        [] => Err(Error::new(Place::File, format!("the {format} file is empty"), "export it again")),
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => Err(Error::new(
            Place::File,
            "the text is encoded as UTF-16".to_owned(),
            "save it as UTF-8 or plain ASCII text",
        )),
        [0xef, 0xbb, 0xbf, ..] => Ok(3),
        _ => Ok(0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_count_alike_with_any_line_end() {
        for text in ["a\nb\nc", "a\r\nb\r\nc", "a\rb\rc", "a\r\nb\nc", "a\rb\r\nc"] {
            assert_eq!(line_at(text.as_bytes(), text.len() - 1), 3, "{text:?}");
            assert_eq!(line_at(text.as_bytes(), 0), 1);
        }
    }

    #[test]
    fn words_are_what_stands_between_blanks() {
        let text = b" a\tbc \r\n d";
        let found: Vec<&[u8]> = words(text, Span::new(0, text.len())).map(|span| span.of(text)).collect();
        assert_eq!(found, [&b"a"[..], b"bc", b"d"]);
    }
}
