//! What is kept of a character's control.

use crate::actor::Actor;
use crate::cast::Cast;
use crate::scene::{CharacterSpec, Scene};
use crate::source_context::Context;
use crate::step_actors::make_tracker;
use sinew_control::reflex;
use sinew_control::source::SourceSpec;
use sinew_control::tracker::TrackerKind;
use sinew_control::{OrderError, OrderErrorKind};
use sinew_snapshot::{Reader, Snapshot, SnapshotError, Writer};
use sinew_world::World;

/// What actors are made from.
pub(crate) struct Makers<'a> {
    pub scene: &'a Scene,
    pub cast: &'a Cast,
    /// Restored already.
    pub world: &'a World,
}

impl Actor {
    /// Appends the state. Body, book and springs are not in it.
    pub(crate) fn save(&self, to: &mut Writer) {
        let Actor {
            id: _,
            sources,
            tracker,
            has_first_tracker,
            wanted,
            reflexes,
            layers,
            springs: _,
            global_gain,
            joint_gain,
            reaches,
            through,
            step_secs: _,
        } = self;
        sources.save(to);
        has_first_tracker.save(to);
        tracker.kind().save(to);
        tracker.save(to);
        wanted.save(to);
        to.length(reflexes.len());
        for (reflex, is_on) in reflexes {
            reflex.name().to_owned().save(to);
            is_on.save(to);
            reflex.save(to);
        }
        layers.save(to);
        global_gain.save(to);
        joint_gain.save(to);
        reaches.save(to);
        through.save(to);
    }

    /// Restores the state into an actor as it was at the start.
    pub(crate) fn restore(&mut self, makers: &Makers<'_>, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        let unknown = || SnapshotError::mismatch("there is no such character");
        let spec = makers.scene.characters.get(makers.cast.character_name(self.id)).ok_or_else(unknown)?;
        self.restore_sources(makers, spec, from)?;
        let (was_first, mut kind) = (self.has_first_tracker, TrackerKind::None);
        self.has_first_tracker.restore(from)?;
        kind.restore(from)?;
        if !self.has_first_tracker {
            self.tracker = make_tracker(makers.scene, makers.cast, makers.world, self, spec, kind)
                .map_err(|error| SnapshotError::mismatch(error.to_string()))?;
        } else if !was_first || self.tracker.kind() != kind {
            return Err(SnapshotError::mismatch("a character had another tracker at the start"));
        }
        self.tracker.restore(from)?;
        self.wanted.restore(from)?;
        self.reflexes.clear();
        for _ in 0..from.length()? {
            let (mut name, mut is_on) = (String::new(), false);
            name.restore(from)?;
            is_on.restore(from)?;
            let reflex = reflex::by_name(&name, self.sources.body());
            let mut reflex = reflex.ok_or(SnapshotError::invalid("name of a reflex"))?;
            reflex.restore(from)?;
            self.reflexes.push((reflex, is_on));
        }
        self.layers.restore(from)?;
        self.global_gain.restore(from)?;
        self.joint_gain.restore(from)?;
        self.reaches.restore(from)?;
        self.through.restore(from)?;
        if self.through.iter().all(|(hand, _)| *hand < 2) { Ok(()) } else { Err(SnapshotError::invalid("hand")) }
    }

    fn restore_sources(
        &mut self,
        makers: &Makers<'_>,
        spec: &CharacterSpec,
        from: &mut Reader<'_>,
    ) -> Result<(), SnapshotError> {
        let (book, first) = (self.sources.book().clone(), self.sources.first().to_owned());
        let context = Context {
            scene: makers.scene,
            spec,
            tracker: self.tracker.kind(),
            book: &book,
            first: &first,
            step_secs: makers.world.settings().step_secs(),
            clips: &[],
            running: None,
        };
        let nothing = || OrderError::new(OrderErrorKind::Contradiction, "it states no source of its own");
        let mut build = |source: &SourceSpec| source.build(&context)?.ok_or_else(nothing);
        self.sources.restore(self.id, from, &mut build)
    }
}
