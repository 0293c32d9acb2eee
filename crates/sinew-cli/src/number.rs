//! Numbers in a range: clap names the flag, this says what to give.

/// A parser of numbers from `FROM` to `TO`, both in hundredths.
pub(crate) fn within<const FROM: i64, const TO: i64>(text: &str) -> Result<f64, String> {
    let (from, to) = (FROM as f64 / 100.0, TO as f64 / 100.0);
    let value: Option<f64> = text.trim().parse().ok();
    value.filter(|value| (from..=to).contains(value)).ok_or_else(|| format!("give a number from {from} to {to}"))
}

#[cfg(test)]
mod tests {
    use super::within;

    #[test]
    fn only_numbers_in_the_range_are_taken() {
        let parse = within::<25, 400>;
        assert_eq!(parse("0.25"), Ok(0.25));
        for text in ["0.2", "5", "nan", "inf", "much", ""] {
            assert_eq!(parse(text), Err("give a number from 0.25 to 4".to_owned()), "{text}");
        }
    }
}
