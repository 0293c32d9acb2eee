//! A place in the text of a hierarchy.

use crate::Error;
use crate::formats::text::{Span, fault, is_space, next_line, number, show};

/// A place in a file's bytes from which words are taken; braces are words of their own.
#[derive(Clone, Copy)]
pub(super) struct Cursor<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) at: usize,
}

impl<'a> Cursor<'a> {
    /// Steps over blanks and line ends.
    pub(super) fn skip_space(&mut self) {
        while self.at < self.bytes.len() && is_space(self.bytes[self.at]) {
            self.at += 1;
        }
    }

    /// The next word, or `None` at the end of the file.
    pub(super) fn word(&mut self) -> Option<Span> {
        self.skip_space();
        let start = self.at;
        let first = *self.bytes.get(start)?;
        self.at += 1;
        if first != b'{' && first != b'}' {
            while self.bytes.get(self.at).is_some_and(|&byte| !is_space(byte) && byte != b'{' && byte != b'}') {
                self.at += 1;
            }
        }
        Some(Span::new(start, self.at))
    }

    /// Takes `text` if it stands next, in any case, blanks before it aside.
    pub(super) fn eat(&mut self, text: &str) -> bool {
        let mut ahead = *self;
        ahead.skip_space();
        let end = ahead.at + text.len();
        let found = self.bytes.get(ahead.at..end).is_some_and(|next| next.eq_ignore_ascii_case(text.as_bytes()));
        if found {
            self.at = end;
        }
        found
    }

    /// The rest of the line up to an opening brace, without blanks around it: a joint's name.
    pub(super) fn name(&mut self) -> Span {
        let (line, _) = next_line(self.bytes, self.at);
        let text = line.of(self.bytes);
        // A brace opens the block when it ends the line or follows a blank; elsewhere it is part of the name.
        let last = text.iter().rposition(|&byte| !is_space(byte));
        let opens = |at: usize| text[at] == b'{' && (Some(at) == last || at == 0 || is_space(text[at - 1]));
        let end = (0..text.len()).find(|&at| opens(at)).unwrap_or(text.len());
        let name = &text[..end];
        let start = name.iter().position(|&byte| !is_space(byte)).unwrap_or(end);
        let stop = name.iter().rposition(|&byte| !is_space(byte)).map_or(start, |at| at + 1);
        self.at = line.start + end;
        Span::new(line.start + start, line.start + stop)
    }

    /// The next word as a number; `what` names it in messages.
    pub(super) fn number(&mut self, what: impl Fn() -> String) -> Result<f64, Error> {
        match self.word() {
            Some(word) => number(self.bytes, word, what),
            None => Err(self.ended(&what())),
        }
    }

    /// Takes an opening brace.
    pub(super) fn open_brace(&mut self, after: &str) -> Result<(), Error> {
        match self.word() {
            Some(word) if word.of(self.bytes) == b"{" => Ok(()),
            Some(word) => {
                let problem = format!("an opening brace should follow {after}, not {}", show(word.of(self.bytes)));
                Err(fault(self.bytes, word.start, problem, "add the missing `{`"))
            }
            None => Err(self.ended(&format!("the opening brace of {after}"))),
        }
    }

    /// The file ends where something should stand.
    pub(super) fn ended(&self, missing: &str) -> Error {
        let problem = format!("the file ends before {missing}");
        fault(self.bytes, self.bytes.len(), problem, "the file is truncated: export or copy it again")
    }
}
