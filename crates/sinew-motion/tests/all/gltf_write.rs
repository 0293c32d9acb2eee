//! glTF files that we write, read by ourselves and judged by the `gltf` crate.

use crate::binary_support::world_gap;
use glam::{DQuat, DVec3};
use gltf::animation::util::ReadOutputs;
use gltf::mesh::util::{ReadIndices, ReadJoints};
use sinew_motion::formats::{BodyShape, Format, WriteJob, gltf as ours};
use sinew_motion::{Clip, Joint, Limits, Skeleton, Transform};

/// A walker of one root, two legs and an arm whose rest pose is bent, 2 s at 120 Hz.
fn clip(roots: usize) -> Clip {
    let mut skeleton = Skeleton::new();
    let mut joint = |name: &str, parent, turn: f64, at: [f64; 3], tip| {
        let rest = Transform::new(DQuat::from_rotation_z(turn), DVec3::from(at));
        skeleton.push(Joint { name: name.into(), parent, rest, tip })
    };
    let hips = joint("hips", None, 0.3, [0.1, 0.9, 0.0], None);
    let spine = joint("spine", Some(hips), 0.0, [0.0, 0.1, 0.02], None);
    joint("leftArm", Some(spine), -2.0, [0.2, 0.4, 0.0], Some(DVec3::new(0.0, -0.6, 0.0)));
    joint("leftLeg", Some(hips), 3.0, [0.1, 0.0, 0.0], Some(DVec3::new(0.0, -0.9, 0.1)));
    for _ in 1..roots {
        joint("prop", None, 0.0, [1.0, 0.0, 0.0], None);
    }
    let count = skeleton.len();
    let rests: Vec<Transform> = skeleton.joints().iter().map(|joint| joint.rest).collect();
    let mut clip = Clip::new(skeleton, 1.0 / 120.0, vec![hips]);
    for frame in 0..241 {
        let t = f64::from(frame) / 120.0;
        let mut locals = rests.clone();
        for (joint, local) in locals.iter_mut().enumerate().take(count).filter(|(joint, _)| *joint != spine) {
            local.rotation *=
                DQuat::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), libm::sin(t * 4.0 + joint as f64) * 4.0);
        }
        locals[hips].translation = DVec3::new(0.1 * t, 0.9 + 0.02 * libm::sin(t * 9.0), 1.3 * t);
        clip.push(&locals);
    }
    clip
}

fn body() -> Vec<BodyShape> {
    let capsule = |joint, to: [f64; 3], radius_m| BodyShape { joint, from: DVec3::ZERO, to: DVec3::from(to), radius_m };
    vec![
        capsule(0, [0.0, 0.0, 0.0], 0.12),
        capsule(1, [0.0, 0.4, 0.0], 0.11),
        capsule(2, [0.0, -0.6, 0.0], 0.04),
        capsule(3, [0.0, -0.9, 0.1], 0.06),
    ]
}

fn write(clip: &Clip, format: Format, body: &[BodyShape]) -> Vec<u8> {
    let mut file = Vec::new();
    ours::write(&mut file, &WriteJob { clip, source: None }, format, body).expect("the clip can be written");
    file
}

fn read(file: &[u8]) -> Clip {
    ours::read_slice(file, None, &Limits::default()).expect("our own file").clip
}

/// The binary chunk of a GLB.
fn bin(file: &[u8]) -> Vec<u8> {
    gltf::Glb::from_slice(file).expect("a GLB").bin.expect("a binary chunk").into_owned()
}

#[test]
fn a_written_clip_comes_back_in_place_in_both_formats() {
    for roots in [1, 3] {
        let clip = clip(roots);
        for (format, body) in [(Format::Glb, body()), (Format::Gltf, body()), (Format::Glb, vec![])] {
            let again = read(&write(&clip, format, &body));
            assert_eq!(again.fps(), 120.0);
            let names =
                |clip: &Clip| clip.skeleton().joints().iter().map(|joint| joint.name.clone()).collect::<Vec<_>>();
            assert_eq!(names(&again), names(&clip));
            let (distance, angle) = world_gap(&clip, &again);
            // Single precision keeps 24 bits: 1e-7 of 3 m and of a turn, over a chain of three joints.
            assert!(distance < 1e-5 && angle < 1e-5, "{distance} m, {angle} rad");
            let tip = again.skeleton().joints()[2].tip.expect("a leaf keeps its tip");
            assert!((tip - DVec3::new(0.0, -0.6, 0.0)).length() < 1e-6);
        }
    }
}

