//! Controllers in Python, in a process of their own.
//!
//! A *script* is the text of a Python file with a controller class in it (Shapiro et al. 2007, section 5 and appendix A):
//! `start()` is called once, `step()` in every simulation step. The text may come from anybody, so it runs in a child
//! process with little memory and no files, and the stage talks to it in whole steps: a [`Snapshot`] goes in, [`Command`]s
//! come out. A script that does not come back is killed, and the stage goes on.
//!
//! [`Script`] starts the child and speaks to it; it knows no Python. What the child runs is the program `sinew-script-host`, a
//! package of its own: RustPython and the words that a script can say. RustPython takes as long to build as all the rest, and
//! brings an LGPL-3.0 library (malachite) along, which a library should not force on anybody. [`ScriptHost::find`] looks for the
//! program. The Python words are listed in `docs/python.md`.
//!
//! ```
//! use sinew_script::{Limits, Script, ScriptHost, StartInfo};
//!
//! // The program that runs the child. Where there is none, the error says so and nothing hangs.
//! let host = ScriptHost { program: "no-such-program".into(), args: Vec::new(), limits: Limits::default() };
//! let info = StartInfo { source: "class C:\n    def step(self): pass\n".into(), class: "C".into(), ..StartInfo::default() };
//! assert!(Script::start(host, &info).is_err());
//! ```
//!
//! Brings along fewer than 90 crates, none of them Python.
//!
//! What it does not do: worlds, scenes.
//!
//! [`Command`]: sinew_control::Command

mod error;
mod limits;
mod names;
mod process;
pub mod protocol;
mod script;
mod snapshot;
mod state;

pub use error::{ScriptError, ScriptErrorKind};
pub use limits::Limits;
pub use names::{CharacterNames, JointName, Names, StartInfo};
pub use script::{Script, ScriptHost, StepOutcome};
pub use snapshot::{CharacterState, Contact, JointState, ObjectState, PartState, Snapshot, Thing};
pub use state::ScriptState;
