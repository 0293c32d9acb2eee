//! The contents of a take.

use crate::scene::{HeldFile, Scene};
use sinew_control::Command;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The version of the format that is written.
pub const TAKE_FORMAT: u32 = 1;

/// A recorded run of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Take {
    /// The version of Sinew that recorded it.
    pub version: String,
    /// The scene file's name, one of [`Take::files`].
    pub scene: String,
    /// The scene's seed.
    pub seed: u64,
    /// The scene's physics rate \[Hz\].
    pub physics_hz: u32,
    /// Values that were changed before the run, as [`Scene::set`] takes them.
    pub sets: Vec<(String, String)>,
    /// Every file that the scene used, by the name that the scene uses for it.
    pub files: BTreeMap<String, TakeFile>,
    /// Commands from outside the scene, by the step before which they were applied; in ascending order.
    pub commands: Vec<Stamped>,
    /// Physics steps done.
    pub steps: u64,
    /// Hash over all physics steps.
    pub hash: u64,
    /// Intermediate hashes, to find where a replay diverges from the take.
    pub trace: Option<HashTrace>,
}

/// A command and its step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stamped {
    /// Physics steps done before it.
    pub step: u64,
    /// The command.
    pub command: Command,
}

sinew_snapshot::snapshot!(Stamped { step, command });

/// A file of a take.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TakeFile {
    /// xxh3 of its content, 64 bits.
    pub hash: u64,
    /// Its content; `None` for a large one, which a replay reads from where the scene had it.
    pub bytes: Option<Arc<[u8]>>,
}

/// Hashes at regular intervals.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HashTrace {
    /// Steps between two hashes, at least 1.
    pub every_steps: u64,
    /// The hash over all steps until then.
    pub hashes: Vec<u64>,
}

/// The commands of a step, from commands in ascending order of steps.
pub fn due(commands: &[Stamped], step: u64) -> &[Stamped] {
    let from = commands.partition_point(|stamped| stamped.step < step);
    let rest = &commands[from..];
    &rest[..rest.partition_point(|stamped| stamped.step == step)]
}

impl TakeFile {
    fn of(held: &HeldFile) -> TakeFile {
        TakeFile {
            hash: held.hash,
            bytes: (held.bytes.len() <= super::write::MAX_HELD_BYTES).then(|| Arc::clone(&held.bytes)),
        }
    }
}

impl Take {
    /// An empty take of a scene.
    pub fn of(scene: &Scene) -> Take {
        Take {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            scene: scene.file_name().to_owned(),
            seed: scene.stage.seed,
            physics_hz: scene.stage.physics_hz,
            sets: scene.sets().to_vec(),
            files: scene.files().iter().map(|(path, held)| (path.clone(), TakeFile::of(held))).collect(),
            commands: Vec::new(),
            steps: 0,
            hash: 0,
            trace: None,
        }
    }

    /// Adds files that it does not have yet.
    pub(crate) fn add_files(&mut self, files: &BTreeMap<String, HeldFile>) {
        for (path, held) in files {
            self.files.entry(path.clone()).or_insert_with(|| TakeFile::of(held));
        }
    }

    /// Adds a command that is applied after `step` steps.
    pub fn push(&mut self, step: u64, command: Command) {
        self.commands.push(Stamped { step, command });
    }
}
