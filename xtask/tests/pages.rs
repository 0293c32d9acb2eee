//! The project's pages say what is there, and nothing is there that they do not say.

use std::collections::BTreeSet;
use std::fs;
use xtask::{page, repository};

const PAGES: [&str; 5] = ["README.md", "ARCHITECTURE.md", "CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md"];

fn read(path: &str) -> String {
    let path = repository::root().join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn files() -> Vec<String> {
    repository::files().expect("these tests need git and a clone of the repository")
}

/// The folders directly below `folder`, `""` for the root.
fn folders(folder: &str) -> BTreeSet<String> {
    let files = files();
    let inside = files.iter().filter_map(|path| path.strip_prefix(folder));
    inside.filter_map(|path| path.split_once('/')).map(|(name, _)| name.to_owned()).collect()
}

#[test]
fn architecture_names_every_crate_and_no_other() {
    let named = page::first_cells(&read("ARCHITECTURE.md"), "## Rooms");
    let named: BTreeSet<String> = named.into_iter().collect();
    assert_eq!(named, folders("crates/"), "left: ARCHITECTURE.md, \"Rooms\"; right: crates/");
}

#[test]
fn architecture_names_every_top_folder_and_no_other() {
    let named = page::first_cells(&read("ARCHITECTURE.md"), "## Folders");
    let named: BTreeSet<String> = named.into_iter().map(|name| name.trim_end_matches('/').to_owned()).collect();
    assert_eq!(named, folders(""), "left: ARCHITECTURE.md, \"Folders\"; right: the repository");
}

/// Whether a line of a Cargo.toml names a crate of ours as what is depended on, and which.
fn ours<'a>(line: &'a str, rooms: &'a [String]) -> Option<&'a String> {
    let name = line.strip_prefix("[dependencies.").unwrap_or(line);
    let name = name.split(['=', '.', ']', ' ']).next()?.trim();
    rooms.iter().find(|room| *room == name)
}

#[test]
fn every_crate_depends_on_earlier_rooms_only() {
    let rooms = page::first_cells(&read("ARCHITECTURE.md"), "## Rooms");
    assert!(!rooms.is_empty());
    for (place, room) in rooms.iter().enumerate() {
        let manifest = read(&format!("crates/{room}/Cargo.toml"));
        let mut section = "";
        for line in manifest.lines() {
            if line.starts_with('[') {
                section = line;
            }
            if !section.contains("dependencies") {
                continue;
            }
            if let Some(used) = ours(line, &rooms) {
                assert!(
                    rooms[..place].contains(used),
                    "{room} depends on {used}, which does not stand above it in ARCHITECTURE.md, \"Rooms\""
                );
            }
        }
    }
}

#[test]
fn every_path_that_the_pages_name_exists() {
    let folders: Vec<String> = folders("").into_iter().collect();
    for name in PAGES.into_iter().chain(["docs/glossary.md"]) {
        for path in page::named_paths(&read(name), &folders) {
            assert!(repository::root().join(&path).exists(), "{name} names {path}, which is not there");
        }
    }
}

#[test]
fn links_in_every_markdown_file_resolve() {
    for file in files().iter().filter(|path| path.ends_with(".md")) {
        let full = repository::root().join(file);
        for link in page::relative_links(&read(file)) {
            assert!(full.with_file_name(&link).exists(), "{file} links to {link}, which is not there");
        }
    }
}

/// Written in pieces, so that this file holds none of them.
fn of_one_machine() -> Vec<String> {
    let folders = ["work", "root", "home"].map(|name| format!("/{name}/"));
    let registries = ["index.crates", "static.crates"].map(|name| format!("{name}.io"));
    let others = [format!("registry.npm{}", "js.org"), format!("proxy.golang{}", ".org")];
    folders.into_iter().chain(registries).chain(others).collect()
}

#[test]
fn no_file_names_a_place_on_somebodys_machine_or_a_registrys_address() {
    let needles = of_one_machine();
    for file in files() {
        let bytes = fs::read(repository::root().join(&file)).unwrap();
        for needle in &needles {
            let at = bytes.windows(needle.len()).position(|window| window == needle.as_bytes());
            if let Some(at) = at {
                let line = 1 + bytes[..at].iter().filter(|&&byte| byte == b'\n').count();
                panic!("{file}:{line} holds {needle:?}; say it without");
            }
        }
    }
}

/// Files of more than a megabyte, with the reason for each; a clone stays small otherwise.
const LARGE: [(&str, &str); 0] = [];

#[test]
fn no_file_is_larger_than_a_megabyte() {
    for file in files() {
        let bytes = fs::metadata(repository::root().join(&file)).unwrap().len();
        let allowed = LARGE.iter().any(|(path, _)| *path == file);
        assert!(
            allowed || bytes <= 1 << 20,
            "{file} has {bytes} bytes; make it smaller, or name it in LARGE with a reason"
        );
    }
}

#[test]
fn the_check_that_ci_runs_is_the_readmes() {
    let commands = page::shell_lines(&read("README.md"));
    let script = read(".ci/run");
    let last = script.lines().last().unwrap_or_default();
    assert!(commands.iter().any(|command| command == last), "README.md does not say {last:?}, which .ci/run runs");
}

#[test]
fn the_picture_of_a_frame_is_the_one_that_xtask_draws() {
    assert!(
        read("docs/frame.svg") == xtask::frame_map::svg(),
        "docs/frame.svg is out of date; run cargo xtask frame-map"
    );
}
