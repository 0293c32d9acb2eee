//! Writing a take.

use super::line::{CommandLine, EndLine, FileLine, Header, hex};
use super::read::{MAX_BYTES, MAX_COMMANDS, MAX_LINE_BYTES};
use super::{TAKE_FORMAT, Take, TakeError, TakeErrorKind as Kind};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::path::Path;

/// Maximum size of a file in a take \[bytes\]; of larger ones it keeps the hash. A motion of a few minutes fits.
pub(super) const MAX_HELD_BYTES: usize = 4 << 20;

impl Take {
    /// Writes the take to a file, atomically.
    ///
    /// # Errors
    /// As [`Take::to_bytes`], and a folder that cannot be written to.
    pub fn write(&self, path: &Path) -> Result<(), TakeError> {
        let bytes = self.to_bytes()?;
        sinew_motion::formats::write_whole(path, &bytes)
            .map_err(|error| TakeError::whole(Kind::Unreadable, error.to_string()))
    }

    /// The take file's content.
    ///
    /// # Errors
    /// A command that cannot be read back unchanged, such as one with an infinite force, or a take that exceeds the
    /// limits.
    pub fn to_bytes(&self) -> Result<Vec<u8>, TakeError> {
        let mut out = Vec::new();
        let header = Header {
            sinew: "take".to_owned(),
            format: TAKE_FORMAT,
            version: self.version.clone(),
            scene: self.scene.clone(),
            seed: self.seed,
            physics_hz: self.physics_hz,
            sets: self.sets.clone(),
        };
        add(&mut out, &header)?;
        for (path, file) in &self.files {
            let text = file.bytes.as_deref().and_then(|bytes| std::str::from_utf8(bytes).ok()).map(str::to_owned);
            let base64 = match (&file.bytes, &text) {
                (Some(bytes), None) => Some(STANDARD.encode(bytes)),
                _ => None,
            };
            add(&mut out, &FileLine { file: path.clone(), hash: hex(file.hash), text, base64 })?;
        }
        if self.commands.len() > MAX_COMMANDS {
            let problem = format!("more than {MAX_COMMANDS} commands cannot be recorded; record a shorter run");
            return Err(TakeError::whole(Kind::TooLarge, problem));
        }
        for stamped in &self.commands {
            let start = out.len();
            add(&mut out, &CommandLine { step: stamped.step, command: stamped.command.clone() })?;
            let again = serde_json::from_slice::<CommandLine>(&out[start..]);
            if !again.is_ok_and(|again| again.command == stamped.command) {
                let problem = "a command holds a number that is not finite and cannot be recorded; check commands before \
                               they are carried out";
                return Err(TakeError::whole(Kind::NotFinite, format!("step {}: {problem}", stamped.step)));
            }
        }
        let end = EndLine {
            steps: self.steps,
            hash: hex(self.hash),
            every_steps: self.trace.as_ref().map(|trace| trace.every_steps),
            hashes: self.trace.iter().flat_map(|trace| &trace.hashes).map(|&hash| hex(hash)).collect(),
        };
        add(&mut out, &end)?;
        if out.len() > MAX_BYTES {
            let problem = format!("the take has more than {MAX_BYTES} bytes; record a shorter run");
            return Err(TakeError::whole(Kind::TooLarge, problem));
        }
        Ok(out)
    }
}

fn add<T: serde::Serialize>(out: &mut Vec<u8>, line: &T) -> Result<(), TakeError> {
    let start = out.len();
    serde_json::to_writer(&mut *out, line)
        .map_err(|error| TakeError::whole(Kind::Unreadable, format!("cannot be written: {error}")))?;
    out.push(b'\n');
    if out.len() - start > MAX_LINE_BYTES {
        let problem = format!("a line has more than {MAX_LINE_BYTES} bytes; use smaller files");
        return Err(TakeError::whole(Kind::TooLarge, problem));
    }
    Ok(())
}
