//! Reads and validates a scene.

use super::document::Document;
use super::error::{Fault, shortened};
use super::files::{FileKind, of_kind};
use super::wording;
use super::{ControllerSpec, DiskFiles, FileError, Files, HeldFile, SceneError, SceneErrorKind, SceneSpec};
use sinew_body::humanoid::Node;
use sinew_control::source::SourceSpec;
use sinew_control::{Action, OrderError, OrderErrorKind};
use std::collections::BTreeMap;
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Largest Python text \[bytes\].
pub(crate) const MAX_PYTHON_BYTES: usize = 1 << 20;

/// Maximum size of a motion file of a scene \[bytes\].
const MAX_CLIP_BYTES: u64 = 256 << 20;

/// A validated scene. Its tables are those of [`SceneSpec`], to which it dereferences.
#[derive(Clone, Debug)]
pub struct Scene {
    spec: SceneSpec,
    name: String,
    held: BTreeMap<String, HeldFile>,
    sets: Vec<(String, String)>,
    source: Arc<dyn Files>,
}

/// Something that can be touched, by the scene's names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Touchable {
    /// The floor.
    Ground,
    /// A prop.
    Prop(String),
    /// Any part of a character.
    Character(String),
    /// One part of a character.
    Part(String, Node),
}

impl Deref for Scene {
    type Target = SceneSpec;

    fn deref(&self) -> &SceneSpec {
        &self.spec
    }
}

impl Scene {
    /// Reads a scene file, and all files that it names.
    ///
    /// # Errors
    /// A file that is missing or too large, or an invalid scene: file, line, key, problem and remedy.
    pub fn read(path: &Path) -> Result<Scene, SceneError> {
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        let Some(name) = path.file_name().and_then(|name| name.to_str()) else {
            let problem = "this names no file; name a scene, such as scenes/block.toml".to_owned();
            let (kind, file) = (SceneErrorKind::NotFound, path.display().to_string());
            return Err(SceneError { kind, file, line: None, path: String::new(), problem });
        };
        Scene::load(name, Arc::new(DiskFiles { folder }), &[])
    }

    /// Makes a scene from files in memory, by the names that the scene uses for them.
    ///
    /// # Errors
    /// As [`Scene::read`].
    pub fn from_files(name: &str, files: BTreeMap<String, Vec<u8>>) -> Result<Scene, SceneError> {
        Scene::load(name, Arc::new(files), &[])
    }

    /// Makes a scene from its text alone, for tests.
    ///
    /// # Errors
    /// As [`Scene::read`].
    pub fn from_text(text: &str) -> Result<Scene, SceneError> {
        Scene::from_files("scene.toml", BTreeMap::from([("scene.toml".to_owned(), text.as_bytes().to_vec())]))
    }

