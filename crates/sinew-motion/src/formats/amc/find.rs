//! Finds the ASF skeleton of an AMC motion.

use crate::{Error, Place};
use std::path::{Path, PathBuf};

/// The skeleton of a motion file: the one stated; else, beside the motion, the `.asf` of the same name, that of the
/// subject (`07.asf` for `07_01.amc`), or the only one there is.
///
/// # Errors
/// None is found, or several could be meant: what was tried, and how to name one.
pub fn find_skeleton(amc_path: &Path, stated: Option<&Path>) -> Result<PathBuf, Error> {
    if let Some(stated) = stated {
        if stated.is_file() {
            return Ok(stated.to_owned());
        }
        let problem = format!("the skeleton {} does not exist", stated.display());
        return Err(Error::new(Place::File, problem, "correct the path in ReadOptions::skeleton").in_file(amc_path));
    }
    let folder = match amc_path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let beside = skeletons_in(folder).map_err(|error| Error::io(folder, &error))?;
    let stem = amc_path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    let subject = stem.rsplit_once('_').map(|(subject, _)| subject.to_owned());
    let names: Vec<String> = [Some(stem), subject].into_iter().flatten().filter(|name| !name.is_empty()).collect();
    for name in &names {
        let has_name = |path: &&PathBuf| path.file_stem().is_some_and(|stem| stem.eq_ignore_ascii_case(name));
        if let Some(found) = beside.iter().find(has_name) {
            return Ok(found.clone());
        }
    }
    if let [only] = &beside[..] {
        return Ok(only.clone());
    }
    let tried: Vec<String> = names.iter().map(|name| format!("{name}.asf")).collect();
    let others = match beside.len() {
        0 => "there is no other .asf".to_owned(),
        count => format!("there are {count} other .asf files"),
    };
    let problem = format!("no skeleton found: {} is not in {}, and {others}", tried.join(" or "), folder.display());
    Err(Error::new(Place::File, problem, "name the .asf in ReadOptions::skeleton").in_file(amc_path))
}

/// The `.asf` files of a folder, sorted.
fn skeletons_in(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("asf")) && path.is_file() {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(files: &[&str]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        files.iter().for_each(|file| std::fs::write(folder.path().join(file), "").unwrap());
        folder
    }

    fn found(files: &[&str], motion: &str) -> Option<String> {
        let folder = folder(files);
        let path = find_skeleton(&folder.path().join(motion), None).ok()?;
        Some(path.file_name()?.to_string_lossy().into_owned())
    }

    #[test]
    fn the_skeleton_is_found_by_name_then_by_being_the_only_one() {
        assert_eq!(found(&["07.asf", "08.asf"], "07_01.amc").as_deref(), Some("07.asf"));
        assert_eq!(found(&["07.asf", "07_01.ASF"], "07_01.amc").as_deref(), Some("07_01.ASF"));
        assert_eq!(found(&["a_b.asf", "c.asf"], "a_b_02.amc").as_deref(), Some("a_b.asf"));
        assert_eq!(found(&["someone.asf"], "walk.amc").as_deref(), Some("someone.asf"));
        assert_eq!(found(&["a.asf", "b.asf"], "walk.amc"), None);
        assert_eq!(found(&[], "walk.amc"), None);
    }

    #[test]
    fn a_missing_skeleton_says_what_was_tried_and_how_to_name_one() {
        let folder = folder(&["a.asf", "b.asf"]);
        let error = find_skeleton(&folder.path().join("07_01.amc"), None).unwrap_err().to_string();
        for word in ["07_01.asf", "07.asf", "2 other", "ReadOptions::skeleton"] {
            assert!(error.contains(word), "{word}: {error}");
        }
        let error = find_skeleton(Path::new("07_01.amc"), Some(Path::new("gone.asf"))).unwrap_err().to_string();
        assert!(error.contains("gone.asf") && error.contains("ReadOptions::skeleton"), "{error}");
    }
}
