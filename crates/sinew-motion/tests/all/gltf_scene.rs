//! Whole scenes that we write as glTF, judged by the `gltf` crate.

use glam::{DQuat, DVec3};
use sinew_motion::formats::{
    Format, JointShape, SceneCharacter, SceneFile, SceneForm, SceneMaterial, SceneThing, gltf as ours,
};
use sinew_motion::{Clip, Joint, Skeleton, Transform};

const FRAMES: usize = 3;

fn character(name: &str, material: usize) -> SceneCharacter {
    let mut skeleton = Skeleton::new();
    let rest = |y: f64| Transform::new(DQuat::IDENTITY, DVec3::Y * y);
    let hips = skeleton.push(Joint { name: format!("{name}:hips"), parent: None, rest: rest(0.9), tip: None });
    let tip = Some(DVec3::Y * 0.3);
    let chest = skeleton.push(Joint { name: format!("{name}:chest"), parent: Some(hips), rest: rest(0.2), tip });
    let mut clip = Clip::new(skeleton, 1.0 / 60.0, vec![hips]);
    for frame in 0..FRAMES {
        let turn = Transform::new(DQuat::from_rotation_x(0.1 * frame as f64), DVec3::Y * 0.2);
        clip.push(&[rest(0.9 + 0.01 * frame as f64), turn]);
    }
    let capsule = SceneForm::Capsule { from: DVec3::ZERO, to: DVec3::Y * 0.2, radius_m: 0.1 };
    let shape = |joint, material| JointShape { joint, form: capsule.clone(), material };
    SceneCharacter { name: name.into(), clip, shapes: vec![shape(hips, material), shape(chest, 2)] }
}

fn thing(name: &str, place: impl Fn(usize) -> DVec3) -> SceneThing {
    let size_m = DVec3::new(2.0, 1.0, 0.5);
    let form = SceneForm::Box { centre: DVec3::X, rotation: DQuat::IDENTITY, size_m };
    let places = (0..FRAMES).map(|frame| Transform::new(DQuat::IDENTITY, place(frame))).collect();
    SceneThing { name: name.into(), forms: vec![form], material: 1, places }
}

fn scene() -> SceneFile {
    let material = |name: &str, rgb| SceneMaterial { name: name.into(), rgb };
    SceneFile {
        materials: vec![material("red", [255, 0, 0]), material("wood", [188, 120, 40]), material("limbs", [0, 0, 255])],
        characters: vec![character("one", 0), character("two", 0)],
        things: vec![thing("falling", |frame| DVec3::Y * (1.0 - 0.1 * frame as f64)), thing("standing", |_| DVec3::Z)],
        frame_time_secs: 1.0 / 60.0,
    }
}

#[test]
fn a_scene_has_a_skin_for_each_character_and_an_object_for_each_thing() {
    let bytes = ours::write_scene(&scene(), Format::Glb).unwrap();
    let file = gltf::Gltf::from_slice(&bytes).unwrap();
    let skins: Vec<_> = file.skins().map(|skin| (skin.name().unwrap().to_owned(), skin.joints().count())).collect();
    assert_eq!(skins, [("one".to_owned(), 2), ("two".to_owned(), 2)]);
    let armature = |name: &str| file.nodes().find(|node| node.name() == Some(name)).unwrap();
    assert_eq!(
        armature("one").children().map(|node| node.name().unwrap().to_owned()).collect::<Vec<_>>(),
        ["one:hips"]
    );
    let roots = file.scenes().next().unwrap().nodes().map(|node| node.name().unwrap().to_owned()).collect::<Vec<_>>();
    assert_eq!(roots, ["one", "one.body", "two", "two.body", "falling", "standing"]);
    // Equal things share a mesh; so do equal bodies.
    assert_eq!(armature("falling").mesh().unwrap().index(), armature("standing").mesh().unwrap().index());
    assert_eq!(file.meshes().count(), 2);
    // Only what moves has channels: the hips' place and the chest's turn of both, and the falling thing's place.
    assert_eq!(file.animations().next().unwrap().channels().count(), 5);
    let colours: Vec<_> = file.materials().map(|material| material.name().unwrap().to_owned()).collect();
    assert_eq!(colours, ["red", "wood", "limbs"]);
    let red = file.materials().next().unwrap().pbr_metallic_roughness().base_color_factor();
    assert_eq!(red, [1.0, 0.0, 0.0, 1.0]);
}

#[test]
fn a_box_is_twelve_triangles_that_face_outward() {
    let bytes = ours::write_scene(&scene(), Format::Glb).unwrap();
    let file = gltf::Gltf::from_slice(&bytes).unwrap();
    let thing = file.nodes().find(|node| node.name() == Some("standing")).unwrap();
    let primitive = thing.mesh().unwrap().primitives().next().unwrap();
    let reader = primitive.reader(|_| file.blob.as_deref());
    let points: Vec<DVec3> = reader.read_positions().unwrap().map(|point| DVec3::from(point.map(f64::from))).collect();
    let normals: Vec<DVec3> = reader.read_normals().unwrap().map(|way| DVec3::from(way.map(f64::from))).collect();
    let indices: Vec<usize> = reader.read_indices().unwrap().into_u32().map(|index| index as usize).collect();
    assert_eq!((points.len(), indices.len()), (24, 36));
    let (low, high) = (points.iter().copied().reduce(DVec3::min), points.iter().copied().reduce(DVec3::max));
    assert_eq!((low, high), (Some(DVec3::new(0.0, -0.5, -0.25)), Some(DVec3::new(2.0, 0.5, 0.25))));
    for triangle in indices.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|corner| points[triangle[corner]]);
        let normal = (b - a).cross(c - a).normalize();
        assert!(normal.dot(normals[triangle[0]]) > 0.999 && normal.dot(a - DVec3::X) > 0.0);
    }
}

#[test]
fn a_scene_that_cannot_be_written_is_an_error_with_the_name_of_its_part() {
    type Spoil = fn(&mut SceneFile);
    let cases: [(&str, Spoil); 7] = [
        ("empty", |scene| *scene = SceneFile::default()),
        ("different numbers of frames", |scene| scene.things[0].places.truncate(1)),
        ("falling", |scene| scene.things[0].places[1].translation.x = f64::NAN),
        ("standing", |scene| {
            scene.things[1].forms = vec![SceneForm::Capsule { from: DVec3::ZERO, to: DVec3::Y, radius_m: -1.0 }]
        }),
        ("standing", |scene| scene.things[1].material = 9),
        ("one", |scene| scene.characters[0].shapes[0].joint = 7),
        ("chest", |scene| scene.characters[0].clip.set_rotation(1, 1, DQuat::from_xyzw(f64::NAN, 0.0, 0.0, 1.0))),
    ];
    for (word, spoil) in cases {
        let mut scene = scene();
        spoil(&mut scene);
        let written = ours::write_scene(&scene, Format::Glb).map(|bytes| bytes.len());
        let error = written.unwrap_err().to_string();
        assert!(error.contains(word), "{word:?} is not in: {error}");
    }
}
