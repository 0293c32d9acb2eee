//! The text of a scene and its pose files as one table, with file and line of every key.

use super::SceneErrorKind as Kind;
use super::error::{Fault, SceneError, known, shortened};
use super::files::{FileError, FileKind, Files, HeldFile, of_kind};
use super::lines::{line_at, line_of, lines_of};
use std::collections::BTreeMap;
use toml::{Table, Value};

/// Maximum size of a scene or pose file \[bytes\].
pub(super) const MAX_TEXT_BYTES: u64 = 4 << 20;

/// Maximum size of a scene together with its pose files \[bytes\].
const MAX_TEXTS_BYTES: u64 = 8 << 20;

/// Maximum number of characters that can begin a table (`{`, `=`, `.`) in a scene together with its pose files: a table
/// takes 2 kB of memory, and a text of 4 MiB can hold two million. Decimal points count too.
const MAX_TABLE_SIGNS: usize = 200_000;

/// Maximum number of commas in a scene together with its pose files, each a value of 200 bytes.
const MAX_COMMAS: usize = 500_000;

/// Maximum total size of all files of a scene \[bytes\].
const MAX_FILES_BYTES: u64 = 512 << 20;

/// Maximum depth of a path that can be set.
const MAX_PATH_DEPTH: usize = 32;

/// Tables whose entries are named by the scene: a misspelt name would be a new entry, not an unknown key.
pub(crate) const NAMED: [&str; 8] =
    ["characters", "props", "ropes", "joints", "shapes", "poses", "graphs", "controllers"];

/// A scene's table and the texts that it came from.
#[derive(Debug)]
pub(super) struct Document {
    /// All tables together.
    pub table: Table,
    /// Files, as the scene names them.
    pub files: BTreeMap<String, HeldFile>,
    /// The scene file's name.
    name: String,
    /// Which pose file an entry of `poses` or `graphs` came from.
    origins: BTreeMap<(&'static str, String), String>,
    /// Values changed from outside.
    sets: Vec<(String, String)>,
    /// Of all texts so far, see [`MAX_TABLE_SIGNS`].
    table_signs: usize,
    /// Of all texts so far.
    commas: usize,
}

impl Document {
    /// Reads the scene and its pose files, and makes the changes.
    pub fn read(name: &str, files: &dyn Files, sets: &[(String, String)]) -> Result<Document, SceneError> {
        let mut document = Document {
            table: Table::new(),
            files: BTreeMap::new(),
            name: name.to_owned(),
            origins: BTreeMap::new(),
            sets: sets.to_vec(),
            table_signs: 0,
            commas: 0,
        };
        document.table = document.parse(name, files)?;
        // What is set may be the list of pose files, or what stands in one.
        let in_pose_file = |path: &str| path.starts_with("poses.") || path.starts_with("graphs.");
        for (path, value) in sets.iter().filter(|(path, _)| !in_pose_file(path)) {
            document.set(path, value).map_err(|fault| document.place(files, fault))?;
        }
        document.merge(files)?;
        for (path, value) in sets.iter().filter(|(path, _)| in_pose_file(path)) {
            document.set(path, value).map_err(|fault| document.place(files, fault))?;
        }
        document.finite().map_err(|fault| document.place(files, fault))?;
        Ok(document)
    }

    /// Takes a file in.
    pub fn hold(&mut self, path: &str, files: &dyn Files, most_bytes: u64) -> Result<(), FileError> {
        if !self.files.contains_key(path) {
            let left = MAX_FILES_BYTES - self.held_bytes();
            let bytes = files.read(path, most_bytes.min(left)).map_err(|mut error| {
                if most_bytes > left {
                    error.problem += &format!(" (all files of a scene together may have {MAX_FILES_BYTES} bytes)");
                }
                error
            })?;
            self.files.insert(path.to_owned(), HeldFile::new(bytes));
        }
        Ok(())
    }

    fn held_bytes(&self) -> u64 {
        self.files.values().map(|file| file.bytes.len() as u64).sum()
    }

    /// Estimates the memory of a text as a table; returns whether all texts so far are small enough.
    fn weigh(&mut self, path: &str) -> bool {
        let text = self.text(path);
        let count = |signs: &[u8]| text.bytes().filter(|byte| signs.contains(byte)).count();
        let (table_signs, commas) = (count(b"{=."), count(b","));
        self.table_signs += table_signs;
        self.commas += commas;
        self.table_signs <= MAX_TABLE_SIGNS && self.commas <= MAX_COMMAS
    }

