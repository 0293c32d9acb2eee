//! What differs between two texts of a scene.

use crate::scene::NAMED;
use toml::{Table, Value};

/// A text that was read before as a table.
pub(super) fn table(text: &str) -> Table {
    text.parse().unwrap_or_default()
}

/// Paths of what differs: of tables their entries, of lists the whole.
pub(super) fn differences(old: &Table, new: &Table) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    compare(&Value::Table(old.clone()), &Value::Table(new.clone()), &mut Vec::new(), &mut found);
    found
}

fn compare(old: &Value, new: &Value, path: &mut Vec<String>, found: &mut Vec<Vec<String>>) {
    let (Value::Table(one), Value::Table(other)) = (old, new) else {
        if old != new {
            found.push(path.clone());
        }
        return;
    };
    let keys: std::collections::BTreeSet<&String> = one.keys().chain(other.keys()).collect();
    for key in keys {
        path.push(key.clone());
        match (one.get(key), other.get(key)) {
            (Some(old), Some(new)) => compare(old, new, path, found),
            // What the scene names comes and goes as a whole; other tables key by key.
            (Some(Value::Table(gone)), None) if !is_named(path) => {
                compare(&Value::Table(gone.clone()), &Value::Table(Table::new()), path, found);
            }
            (None, Some(Value::Table(come))) if !is_named(path) => {
                compare(&Value::Table(Table::new()), &Value::Table(come.clone()), path, found);
            }
            _ => found.push(path.clone()),
        }
        path.pop();
    }
}

/// Whether a path is that of something with a name: a character, a prop.
fn is_named(path: &[String]) -> bool {
    matches!(path, [list, _] if NAMED.contains(&list.as_str()))
}

/// Takes a value over by its path, or its absence.
pub(super) fn put(running: &mut Table, keys: &[&str], wanted: &Table) {
    let Some((first, rest)) = keys.split_first() else { return };
    let new = wanted.get(*first);
    match (rest.is_empty(), new) {
        (false, Some(Value::Table(inside))) => {
            let entry = running.entry((*first).to_owned()).or_insert_with(|| Value::Table(Table::new()));
            if let Value::Table(table) = entry {
                put(table, rest, inside);
            }
        }
        (false, None) => {
            if let Some(Value::Table(table)) = running.get_mut(*first) {
                put(table, rest, &Table::new());
            }
        }
        (_, Some(value)) => drop(running.insert((*first).to_owned(), value.clone())),
        (true, None) => drop(running.remove(*first)),
    }
}
