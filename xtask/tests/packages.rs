//! Every crate that is to be published stands in its package, and brings along no more than its page says.

use std::collections::BTreeSet;
use std::fs;
use xtask::{command, package, repository};

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
