//! The paths that Rust source names, for the test that holds crates to their rows in ARCHITECTURE.md.
//!
//! A scanner of our own and not the library `syn`: nothing in this package depends on anything, so that the check itself is
//! built in a moment. It reads `use` trees and paths in code; macros of other crates are not expanded.

use std::collections::BTreeSet;

/// Every path of at least one segment that a source names, such as `std::net::UdpSocket`: `use` trees are spelled out, comments
/// and literals are left out.
///
/// ```
/// let paths = xtask::imports::paths("use std::{fs, net::{self, UdpSocket as Udp}}; // std::env\nlet x = a::b(\"c::d\");");
/// assert!(["std::fs", "std::net::UdpSocket", "a::b"].iter().all(|path| paths.contains(*path)));
/// assert!(!paths.iter().any(|path| path.starts_with("std::env") || path.starts_with("c")));
/// ```
pub fn paths(source: &str) -> BTreeSet<String> {
    let tokens = tokens(&without_comments_and_literals(source));
    let mut found = BTreeSet::new();
    let mut at = 0;
    while at < tokens.len() {
        let before = at;
        tree(&tokens, &mut at, "", &mut found);
        at = at.max(before + 1);
    }
    found
}

/// Whether a path is `forbidden` or lies below it.
pub fn is_below(path: &str, forbidden: &str) -> bool {
    path.strip_prefix(forbidden).is_some_and(|rest| rest.is_empty() || rest.starts_with("::"))
}

/// Reads a path from `at` on, and the group in braces at its end if it has one.
fn tree(tokens: &[String], at: &mut usize, prefix: &str, found: &mut BTreeSet<String>) {
    let mut path = prefix.to_owned();
    let mut is_segment_due = true;
    while let Some(token) = tokens.get(*at) {
        match token.as_str() {
            "::" if !is_segment_due || path.is_empty() => is_segment_due = true,
            "{" if is_segment_due && !path.is_empty() => {
                *at += 1;
                while tokens.get(*at).is_some_and(|token| token != "}") {
                    let before = *at;
                    tree(tokens, at, &path, found);
                    *at = (*at).max(before + 1);
                }
                *at += 1;
                return;
            }
            word if is_segment_due && is_identifier(word) => {
                if word != "self" || path.is_empty() {
                    path = if path.is_empty() { word.to_owned() } else { format!("{path}::{word}") };
                }
                is_segment_due = false;
            }
            _ => break,
        }
        *at += 1;
    }
    if !path.is_empty() {
        found.insert(path);
    }
}

fn is_identifier(token: &str) -> bool {
    token.starts_with(|first: char| first.is_alphabetic() || first == '_')
}

/// Identifiers, `::`, and single characters.
fn tokens(code: &str) -> Vec<String> {
    let mut tokens = Vec::new();
    let mut rest = code.trim_start();
    while let Some(first) = rest.chars().next() {
        let is_part = |c: char| c.is_alphanumeric() || c == '_';
        let length = if is_part(first) {
            rest.find(|c| !is_part(c)).unwrap_or(rest.len())
        } else if rest.starts_with("::") {
            2
        } else {
            first.len_utf8()
        };
        let (token, after) = rest.split_at(length);
        tokens.push(token.to_owned());
        rest = after.trim_start();
    }
    tokens
}

/// The code alone. A literal becomes a blank.
fn without_comments_and_literals(source: &str) -> String {
    let mut code = String::new();
    let mut rest = source;
    while let Some(first) = rest.chars().next() {
        let is_raw = rest.starts_with("r\"") || rest.starts_with("r#");
        let is_inside_word = code.ends_with(|c: char| c.is_alphanumeric() || c == '_');
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            block_comment(rest)
        } else if is_raw && !is_inside_word && raw_string(rest).is_some() {
            raw_string(rest).unwrap_or(1)
        } else if first == '"' {
            quoted(rest, '"')
        } else if first == '\'' {
            character(rest)
        } else {
            code.push(first);
            rest = &rest[first.len_utf8()..];
            continue;
        };
        code.push(' ');
        rest = &rest[length..];
    }
    code
}

/// Length of a comment between `/*` and `*/`, which may hold others.
fn block_comment(text: &str) -> usize {
    let (mut depth, mut at) = (0, 0);
    while at < text.len() {
        let here = &text.as_bytes()[at..];
        let step = if here.starts_with(b"/*") {
            depth += 1;
            2
        } else if here.starts_with(b"*/") {
            depth -= 1;
            2
        } else {
            1
        };
        at += step;
        if depth == 0 {
            return at;
        }
    }
    text.len()
}

/// Length of `r"..."` or `r#"..."#`; `None` for something else that begins with `r#`.
fn raw_string(text: &str) -> Option<usize> {
    let hashes = text[1..].bytes().take_while(|byte| *byte == b'#').count();
    let begin = 1 + hashes + 1;
    text.as_bytes().get(begin - 1).filter(|byte| **byte == b'"')?;
    let end = format!("\"{}", "#".repeat(hashes));
    Some(text[begin..].find(&end).map_or(text.len(), |at| begin + at + end.len()))
}

/// Length of a literal that ends with the quote with which it begins; a backslash takes the next character along.
fn quoted(text: &str, quote: char) -> usize {
    let mut is_escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        match c {
            _ if is_escaped => is_escaped = false,
            '\\' => is_escaped = true,
            _ if c == quote => return at + c.len_utf8(),
            _ => {}
        }
    }
    text.len()
}

/// Length of a character literal; 1 for the quote of a lifetime.
fn character(text: &str) -> usize {
    let mut chars = text.chars().skip(1);
    match (chars.next(), chars.next()) {
        (Some('\\'), _) => quoted(text, '\''),
        (Some(c), Some('\'')) => 2 + c.len_utf8(),
        _ => 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_in_a_comment_or_a_literal_is_not_named() {
        let source = r####"
            /* std::fs /* std::env */ std::net */ // std::process
            let a = "std::fs \" std::net"; let b = r#"std::env " std::fs"#; let c = '"'; let d: &'static str = x::y;
        "####;
        let found = paths(source);
        assert!(!found.iter().any(|path| is_below(path, "std")), "{found:?}");
        assert!(found.contains("x::y"));
    }

    #[test]
    fn nested_groups_and_paths_over_several_lines_are_spelled_out() {
        let found = paths("pub use a::{b::{c, d as e}, f,\n g::*};\nlet _ = h\n::i::<j::k>();");
        for path in ["a::b::c", "a::b::d", "a::f", "a::g", "h::i", "j::k"] {
            assert!(found.contains(path), "{path} is not in {found:?}");
        }
    }

    #[test]
    fn a_longer_name_is_not_below_a_shorter_one() {
        assert!(is_below("std::net", "std::net") && is_below("std::net::UdpSocket", "std::net"));
        assert!(!is_below("std::network", "std::net"));
    }
}
