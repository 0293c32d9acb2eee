//! The tracker `none`: joints are limp, and the body falls.

use super::{Honours, Tracker, TrackerKind, TrackerStart, Wants};
use crate::Wanted;
use sinew_world::{CharacterId, World};

/// The tracker `none`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Limp;

sinew_snapshot::snapshot!(Limp {});

impl Limp {
    /// See [`Tracker::honours`].
    pub const HONOURS: Honours = Honours::NOTHING;
}

impl Tracker for Limp {
    fn cloned(&self) -> Box<dyn Tracker> {
        Box::new(*self)
    }

    fn kind(&self) -> TrackerKind {
        TrackerKind::None
    }

    fn honours(&self) -> Honours {
        Limp::HONOURS
    }

    fn wants(&self) -> Wants {
        Wants::Nothing
    }

    fn start(&mut self, _: &TrackerStart, world: &mut World, character: CharacterId) {
        world.set_limp(character);
    }

    fn follow(&mut self, _: &Wanted, _: &mut World, _: CharacterId) {}

    fn release(&mut self, _: &mut World, _: CharacterId) {}
}
