//! The report and recording of a client.

use crate::jobs::run::Marks;
use serde::Serialize;
use sinew_live::session::{Client, ClientStats, ConnectionState, Role};
use sinew_stage::{Cast, Recording, StageError};
use sinew_world::Frame;

/// The report of `sinew join`.
#[derive(Clone, Debug, Serialize)]
pub struct JoinReport {
    /// The scene file.
    pub scene: String,
    /// What the client may do.
    pub role: Role,
    /// Actors that it plays.
    pub actors: Vec<String>,
    /// Physics steps that were done when it joined.
    pub joined_step: u64,
    /// Why the session ended before the client wanted to leave.
    pub ended: Option<String>,
    /// What was received.
    #[serde(flatten)]
    pub stats: ClientStats,
}

impl JoinReport {
    /// Of a client, as things are now.
    pub fn of(client: &Client) -> JoinReport {
        let welcome = client.welcome();
        JoinReport {
            scene: client.scene().file_name().to_owned(),
            role: welcome.role,
            actors: welcome.actors.clone(),
            joined_step: welcome.step,
            ended: match client.state() {
                ConnectionState::Ended(why) => Some(why.to_string()),
                _ => None,
            },
            stats: client.stats(),
        }
    }
}

/// The motion as a client sees it, for its own pictures and files, of an hour at most.
pub struct View {
    recording: Recording,
    marks: Marks,
    cast: Cast,
    steps_per_frame: u64,
    first_step: Option<u64>,
}

/// Frames that are kept: an hour at 60 Hz.
const MAX_FRAMES: usize = 216_000;

impl View {
    /// Nothing yet.
    ///
    /// # Errors
    /// When a clip of the scene cannot be read.
    pub fn of(client: &Client) -> Result<View, StageError> {
        let scene = client.scene();
        let steps_per_frame = u64::from(scene.stage.steps_per_frame()).max(1);
        let (marks, cast) = (Marks::of_scene(scene), Cast::of(scene));
        Ok(View { recording: Recording::of_scene(scene)?, marks, cast, steps_per_frame, first_step: None })
    }

    /// Takes a frame down. Frames that never came are shown as the one after them.
    pub fn push(&mut self, frame: &Frame) {
        let first = *self.first_step.get_or_insert(frame.step);
        let place = frame.step.saturating_sub(first) / self.steps_per_frame;
        // What is in later slots was added after the scene was built.
        let is_whole = frame.characters.len() >= self.recording.characters.len()
            && frame.props.len() >= self.recording.props.len();
        while is_whole && self.recording.frames as u64 <= place && self.recording.frames < MAX_FRAMES {
            self.recording.push_frame(frame);
            self.marks.watch_frame(self.recording.frames - 1, frame, &self.cast);
        }
    }

    /// What was seen.
    pub fn recording(&self) -> &Recording {
        &self.recording
    }

    /// The impacts in it; pushes and events are not sent.
    pub fn marks(&self) -> &Marks {
        &self.marks
    }
}
