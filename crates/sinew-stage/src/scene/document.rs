//! The text of a scene and its pose files as one table, with the way back from a key to its file and line.

use super::error::{Fault, SceneError, known, shortened};
use super::files::{Files, HeldFile};
use std::collections::BTreeMap;
use toml::de::{DeTable, DeValue};
use toml::{Table, Value};

/// Largest scene or pose file \[bytes\].
pub(super) const MOST_TEXT_BYTES: u64 = 4 << 20;

/// Deepest path that can be set.
const DEEPEST: usize = 32;

/// Tables whose entries have names that the scene chooses: a misspelt one would be a new entry, not an unknown key.
const NAMED: [&str; 6] = ["characters", "props", "shapes", "poses", "graphs", "controllers"];

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
    /// What was changed from outside.
    sets: Vec<(String, String)>,
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
    pub fn hold(&mut self, path: &str, files: &dyn Files, most_bytes: u64) -> Result<(), String> {
        if !self.files.contains_key(path) {
            self.files.insert(path.to_owned(), HeldFile::new(files.read(path, most_bytes)?));
        }
        Ok(())
    }

    fn parse(&mut self, path: &str, files: &dyn Files) -> Result<Table, SceneError> {
        let whole = |line, problem| SceneError { file: files.shown(path), line, path: String::new(), problem };
        self.hold(path, files, MOST_TEXT_BYTES).map_err(|problem| whole(None, problem))?;
        let text = self.text(path);
        if std::str::from_utf8(&self.files[path].bytes).is_err() {
            return Err(whole(None, "this is no UTF-8 text; save it as UTF-8".to_owned()));
        }
        text.parse::<Table>().map_err(|error| {
            let line = error.span().map(|span| line_at(text, span.start));
            whole(line, format!("this is no TOML: {}; correct the line", error.message().trim()))
        })
    }

    fn text(&self, path: &str) -> &str {
        self.files.get(path).and_then(HeldFile::text).unwrap_or_default().trim_start_matches('\u{feff}')
    }

    /// Adds the poses and graphs of the pose files.
    fn merge(&mut self, files: &dyn Files) -> Result<(), SceneError> {
        let listed = self.table.get("stage").and_then(|stage| stage.get("pose_files")).and_then(Value::as_array);
        // Anything but a list of texts is told when the stage is read.
        let listed: Vec<String> = listed.into_iter().flatten().filter_map(Value::as_str).map(str::to_owned).collect();
        for path in listed.iter().take(100) {
            if let Err(problem) = self.hold(path, files, MOST_TEXT_BYTES) {
                let fault = Fault::at(&["stage", "pose_files"], format!("`{}`: {problem}", shortened(path)));
                return Err(self.place(files, fault));
            }
            let mut table = self.parse(path, files)?;
            let fault = |path: &str, key: &str, line: Option<usize>, problem: String| SceneError {
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

    /// Changes a value by its path. Only entries and tables that exist are entered, so that a misspelt name is told.
    fn set(&mut self, path: &str, value: &str) -> Result<(), Fault> {
        let keys: Vec<&str> = path.split('.').collect();
        let fault = |depth: usize, problem: String| Fault::at(&keys[..depth.min(keys.len())], problem);
        if keys.len() > DEEPEST || keys.iter().any(|key| key.is_empty()) {
            return Err(Fault::at(&[shortened(path)], "write a path such as characters.left.pose_gain"));
        }
        if value.len() as u64 > MOST_TEXT_BYTES {
            return Err(fault(keys.len(), "the value is too long".to_owned()));
        }
        // A word that is no TOML is a text without its quotes.
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
                    Err(Fault::at::<&str>(&[], format!("{number} is no finite number; write one")))
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

    /// The file that a key stands in.
    fn origin(&self, path: &[String]) -> &str {
        let section = path.first().and_then(|first| ["poses", "graphs"].into_iter().find(|section| section == first));
        let named = section.zip(path.get(1)).and_then(|(section, name)| self.origins.get(&(section, name.clone())));
        named.unwrap_or(&self.name)
    }

    /// The line of a key, in whatever file it stands.
    pub fn line(&self, path: &[String]) -> Option<usize> {
        line_of(self.text(self.origin(path)), &path.iter().map(String::as_str).collect::<Vec<_>>())
    }

    /// Lines of the entries of a list of tables.
    pub fn lines(&self, list: &str) -> Vec<usize> {
        let text = self.text(&self.name);
        let Ok(table) = DeTable::parse(text) else { return Vec::new() };
        let found = table.get_ref().iter().find(|(key, _)| key.get_ref() == list);
        let Some(DeValue::Array(items)) = found.map(|(_, value)| value.get_ref()) else { return Vec::new() };
        let lines = Lines::of(text);
        items.iter().map(|item| lines.at(item.span().start)).collect()
    }

    /// Gives a fault its file and line.
    pub fn place(&self, files: &dyn Files, fault: Fault) -> SceneError {
        let path = fault.path.iter().map(|key| shortened(key)).collect::<Vec<_>>().join(".");
        let is_inside = |set: &str| path == set || path.strip_prefix(set).is_some_and(|rest| rest.starts_with('.'));
        let set = self.sets.iter().rev().find(|(set, _)| is_inside(set) || set.starts_with(&format!("{path}.")));
        match set {
            Some((set, value)) if is_inside(set) => SceneError {
                file: files.shown(self.origin(&fault.path)),
                line: None,
                path,
                problem: format!("{} (it was set to {} from outside)", fault.problem, shortened(value)),
            },
            _ => SceneError {
                file: files.shown(self.origin(&fault.path)),
                line: self.line(&fault.path),
                path,
                problem: fault.problem,
            },
        }
    }
}

/// Line of the deepest key of a path that the text has.
fn line_of(text: &str, path: &[&str]) -> Option<usize> {
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

fn line_at(text: &str, at: usize) -> usize {
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
