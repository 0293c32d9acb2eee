//! glTF files that lie: refused with a word on where and what to do, never a panic, a hang or a flood of memory.

use crate::binary_support::{floats, glb};
use proptest::prelude::*;
use sinew_motion::formats::gltf;
use sinew_motion::{Limits, Place};

const NODES: &str = r#"[{"name":"hips","children":[1]},{"name":"spine","translation":[0,0.5,0]}]"#;
const VIEWS: &str = r#"[{"buffer":0,"byteLength":12},{"buffer":0,"byteOffset":12,"byteLength":48}]"#;
const ACCESSORS: &str = r#"[{"bufferView":0,"componentType":5126,"count":3,"type":"SCALAR"},
    {"bufferView":1,"componentType":5126,"count":3,"type":"VEC4"}]"#;
const CHANNELS: &str = r#"[{"sampler":0,"target":{"node":1,"path":"rotation"}}]"#;
const SAMPLERS: &str = r#"[{"input":0,"output":1}]"#;

/// The parts of a small healthy file, to be made ill one at a time.
struct Parts<'a> {
    nodes: &'a str,
    views: &'a str,
    accessors: &'a str,
    channels: &'a str,
    samplers: &'a str,
    more: &'a str,
    bin: Vec<u8>,
}

fn healthy() -> Parts<'static> {
    let mut bin = floats(&[0.0, 0.1, 0.3]);
    bin.extend(floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.6, 0.8, 0.0, 0.0, 0.0, 1.0]));
    let (channels, samplers) = (CHANNELS, SAMPLERS);
    Parts { nodes: NODES, views: VIEWS, accessors: ACCESSORS, channels, samplers, more: "", bin }
}

impl Parts<'_> {
    fn glb(&self) -> Vec<u8> {
        let Parts { nodes, views, accessors, channels, samplers, more, bin } = self;
        let json = format!(
            r#"{{"asset":{{"version":"2.0"}},{more}"skins":[{{"joints":[0,1]}}],"nodes":{nodes},
            "buffers":[{{"byteLength":{}}}],"bufferViews":{views},"accessors":{accessors},
            "animations":[{{"channels":{channels},"samplers":{samplers}}}]}}"#,
            bin.len()
        );
        glb(&json, bin)
    }

    /// Reads it, which must fail at an element whose name contains `place`.
    #[track_caller]
    fn fails_at(&self, place: &str) {
        let error = gltf::read_slice(&self.glb(), None, &Limits::default()).expect_err(place);
        let Place::Element(element) = error.place() else { panic!("{error}") };
        assert!(element.contains(place), "{error}");
        assert!(!error.remedy().is_empty() && !error.problem().is_empty());
    }
}

#[test]
fn the_healthy_file_is_read() {
    assert_eq!(gltf::read_slice(&healthy().glb(), None, &Limits::default()).unwrap().clip.frames(), 10);
}

