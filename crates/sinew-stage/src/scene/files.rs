//! Sources of a scene's files: a folder, a take, memory.

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
    /// Why the file cannot be read, with a remedy; also if it exceeds `most_bytes`.
    fn read(&self, path: &str, most_bytes: u64) -> Result<Vec<u8>, FileError>;

    /// The file's name in messages.
    fn shown(&self, path: &str) -> String {
        path.to_owned()
    }

    /// Its path, if it is on a disk.
    fn on_disk(&self, _path: &str) -> Option<PathBuf> {
        None
    }
}

/// What kind of trouble a [`FileError`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FileErrorKind {
    /// There is no such file.
    NotFound,
    /// It is larger than allowed.
    TooLarge,
    /// A scene may not name it so.
    NotAllowed,
    /// It is there and cannot be read.
    Unreadable,
    /// It is not the one that a take was recorded with.
    Changed,
}

/// Why a scene does not get a file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{problem}")]
pub struct FileError {
    /// What kind of trouble it is.
    pub kind: FileErrorKind,
    /// What is wrong and what to do.
    pub problem: String,
}

impl FileError {
    /// An error of a kind; `problem` says what is wrong and what to do.
    pub fn new(kind: FileErrorKind, problem: impl Into<String>) -> FileError {
        FileError { kind, problem: problem.into() }
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

    /// Its text, if it is UTF-8.
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
    fn read(&self, path: &str, most_bytes: u64) -> Result<Vec<u8>, FileError> {
        allowed(path)?;
        let place = self.folder.join(path);
        // Checked before it is opened: opening a pipe would wait for its other end.
        let about = std::fs::metadata(&place).map_err(|error| wording(&error))?;
        if !about.is_file() {
            return Err(FileError::new(FileErrorKind::Unreadable, "this is no file; name a file"));
        }
        let file = std::fs::File::open(&place).map_err(|error| wording(&error))?;
        let mut bytes = Vec::new();
        // One byte more than the maximum, so that a file that grows while it is read is detected too.
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
    fn read(&self, path: &str, most_bytes: u64) -> Result<Vec<u8>, FileError> {
        allowed(path)?;
        let bytes = self.get(path).ok_or_else(not_there)?;
        within(bytes.clone(), most_bytes)
    }
}

/// Checks a file name of a scene. A path with `..` (`../samples/walk.bvh`) is allowed: the scene's author wrote it, and
/// files are only read. Absolute and platform-dependent paths are not.
///
/// # Errors
/// Why it is not allowed.
pub(crate) fn allowed(path: &str) -> Result<(), FileError> {
    let refused = |problem: String| Err(FileError::new(FileErrorKind::NotAllowed, problem));
    let remedy = "write it relative to the scene's folder, with `/`";
    if path.is_empty() {
        return refused(format!("the name of a file is empty; {remedy}"));
    }
    if path.len() > 1024 || path.chars().any(char::is_control) {
        return refused(format!("a file's name is longer than 1024 bytes or holds control characters; {remedy}"));
    }
    if path.starts_with('/') || path.contains(['\\', ':']) || Path::new(path).is_absolute() {
        return refused(format!(
            "{path:?} is an absolute path, or uses `\\` or `:`, and means another file elsewhere; {remedy}"
        ));
    }
    Ok(())
}

/// Checks the extension of a file. So an untrusted scene cannot make a take, which holds copies of the scene's files,
/// carry other files away.
///
/// # Errors
/// The expected extensions.
pub(crate) fn of_kind(path: &str, kind: &FileKind) -> Result<(), FileError> {
    let extension = Path::new(path).extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    if kind.extensions.iter().any(|known| known.eq_ignore_ascii_case(extension)) {
        return Ok(());
    }
    let problem = format!("{} is expected, a file that ends in .{}", kind.what, kind.extensions.join(", ."));
    Err(FileError::new(FileErrorKind::NotAllowed, problem))
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

pub(super) fn within(bytes: Vec<u8>, most_bytes: u64) -> Result<Vec<u8>, FileError> {
    if bytes.len() as u64 > most_bytes {
        let problem = format!("the file is larger than the {most_bytes} bytes allowed; make it smaller");
        return Err(FileError::new(FileErrorKind::TooLarge, problem));
    }
    Ok(bytes)
}

fn not_there() -> FileError {
    FileError::new(FileErrorKind::NotFound, "there is no such file; correct the name or add the file")
}

fn wording(error: &std::io::Error) -> FileError {
    if error.kind() == std::io::ErrorKind::NotFound {
        return not_there();
    }
    let problem = format!("the file cannot be read ({error}); check its place and permissions");
    FileError::new(FileErrorKind::Unreadable, problem)
}
