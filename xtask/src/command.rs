//! Runs programs with visible output.

use std::env;
use std::ffi::OsString;
use std::io::{self, BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Command, Stdio};

/// The cargo that runs this program, with arguments, in a folder.
pub fn cargo(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env::var_os("CARGO").unwrap_or_else(|| OsString::from("cargo")));
    command.args(arguments).current_dir(folder);
    command
}

/// The command as typed in a shell.
fn typed(command: &Command) -> String {
    let name = Path::new(command.get_program()).file_stem().unwrap_or_default().to_owned();
    let words = std::iter::once(name).chain(command.get_args().map(OsString::from));
    let words: Vec<String> = words.map(|word| word.to_string_lossy().into_owned()).collect();
    words.join(" ")
}

/// Says what it runs, runs it with its words passed on.
///
/// # Errors
/// When it does not end well.
pub fn run(command: &mut Command) -> Result<(), String> {
    println!("\n$ {}", typed(command));
    let status = command.status().map_err(|error| format!("{}: {error}", typed(command)))?;
    if status.success() { Ok(()) } else { Err(format!("{}: {status}", typed(command))) }
}

/// As [`run`], and counts the lines of its standard output that begin with a word.
///
/// # Errors
/// When it does not end well.
pub fn run_counting(command: &mut Command, word: &str) -> Result<usize, String> {
    println!("\n$ {}", typed(command));
    let io = |error: io::Error| format!("{}: {error}", typed(command));
    let mut child = Command::new(command.get_program());
    child.args(command.get_args()).stdout(Stdio::piped());
    if let Some(folder) = command.get_current_dir() {
        child.current_dir(folder);
    }
    let mut child = child.spawn().map_err(io)?;
    let mut count = 0;
    if let Some(output) = child.stdout.take() {
        let mut out = io::stdout().lock();
        for line in BufReader::new(output).split(b'\n') {
            let line = line.map_err(io)?;
            count += usize::from(line.starts_with(word.as_bytes()));
            out.write_all(&line).and_then(|()| out.write_all(b"\n")).map_err(io)?;
        }
    }
    let status = child.wait().map_err(io)?;
    if status.success() { Ok(count) } else { Err(format!("{}: {status}", typed(command))) }
}

/// What a command prints, when it ends well.
///
/// # Errors
/// When it does not.
pub fn output(command: &mut Command) -> Result<String, String> {
    let output = command.output().map_err(|error| format!("{}: {error}", typed(command)))?;
    if !output.status.success() {
        let words = String::from_utf8_lossy(&output.stderr);
        return Err(format!("{}: {}\n{words}", typed(command), output.status));
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}
