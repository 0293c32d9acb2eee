//! Checks of numbers and names, worded.

use super::SceneErrorKind as Kind;
use super::error::{Fault, known, shortened};
use std::ops::RangeInclusive;

/// A number within a range; `hint` says what is expected.
pub(super) fn number<S: ToString>(path: &[S], value: f64, range: RangeInclusive<f64>, hint: &str) -> Result<(), Fault> {
    if range.contains(&value) {
        return Ok(());
    }
    let problem = format!("{value} is out of range {} to {}; {hint}", range.start(), range.end());
    Err(Fault::at(path, problem).of_kind(Kind::OutOfRange))
}

/// The same where a value may be missing.
pub(super) fn optional<S: ToString>(
    path: &[S],
    value: Option<f64>,
    range: RangeInclusive<f64>,
    hint: &str,
) -> Result<(), Fault> {
    value.map_or(Ok(()), |value| number(path, value, range, hint))
}

/// Three numbers, none beyond `most` in size.
pub(super) fn vector<S: ToString>(path: &[S], value: [f64; 3], most: f64, hint: &str) -> Result<(), Fault> {
    value.into_iter().try_for_each(|value| number(path, value, -most..=most, hint))
}

/// Not more of something than allowed.
pub(super) fn count<S: ToString>(path: &[S], count: usize, most: usize) -> Result<(), Fault> {
    if count <= most {
        return Ok(());
    }
    let problem = format!("{count} are more than the {most} allowed; leave some out");
    Err(Fault::at(path, problem).of_kind(Kind::TooLarge))
}

/// A name that exists.
pub(super) fn name<'a, S: ToString>(
    path: &[S],
    what: &str,
    wanted: &str,
    names: impl IntoIterator<Item = &'a str> + Clone,
) -> Result<(), Fault> {
    if names.clone().into_iter().any(|name| name == wanted) {
        return Ok(());
    }
    let problem = format!("no {what} `{}`; {}", shortened(wanted), known(wanted, names));
    Err(Fault::at(path, problem).of_kind(Kind::NotFound))
}

/// A name that something new may bear.
pub(super) fn new_name<S: ToString>(path: &[S], name: &str) -> Result<(), Fault> {
    let problem = if name.is_empty() || name.len() > 64 {
        "a name has 1 to 64 bytes"
    } else if name.contains('.') {
        "a name holds no `.`, which stands between a character and its part (`left.leftHand`)"
    } else if name.chars().any(char::is_control) {
        "a name holds no control characters"
    } else if name == GROUND {
        "`ground` is the floor's own name"
    } else {
        return Ok(());
    };
    Err(Fault::at(path, format!("{problem}; choose another")))
}

/// What the floor is called.
pub(super) const GROUND: &str = "ground";

/// `#rrggbb`.
pub(super) fn colour<S: ToString>(path: &[S], text: Option<&str>) -> Result<(), Fault> {
    match text {
        Some(text) if rgb(text).is_none() => {
            Err(Fault::at(path, format!("`{}` is no colour; write `#rrggbb`, such as \"#4f7cac\"", shortened(text))))
        }
        _ => Ok(()),
    }
}

/// The three bytes of `#rrggbb`.
pub(super) fn rgb(text: &str) -> Option<[u8; 3]> {
    let digits = text.strip_prefix('#').filter(|digits| digits.len() == 6)?;
    if !digits.bytes().all(|byte| byte.is_ascii_hexdigit()) {
        return None;
    }
    let value = u32::from_str_radix(digits, 16).ok()?;
    let [_, red, green, blue] = value.to_be_bytes();
    Some([red, green, blue])
}
