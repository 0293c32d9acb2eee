//! What is saved comes back bit for bit, and nothing that bytes hold can panic, hang or fill the memory.

use glam::{DMat3, DQuat, DVec2, DVec3};
use proptest::prelude::*;
use sinew_snapshot::{FrameKind, Reader, Snapshot, SnapshotError, Writer, snapshot};
use std::collections::{BTreeMap, BTreeSet, VecDeque};

const KIND: FrameKind = FrameKind { magic: *b"TEST", version: 3 };

#[derive(Clone, Debug, Default, PartialEq)]
enum Phase {
    #[default]
    Idle,
    Moving {
        since_secs: f64,
        from: DVec3,
    },
    Held(String, u8),
}

snapshot!(enum Phase { 0: Idle, 1: Moving { since_secs, from }, 2: Held(word, number) });

#[derive(Clone, Debug, Default, PartialEq)]
struct Everything {
    name: &'static str,
    flag: bool,
    integers: (u8, i16, u32, i64),
    index: usize,
    number: f64,
    vectors: (DVec2, DVec3, DQuat, DMat3),
    array: [f64; 3],
    maybe: Option<DVec3>,
    list: Vec<Phase>,
    queue: VecDeque<u16>,
    text: String,
    map: BTreeMap<String, Vec<f64>>,
    set: BTreeSet<u32>,
    phase: Phase,
}

snapshot!(Everything {
    flag, integers, index, number, vectors, array, maybe, list, queue, text, map, set, phase
} fixed { name });

fn full() -> Everything {
    Everything {
        name: "full",
        flag: true,
        integers: (1, -2, 3, -4),
        index: 77,
        number: -0.0,
        vectors: (DVec2::X, DVec3::new(1.0, 2.0, 3.0), DQuat::from_rotation_y(0.3), DMat3::from_diagonal(DVec3::Z)),
        array: [f64::MIN_POSITIVE, f64::MAX, 0.1],
        maybe: Some(DVec3::NEG_ONE),
        list: vec![Phase::Idle, Phase::Moving { since_secs: 0.5, from: DVec3::X }, Phase::Held("grip".into(), 9)],
        queue: VecDeque::from([5, 6]),
        text: "Größe".into(),
        map: BTreeMap::from([("a".into(), vec![1.0]), ("b".into(), vec![])]),
        set: BTreeSet::from([1, 5, 9]),
        phase: Phase::Held(String::new(), 0),
    }
}

fn saved<T: Snapshot + ?Sized>(state: &T) -> Vec<u8> {
    let mut to = Writer::new();
    state.save(&mut to);
    to.into_bytes()
}

#[test]
fn what_is_saved_comes_back_and_what_is_fixed_stays() {
    let bytes = KIND.save(&full());
    let mut other = Everything { name: "other", list: vec![Phase::Idle; 9], ..Everything::default() };
    KIND.restore(&mut other, &bytes).unwrap();
    assert_eq!(other, Everything { name: "other", ..full() });
    assert_eq!(KIND.save(&other), bytes, "the same state gives the same bytes");
}

#[test]
fn numbers_keep_every_bit() {
    for bits in [0, 1, 0x8000_0000_0000_0000, 0x7ff8_0000_dead_beef, u64::MAX, 1.0_f64.to_bits()] {
        let mut back = 5.0_f64;
        back.restore(&mut Reader::new(&saved(&f64::from_bits(bits)))).unwrap();
        assert_eq!(back.to_bits(), bits);
    }
}

#[test]
fn a_trait_object_is_saved_through_its_box() {
    let states: Vec<Box<dyn Snapshot>> = vec![Box::new(1.5_f64), Box::new(Phase::Held("a".into(), 2)), Box::new(7_u8)];
    let bytes = saved(&*states);
    let mut others: Vec<Box<dyn Snapshot>> = vec![Box::new(0.0_f64), Box::new(Phase::Idle), Box::new(0_u8)];
    others[..].restore(&mut Reader::new(&bytes)).unwrap();
    assert_eq!(saved(&*others), bytes);
}

