//! The library's messages name fields; whoever types reads the options instead.

/// Fields as the library's messages name them, and the options that set them.
const OPTIONS: [(&str, &str); 16] = [
    ("ReadOptions::unit_m", "--units"),
    ("GroundJob::floor_m", "--floor"),
    ("ReachJob::target", "--target X:Y:Z"),
    ("ReachJob::moving", "--moving X:Y:Z@SECONDS"),
    ("ReachJob::from_secs", "--from"),
    ("Style::print off", "no --print"),
    ("Excerpt::cycle", "--cycle FIRST..LAST"),
    ("Excerpt::repeat", "--repeat"),
    ("ReadOptions::animation", "--animation NAME"),
    ("ReadOptions::person", "--person NAME"),
    ("ReadOptions::parts", "--part PART=JOINT"),
    ("ReadOptions::skeleton", "--skeleton FILE.asf"),
    ("ServerSettings::name", "--name HOST"),
    ("ServerSettings::bind", "--bind"),
    ("Take::write", "--take"),
    ("other values set", "other --set values"),
];

/// A message with options in place of fields.
pub(crate) fn with_options(text: &str) -> String {
    OPTIONS.iter().fold(text.to_owned(), |text, (field, option)| text.replace(field, option))
}

#[cfg(test)]
mod tests {
    use super::with_options;
    use sinew::jobs::reach::ReachError;

    #[test]
    fn messages_name_options_and_not_fields() {
        let text = with_options(&ReachError::NoTarget.to_string());
        assert!(text.contains("--target X:Y:Z") && !text.contains("ReachJob"), "{text}");
        let text = with_options(&ReachError::ClipEnds { ends_secs: 1.0, from_secs: 2.0 }.to_string());
        assert!(text.starts_with("--from: the clip ends"), "{text}");
    }
}
