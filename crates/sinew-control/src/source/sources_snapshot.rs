//! What is kept of a character's sources. They are boxes: what is in one is made again before its state is restored.

use super::sources::{Origin, Sources};
use super::{ReachSource, Source, SourceSpec};
use crate::OrderError;
use sinew_body::humanoid::Pose;
use sinew_reach::{Start, Style};
use sinew_snapshot::{Reader, Snapshot, SnapshotError, Writer, snapshot};
use sinew_world::CharacterId;

/// Makes a source that was stated in the run.
type Build<'a> = dyn FnMut(&SourceSpec) -> Result<Box<dyn Source>, OrderError> + 'a;

snapshot!(enum Origin { 0: KeyPoses, 1: Start, 2: Stated(spec) });

impl Sources {
    /// Appends the state. Body, poses and graphs are not in it.
    pub fn save(&self, to: &mut Writer) {
        self.own_from.save(to);
        self.own.save(to);
        self.before.is_some().save(to);
        if let Some((before, from, since_secs)) = &self.before {
            from.save(to);
            before.save(to);
            since_secs.save(to);
        }
        if let Some(performer) = &self.performer {
            performer.save(to);
        }
        self.reach.is_some().save(to);
        if let Some(reach) = &self.reach {
            reach.save(to);
        }
        self.root.save(to);
    }

    /// Restores the state of the sources of `character` into what they were at the start. `build` makes a source that was stated in
    /// the run.
    ///
    /// # Errors
    /// When the bytes are of other sources, or a source cannot be made.
    pub fn restore(
        &mut self,
        character: CharacterId,
        from: &mut Reader<'_>,
        build: &mut Build<'_>,
    ) -> Result<(), SnapshotError> {
        let start = (self.own.clone(), self.own_from.clone());
        (self.own, self.own_from) = self.restored(&start, from, build)?;
        let mut is_there = false;
        is_there.restore(from)?;
        self.before = None;
        if is_there {
            let (before, origin) = self.restored(&start, from, build)?;
            let mut since_secs = 0.0;
            since_secs.restore(from)?;
            self.before = Some((before, origin, since_secs));
        }
        if let Some(performer) = &mut self.performer {
            performer.restore(from)?;
        }
        is_there.restore(from)?;
        if is_there {
            let at_rest = Start { pose: Pose::STANDING, before: None };
            let new = ReachSource::new(self.body(), character, &Style::default(), &at_rest, 0.0, self.step_secs());
            let mut reach = new.map_err(|_| SnapshotError::invalid("reach"))?;
            reach.restore(from)?;
            self.reach = Some(reach);
        } else {
            self.reach = None;
        }
        self.root.restore(from)
    }

    fn restored(
        &self,
        start: &(Box<dyn Source>, Origin),
        from: &mut Reader<'_>,
        build: &mut Build<'_>,
    ) -> Result<(Box<dyn Source>, Origin), SnapshotError> {
        let mut origin = Origin::KeyPoses;
        origin.restore(from)?;
        let mut source: Box<dyn Source> = match &origin {
            Origin::KeyPoses => Box::new(self.first_poses()),
            Origin::Start if start.1 == Origin::Start => start.0.clone(),
            Origin::Start => return Err(SnapshotError::mismatch("a character followed another source at the start")),
            Origin::Stated(spec) => build(spec).map_err(|error| SnapshotError::mismatch(error.to_string()))?,
        };
        source.restore(from)?;
        Ok((source, origin))
    }
}
