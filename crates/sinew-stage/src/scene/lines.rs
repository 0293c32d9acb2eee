//! From a key of a TOML text to its line.

use toml::de::{DeTable, DeValue};

/// Lines of the entries of a list of tables.
pub(super) fn lines_of(text: &str, list: &str) -> Vec<usize> {
    let Ok(table) = DeTable::parse(text) else { return Vec::new() };
    let found = table.get_ref().iter().find(|(key, _)| key.get_ref() == list);
    let Some(DeValue::Array(items)) = found.map(|(_, value)| value.get_ref()) else { return Vec::new() };
    let lines = Lines::of(text);
    items.iter().map(|item| lines.at(item.span().start)).collect()
}

/// Line of the deepest key of a path that the text has.
pub(super) fn line_of(text: &str, path: &[&str]) -> Option<usize> {
    let table = DeTable::parse(text).ok()?;
    let mut found = None;
    let mut inside = Inside::Table(table.get_ref());
    for key in path {
        let value = match inside {
            Inside::Table(table) => {
                let Some((name, value)) = table.iter().find(|(name, _)| name.get_ref() == key) else { break };
                found = Some(name.span().start);
                value
            }
            Inside::List(list) => {
                let Some(value) = key.parse().ok().and_then(|index: usize| list.get(index)) else { break };
                found = Some(value.span().start);
                value
            }
        };
        inside = match value.get_ref() {
            DeValue::Table(table) => Inside::Table(table),
            DeValue::Array(list) => Inside::List(list),
            _ => break,
        };
    }
    found.map(|at| line_at(text, at))
}

enum Inside<'a> {
    Table(&'a DeTable<'a>),
    List(&'a toml::de::DeArray<'a>),
}

/// The line of a byte.
pub(super) fn line_at(text: &str, at: usize) -> usize {
    1 + text.as_bytes().iter().take(at).filter(|&&byte| byte == b'\n').count()
}

/// Where lines begin.
struct Lines(Vec<usize>);

impl Lines {
    fn of(text: &str) -> Lines {
        Lines(text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(at, _)| at).collect())
    }

    fn at(&self, byte: usize) -> usize {
        1 + self.0.partition_point(|&end| end < byte)
    }
}