    fn parse(&mut self, path: &str, files: &dyn Files) -> Result<Table, SceneError> {
        let whole = |kind, line, problem| {
            let file = files.shown(path);
            SceneError { kind, file, line, path: String::new(), problem }
        };
        self.hold(path, files, MAX_TEXT_BYTES).map_err(|error| whole(error.kind.into(), None, error.problem))?;
        let is_light = self.weigh(path);
        let text = self.text(path);
        if std::str::from_utf8(&self.files[path].bytes).is_err() {
            return Err(whole(Kind::Unreadable, None, "this is no UTF-8 text; save it as UTF-8".to_owned()));
        }
        if !is_light {
            let problem = "the scene and its pose files state too many values; leave some out, or make meshes coarser";
            return Err(whole(Kind::TooLarge, None, problem.to_owned()));
        }
        text.parse::<Table>().map_err(|error| {
            let line = error.span().map(|span| line_at(text, span.start));
            whole(Kind::Unreadable, line, format!("this is no TOML: {}; correct the line", error.message().trim()))
        })
    }

    fn text(&self, path: &str) -> &str {
        self.files.get(path).and_then(HeldFile::text).unwrap_or_default().trim_start_matches('\u{feff}')
    }

    /// Adds the poses and graphs of the pose files.
    fn merge(&mut self, files: &dyn Files) -> Result<(), SceneError> {
        let listed = self.table.get("stage").and_then(|stage| stage.get("pose_files")).and_then(Value::as_array);
        // Anything but a list of texts is reported when the stage is read.
        let listed: Vec<String> = listed.into_iter().flatten().filter_map(Value::as_str).map(str::to_owned).collect();
        for path in listed.iter().take(100) {
            // Only texts are held yet.
            let left = MAX_TEXT_BYTES.min(MAX_TEXTS_BYTES - self.held_bytes());
            let held = of_kind(path, &FileKind::POSES).and_then(|()| self.hold(path, files, left));
            if let Err(error) = held {
                let fault = Fault::of_file(&["stage", "pose_files"], path, &error);
                return Err(self.place(files, fault));
            }
            let mut table = self.parse(path, files)?;
            let fault = |path: &str, key: &str, line: Option<usize>, problem: String| SceneError {
                kind: Kind::Malformed,
                file: files.shown(path),
                line,
                path: key.to_owned(),
                problem,
            };
            match table.remove("format") {
                None => {}
                Some(Value::Integer(1)) => {}
                Some(other) => {
                    let line = line_of(self.text(path), &["format"]);
                    let problem = format!("{other} is no known version of the format; write format = 1");
                    return Err(fault(path, "format", line, problem));
                }
            }
            for section in ["poses", "graphs"] {
                let entries = match table.remove(section) {
                    None => continue,
                    Some(Value::Table(entries)) => entries,
                    Some(_) => {
                        let line = line_of(self.text(path), &[section]);
                        return Err(fault(path, section, line, format!("expected tables such as [{section}.NAME]")));
                    }
                };
                let Some(all) = self.table.entry(section).or_insert(Value::Table(Table::new())).as_table_mut() else {
                    continue;
                };
                for (name, entry) in entries {
                    if all.insert(name.clone(), entry).is_some() {
                        let line = line_of(self.text(path), &[section, &name]);
                        let key = format!("{section}.{}", shortened(&name));
                        let problem = "another file or the scene has this name already; rename one of the two";
                        return Err(fault(path, &key, line, problem.to_owned()));
                    }
                    self.origins.insert((section, name), path.clone());
                }
            }
            if let Some(key) = table.keys().next() {
                let line = line_of(self.text(path), &[key]);
                let problem = format!("unknown key; {}", known(key, ["format", "poses", "graphs"]));
                return Err(fault(path, &shortened(key), line, problem));
            }
        }
        Ok(())
    }

