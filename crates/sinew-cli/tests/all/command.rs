//! The command line as its user runs it.

use serde_json::Value;
use std::ffi::OsStr;
use std::path::Path;
use std::process::{Command, Output};

/// How one run went.
pub struct Ran {
    pub code: i32,
    pub out: String,
    pub err: String,
}

/// Runs `sinew` in a folder.
pub fn sinew<S: AsRef<OsStr>>(folder: &Path, arguments: impl IntoIterator<Item = S>) -> Ran {
    let mut command = Command::new(env!("CARGO_BIN_EXE_sinew"));
    let Output { status, stdout, stderr } = command.current_dir(folder).args(arguments).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    // A panic ends with 101, a signal has no code: neither is ever right.
    Ran { code: status.code().unwrap(), out: text(stdout), err: text(stderr) }
}

impl Ran {
    #[track_caller]
    pub fn done(self) -> Ran {
        assert_eq!(self.code, 0, "{}{}", self.out, self.err);
        self
    }

    /// Failed, exit code 1, and said something with these words.
    #[track_caller]
    pub fn failed(self, words: &[&str]) -> Ran {
        self.ended(1, words)
    }

    /// Refused as wrong usage, exit code 2, and said something with these words.
    #[track_caller]
    pub fn refused(self, words: &[&str]) -> Ran {
        self.ended(2, words)
    }

    #[track_caller]
    fn ended(self, code: i32, words: &[&str]) -> Ran {
        assert_eq!(self.code, code, "{}{}", self.out, self.err);
        for word in words {
            assert!(self.err.contains(word), "{word:?} is not in: {}", self.err);
        }
        self
    }
}

/// A file's JSON.
pub fn json(path: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}