    /// Makes a scene from files of any source, with changes as [`Scene::set`] makes them.
    ///
    /// # Errors
    /// As [`Scene::read`].
    pub fn load(name: &str, source: Arc<dyn Files>, sets: &[(String, String)]) -> Result<Scene, SceneError> {
        let files = source.as_ref();
        let mut document = Document::read(name, files, sets)?;
        let table = toml::Value::Table(std::mem::take(&mut document.table));
        let mut spec: SceneSpec = match serde_path_to_error::deserialize(table) {
            Ok(spec) => spec,
            Err(error) => return Err(document.place(files, wording::fault(error))),
        };
        spec.lay_ropes().map_err(|fault| document.place(files, fault))?;
        spec.check().map_err(|fault| document.place(files, fault))?;
        for (path, file, kind, most_bytes) in named_files(&spec) {
            let held = super::files::allowed(&file).and_then(|()| of_kind(&file, &kind));
            let held = held.and_then(|()| document.hold(&file, files, most_bytes));
            held.map_err(|error| document.place(files, Fault::of_file(&path, &file, &error)))?;
        }
        for (controller, ControllerSpec { file, text, .. }) in &spec.controllers {
            let at = |key| ["controllers", controller, key];
            if text.as_ref().is_some_and(|text| text.len() > MAX_PYTHON_BYTES) {
                let problem = format!("the text is longer than {MAX_PYTHON_BYTES} bytes; shorten it");
                let fault = Fault::at(&at("text"), problem).of_kind(SceneErrorKind::TooLarge);
                return Err(document.place(files, fault));
            }
            if let Some(file) = file
                && document.files.get(file).is_none_or(|held| held.text().is_none())
            {
                let fault = Fault::at(&at("file"), format!("`{}` is no UTF-8 text; save it as UTF-8", shortened(file)));
                return Err(document.place(files, fault));
            }
        }
        let text = |name: &str| {
            let controller = spec.controllers.get(name)?;
            match &controller.file {
                Some(file) => document.files.get(file)?.text(),
                None => controller.text.as_deref(),
            }
        };
        spec.check_honoured(&text).map_err(|fault| document.place(files, fault))?;
        for (timed, line) in spec.at.iter_mut().zip(document.lines("at")) {
            timed.line = line;
        }
        for (reaction, line) in spec.when.iter_mut().zip(document.lines("when")) {
            reaction.line = line;
        }
        Ok(Scene { spec, name: name.to_owned(), held: document.files, sets: sets.to_vec(), source })
    }

    /// Changes a value by its path, as `characters.left.pose_gain`; entries of lists are counted from 0, as `at.0.time_secs`.
    /// The value is written as in the file; a text may come without its quotes.
    ///
    /// # Errors
    /// An invalid path or value; the scene then does not change.
    pub fn set(&mut self, path: &str, value: &str) -> Result<(), SceneError> {
        let mut sets = self.sets.clone();
        sets.push((path.to_owned(), value.to_owned()));
        *self = Scene::load(&self.name, Arc::clone(&self.source), &sets)?;
        Ok(())
    }

    /// The scene file's text.
    pub(crate) fn text(&self) -> &str {
        self.held.get(&self.name).and_then(HeldFile::text).unwrap_or_default()
    }

    /// The scene with another text of its file. Files that it has read, or that are among the `known` ones, are not read again; others are
    /// read from where this scene's files are.
    pub(crate) fn with_text(&self, text: &str, known: &BTreeMap<String, HeldFile>) -> Result<Scene, SceneError> {
        let mut known = known.clone();
        known.extend(self.held.clone());
        known.insert(self.name.clone(), HeldFile::new(text.as_bytes().to_vec()));
        let edited = EditedFiles { name: self.name.clone(), known, others: Arc::clone(&self.source) };
        Scene::load(&self.name, Arc::new(edited), &self.sets)
    }

    /// Its commands as another scene has them, with the lines of that one's file.
    pub(crate) fn take_lines_of(&mut self, other: &Scene) {
        self.spec.at.clone_from(&other.spec.at);
        self.spec.when.clone_from(&other.spec.when);
        self.spec.keys.clone_from(&other.spec.keys);
    }

    /// The scene file's own name, without folders.
    pub fn file_name(&self) -> &str {
        &self.name
    }

    /// Every file that the scene used, the scene file included, by the name that the scene uses for it.
    pub fn files(&self) -> &BTreeMap<String, HeldFile> {
        &self.held
    }

    /// Whether it is the same scene: the same text and files, by their hashes, and the same values set.
    pub(crate) fn is_same_as(&self, other: &Scene) -> bool {
        let files = |scene: &Scene| scene.held.iter().map(|(path, held)| (path.clone(), held.hash)).collect::<Vec<_>>();
        self.name == other.name && self.sets == other.sets && files(self) == files(other)
    }

