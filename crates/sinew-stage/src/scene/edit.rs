//! A scene's text that is edited: comments, order and spacing stay as their author wrote them.

use super::{SceneError, SceneErrorKind};
use toml_edit::{DocumentMut, Item, Table, Value};

/// The text of a scene file that is being edited.
///
/// ```
/// use sinew_stage::scene::SceneDocument;
/// let mut document = SceneDocument::parse("format = 1\n\n# the boxer\n[characters.left]\npose_gain = 1 # soft\n")?;
/// document.set("characters.left.pose_gain", "2.5")?;
/// document.set("characters.left.reflexes", "[\"balance\"]")?;
/// assert_eq!(
///     document.to_string(),
///     "format = 1\n\n# the boxer\n[characters.left]\npose_gain = 2.5 # soft\nreflexes = [\"balance\"]\n"
/// );
/// assert!(document.remove("characters.left.reflexes")?);
/// # Ok::<(), sinew_stage::SceneError>(())
/// ```
#[derive(Clone, Debug)]
pub struct SceneDocument {
    document: DocumentMut,
}

/// Deepest path that can be set.
const MAX_DEPTH: usize = 32;

/// Largest text that is edited \[bytes\].
const MAX_BYTES: usize = 4 << 20;

impl SceneDocument {
    /// Reads a text. Whether it is a sound scene is not asked yet: [`Stage::edit`](crate::Stage::edit) or
    /// [`Scene::load`](super::Scene::load) does that.
    ///
    /// # Errors
    /// A text that is no TOML, or larger than 4 MiB.
    pub fn parse(text: &str) -> Result<SceneDocument, SceneError> {
        if text.len() > MAX_BYTES {
            let problem = format!("the text is larger than {MAX_BYTES} bytes; make it smaller");
            return Err(SceneError { kind: SceneErrorKind::TooLarge, ..wrong("", problem) });
        }
        match text.parse::<DocumentMut>() {
            Ok(document) => Ok(SceneDocument { document }),
            Err(error) => {
                let line = error.span().map(|span| super::lines::line_at(text, span.start));
                let problem = format!("this is no TOML: {}; correct the line", error.message().trim());
                Err(SceneError { kind: SceneErrorKind::Unreadable, line, ..wrong("", problem) })
            }
        }
    }

    /// Sets a value by its path, as `characters.left.pose_gain`; entries of lists are counted from 0, as `at.0.time_secs`. Tables on
    /// the way are made. The value is written as in the file; a text may come without its quotes.
    ///
    /// # Errors
    /// A path that leads through something that is no table.
    pub fn set(&mut self, path: &str, value: &str) -> Result<(), SceneError> {
        let keys = keys(path)?;
        let mut new: Value = value.trim().parse().unwrap_or_else(|_| Value::from(value));
        let Some((last, way)) = keys.split_last() else { return Err(wrong(path, "the path is empty; name a key")) };
        let mut item = self.document.as_item_mut();
        for key in way {
            item = step(item, key, true).ok_or_else(|| wrong(path, format!("`{key}` leads through no table")))?;
        }
        let place = step(item, last, true).ok_or_else(|| wrong(path, format!("`{last}` stands in no table")))?;
        // The comment behind a value stays.
        if let Some(old) = place.as_value() {
            *new.decor_mut() = old.decor().clone();
        }
        *place = Item::Value(new);
        Ok(())
    }

    /// Removes a key or a table. False when there is none.
    ///
    /// # Errors
    /// A path that is empty or too deep.
    pub fn remove(&mut self, path: &str) -> Result<bool, SceneError> {
        let keys = keys(path)?;
        let Some((last, way)) = keys.split_last() else { return Err(wrong(path, "the path is empty; name a key")) };
        let mut item = self.document.as_item_mut();
        for key in way {
            match step(item, key, false) {
                Some(inside) => item = inside,
                None => return Ok(false),
            }
        }
        Ok(item.as_table_like_mut().and_then(|table| table.remove(last)).is_some())
    }
}

impl std::fmt::Display for SceneDocument {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.document.fmt(f)
    }
}

fn keys(path: &str) -> Result<Vec<&str>, SceneError> {
    let keys: Vec<&str> = path.split('.').collect();
    if keys.len() > MAX_DEPTH || keys.iter().any(|key| key.is_empty()) {
        return Err(wrong(path, "this is no path; write keys with dots between them, as characters.left.pose_gain"));
    }
    Ok(keys)
}

/// What a key leads to; when it is to be made and is not there, an empty place.
fn step<'a>(item: &'a mut Item, key: &str, makes: bool) -> Option<&'a mut Item> {
    if makes && item.is_none() {
        let mut table = Table::new();
        table.set_implicit(true);
        *item = Item::Table(table);
    }
    if let Some(index) = key.parse::<usize>().ok().filter(|_| !item.is_table_like()) {
        return item.get_mut(index);
    }
    let table = item.as_table_like_mut()?;
    if makes { Some(table.entry(key).or_insert(Item::None)) } else { table.get_mut(key) }
}

fn wrong(path: &str, problem: impl Into<String>) -> SceneError {
    let (kind, file) = (SceneErrorKind::Invalid, "scene".to_owned());
    SceneError { kind, file, line: None, path: path.to_owned(), problem: problem.into() }
}
