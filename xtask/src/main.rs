//! `cargo xtask`.

use std::process::ExitCode;

const USAGE: &str = "\
cargo xtask check    format, lints, documentation, tests, crates that stand alone, the README's commands
cargo xtask frame-map    writes docs/frame.svg, the picture of a frame's data flow
cargo xtask two-hosts    a tug of war on three network hosts (Linux network namespaces, as root): two performed actors with 80 ms
                     between them and the stage, one of them killed and back; checks hashes and times

It stops at the first failure with exit code 1. Tests on captured motion need the shared folder: beside the repository, or
named by SINEW_SHARED. Where it is found they must run; where it is missing the check says how many were skipped.";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["check"] => end(xtask::check::run()),
        ["frame-map"] => end(write_frame_map()),
        ["two-hosts"] => end(xtask::two_hosts::run()),
        ["help" | "--help" | "-h"] => {
            println!("{USAGE}");
            ExitCode::SUCCESS
        }
        _ => {
            eprintln!("{USAGE}");
            ExitCode::from(2)
        }
    }
}

/// Writes the picture of a frame's data flow into the pages.
fn write_frame_map() -> Result<(), String> {
    let path = xtask::repository::root().join("docs/frame.svg");
    std::fs::write(&path, xtask::frame_map::svg()).map_err(|error| format!("{}: {error}", path.display()))
}

fn end(result: Result<(), String>) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("xtask: {problem}");
            ExitCode::from(1)
        }
    }
}
