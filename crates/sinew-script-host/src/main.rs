//! The program in which a scene's Python controllers run, one process for each. A stage starts it (`sinew_script::ScriptHost`), asks
//! over standard input and output, and ends it; the process gives up files, memory and children before it reads a script.
//!
//! A package of its own, because RustPython takes as long to build as all the rest: `cargo build --release -p sinew-script-host`
//! puts it beside `sinew`, which looks for it there. It contains the library malachite under LGPL-3.0.

// RustPython's macros write `unsafe` into the modules that use them; none is written by hand here.
#![allow(unsafe_code, clippy::unwrap_used, reason = "RustPython's macros")]
#![allow(
    clippy::module_inception,
    reason = "RustPython makes a Python module of a Rust one, which stands alone in its file"
)]

mod arguments;
mod bounds;
mod character;
mod console;
mod controller;
mod devices;
mod drive;
mod drive_kd;
mod fault;
mod interpreter;
mod maths;
mod random;
mod reach;
mod sense;
mod stage;
mod state;
mod words;

use controller::Controller;
use rustpython_vm::VirtualMachine;
use sinew_script::protocol::{self, Asked, MAX_REQUEST, Reply};
use sinew_script::{ScriptError, ScriptErrorKind};
use std::fs::File;
use std::io::{self, Read, Write};
use std::process::ExitCode;

/// Address space for the interpreter's thread, of which it touches what it needs. A thousand nested calls need a tenth.
const STACK_BYTES: usize = 64 << 20;

fn main() -> ExitCode {
    match std::env::var(protocol::VERSION_VARIABLE) {
        Ok(version) if version == protocol::VERSION.to_string() => {}
        // Whoever asks sees why by the code: standard output is the wire, and nobody reads standard error.
        Ok(_) => return ExitCode::from(protocol::WRONG_VERSION),
        Err(_) => {
            eprintln!(
                "sinew-script-host runs the Python controllers of a scene; `sinew run SCENE` starts it by itself"
            );
            return ExitCode::from(2);
        }
    }
    // Deep recursion is to be Python's error and not the stack's end.
    let thread = std::thread::Builder::new().stack_size(STACK_BYTES).spawn(|| {
        let done = interpreter::new().enter(serve);
        // Ends here, not by return: Python objects in thread locals must not outlive their interpreter.
        std::process::exit(i32::from(done.is_err()))
    });
    let _ = thread.map(std::thread::JoinHandle::join);
    // It has not come to its own end.
    ExitCode::from(2)
}

fn serve(vm: &VirtualMachine) -> io::Result<()> {
    let mut input = io::stdin().lock();
    let mut output = output()?;
    let mut controller: Option<Controller> = None;
    loop {
        let mut head = [0; 4];
        input.read_exact(&mut head)?;
        let mut bytes = vec![0; protocol::length(head, MAX_REQUEST)?];
        input.read_exact(&mut bytes)?;
        let (mut kept, mut lost) = (Vec::new(), Vec::new());
        let error = match protocol::content::<Asked>(&bytes)? {
            Asked::Start(start) => {
                let (info, limits) = *start;
                bounds::give_up_rights(&limits)?;
                stage::set_up(&info, limits);
                Controller::load(vm, &info.source, &info.file, &info.class).map(|new| controller = Some(new)).err()
            }
            Asked::Step(snapshot) => {
                stage::with(|stage| stage.begin(snapshot));
                let error = controller.as_mut().and_then(|controller| controller.step(vm).err());
                stage::with(stage::Stage::end);
                error
            }
            Asked::Reload(source) => match &mut controller {
                Some(controller) => controller.reload(vm, &source).err(),
                None => None,
            },
            Asked::Names(names) => {
                stage::with(|stage| stage.rename(*names));
                None
            }
            Asked::Save => {
                if let Some(controller) = &controller {
                    (kept, lost) = state_of(vm, controller)?;
                }
                None
            }
            Asked::Restore(source, bytes) => match (&mut controller, kept_state(&bytes)) {
                (Some(controller), Ok(kept)) => controller.restore(vm, &source, kept.as_ref()).err(),
                _ => Some(ScriptError {
                    kind: ScriptErrorKind::State,
                    file: String::new(),
                    line: None,
                    message: "the kept state is broken".into(),
                }),
            },
        };
        drop(bytes);
        answer(&mut output, error, kept, lost)?;
    }
}

/// Standard output as an unbuffered file.
fn output() -> io::Result<File> {
    #[cfg(unix)]
    {
        use std::os::fd::AsFd;
        Ok(File::from(io::stdout().as_fd().try_clone_to_owned()?))
    }
    #[cfg(not(unix))]
    Err(io::ErrorKind::Unsupported.into())
}

/// A script's state as bytes; empty if it is too long.
fn state_of(vm: &VirtualMachine, controller: &Controller) -> io::Result<(Vec<u8>, Vec<String>)> {
    let (kept, lost) = state::save(vm, controller);
    let bytes = postcard::to_stdvec(&kept).map_err(io::Error::other)?;
    if bytes.len() > protocol::MAX_STATE {
        let words = format!("everything: its state is longer than {} bytes", protocol::MAX_STATE);
        return Ok((Vec::new(), vec![words]));
    }
    Ok((bytes, lost))
}

/// Decodes a state; `None` for an empty one.
fn kept_state(bytes: &[u8]) -> io::Result<Option<state::Kept>> {
    if bytes.is_empty() { Ok(None) } else { postcard::from_bytes(bytes).map(Some).map_err(io::Error::other) }
}

fn answer(output: &mut File, error: Option<ScriptError>, state: Vec<u8>, lost: Vec<String>) -> io::Result<()> {
    let (commands, printed) = stage::with(stage::Stage::take);
    let commands = if commands.is_empty() { Vec::new() } else { serde_json::to_vec(&commands)? };
    let bytes = protocol::message(&Reply { commands, printed, error, state, lost }, protocol::MAX_REPLY)?;
    output.write_all(&bytes)
}

/// Maximum length of a printed line, a spoken line or a signal \[characters\].
const MAX_TEXT: usize = 300;

/// Truncates a text to a number of characters.
fn cut(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}
