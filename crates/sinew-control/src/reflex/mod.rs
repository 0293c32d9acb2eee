//! Feedback controllers in Rust beside poses and scripts: the layer of reactive control (Shapiro et al. 2007, section
//! 6).
//!
//! A reflex reads the finished [`Frame`] of the previous step and changes the wanted pose of the layers above it. It
//! has its own state and is called at every physics step while it is switched on.

mod balance;

pub use balance::{Balance, BalanceSettings};

use crate::Wanted;
use crate::tracker::Gains;
use sinew_body::humanoid::Body;
use sinew_snapshot::Snapshot;
use sinew_world::{CharacterFrame, CharacterId, Frame};

/// The input of a reflex.
#[derive(Clone, Copy, Debug)]
pub struct Sense<'a> {
    /// The world after the last step.
    pub frame: &'a Frame,
    /// The character.
    pub own: CharacterId,
    /// Its body.
    pub body: &'a Body,
    /// Its joints' springs, before any factor.
    pub gains: &'a Gains,
    /// Length of a step \[s\].
    pub step_secs: f64,
    /// Gravity that acts on it \[m/s²\].
    pub gravity_m_s2: f64,
}

impl Sense<'_> {
    /// The character itself.
    pub fn character(&self) -> &CharacterFrame {
        &self.frame.characters[self.own.slot()]
    }
}

/// A controller in Rust. What it remembers is kept with the stage: [`Snapshot`].
pub trait Reflex: Snapshot + Send + Sync {
    /// A copy of it with all its state, which goes on to the same bits: a snapshot of a stage holds one.
    fn cloned(&self) -> Box<dyn Reflex>;

    /// Its name in scenes and commands.
    fn name(&self) -> &'static str;

    /// Changes the wanted pose for the next step. Must not panic, and not allocate.
    fn step(&mut self, sense: &Sense, target: &mut Wanted);

    /// Resets its state: it was switched on, or the character was reset.
    fn reset(&mut self);
}

impl Clone for Box<dyn Reflex> {
    fn clone(&self) -> Box<dyn Reflex> {
        self.as_ref().cloned()
    }
}

/// The names of all reflexes.
pub const NAMES: &[&str] = &["balance"];

/// A reflex by its name; `None` when there is none of that name.
pub fn by_name(name: &str, body: &Body) -> Option<Box<dyn Reflex>> {
    (name == "balance").then(|| Box::new(Balance::new(body, BalanceSettings::default())) as Box<dyn Reflex>)
}