#[test]
fn the_gltf_crate_finds_no_fault_and_the_same_times() {
    for (roots, body) in [(1, body()), (3, body()), (1, vec![])] {
        let clip = clip(roots);
        let file = write(&clip, Format::Glb, &body);
        let seen = gltf::Gltf::from_slice(&file).expect("it validates");
        gltf::Gltf::from_slice(&write(&clip, Format::Gltf, &body)).expect("the text validates");
        let bin = bin(&file);
        assert_eq!(seen.as_json().asset.generator.as_deref(), Some("sinew"));
        let animation = seen.animations().next().expect("an animation");
        // The spine never leaves its rest: no channel. The hips turn and move.
        assert_eq!(animation.channels().count(), clip.skeleton().len());
        for channel in animation.channels() {
            let reader = channel.reader(|buffer| Some(&bin[..buffer.length()]));
            let times: Vec<f32> = reader.read_inputs().expect("times").collect();
            assert_eq!(times.len(), 241);
            assert!(times.windows(2).all(|pair| pair[0] < pair[1]), "strictly ascending");
            match reader.read_outputs().expect("values") {
                ReadOutputs::Rotations(rotations) => {
                    let rotations: Vec<[f32; 4]> = rotations.into_f32().collect();
                    for pair in rotations.windows(2) {
                        let dot: f32 = pair[0].iter().zip(pair[1]).map(|(a, b)| a * b).sum();
                        assert!(dot > 0.0, "no viewer is led the long way round");
                    }
                }
                ReadOutputs::Translations(translations) => assert_eq!(translations.count(), 241),
                _ => panic!("only rotations and translations"),
            }
        }
    }
}

#[test]
fn views_are_aligned_inside_the_buffer_and_bounds_are_those_of_the_values() {
    let file = write(&clip(1), Format::Glb, &body());
    assert_eq!(file.len() % 4, 0);
    let seen = gltf::Gltf::from_slice(&file).unwrap();
    let bin = bin(&file);
    let mut bounded = 0;
    for accessor in seen.accessors() {
        let view = accessor.view().expect("no empty accessor");
        assert_eq!((view.offset() + accessor.offset()) % 4, 0, "aligned");
        assert!(accessor.offset() + accessor.count() * accessor.size() <= view.length());
        assert!(view.offset() + view.length() <= bin.len());
        let (Some(min), Some(max)) = (accessor.min(), accessor.max()) else { continue };
        bounded += 1;
        let width = accessor.dimensions().multiplicity();
        let values: Vec<f32> = bin[view.offset()..view.offset() + view.length()]
            .chunks_exact(4)
            .map(|bytes| f32::from_le_bytes(bytes.try_into().unwrap()))
            .collect();
        for component in 0..width {
            let column = || values.iter().skip(component).step_by(width).copied();
            assert_eq!(min[component].as_f64(), Some(f64::from(column().fold(f32::MAX, f32::min))));
            assert_eq!(max[component].as_f64(), Some(f64::from(column().fold(f32::MIN, f32::max))));
        }
    }
    assert_eq!(bounded, 2, "times and positions");
}

