//! What is kept of a script.

use sinew_snapshot::snapshot;

/// What is kept of a script: its text, and the values of its object's attributes and its text's variables as far as they can be
/// had. `docs/python.md` says which can.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ScriptState {
    /// The text that it was last read from.
    pub(crate) source: String,
    pub(crate) is_running: bool,
    pub(crate) is_new: bool,
    pub(crate) printed: Vec<String>,
    /// In the child's own form.
    pub(crate) content: Vec<u8>,
    pub(crate) lost: Vec<String>,
}

snapshot!(ScriptState { source, is_running, is_new, printed, content, lost });

impl ScriptState {
    /// What could not be had, such as `self.gait (generator)`. After a restore it is as reading the text and making the object leave
    /// it.
    pub fn lost(&self) -> &[String] {
        &self.lost
    }
}
