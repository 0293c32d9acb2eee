//! Any bytes in: no panic, no deep recursion, no unbounded memory.

#[path = "../../../../../fuzz/src/live.rs"]
mod fuzz;

use proptest::prelude::*;
use sinew_body::humanoid::{Body, Pose};
use sinew_control::perform::PerformerSample;
use sinew_live::vmc::{Malformed, VmcFrame, VmcReader};

fn frame() -> Vec<u8> {
    let body = Body::standard(70.0, 1.8);
    VmcFrame::of(&PerformerSample::of_pose(0.0, &Pose::STANDING, &body), &body).to_bytes()
}

/// As little as a thread may have anywhere.
fn on_a_small_stack(job: impl FnOnce() + Send + 'static) {
    std::thread::Builder::new().stack_size(128 << 10).spawn(job).unwrap().join().unwrap();
}

fn refusal(bytes: &[u8]) -> Malformed {
    VmcReader::new().datagram(bytes, 0.0, &mut |_| ()).unwrap_err()
}

#[test]
fn bundles_in_bundles_and_arrays_in_arrays_exhaust_no_stack() {
    on_a_small_stack(|| {
        // The innermost first: a bundle of one bundle of one bundle ...
        let mut nested = b"#bundle\0\0\0\0\0\0\0\0\x01".to_vec();
        while nested.len() < 12_000 {
            let mut outer = b"#bundle\0\0\0\0\0\0\0\0\x01".to_vec();
            outer.extend((nested.len() as u32).to_be_bytes());
            outer.append(&mut nested);
            nested = outer;
        }
        assert_eq!(refusal(&nested), Malformed::Deep);
        let mut arrays = b"/a\0\0,".to_vec();
        arrays.extend(std::iter::repeat_n(b'[', 10_000));
        arrays.extend(b"\0\0\0\0");
        assert_eq!(refusal(&arrays), Malformed::Deep);
    });
}

#[test]
fn a_datagram_that_is_too_large_or_lies_about_its_sizes_is_refused_as_a_whole() {
    assert_eq!(refusal(&vec![0; 20_000]), Malformed::Large);
    let good = frame();
    for at in [17, 18, 19] {
        let mut bytes = good.clone();
        bytes[at] = 0xff;
        assert_eq!(refusal(&bytes), Malformed::Sizes);
    }
    for length in 1..good.len() {
        let mut heard = 0;
        let _ = VmcReader::new().datagram(&good[..length], 0.0, &mut |_| heard += 1);
        // Cut exactly between two messages it is a sound, shorter bundle.
        assert!(heard <= 1);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    #[test]
    fn any_bytes_are_samples_or_an_error(bytes in prop::collection::vec(any::<u8>(), 0..600)) {
        fuzz::vmc(&bytes);
        fuzz::raw(&bytes);
    }

    #[test]
    fn a_sound_frame_with_wrong_bytes_is_samples_or_an_error(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..12),
        cut in any::<prop::sample::Index>(),
    ) {
        let mut bytes = frame();
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        fuzz::vmc(&bytes);
        bytes.truncate(cut.index(bytes.len()));
        fuzz::vmc(&bytes);
    }
}
