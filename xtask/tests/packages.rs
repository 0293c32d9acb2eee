//! Every crate that is to be published stands in its package, and brings along no more than its page says.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use xtask::{command, package, repository};

/// Of every file below a folder, its text.
fn sources(folder: &Path, each: &mut dyn FnMut(&Path, &str)) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, each);
        } else if let Ok(text) = fs::read_to_string(&path) {
            each(&path, &text);
        }
    }
}

#[test]
fn no_source_includes_a_file_from_outside_its_package() {
    for name in package::published().unwrap() {
        let root = repository::root().join("crates").join(&name).canonicalize().unwrap();
        sources(&root.join("src"), &mut |path, text| {
            let mut above = "";
            for line in text.lines() {
                let included = ["include_str!(\"", "include_bytes!(\""].iter().find_map(|word| line.split_once(word));
                // The README is compiled as documentation in the repository's own tests only.
                if let Some((_, rest)) = included.filter(|_| above != "#[cfg(doctest)]") {
                    let file = path.with_file_name(rest.split('"').next().unwrap());
                    let file = file.canonicalize().unwrap_or_else(|error| panic!("{}: {error}", file.display()));
                    assert!(file.starts_with(&root), "{} includes {}", path.display(), file.display());
                }
                above = line;
            }
        });
    }
}

#[test]
fn no_library_brings_more_crates_along_than_its_page_says() {
    for name in package::published().unwrap() {
        let page = repository::root().join("crates").join(&name).join("src/lib.rs");
        // The program is no library.
        let Ok(page) = fs::read_to_string(page) else { continue };
        let words = page.split("rings along fewer than ").nth(1).unwrap_or_else(|| panic!("{name} says no number"));
        let limit: usize = words.split(' ').next().unwrap().parse().unwrap();
        let tree = ["tree", "--offline", "--package", &name, "--edges", "normal,build", "--prefix", "none"];
        let tree = command::output(&mut command::cargo(&repository::root(), &tree)).unwrap();
        let crates: BTreeSet<&str> = tree.lines().filter(|line| !line.is_empty()).map(without_marks).collect();
        // It is itself among them.
        assert!(
            crates.len() - 1 < limit,
            "{name} brings {} crates along, its page says fewer than {limit}",
            crates.len() - 1
        );
    }
}

/// Name and version of a line of `cargo tree`.
fn without_marks(line: &str) -> &str {
    let end = line.match_indices(' ').nth(1).map_or(line.len(), |(at, _)| at);
    &line[..end]
}