    /// A hash of all that [`Scene::is_same_as`] compares.
    pub(crate) fn fingerprint(&self) -> u64 {
        let files = self.held.iter().map(|(path, held)| (path, held.hash)).collect::<Vec<_>>();
        let compared = serde_json::to_vec(&(&self.name, &self.sets, files)).unwrap_or_default();
        xxhash_rust::xxh3::xxh3_64(&compared)
    }

    /// What [`Scene::set`] changed.
    pub fn sets(&self) -> &[(String, String)] {
        &self.sets
    }

    /// Where a file lies; `None` when it is only held in memory.
    pub fn on_disk(&self, file: &str) -> Option<PathBuf> {
        self.source.on_disk(file)
    }

    /// The Python text of a controller.
    pub fn controller_text(&self, name: &str) -> Option<&str> {
        let controller = self.spec.controllers.get(name)?;
        match &controller.file {
            Some(file) => self.held.get(file)?.text(),
            None => controller.text.as_deref(),
        }
    }

    /// Reads a controller's file again, for a reload while the stage runs.
    ///
    /// # Errors
    /// No such controller, or a file that cannot be read.
    pub fn controller_text_again(&self, name: &str) -> Result<String, OrderError> {
        let wrong = |kind, problem: String| OrderError::new(kind, problem);
        let controller = self.spec.controllers.get(name);
        let controller = controller
            .ok_or_else(|| wrong(OrderErrorKind::NotFound, format!("no controller `{}`", shortened(name))))?;
        let Some(file) = &controller.file else { return Ok(controller.text.clone().unwrap_or_default()) };
        let bytes = self.source.read(file, MAX_PYTHON_BYTES as u64);
        let bytes = bytes.map_err(|problem| wrong(OrderErrorKind::Script, format!("{file}: {problem}")))?;
        String::from_utf8(bytes)
            .map_err(|_| wrong(OrderErrorKind::Script, format!("{file} is no UTF-8 text; save it as UTF-8")))
    }
}

/// Files of a scene whose own text is another.
#[derive(Clone, Debug)]
struct EditedFiles {
    name: String,
    known: BTreeMap<String, HeldFile>,
    others: Arc<dyn Files>,
}

impl Files for EditedFiles {
    fn read(&self, path: &str, most_bytes: u64) -> Result<Vec<u8>, FileError> {
        match self.known.get(path) {
            Some(held) => super::files::within(held.bytes.to_vec(), most_bytes),
            None => self.others.read(path, most_bytes),
        }
    }

    fn shown(&self, path: &str) -> String {
        self.others.shown(path)
    }

    fn on_disk(&self, path: &str) -> Option<PathBuf> {
        if path == self.name { None } else { self.others.on_disk(path) }
    }
}

/// Files that a scene names besides its pose files: where, which, of what kind, and how large at most.
fn named_files(spec: &SceneSpec) -> Vec<(Vec<String>, String, FileKind, u64)> {
    let mut files = Vec::new();
    let mut add = |path: &[&str], file: &Option<String>, kind: FileKind, most_bytes: u64| {
        if let Some(file) = file {
            files.push((path.iter().map(|key| (*key).to_owned()).collect(), file.clone(), kind, most_bytes));
        }
    };
    for (name, character) in &spec.characters {
        add(&["characters", name, "clip"], &character.clip, FileKind::CLIP, MAX_CLIP_BYTES);
        for play in character.source.iter().flat_map(SourceSpec::clips) {
            add(&["characters", name, "source", "clip"], &Some(play.file), FileKind::CLIP, MAX_CLIP_BYTES);
        }
    }
    for (list, _, command) in spec.commands() {
        let Action::Source { source } = &command.action else { continue };
        for play in source.clips() {
            add(&[list], &Some(play.file), FileKind::CLIP, MAX_CLIP_BYTES);
        }
    }
    for (name, controller) in &spec.controllers {
        add(&["controllers", name, "file"], &controller.file, FileKind::PYTHON, MAX_PYTHON_BYTES as u64);
    }
    files
}