#[test]
fn the_body_wraps_its_joints_with_its_faces_outward() {
    let clip = clip(1);
    let file = write(&clip, Format::Glb, &body());
    let seen = gltf::Gltf::from_slice(&file).unwrap();
    let bin = bin(&file);
    let skin = seen.skins().next().unwrap();
    let matrices: Vec<[[f32; 4]; 4]> =
        skin.reader(|_| Some(&bin)).read_inverse_bind_matrices().expect("matrices").collect();
    let primitive = seen.meshes().next().unwrap().primitives().next().unwrap();
    let reader = primitive.reader(|_| Some(&bin));
    let positions: Vec<DVec3> = reader.read_positions().unwrap().map(|at| DVec3::from(at.map(f64::from))).collect();
    let normals: Vec<DVec3> = reader.read_normals().unwrap().map(|at| DVec3::from(at.map(f64::from))).collect();
    let Some(ReadJoints::U16(joints)) = reader.read_joints(0) else { panic!("joints of two bytes") };
    let joints: Vec<usize> = joints.map(|joints| usize::from(joints[0])).collect();
    for weights in reader.read_weights(0).unwrap().into_f32() {
        assert_eq!(weights, [1.0, 0.0, 0.0, 0.0]);
    }
    // Each vertex lies on its capsule, at the radius from its axis, seen from its joint.
    for ((position, normal), &joint) in positions.iter().zip(&normals).zip(&joints) {
        let bind = glam::DMat4::from_cols_array_2d(&matrices[joint].map(|column| column.map(f64::from)));
        let (at, shape) = (bind.transform_point3(*position), body()[joint]);
        let axis = shape.to - shape.from;
        let along = if axis == DVec3::ZERO { 0.0 } else { (at.dot(axis) / axis.length_squared()).clamp(0.0, 1.0) };
        let off = at - axis * along;
        // Single-precision positions and matrices.
        assert!((off.length() - shape.radius_m).abs() < 1e-6);
        assert!((bind.transform_vector3(*normal) - off.normalize()).length() < 1e-5);
    }
    let Some(ReadIndices::U16(indices)) = reader.read_indices() else { panic!("indices of two bytes") };
    let indices: Vec<usize> = indices.map(usize::from).collect();
    assert_eq!(indices.len() % 3, 0);
    // A closed surface has two triangles for every three edges: V - E + F = 2 for each of the four shapes.
    assert_eq!(positions.len() as i64 - (indices.len() / 2) as i64 + (indices.len() / 3) as i64, 2 * 4);
    for triangle in indices.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|corner| positions[triangle[corner]]);
        assert!((b - a).cross(c - a).dot(normals[triangle[0]]) > 0.0, "counter-clockwise from outside");
    }
}

#[test]
fn a_clip_that_cannot_be_written_is_refused_by_name() {
    let mut broken = clip(1);
    broken.set_rotation(17, 2, DQuat::from_xyzw(f64::NAN, 0.0, 0.0, 1.0));
    let refuse = |clip: &Clip, format, body: &[BodyShape]| {
        let mut file = Vec::new();
        let error = ours::write(&mut file, &WriteJob { clip, source: None }, format, body).expect_err("refused");
        assert!(file.is_empty(), "nothing half written");
        error.to_string()
    };
    let error = refuse(&broken, Format::Glb, &[]);
    assert!(error.contains("leftArm") && error.contains("17"), "{error}");
    let mut far = clip(1);
    far.set_translation(3, 0, DVec3::splat(1e39));
    assert!(refuse(&far, Format::Glb, &[]).contains("hips"));
    let fine = clip(1);
    assert!(refuse(&fine, Format::Bvh, &[]).contains("bvh"));
    assert!(refuse(&Clip::new(fine.skeleton().clone(), 0.1, vec![]), Format::Glb, &[]).contains("no frames"));
    assert!(refuse(&Clip::new(Skeleton::new(), 0.1, vec![]), Format::Glb, &[]).contains("no"));
    for shape in [
        BodyShape { joint: 9, ..body()[0] },
        BodyShape { radius_m: 0.0, ..body()[0] },
        BodyShape { radius_m: f64::NAN, ..body()[0] },
        BodyShape { to: DVec3::NAN, ..body()[0] },
    ] {
        assert!(refuse(&fine, Format::Glb, &[shape]).contains("body[0]"));
    }
}

#[test]
fn a_single_frame_and_a_joint_at_the_origin_are_kept() {
    let mut skeleton = Skeleton::new();
    skeleton.push(Joint { name: "hips".into(), parent: None, rest: Transform::IDENTITY, tip: None });
    skeleton.push(Joint { name: "hips".into(), parent: Some(0), rest: Transform::IDENTITY, tip: None });
    let mut clip = Clip::new(skeleton, 0.1, vec![]);
    clip.push(&[Transform::IDENTITY; 2]);
    let again = read(&write(&clip, Format::Glb, &[]));
    assert_eq!((again.frames(), again.skeleton().len()), (1, 2));
}
