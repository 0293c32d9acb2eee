//! `cargo xtask`.

use std::process::ExitCode;

const USAGE: &str = "\
cargo xtask check    format, lints, documentation, tests, crates that stand alone, the README's commands
cargo xtask two-hosts    a tug of war on three network hosts (Linux network namespaces, as root): two performed actors with 80 ms
                     between them and the stage, one of them killed and back; checks hashes and times

It stops at the first failure with exit code 1. Tests on captured motion need the shared folder: beside the repository, or
named by SINEW_SHARED. Where it is found they must run; where it is missing the check says how many were skipped.";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["check"] => end(xtask::check::run()),
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

fn end(result: Result<(), String>) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("xtask: {problem}");
            ExitCode::from(1)
        }
    }
}
