//! A snapshot as bytes.

use crate::actor_snapshot::Makers;
use crate::packed::{Packed, Sections};
use crate::{Stage, StageSnapshot};
use sinew_control::tracker::TrackerKind;
use sinew_snapshot::{FrameKind, Reader, Snapshot, SnapshotError, Writer};
use std::sync::{Arc, OnceLock};

/// Version of the layout. Only this one is read.
pub const SNAPSHOT_VERSION: u32 = 1;

/// What stands around the content.
const KIND: FrameKind = FrameKind { magic: *b"SNST", version: SNAPSHOT_VERSION };

/// Why a snapshot has no bytes, or bytes are no snapshot of this stage.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SnapshotBytesError {
    /// Another magic number or version; bytes that were changed, lost or added; a state that the scene cannot have.
    #[error(transparent)]
    Bytes(#[from] SnapshotError),
    /// The snapshot is of another scene, or of the same one with other files or values.
    #[error("the snapshot is of another scene, or of this one with other files or --set values; load that scene")]
    OtherScene,
    /// Something in the run has no bytes. A snapshot in memory keeps it.
    #[error("{what} is not kept in bytes; keep the take, or the snapshot in memory")]
    NotInBytes {
        /// What it is.
        what: String,
    },
}

/// A stage as it was built. Bytes of a snapshot hold what has changed since then.
pub(crate) struct Start {
    snapshot: StageSnapshot,
    bytes: OnceLock<[Sections; 2]>,
}

impl Start {
    pub fn of(stage: &Stage) -> Start {
        Start { snapshot: stage.snapshot_of_run(), bytes: OnceLock::new() }
    }

    /// What bytes of a snapshot are compared with: the stage as it was built, and the same with its world a step later. Before its
    /// first step a world knows neither its bodies' mass properties nor who is near whom, which all later ones have in common.
    fn bytes(&self) -> &[Sections; 2] {
        self.bytes.get_or_init(|| {
            let mut stepped = self.snapshot.clone();
            stepped.world.step();
            [self.snapshot.state(), stepped.state()]
        })
    }
}

impl StageSnapshot {
    /// The snapshot as bytes, for a file: restored by [`StageSnapshot::from_bytes`] with a stage of the same scene in another process
    /// or on another machine, it goes on to the same bits. `stage` is one of the same scene, at any step.
    ///
    /// What the scene describes is not in the bytes, only what has changed since it was built, compressed (Deflate): some 18 KB a character.
    /// The layout is that of one version of this program; another version refuses it. Bytes carry a checksum against accidents, which
    /// does not authenticate: who can change them can make a state that no run would reach, in which the next step may panic. So
    /// treat them as you treat the program; what comes from others is a [`Take`](crate::Take).
    ///
    /// ```
    /// use sinew_stage::{Scene, SnapshotBytesError, Stage, StageSnapshot};
    /// const BALL: &str = "format = 1\n[props.ball]\nball_radius_m = 0.1\nmass_kg = 1\nposition_m = [0, 1, 0]";
    /// let mut stage = Stage::new(Scene::from_text(BALL)?, None)?;
    /// (0..100).for_each(|_| stage.step());
    /// let bytes = stage.snapshot().to_bytes(&stage)?;
    /// (0..100).for_each(|_| stage.step());
    ///
    /// let mut other = Stage::new(Scene::from_text(BALL)?, None)?;
    /// let kept = StageSnapshot::from_bytes(&bytes, &other)?;
    /// other.restore(&kept)?;
    /// (0..100).for_each(|_| other.step());
    /// assert_eq!(other.hash(), stage.hash());
    ///
    /// let another = Stage::new(Scene::from_text(&BALL.replace("0.1", "0.2"))?, None)?;
    /// assert!(matches!(StageSnapshot::from_bytes(&bytes, &another), Err(SnapshotBytesError::OtherScene)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`SnapshotBytesError::OtherScene`] when the stage is of another scene; [`SnapshotBytesError::NotInBytes`] when the run holds
    /// something that cannot be made again from the scene.
    pub fn to_bytes(&self, stage: &Stage) -> Result<Vec<u8>, SnapshotBytesError> {
        let start = self.start_in(stage)?;
        if !self.is_of(&self.running_scene) {
            let what = "a run in which characters, props, joints or poses were edited".to_owned();
            return Err(SnapshotBytesError::NotInBytes { what });
        }
        for (id, actor) in &self.actors {
            // Its coordinates are of the motion as it was placed then.
            if !actor.has_first_tracker
                && actor.tracker.kind() == TrackerKind::Response
                && actor.sources.own().motion().is_some()
            {
                let name = self.cast.character_name(*id);
                let what = format!("the response of `{name}` to a clip, which began in the middle of the run,");
                return Err(SnapshotBytesError::NotInBytes { what });
            }
        }
        let mut to = KIND.begin(Vec::new());
        self.scene.fingerprint().save(&mut to);
        Packed::pack(&self.state(), start.bytes()).save(&mut to);
        Ok(FrameKind::finish(to))
    }

