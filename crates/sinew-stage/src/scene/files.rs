//! Where a scene's files come from: a disk, a take, a test.

use std::collections::BTreeMap;
use std::fmt::Debug;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Gives a scene the files that it names.
pub trait Files: Debug + Send + Sync {
    /// The bytes of a file, named as the scene names it: relative to the scene's folder, with `/`.
    ///
    /// # Errors
    /// Why there are none, with a remedy; also when there are more than `most_bytes`.
    fn read(&self, path: &str, most_bytes: u64) -> Result<Vec<u8>, String>;

    /// How messages name the file.
    fn shown(&self, path: &str) -> String {
        path.to_owned()
    }

    /// Where the file lies, if it lies on a disk.
    fn on_disk(&self, _path: &str) -> Option<PathBuf> {
        None
    }
}

/// A file that a scene used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HeldFile {
    /// Its content.
    pub bytes: Arc<[u8]>,
    /// xxh3 of the content, 64 bits.
    pub hash: u64,
}

impl HeldFile {
    /// Takes bytes in.
    pub fn new(bytes: Vec<u8>) -> HeldFile {
        HeldFile { hash: xxhash_rust::xxh3::xxh3_64(&bytes), bytes: bytes.into() }
    }

    /// Its text, if it is one.
    pub fn text(&self) -> Option<&str> {
        std::str::from_utf8(&self.bytes).ok()
    }
}

/// Files in a folder and around it.
#[derive(Clone, Debug)]
pub struct DiskFiles {
    /// The scene's folder.
    pub folder: PathBuf,
}

impl Files for DiskFiles {
    fn read(&self, path: &str, most_bytes: u64) -> Result<Vec<u8>, String> {
        allowed(path)?;
        let place = self.folder.join(path);
        // Looked at before it is opened: opening a pipe would wait for its other end.
        let about = std::fs::metadata(&place).map_err(|error| wording(&error))?;
        if !about.is_file() {
            return Err("this is no file; name a file".to_owned());
        }
        let file = std::fs::File::open(&place).map_err(|error| wording(&error))?;
        let mut bytes = Vec::new();
        // One more than allowed, so that a file that grows while it is read is caught too.
        file.take(most_bytes + 1).read_to_end(&mut bytes).map_err(|error| wording(&error))?;
        within(bytes, most_bytes)
    }

    fn shown(&self, path: &str) -> String {
        self.folder.join(path).display().to_string()
    }

    fn on_disk(&self, path: &str) -> Option<PathBuf> {
        Some(self.folder.join(path))
    }
}

impl Files for BTreeMap<String, Vec<u8>> {
    fn read(&self, path: &str, most_bytes: u64) -> Result<Vec<u8>, String> {
        allowed(path)?;
        let bytes = self.get(path).ok_or("there is no such file; correct the name or add the file")?;
        within(bytes.clone(), most_bytes)
    }
}

/// Whether a scene may name a file so. A way up (`../samples/walk.bvh`) is allowed: the scene's author wrote it, and files
/// are only read. Places that mean another file on another machine are not.
///
/// # Errors
/// Why not.
pub(crate) fn allowed(path: &str) -> Result<(), String> {
    let remedy = "write it relative to the scene's folder, with `/`";
    if path.is_empty() {
        return Err(format!("the name of a file is empty; {remedy}"));
    }
    if path.len() > 1024 || path.chars().any(char::is_control) {
        return Err(format!("a file's name is longer than 1024 bytes or holds control characters; {remedy}"));
    }
    if path.starts_with('/') || path.contains(['\\', ':']) || Path::new(path).is_absolute() {
        return Err(format!(
            "{path:?} is an absolute path, or uses `\\` or `:`, and means another file elsewhere; {remedy}"
        ));
    }
    Ok(())
}

/// Whether a file's name ends as one of its kind does. A scene from a stranger can so not make a take, which holds copies of
/// the scene's files, carry something else away.
///
/// # Errors
/// How it should end.
pub(crate) fn of_kind(path: &str, kind: &FileKind) -> Result<(), String> {
    let extension = Path::new(path).extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    if kind.extensions.iter().any(|known| known.eq_ignore_ascii_case(extension)) {
        return Ok(());
    }
    Err(format!("{} is expected, a file that ends in .{}", kind.what, kind.extensions.join(", .")))
}

/// A kind of file that a scene may name.
pub(crate) struct FileKind {
    what: &'static str,
    extensions: &'static [&'static str],
}

impl FileKind {
    /// Poses and graphs.
    pub const POSES: FileKind = FileKind { what: "a pose file", extensions: &["toml"] };
    /// Python controllers.
    pub const PYTHON: FileKind = FileKind { what: "a Python file", extensions: &["py"] };
    /// Motions in one file: an AMC's skeleton is in another, so convert it.
    pub const CLIP: FileKind = FileKind {
        what: "a motion in one file (`sinew convert` makes one of .amc and .asf)",
        extensions: &["bvh", "glb", "gltf", "fbx"],
    };
}

fn within(bytes: Vec<u8>, most_bytes: u64) -> Result<Vec<u8>, String> {
    if bytes.len() as u64 > most_bytes {
        return Err(format!("the file is larger than the {most_bytes} bytes allowed; make it smaller"));
    }
    Ok(bytes)
}

fn wording(error: &std::io::Error) -> String {
    match error.kind() {
        std::io::ErrorKind::NotFound => "there is no such file; correct the name or add the file".to_owned(),
        _ => format!("the file cannot be read ({error}); check its place and permissions"),
    }
}
