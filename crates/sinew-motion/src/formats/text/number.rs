//! Parses finite numbers; anything else (NaN, infinite, too large, malformed) is an error that names the problem.

use super::{Span, fault, show};
use crate::Error;

/// Maximum absolute value: no length, angle or time of a motion file is larger, and products of larger numbers could
/// overflow.
const MAX_VALUE: f64 = 1e12;

/// The number in a word. `what` names it for the message, such as "OFFSET of Hips".
///
/// # Errors
/// A word that is not a number, a decimal comma, `nan`, `inf`, and anything beyond 1e12.
pub(crate) fn number(bytes: &[u8], word: Span, what: impl FnOnce() -> String) -> Result<f64, Error> {
    let token = word.of(bytes);
    let parsed = std::str::from_utf8(token).ok().and_then(|text| text.parse::<f64>().ok());
    match parsed {
        // Also false for NaN.
        Some(value) if value.abs() <= MAX_VALUE => Ok(value),
        other => Err(refuse(bytes, word, other, &what())),
    }
}

#[cold]
fn refuse(bytes: &[u8], word: Span, parsed: Option<f64>, what: &str) -> Error {
    let token = word.of(bytes);
    let shown = show(token);
    let (problem, remedy) = match parsed {
        Some(value) if value.is_finite() => {
            (format!("{what} is {shown}, which is too large"), "check the export: no value may exceed 1e12")
        }
        Some(_) => (format!("{what} is {shown}, which is not a finite number"), "repair the value or cut the frames"),
        None if token.contains(&b',') && token.iter().all(|byte| !byte.is_ascii_alphabetic()) => (
            format!("{what} is {shown}, with a comma"),
            "write numbers with a decimal point and blanks between them (export with an English locale)",
        ),
        None => (format!("{what} is {shown}, which is not a number"), "repair the value or export the file again"),
    };
    fault(bytes, word.start, problem, remedy)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<f64, Error> {
        number(text.as_bytes(), Span::new(0, text.len()), || "it".to_owned())
    }

    #[test]
    fn numbers_of_every_exporter_are_read() {
        for (text, value) in [
            (".0083333", 0.0083333),
            ("-.5", -0.5),
            ("1.", 1.0),
            ("+2", 2.0),
            ("1.07375e-014", 1.07375e-14),
            ("-9.23872e-007", -9.23872e-7),
            ("1E+02", 100.0),
            ("1e-400", 0.0),
        ] {
            assert_eq!(read(text), Ok(value), "{text}");
        }
    }

    #[test]
    fn words_that_are_no_finite_number_say_why() {
        for (text, problem) in [
            ("nan", "not a finite number"),
            ("-inf", "not a finite number"),
            ("1e999", "not a finite number"),
            ("1e13", "too large"),
            ("0,5", "with a comma"),
            ("-1.#IND", "not a number"),
            ("-", "not a number"),
        ] {
            assert!(read(text).is_err_and(|error| error.problem().contains(problem)), "{text}");
        }
    }
}
