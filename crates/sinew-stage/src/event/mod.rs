//! Events of the stage: a cause and an effect, for programs to match on and, by `Display`, for people to read.
//!
//! ```
//! use sinew_control::{Action, Command};
//! use sinew_stage::{Cause, CharacterEffect, Effect, Scene, Stage};
//! let mut stage = Stage::new(Scene::from_text("format = 1\n[characters.one]")?, None)?;
//! stage.command(Command::to("one", Action::Gain { factor: 0.5, part: None }));
//! stage.step();
//! let event = &stage.events().list()[0];
//! assert_eq!(event.cause, Cause::Command);
//! assert_eq!(event.effect, Effect::of("one", CharacterEffect::Gain { node: None, factor: 0.5 }));
//! assert_eq!(event.effect.to_string(), "one: gain of all joints is 0.5");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod cause;
mod character_effect;
mod effect;
mod log;

pub use cause::Cause;
pub use character_effect::{CharacterEffect, ReachTarget};
pub use effect::Effect;
pub use log::{Event, Events};

/// Maximum length of an untrusted text in an event \[bytes\].
const MAX_TEXT: usize = 400;

/// Truncates an untrusted text, so that ten thousand events stay small.
fn cut(text: &mut String) {
    if text.len() > MAX_TEXT {
        let end = (0..=MAX_TEXT).rev().find(|&at| text.is_char_boundary(at)).unwrap_or(0);
        text.truncate(end);
        text.push('…');
    }
}