#[test]
fn every_changed_byte_is_an_error_and_changes_nothing() {
    let bytes = KIND.save(&full());
    let mut state = Everything::default();
    for place in 0..bytes.len() {
        for change in [1, 0x80, 0xff] {
            let mut changed = bytes.clone();
            changed[place] ^= change;
            assert!(KIND.restore(&mut state, &changed).is_err(), "byte {place}");
        }
    }
    assert_eq!(state, Everything::default());
}

#[test]
fn every_cut_and_every_appendix_is_an_error() {
    let bytes = KIND.save(&full());
    for length in 0..bytes.len() {
        assert!(KIND.restore(&mut full(), &bytes[..length]).is_err(), "{length} bytes");
    }
    let longer = [&bytes[..], &[0]].concat();
    assert_eq!(KIND.restore(&mut full(), &longer), Err(SnapshotError::Corrupt));
}

#[test]
fn an_error_says_of_which_kind_it_is() {
    let bytes = KIND.save(&1.0_f64);
    let newer = FrameKind { version: 4, ..KIND };
    let other = FrameKind { magic: *b"ELSE", ..KIND };
    assert_eq!(newer.restore(&mut 0.0_f64, &bytes), Err(SnapshotError::Version { found: 3, expected: 4 }));
    assert_eq!(other.restore(&mut 0.0_f64, &bytes), Err(SnapshotError::NotASnapshot));
    assert_eq!(KIND.restore(&mut [0.0_f64; 2], &bytes), Err(SnapshotError::TooShort { wanted: 8, left: 0 }));
    assert_eq!(KIND.restore(&mut 0_u32, &bytes), Err(SnapshotError::TooLong { bytes: 4 }));
    assert_eq!(true.restore(&mut Reader::new(&[2])), Err(SnapshotError::invalid("bool")));
    assert_eq!(Phase::Idle.restore(&mut Reader::new(&[3])), Err(SnapshotError::invalid("variant of Phase")));
    let mut three = [0.0_f64; 3];
    assert!(matches!(three[..].restore(&mut Reader::new(&[1, 0, 0, 0, 9])), Err(SnapshotError::Mismatch { .. })));
}

#[test]
fn a_length_that_the_bytes_cannot_hold_is_refused_before_anything_is_allocated() {
    let promise = u32::MAX.to_le_bytes();
    let mut list: Vec<[f64; 64]> = Vec::new();
    assert!(matches!(list.restore(&mut Reader::new(&promise)), Err(SnapshotError::TooShort { .. })));
    assert_eq!(list.capacity(), 0);
    // A hundred elements are promised and a hundred bytes are there: enough for none of them.
    let mut lies = 100_u32.to_le_bytes().to_vec();
    lies.extend([0; 100]);
    assert!(list.restore(&mut Reader::new(&lies)).is_err());
    assert!(list.capacity() * size_of::<[f64; 64]>() <= 4 * size_of::<[f64; 64]>(), "the least that a vector grows by");
}

#[test]
fn keys_out_of_order_are_refused() {
    let bytes = saved(&vec![3_u8, 3]);
    assert!(BTreeSet::<u8>::new().restore(&mut Reader::new(&bytes)).is_err());
    let bytes = saved(&vec![(2_u8, 0_u8), (1, 0)]);
    assert!(BTreeMap::<u8, u8>::new().restore(&mut Reader::new(&bytes)).is_err());
}

#[test]
fn a_vector_that_is_restored_keeps_its_room() {
    let mut list: Vec<f64> = Vec::with_capacity(100);
    let room = list.as_ptr();
    list.restore(&mut Reader::new(&saved(&vec![1.0_f64; 50]))).unwrap();
    assert_eq!((list.len(), list.as_ptr()), (50, room));
}

proptest! {
    #[test]
    fn any_bytes_are_read_without_a_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let mut state = Everything::default();
        let _ = state.restore(&mut Reader::new(&bytes));
        prop_assert!(state.list.len() + state.queue.len() + state.set.len() <= bytes.len());
    }

    #[test]
    fn lists_of_any_content_come_back(list in prop::collection::vec(any::<(u32, i64, f64)>(), 0..50)) {
        let mut back: Vec<(u32, i64, f64)> = Vec::new();
        back.restore(&mut Reader::new(&saved(&list))).unwrap();
        prop_assert_eq!(saved(&back), saved(&list));
    }
}
