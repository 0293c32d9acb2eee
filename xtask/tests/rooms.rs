//! What a row of ARCHITECTURE.md says that a crate does not know, it does not name: neither in its source nor in its manifest.

use std::collections::BTreeMap;
use std::fs;
use xtask::imports::{is_below, paths};
use xtask::{page, repository};

/// The terms of the column "knows nothing of", each with the paths that a crate must not name. An unknown term is an
/// error, because a row must be checkable.
const TERMS: [(&str, &[&str]); 22] = [
    ("all other crates of ours", &["sinew"]),
    ("masses", &["sinew_body"]),
    ("forces", &["sinew_response", "sinew_world"]),
    ("time stepping", &["sinew_response", "sinew_world", "rapier3d_f64"]),
    ("worlds", &["sinew_world", "rapier3d_f64"]),
    ("engines", &["rapier3d_f64"]),
    ("scenes", &["sinew_stage"]),
    ("where poses come from", &["sinew_control", "sinew_reach", "sinew_response", "sinew_stage", "sinew_live"]),
    ("how a pose is followed", &["sinew_control::tracker", "sinew_control::reflex"]),
    ("motion files", &["sinew_motion::formats"]),
    ("the file system", &["std::fs", "tempfile"]),
    ("sockets", &["std::net", "tokio", "quinn", "socket2"]),
    ("processes", &["std::process", "std::thread"]),
    ("the clock", &["std::time::Instant", "std::time::SystemTime"]),
    ("Python", &["rustpython", "rustpython_vm"]),
    ("skeletons", &["sinew_motion"]),
    ("methods", &["sinew_body", "sinew_response", "sinew_reach", "sinew_control"]),
    ("pictures", &["sinew_picture", "tiny_skia"]),
    ("the command line", &["clap", "std::env"]),
    ("terminals", &["indicatif", "anyhow", "std::io::stdin", "std::io::IsTerminal"]),
    ("solvers", &["nalgebra", "rapier3d_f64", "wide"]),
    ("the rigid-body library", &["rapier3d_f64"]),
];

fn read(path: &str) -> String {
    let path = repository::root().join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Every crate's terms, from the third column of the table of rooms.
fn rooms() -> BTreeMap<String, Vec<String>> {
    let text = read("ARCHITECTURE.md");
    let terms = |cell: &str| cell.split(',').map(|term| term.trim().to_owned()).collect();
    let rows = page::rows(&text, "## Rooms").into_iter();
    rows.map(|row| (row[0].trim_matches('`').to_owned(), terms(&row[2]))).collect()
}

fn forbidden(room: &str, term: &str) -> &'static [&'static str] {
    let found = TERMS.iter().find(|(known, _)| *known == term);
    found.unwrap_or_else(|| panic!("{room} knows nothing of {term:?}, which is not a term of xtask/tests/rooms.rs")).1
}

#[test]
fn a_crate_names_nothing_that_its_row_says_it_does_not_know() {
    let files = repository::files().expect("these tests need git and a clone of the repository");
    let mut faults = Vec::new();
    for (room, terms) in rooms() {
        let own = room.replace('-', "_");
        let below = format!("crates/{room}/src/");
        for file in files.iter().filter(|file| file.starts_with(&below) && file.ends_with(".rs")) {
            let named = paths(&read(file));
            for term in &terms {
                for path in forbidden(&room, term) {
                    // `sinew` stands for every crate whose name begins with it.
                    let is_named = |name: &&String| match *path {
                        "sinew" => name.starts_with("sinew") && !is_below(name, &own),
                        path => is_below(name, path),
                    };
                    faults.extend(named.iter().find(is_named).map(|name| {
                        format!("{file} names {name}, but ARCHITECTURE.md says that {room} knows nothing of {term}")
                    }));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

/// Names of the packages under `[dependencies]` and its like, those for tests left out.
fn dependencies(manifest: &str) -> Vec<String> {
    let mut names = Vec::new();
    let mut is_inside = false;
    for line in manifest.lines().map(str::trim) {
        if let Some(section) = line.strip_prefix('[') {
            let section = section.trim_end_matches(']');
            is_inside = section == "dependencies" || section.ends_with(".dependencies");
            names.extend(section.strip_prefix("dependencies.").map(str::to_owned));
        } else if is_inside && !line.starts_with('#') {
            names.extend(line.split(['.', '=', ' ']).next().filter(|name| !name.is_empty()).map(str::to_owned));
        }
    }
    names
}

#[test]
fn a_crate_depends_on_nothing_that_its_row_says_it_does_not_know() {
    let mut faults = Vec::new();
    for (room, terms) in rooms() {
        let names = dependencies(&read(&format!("crates/{room}/Cargo.toml")));
        for term in &terms {
            for path in forbidden(&room, term).iter().filter(|path| !path.contains("::")) {
                let is_named = |name: &&String| match *path {
                    "sinew" => name.starts_with("sinew"),
                    path => name.replace('-', "_") == path,
                };
                faults.extend(
                    names.iter().find(is_named).map(|name| {
                        format!("crates/{room}/Cargo.toml names {name}, but {room} knows nothing of {term}")
                    }),
                );
            }
        }
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}
