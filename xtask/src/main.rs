//! `cargo xtask`.

use std::process::ExitCode;

const USAGE: &str = "\
cargo xtask check    format, lints, documentation, tests, crates that stand alone, the README's commands

It stops at the first failure with exit code 1. Tests on captured motion need the shared folder: beside the repository, or
named by SINEW_SHARED. Where it is found they must run; where it is missing the check says how many were skipped.";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["check"] => match xtask::check::run() {
            Ok(()) => ExitCode::SUCCESS,
            Err(problem) => {
                eprintln!("xtask: {problem}");
                ExitCode::from(1)
            }
        },
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