#[test]
fn accessors_that_reach_beyond_their_views_are_refused() {
    let accessor =
        |second: &str| format!(r#"[{{"bufferView":0,"componentType":5126,"count":3,"type":"SCALAR"}},{second}]"#);
    for (second, place) in [
        (r#"{"bufferView":1,"componentType":5126,"count":4,"type":"VEC4"}"#, "accessors[1]"),
        (r#"{"bufferView":1,"byteOffset":4,"componentType":5126,"count":3,"type":"VEC4"}"#, "accessors[1]"),
        (
            r#"{"bufferView":1,"byteOffset":18446744073709551615,"componentType":5126,"count":3,"type":"VEC4"}"#,
            "accessors[1]",
        ),
        (r#"{"bufferView":1,"componentType":5126,"count":18446744073709551615,"type":"VEC4"}"#, "accessors[1]"),
        (r#"{"bufferView":1,"componentType":5126,"count":0,"type":"VEC4"}"#, "accessors[1]"),
        (r#"{"componentType":5126,"count":4000000000,"type":"VEC4"}"#, "accessors[1]"),
        (r#"{"bufferView":9,"componentType":5126,"count":3,"type":"VEC4"}"#, "accessors[1]"),
        (r#"{"bufferView":1,"componentType":5125,"count":3,"type":"VEC4"}"#, "accessors[1]"),
        (r#"{"bufferView":1,"componentType":5122,"count":3,"type":"VEC4"}"#, "accessors[1]"),
        (r#"{"bufferView":1,"componentType":77,"count":3,"type":"VEC4"}"#, "accessors[1]"),
        (r#"{"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"}"#, "accessors[1]"),
        (r#"{"bufferView":1,"componentType":5126,"count":2,"type":"VEC4"}"#, "samplers[0].output"),
        (
            r#"{"bufferView":1,"componentType":5126,"count":3,"type":"VEC4","sparse":{"count":1,"indices":{"bufferView":0,"componentType":5125},"values":{"bufferView":1}}}"#,
            "accessors[1].sparse",
        ),
        (
            r#"{"bufferView":1,"componentType":5126,"count":3,"type":"VEC4","sparse":{"count":4000000000,"indices":{"bufferView":0,"componentType":5125},"values":{"bufferView":1}}}"#,
            "accessors[1].sparse",
        ),
    ] {
        let accessors = accessor(second);
        // The first index is then the bits of 1.0, far beyond the end.
        let accessors =
            accessors.replace(r#""indices":{"bufferView":0,"#, r#""indices":{"bufferView":1,"byteOffset":12,"#);
        Parts { accessors: &accessors, ..healthy() }.fails_at(place);
    }
}

#[test]
fn views_that_reach_beyond_their_buffers_are_refused() {
    for second in [
        r#"{"buffer":0,"byteOffset":13,"byteLength":48}"#,
        r#"{"buffer":0,"byteOffset":12,"byteLength":1000000000000}"#,
        r#"{"buffer":0,"byteOffset":18446744073709551615,"byteLength":48}"#,
        r#"{"buffer":0,"byteOffset":12,"byteLength":48,"byteStride":1}"#,
        r#"{"buffer":0,"byteOffset":12,"byteLength":48,"byteStride":0}"#,
        r#"{"buffer":3,"byteLength":48}"#,
    ] {
        let views = format!(r#"[{{"buffer":0,"byteLength":12}},{second}]"#);
        Parts { views: &views, ..healthy() }.fails_at("bufferViews[1]");
    }
    let views = r#"[{"buffer":0,"byteLength":12},{"buffer":0,"byteOffset":12,"byteLength":48,"byteStride":18446744073709551615}]"#;
    Parts { views, ..healthy() }.fails_at("accessors[1]");
}

#[test]
fn nodes_that_are_their_own_ancestors_or_have_two_parents_are_refused() {
    for (nodes, place) in [
        (r#"[{"children":[1]},{"children":[0]}]"#, "nodes[0]"),
        (r#"[{"children":[0]},{}]"#, "nodes[0]"),
        (r#"[{"children":[1]},{"children":[2]},{"children":[1]}]"#, "nodes[2]"),
        (r#"[{"children":[1,1]},{}]"#, "nodes[0].children"),
        (r#"[{"children":[7]},{}]"#, "nodes[0].children"),
    ] {
        Parts { nodes, ..healthy() }.fails_at(place);
    }
}

#[test]
fn a_chain_of_50000_nodes_is_refused_when_it_is_the_skeleton_and_skipped_when_not() {
    let chain = |tail: &str| {
        let mut nodes =
            (1..50_000).map(|child| format!(r#"{{"translation":[0,1,0],"children":[{child}]}}"#)).collect::<Vec<_>>();
        nodes.push("{}".into());
        format!(r#"{{"asset":{{"version":"2.0"}},"nodes":[{}],"skins":[{{"joints":[{tail}]}}]}}"#, nodes.join(","))
    };
    let error = gltf::read_slice(chain("49999").as_bytes(), None, &Limits::default()).unwrap_err();
    assert!(error.problem().contains("joints"), "{error}");
    let wide = Limits { joints: 100_000, ..Limits::default() };
    let error = gltf::read_slice(chain("49999").as_bytes(), None, &wide).unwrap_err();
    assert!(error.problem().contains("deeper"), "{error}");
    let parsed = gltf::read_slice(chain("0").as_bytes(), None, &Limits::default()).unwrap();
    assert_eq!(parsed.clip.skeleton().len(), 1);
}

#[test]
fn broken_numbers_are_refused_where_they_are() {
    let with = |at: usize, value: f32| {
        let mut parts = healthy();
        parts.bin[at * 4..at * 4 + 4].copy_from_slice(&value.to_le_bytes());
        parts
    };
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        with(1, value).fails_at("accessors[0]");
        with(8, value).fails_at("accessors[1]");
    }
    with(1, 0.0).fails_at("samplers[0].input");
    with(1, 0.3).fails_at("samplers[0].input");
    with(1, -1.0).fails_at("samplers[0].input");
    with(6, 5.0).fails_at("samplers[0].output");
    with(6, 0.0).fails_at("samplers[0].output");
}

#[test]
fn a_long_time_between_few_keys_does_not_become_a_gigabyte() {
    let mut parts = healthy();
    parts.bin[8..12].copy_from_slice(&1e9_f32.to_le_bytes());
    parts.fails_at("animations[0]");
}

#[test]
fn indices_names_and_words_that_mean_nothing_are_refused() {
    Parts { channels: r#"[{"sampler":4,"target":{"node":1,"path":"rotation"}}]"#, ..healthy() }.fails_at("channels[0]");
    Parts { channels: r#"[{"sampler":0,"target":{"node":9,"path":"rotation"}}]"#, ..healthy() }.fails_at("channels[0]");
    let twice =
        r#"[{"sampler":0,"target":{"node":1,"path":"rotation"}},{"sampler":0,"target":{"node":1,"path":"rotation"}}]"#;
    Parts { channels: twice, ..healthy() }.fails_at("channels[1]");
    Parts { samplers: r#"[{"input":8,"output":1}]"#, ..healthy() }.fails_at("samplers[0].input");
    Parts { samplers: r#"[{"input":0,"output":8}]"#, ..healthy() }.fails_at("samplers[0].output");
    Parts { samplers: r#"[{"input":0,"output":1,"interpolation":"MAGIC"}]"#, ..healthy() }.fails_at("samplers[0]");
    let packed = r#""extensionsRequired":["EXT_meshopt_compression"],"#;
    Parts { more: packed, ..healthy() }.fails_at("extensionsRequired");
    for (nodes, place) in [
        (r#"[{"rotation":[0,0,0,9]},{}]"#, "nodes[0].rotation"),
        (r#"[{"rotation":[0,0,0,0]},{}]"#, "nodes[0].rotation"),
        (r#"[{"translation":[1e39,0,0]},{}]"#, "nodes[0].translation"),
        (r#"[{"scale":[1,1,1e300]},{}]"#, "nodes[0].scale"),
        (r#"[{"matrix":[0,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]},{}]"#, "nodes[0].matrix"),
        (r#"[{"matrix":[1,0,0,5,0,1,0,0,0,0,1,0,0,0,0,1]},{}]"#, "nodes[0].matrix"),
    ] {
        Parts { nodes, ..healthy() }.fails_at(place);
    }
    let name = format!(r#"[{{"name":"{}"}},{{}}]"#, "x".repeat(2000));
    Parts { nodes: &name, ..healthy() }.fails_at("nodes[0].name");
    let skin = br#"{"asset":{"version":"2.0"},"nodes":[],"skins":[{"joints":[5]}]}"#;
    assert!(gltf::read_slice(skin, None, &Limits::default()).unwrap_err().to_string().contains("skins[0].joints"));
    let old = br#"{"asset":{"version":"1.0"},"nodes":[],"skins":[]}"#;
    assert!(gltf::read_slice(old, None, &Limits::default()).unwrap_err().to_string().contains("2.0"));
}

#[test]
fn json_that_is_deep_or_a_mere_flood_of_values_is_refused_before_it_is_parsed() {
    let deep = format!(r#"{{"asset":{{"version":"2.0"}},"extras":{}1{}}}"#, "[".repeat(100_000), "]".repeat(100_000));
    let flood = format!(r#"{{"asset":{{"version":"2.0"}},"extras":[{}0]}}"#, "0,".repeat(3_000_000));
    for json in [deep, flood, "[".repeat(1_000_000)] {
        let error = gltf::read_slice(json.as_bytes(), None, &Limits::default()).unwrap_err();
        assert!(matches!(error.place(), Place::Byte(_)), "{error}");
    }
    for json in ["", "{", "null", "{}", "[]", "glT", "\u{feff}{}", r#"{"asset":{"version":2}}"#] {
        gltf::read_slice(json.as_bytes(), None, &Limits::default()).expect_err(json);
    }
}

#[test]
fn overlapping_accessors_cannot_ask_for_more_values_than_the_limit() {
    let limits = Limits { values: 14, ..Limits::default() };
    let error = gltf::read_slice(&healthy().glb(), None, &limits).unwrap_err();
    assert!(error.problem().contains("more values"), "{error}");
}

#[test]
fn a_glb_cut_off_anywhere_is_refused_and_says_where() {
    let glb = healthy().glb();
    for length in 0..glb.len() {
        let error = gltf::read_slice(&glb[..length], None, &Limits::default()).expect_err("it is cut off");
        assert!(!error.remedy().is_empty());
        if length >= 12 {
            assert!(matches!(error.place(), Place::Byte(_)), "{length}: {error}");
        }
    }
}

#[test]
fn chunks_that_lie_about_their_length_are_refused() {
    let glb = healthy().glb();
    let json_bytes = u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize;
    for at in [8, 12, 20 + json_bytes] {
        let truth = u32::from_le_bytes(glb[at..at + 4].try_into().unwrap());
        for lie in [0, 1, truth - 4, truth + 4, truth + 1, 0x7fff_ffff, 0xffff_ffff] {
            let mut glb = glb.clone();
            glb[at..at + 4].copy_from_slice(&lie.to_le_bytes());
            assert!(gltf::read_slice(&glb, None, &Limits::default()).is_err(), "byte {at} says {lie}");
        }
    }
}

/// Limits under which nothing that a flipped bit asks for takes long.
fn tight() -> Limits {
    Limits { file_bytes: 1 << 16, joints: 64, depth: 16, frames: 2_000, values: 100_000, name_bytes: 64 }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn flipped_bytes_never_panic_and_what_is_read_is_finite(flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6)) {
        let mut glb = healthy().glb();
        for (at, byte) in flips {
            let at = at.index(glb.len());
            glb[at] = byte;
        }
        gltf::fuzz(&glb);
        if let Ok(parsed) = gltf::read_slice(&glb, None, &tight()) {
            prop_assert_eq!(parsed.clip.first_non_finite(), None);
            for frame in 0..parsed.clip.frames() {
                for rotation in parsed.clip.rotations(frame) {
                    prop_assert!((rotation.length() - 1.0).abs() < 1e-9);
                }
            }
        }
    }

    #[test]
    fn digits_of_the_json_may_be_anything(flips in prop::collection::vec((any::<prop::sample::Index>(), b'0'..=b'9'), 1..8)) {
        let mut glb = healthy().glb();
        let digits: Vec<usize> = (20..glb.len() - 68).filter(|&at| glb[at].is_ascii_digit()).collect();
        for (at, digit) in flips {
            glb[digits[at.index(digits.len())]] = digit;
        }
        let _ = gltf::read_slice(&glb, None, &tight());
    }
}
