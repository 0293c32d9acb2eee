//! The number of decimals that a file uses.

/// Maximum number of printed decimals: more than an `f64` of everyday size holds.
const MAX_DECIMALS: usize = 15;
/// Default number of decimals if the file does not show its precision.
const DEFAULT: usize = 6;

/// The decimals of one kind of values (positions, rotations) of a file, gathered word by word.
///
/// One number serves the whole kind and not each column, because a column that never changes is often written `0`
/// and says nothing about the precision that the file's user expects.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Decimals {
    most: usize,
    exponents: bool,
}

impl Decimals {
    /// Takes a word of the file into account.
    pub(crate) fn add(&mut self, word: &[u8]) {
        let mantissa = match word.iter().position(|byte| matches!(byte, b'e' | b'E')) {
            Some(at) => {
                self.exponents = true;
                &word[..at]
            }
            None => word,
        };
        if let Some(point) = mantissa.iter().position(|&byte| byte == b'.') {
            self.most = self.most.max(mantissa.len() - point - 1);
        }
    }

    /// The number of decimals to print: the maximum that the file uses. Files with exponents get at least six, and so
    /// do files with whole numbers or a bare `.0`, which do not show a precision.
    pub(crate) fn count(self) -> usize {
        if self.exponents || self.most < 2 {
            self.most.clamp(DEFAULT, MAX_DECIMALS)
        } else {
            self.most.min(MAX_DECIMALS)
        }
    }
}

/// Appends the value, or the file's own text if it is equal to the value at this precision.
pub(crate) fn replace(text: &mut Vec<u8>, word: &[u8], old: f64, value: f64, decimals: usize) {
    let half_a_digit = (0..decimals).fold(0.5, |digit, _| digit / 10.0);
    if (value - old).abs() < half_a_digit {
        text.extend_from_slice(word);
    } else {
        text.extend_from_slice(fixed(value, decimals).as_bytes());
    }
}

/// The value with this number of decimals, without a minus before zero.
pub(crate) fn fixed(value: f64, decimals: usize) -> String {
    let printed = format!("{value:.decimals$}");
    match printed.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|byte| matches!(byte, b'0' | b'.')) => rest.to_owned(),
        _ => printed,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_most_precise_word_rules() {
        let count = |words: &[&str]| {
            let mut decimals = Decimals::default();
            words.iter().for_each(|word| decimals.add(word.as_bytes()));
            decimals.count()
        };
        assert_eq!(count(&["0", "1.25", "-3.1234"]), 4);
        assert_eq!(count(&["0", "0.0"]), 6);
        assert_eq!(count(&["1.5", "1.07375e-014"]), 6);
        assert_eq!(count(&["1.2345678e+00"]), 7);
        assert_eq!(count(&["0.12345678901234567890"]), 15);
    }
}
