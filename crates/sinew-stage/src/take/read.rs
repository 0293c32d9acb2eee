//! Reading a take.

use super::TakeErrorKind as Kind;
use super::line::{AnyHeader, CommandLine, EndLine, FileLine, Header, from_hex};
use super::{HashTrace, Stamped, TAKE_FORMAT, Take, TakeError, TakeFile};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;

/// Maximum size of a take \[bytes\].
pub(super) const MAX_BYTES: usize = 256 << 20;

/// Maximum length of a line \[bytes\]: a file of 4 MiB whose every character is escaped.
pub(super) const MAX_LINE_BYTES: usize = 25 << 20;

/// Maximum number of commands in a take.
pub(super) const MAX_COMMANDS: usize = 1_000_000;

/// Maximum number of files in a take.
const MAX_FILES: usize = 2_000;

impl Take {
    /// Reads a take file.
    ///
    /// # Errors
    /// A file that cannot be read or is not a valid take: line, problem and remedy.
    pub fn open(path: &Path) -> Result<Take, TakeError> {
        let whole = |problem: String| TakeError::whole(Kind::Unreadable, format!("{}: {problem}", path.display()));
        // Checked before it is opened: opening a pipe would wait for its other end.
        let about = std::fs::metadata(path).map_err(|error| whole(format!("the take cannot be read: {error}")))?;
        if !about.is_file() {
            return Err(whole("this is no file; name a take".to_owned()));
        }
        let mut bytes = Vec::new();
        let file = std::fs::File::open(path).map_err(|error| whole(format!("the take cannot be read: {error}")))?;
        let read = file.take(MAX_BYTES as u64 + 1).read_to_end(&mut bytes);
        read.map_err(|error| whole(format!("the take cannot be read: {error}")))?;
        Take::read(&bytes).map_err(|TakeError { kind, line, problem }| {
            let line = line.map_or(String::new(), |line| format!("line {line}: "));
            TakeError::whole(kind, format!("{}: {line}{problem}", path.display()))
        })
    }

    /// Reads a take from the content of its file.
    ///
    /// # Errors
    /// As [`Take::open`].
    pub fn read(bytes: &[u8]) -> Result<Take, TakeError> {
        if bytes.len() > MAX_BYTES {
            let problem = format!("the take has more than {MAX_BYTES} bytes; record a shorter run");
            return Err(TakeError::whole(Kind::TooLarge, problem));
        }
        let Some(body) = bytes.strip_suffix(b"\n") else {
            let problem = "the take is cut off: its last line has no end; record it again";
            return Err(TakeError::whole(Kind::Incomplete, problem));
        };
        let mut lines = body.split(|&byte| byte == b'\n').enumerate().map(|(index, line)| (index + 1, line));
        let mut take = header(lines.next().map_or(&[], |(_, line)| line))?;
        let mut ended = false;
        for (number, line) in lines {
            if ended {
                return Err(TakeError::line(number, "nothing may follow the end; remove the line"));
            }
            if line.len() > MAX_LINE_BYTES {
                return Err(TakeError::line(number, format!("longer than {MAX_LINE_BYTES} bytes; record it again")));
            }
            match kind(line) {
                LineKind::File => file(number, line, &mut take)?,
                LineKind::Command => command(number, line, &mut take)?,
                LineKind::End => {
                    end(number, line, &mut take)?;
                    ended = true;
                }
            }
        }
        if !ended {
            let problem = "the take is cut off: its last line, with steps and hash, is missing; record it again";
            return Err(TakeError::whole(Kind::Incomplete, problem));
        }
        if !take.files.contains_key(&take.scene) {
            return Err(TakeError::line(1, format!("the scene {:?} is none of the take's files", short(&take.scene))));
        }
        Ok(take)
    }
}

/// What a line is, by its first key.
enum LineKind {
    File,
    Command,
    End,
}

fn kind(line: &[u8]) -> LineKind {
    let starts = |key: &str| line.starts_with(key.as_bytes());
    if starts("{\"file\"") {
        LineKind::File
    } else if starts("{\"steps\"") {
        LineKind::End
    } else {
        LineKind::Command
    }
}