    /// Changes a value by its path. Only existing entries and tables are entered, so that a misspelt name is an error.
    fn set(&mut self, path: &str, value: &str) -> Result<(), Fault> {
        let keys: Vec<&str> = path.split('.').collect();
        let fault = |depth: usize, problem: String| Fault::at(&keys[..depth.min(keys.len())], problem);
        if keys.len() > MAX_PATH_DEPTH || keys.iter().any(|key| key.is_empty()) {
            return Err(Fault::at(&[shortened(path)], "write a path such as characters.left.pose_gain"));
        }
        if value.len() as u64 > MAX_TEXT_BYTES {
            return Err(fault(keys.len(), "the value is too long".to_owned()));
        }
        // A value that is not TOML is a text without its quotes.
        let value = value.trim().parse::<Value>().unwrap_or_else(|_| Value::String(value.to_owned()));
        let (last, way) = keys.split_last().unwrap_or((&"", &[]));
        let mut table = &mut self.table;
        let mut depth = 0;
        while let Some(key) = way.get(depth) {
            let is_entry = depth == 1 && NAMED.contains(&keys[0]);
            if !table.contains_key(*key) {
                if is_entry {
                    let names = known(key, table.keys().map(String::as_str));
                    return Err(fault(depth + 1, format!("there is no `{}` in {}; {names}", shortened(key), keys[0])));
                }
                table.insert((*key).to_owned(), Value::Table(Table::new()));
            }
            depth += 1;
            match table.get_mut(*key) {
                Some(Value::Table(inner)) => table = inner,
                Some(Value::Array(items)) => {
                    let length = items.len();
                    let index = way.get(depth).unwrap_or(last);
                    let Some(item) = index.parse().ok().and_then(|index: usize| items.get_mut(index)) else {
                        let problem = format!("`{}` is none of its {length} entries, counted from 0", shortened(index));
                        return Err(fault(depth, problem));
                    };
                    depth += 1;
                    if depth > way.len() {
                        *item = value;
                        return Ok(());
                    }
                    let Value::Table(inner) = item else {
                        return Err(fault(depth, "this is no table; set it as a whole".to_owned()));
                    };
                    table = inner;
                }
                _ => return Err(fault(depth, "this is no table; set it as a whole".to_owned())),
            }
        }
        if keys.len() == 2 && NAMED.contains(&keys[0]) && !table.contains_key(*last) {
            let names = known(last, table.keys().map(String::as_str));
            return Err(fault(2, format!("there is no `{}` in {}; {names}", shortened(last), keys[0])));
        }
        table.insert((*last).to_owned(), value);
        Ok(())
    }

    /// Refuses `nan` and `inf`, wherever they stand.
    fn finite(&self) -> Result<(), Fault> {
        fn walk(value: &Value) -> Result<(), Fault> {
            match value {
                Value::Float(number) if !number.is_finite() => {
                    let problem = format!("{number} is no finite number; write one");
                    Err(Fault::at::<&str>(&[], problem).of_kind(Kind::OutOfRange))
                }
                // A path of numbers in a list ends at the list: all on a line as a rule.
                Value::Array(items) => items.iter().enumerate().try_for_each(|(index, item)| {
                    walk(item).map_err(|fault| if item.is_table() { fault.below(&[index]) } else { fault })
                }),
                Value::Table(table) => {
                    table.iter().try_for_each(|(key, item)| walk(item).map_err(|fault| fault.below(&[key])))
                }
                _ => Ok(()),
            }
        }
        self.table.iter().try_for_each(|(key, value)| walk(value).map_err(|fault| fault.below(&[key])))
    }

    /// The file of a key.
    fn origin(&self, path: &[String]) -> &str {
        let section = path.first().and_then(|first| ["poses", "graphs"].into_iter().find(|section| section == first));
        let named = section.zip(path.get(1)).and_then(|(section, name)| self.origins.get(&(section, name.clone())));
        named.unwrap_or(&self.name)
    }

    /// The line of a key, in its file.
    pub fn line(&self, path: &[String]) -> Option<usize> {
        line_of(self.text(self.origin(path)), &path.iter().map(String::as_str).collect::<Vec<_>>())
    }

    /// Lines of the entries of a list of tables.
    pub fn lines(&self, list: &str) -> Vec<usize> {
        lines_of(self.text(&self.name), list)
    }

    /// Gives a fault its file and line.
    pub fn place(&self, files: &dyn Files, fault: Fault) -> SceneError {
        let path = fault.path.iter().map(|key| shortened(key)).collect::<Vec<_>>().join(".");
        let is_inside = |set: &str| path == set || path.strip_prefix(set).is_some_and(|rest| rest.starts_with('.'));
        let set = self.sets.iter().rev().find(|(set, _)| is_inside(set) || set.starts_with(&format!("{path}.")));
        match set {
            Some((set, value)) if is_inside(set) => SceneError {
                kind: fault.kind,
                file: files.shown(self.origin(&fault.path)),
                line: None,
                path,
                problem: format!("{} (it was set to {} from outside)", fault.problem, shortened(value)),
            },
            _ => SceneError {
                kind: fault.kind,
                file: files.shown(self.origin(&fault.path)),
                line: self.line(&fault.path),
                path,
                problem: fault.problem,
            },
        }
    }
}