    /// Reads a snapshot that [`StageSnapshot::to_bytes`] wrote, for a stage of the same scene; [`Stage::restore`] puts it in place.
    /// Any bytes may come; memory is at most some thousand times their length, and the scene's.
    ///
    /// # Errors
    /// [`SnapshotBytesError::Bytes`] says what is wrong with the bytes, among others [`SnapshotError::Version`] and
    /// [`SnapshotError::Corrupt`]; [`SnapshotBytesError::OtherScene`] that they are of another scene.
    pub fn from_bytes(bytes: &[u8], stage: &Stage) -> Result<StageSnapshot, SnapshotBytesError> {
        let mut from = KIND.open(bytes)?;
        let mut fingerprint = 0_u64;
        fingerprint.restore(&mut from)?;
        if fingerprint != stage.first_scene.fingerprint() {
            return Err(SnapshotBytesError::OtherScene);
        }
        let mut packed = Packed::default();
        packed.restore(&mut from)?;
        from.end()?;
        let start = stage.start.as_ref().ok_or(SnapshotBytesError::OtherScene)?;
        let state = packed.unpack(start.bytes())?;
        let mut kept = start.snapshot.clone();
        kept.restore_state(&mut Reader::new(&state))?;
        Ok(kept)
    }

    fn start_in<'a>(&self, stage: &'a Stage) -> Result<&'a Arc<Start>, SnapshotBytesError> {
        stage.start.as_ref().filter(|_| self.is_of(&stage.first_scene)).ok_or(SnapshotBytesError::OtherScene)
    }

    /// All of it but the scene.
    fn state(&self) -> Sections {
        let StageSnapshot {
            scene: _,
            running_scene: _,
            cast: _,
            world,
            actors,
            timed_effects,
            shapes,
            events,
            reactions,
            broken,
            running,
            keys,
            timed,
            hash,
            inbox,
            history,
            record,
            scripts,
        } = self;
        let mut to = Writer::new();
        world.save(&mut to);
        for actor in actors.values() {
            to.section();
            actor.save(&mut to);
        }
        to.section();
        reactions.save(&mut to);
        keys.save(&mut to);
        timed.save(&mut to);
        to.section();
        timed_effects.save(&mut to);
        shapes.save(&mut to);
        broken.save(&mut to);
        // A table that was read from a text has one.
        running.as_ref().map(|table| toml::to_string(table).unwrap_or_default()).save(&mut to);
        hash.save(&mut to);
        inbox.save(&mut to);
        history.save(&mut to);
        record.save(&mut to);
        scripts.save(&mut to);
        events.save(&mut to);
        Sections::of(to)
    }

    fn restore_state(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        self.world.restore(from)?;
        let makers = Makers { scene: &self.scene, cast: &self.cast, world: &self.world };
        self.actors.values_mut().try_for_each(|actor| actor.restore(&makers, from))?;
        self.reactions.restore(from)?;
        self.keys.restore(from)?;
        self.timed.restore(from)?;
        self.timed_effects.restore(from)?;
        self.shapes.restore(from)?;
        self.broken.restore(from)?;
        let mut running: Option<String> = None;
        running.restore(from)?;
        let table = |text: String| text.parse().map_err(|_| SnapshotError::invalid("edited scene"));
        self.running = running.map(table).transpose()?;
        self.hash.restore(from)?;
        self.inbox.restore(from)?;
        self.history.restore(from)?;
        self.record.restore(from)?;
        self.scripts.restore(from)?;
        self.events.restore(from)?;
        from.end()
    }
}