fn header(line: &[u8]) -> Result<Take, TakeError> {
    let any: AnyHeader = parse(1, line)
        .map_err(|error| TakeError::line(1, format!("this is no take: {}", error.problem)).of_kind(Kind::NotATake))?;
    if any.sinew != "take" {
        return Err(TakeError::line(1, "this is no take; name a file that Take::write wrote").of_kind(Kind::NotATake));
    }
    if any.format != TAKE_FORMAT {
        let by =
            if any.version.is_empty() { String::new() } else { format!(" (written by Sinew {})", short(&any.version)) };
        let remedy = if any.format > TAKE_FORMAT { "update Sinew" } else { "record it again" };
        let problem = format!("format {}{by} is not the {TAKE_FORMAT} that this version reads; {remedy}", any.format);
        return Err(TakeError::line(1, problem).of_kind(Kind::WrongVersion));
    }
    let header: Header = parse(1, line)?;
    Ok(Take {
        version: header.version,
        scene: header.scene,
        seed: header.seed,
        physics_hz: header.physics_hz,
        sets: header.sets,
        files: BTreeMap::new(),
        commands: Vec::new(),
        steps: 0,
        hash: 0,
        trace: None,
    })
}

fn file(number: usize, line: &[u8], take: &mut Take) -> Result<(), TakeError> {
    let wrong = |problem: &str| TakeError::line(number, problem);
    if !take.commands.is_empty() {
        return Err(wrong("a file stands after a command; files come first"));
    }
    if take.files.len() >= MAX_FILES {
        let problem = format!("more than {MAX_FILES} files; use fewer");
        return Err(TakeError::line(number, problem).of_kind(Kind::TooLarge));
    }
    let line: FileLine = parse(number, line)?;
    crate::scene::allowed(&line.file).map_err(|error| TakeError::line(number, error.problem))?;
    let hash = from_hex(&line.hash).ok_or_else(|| wrong("the hash is not 16 hexadecimal digits; record it again"))?;
    let bytes = match (line.text, line.base64) {
        (Some(text), None) => Some(text.into_bytes()),
        (None, Some(code)) => Some(STANDARD.decode(code).map_err(|_| wrong("the base64 is broken; record it again"))?),
        (None, None) => None,
        (Some(_), Some(_)) => return Err(wrong("text and base64 are both given; keep one")),
    };
    if let Some(bytes) = &bytes
        && xxhash_rust::xxh3::xxh3_64(bytes) != hash
    {
        let problem =
            format!("{:?} is not the file that was recorded: its hash differs; record it again", short(&line.file));
        return Err(wrong(&problem));
    }
    let file = TakeFile { hash, bytes: bytes.map(Into::into) };
    match take.files.insert(line.file, file) {
        None => Ok(()),
        Some(_) => Err(wrong("this file stands here twice; remove one")),
    }
}

fn command(number: usize, line: &[u8], take: &mut Take) -> Result<(), TakeError> {
    let CommandLine { step, command } = parse(number, line)?;
    if take.commands.len() >= MAX_COMMANDS {
        let problem = format!("more than {MAX_COMMANDS} commands; record a shorter run");
        return Err(TakeError::line(number, problem).of_kind(Kind::TooLarge));
    }
    if take.commands.last().is_some_and(|last| last.step > step) {
        return Err(TakeError::line(number, format!("step {step} stands after a later one; put the lines in order")));
    }
    take.commands.push(Stamped { step, command });
    Ok(())
}

fn end(number: usize, line: &[u8], take: &mut Take) -> Result<(), TakeError> {
    let wrong = |problem: &str| TakeError::line(number, problem);
    let end: EndLine = parse(number, line)?;
    let hash = |text: &str| from_hex(text).ok_or_else(|| wrong("a hash is not 16 hexadecimal digits; record it again"));
    take.steps = end.steps;
    take.hash = hash(&end.hash)?;
    let hashes = end.hashes.iter().map(|text| hash(text)).collect::<Result<Vec<u64>, TakeError>>()?;
    take.trace = match end.every_steps {
        Some(0) => return Err(wrong("every_steps is 0; write at least 1")),
        Some(every_steps) if hashes.len() as u64 <= end.steps / every_steps => Some(HashTrace { every_steps, hashes }),
        Some(_) => return Err(wrong("there are more hashes than steps; record it again")),
        None if hashes.is_empty() => None,
        None => return Err(wrong("hashes have no every_steps; record it again")),
    };
    if take.commands.last().is_some_and(|last| last.step > end.steps) {
        return Err(wrong("a command stands after the last step; record it again"));
    }
    Ok(())
}

fn parse<T: serde::de::DeserializeOwned>(number: usize, line: &[u8]) -> Result<T, TakeError> {
    let text =
        std::str::from_utf8(line).map_err(|_| TakeError::line(number, "this is no UTF-8 text; record it again"))?;
    serde_json::from_str(text).map_err(|error| {
        let error = error.to_string();
        // Its own line number is always 1.
        let problem = error.split(" at line ").next().unwrap_or(&error);
        TakeError::line(number, format!("{}; record it again", short(problem)))
    })
}

fn short(text: &str) -> String {
    text.chars().take(200).map(|c| if c.is_control() { ' ' } else { c }).collect()
}
