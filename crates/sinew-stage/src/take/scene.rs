//! Restores the scene of a take.

use super::{Take, TakeFile};
use crate::scene::{DiskFiles, FileError, FileErrorKind, Files, Scene, SceneError, SceneErrorKind};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Files of a take: those that it holds, and large ones from the disk if their hash is unchanged.
#[derive(Clone, Debug)]
struct TakeFiles {
    files: BTreeMap<String, TakeFile>,
    disk: Option<DiskFiles>,
}

impl Files for TakeFiles {
    fn read(&self, path: &str, most_bytes: u64) -> Result<Vec<u8>, FileError> {
        let missing = "the take was recorded without this file; record it with the file";
        let file = self.files.get(path).ok_or_else(|| FileError::new(FileErrorKind::NotFound, missing))?;
        if let Some(bytes) = &file.bytes {
            let fits = bytes.len() as u64 <= most_bytes;
            let too_large =
                || FileError::new(FileErrorKind::TooLarge, format!("larger than the {most_bytes} bytes allowed"));
            return if fits { Ok(bytes.to_vec()) } else { Err(too_large()) };
        }
        let Some(disk) = &self.disk else {
            let problem = "the take holds only the hash of this large file; give the scene's folder";
            return Err(FileError::new(FileErrorKind::NotFound, problem));
        };
        let bytes = disk.read(path, most_bytes)?;
        if xxhash_rust::xxh3::xxh3_64(&bytes) != file.hash {
            let place = disk.shown(path);
            let problem = format!("{place} is not the file that the take was recorded with; put the old one back");
            return Err(FileError::new(FileErrorKind::Changed, problem));
        }
        Ok(bytes)
    }

    fn on_disk(&self, path: &str) -> Option<PathBuf> {
        let is_large = self.files.get(path).is_some_and(|file| file.bytes.is_none());
        if is_large { self.disk.as_ref()?.on_disk(path) } else { None }
    }
}

impl Take {
    /// The scene as it was recorded. `folder`, the folder of the scene file, is searched for large files, of which the
    /// take has only the hash.
    ///
    /// # Errors
    /// A scene that this version cannot read, or a large file that is missing or has changed.
    pub fn to_scene(&self, folder: Option<&Path>) -> Result<Scene, SceneError> {
        let disk = folder.map(|folder| DiskFiles { folder: folder.to_owned() });
        let scene = Scene::load(&self.scene, Arc::new(TakeFiles { files: self.files.clone(), disk }), &self.sets)?;
        let recorded = (self.seed, self.physics_hz);
        if (scene.stage.seed, scene.stage.physics_hz) != recorded {
            let problem =
                "the take's first line states another seed or physics_hz than its scene; record it again".to_owned();
            let (kind, path) = (SceneErrorKind::Invalid, "stage".to_owned());
            return Err(SceneError { kind, file: self.scene.clone(), line: None, path, problem });
        }
        Ok(scene)
    }
}
