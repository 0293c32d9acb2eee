//! What the fuzz target of snapshots does with bytes. The tests of `sinew-stage` call the same function, so that it runs without a
//! nightly compiler.

use sinew_snapshot::{FrameKind, Snapshot};
use sinew_stage::{SNAPSHOT_VERSION, Scene, Stage, StageSnapshot};
use std::cell::RefCell;

const KIND: FrameKind = FrameKind { magic: *b"SNST", version: SNAPSHOT_VERSION };

/// As the stage compresses.
const LEVEL: u8 = 6;

/// Two bodies that touch and a joint.
const SCENE: &str = "format = 1\n[characters.one]\nreflexes = [\"balance\"]\n[props.ball]\nball_radius_m = 0.1\nmass_kg = 1\n\
                     position_m = [0, 0.1, 0.5]\n[joints.cord]\nbetween = [\"ball\", \"ground\"]\nkind = \"ball\"\nanchor_m = [0, 0.3, 0.5]\n";

/// What is in the bytes of a snapshot.
#[derive(Clone)]
struct Content {
    fingerprint: u64,
    begins: Vec<u32>,
    bases: Vec<u8>,
    /// The difference to the stage as it was built.
    state: Vec<u8>,
}

impl Content {
    fn of(bytes: &[u8]) -> Content {
        let mut from = KIND.open(bytes).expect("a snapshot");
        let (mut fingerprint, mut length, mut begins, mut block) = (0_u64, 0_usize, Vec::new(), Vec::<u8>::new());
        fingerprint.restore(&mut from).expect("a scene");
        length.restore(&mut from).expect("a length");
        begins.restore(&mut from).expect("sections");
        let mut bases = Vec::new();
        bases.restore(&mut from).expect("bases");
        block.restore(&mut from).expect("a block");
        let state = miniz_oxide::inflate::decompress_to_vec_with_limit(&block, length).expect("Deflate");
        Content { fingerprint, begins, bases, state }
    }

    fn to_bytes(&self) -> Vec<u8> {
        let mut to = KIND.begin(Vec::new());
        self.fingerprint.save(&mut to);
        self.state.len().save(&mut to);
        self.begins.save(&mut to);
        self.bases.save(&mut to);
        miniz_oxide::deflate::compress_to_vec(&self.state, LEVEL).save(&mut to);
        FrameKind::finish(to)
    }
}

thread_local! {
    static KNOWN: RefCell<Option<(Stage, Content)>> = const { RefCell::new(None) };
}

/// Changes the state in a snapshot, three bytes for each change, and restores what comes of it; then the same bytes as a snapshot.
///
/// # Panics
/// Never, whatever the bytes are.
pub fn snapshot(data: &[u8]) {
    KNOWN.with_borrow_mut(|known| {
        let (stage, content) = known.get_or_insert_with(|| {
            let mut stage = Stage::new(Scene::from_text(SCENE).expect("a scene"), None).expect("a stage");
            (0..40).for_each(|_| stage.step());
            let bytes = stage.snapshot().to_bytes(&stage).expect("bytes");
            let content = Content::of(&bytes);
            assert_eq!(content.to_bytes(), bytes, "the layout is as it is here");
            (stage, content)
        });
        let mut changed = content.clone();
        for change in data.chunks_exact(3) {
            let at = usize::from(u16::from_le_bytes([change[0], change[1]]));
            // More changes at the places whose meaning is structure: the smaller ones of each section.
            let at = match changed.begins.get(usize::from(change[2] >> 4)) {
                Some(begin) if change[2] & 8 != 0 => *begin as usize + at % 256,
                _ => at,
            };
            let length = changed.state.len();
            if let Some(byte) = changed.state.get_mut(at % length.max(1)) {
                *byte ^= change[2].max(1);
            }
        }
        restore(stage, &changed.to_bytes());
        let mut to = KIND.begin(Vec::new());
        content.fingerprint.save(&mut to);
        to.bytes(data);
        restore(stage, &FrameKind::finish(to));
        let whole = Content { state: data.to_vec(), ..content.clone() };
        restore(stage, &whole.to_bytes());
    });
}

/// What is restored is saved, looked at, and taken back.
fn restore(stage: &mut Stage, bytes: &[u8]) {
    let Ok(kept) = StageSnapshot::from_bytes(bytes, stage) else { return };
    let before = stage.snapshot();
    stage.restore(&kept).expect("it is of this scene, and has no controllers");
    let _ = (stage.frame().hash(), stage.hash(), stage.events().list().len());
    let again = stage.snapshot().to_bytes(stage).expect("what was read has bytes");
    let read = StageSnapshot::from_bytes(&again, stage);
    assert!(read.is_ok(), "what was written can be read: {read:?}");
    stage.restore(&before).expect("its own");
}
