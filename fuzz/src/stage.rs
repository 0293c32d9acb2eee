//! What the fuzz targets of scenes, pose files and takes do with a file. The tests of `sinew-stage` call the same functions on
//! mutated files, so that they run without a nightly compiler.

use sinew_stage::{Scene, Take};

/// A scene that names `poses.toml`.
pub const WITH_POSES: &str = "format = 1\n[stage]\npose_files = [\"poses.toml\"]\n[characters.one]\n";

/// Reads a scene; what is read goes through a take and back.
///
/// # Panics
/// If the scene that comes back is another, or an error has no words.
pub fn scene(data: &[u8]) {
    let Some(scene) = sound("scene.toml", &[("scene.toml", data)]) else { return };
    through_a_take(&scene);
    let commands =
        scene.at.iter().map(|timed| &timed.command).chain(scene.when.iter().map(|reaction| &reaction.command));
    for command in commands.chain(scene.keys.iter().map(|binding| &binding.command)) {
        scene.check_command(command).expect("a scene's own commands are sound");
    }
    for prop in scene.props.values() {
        assert!(prop.in_world().is_some(), "a prop that was read has a shape");
    }
    for shape in scene.shapes.values() {
        assert!(shape.solid().is_some(), "a shape that was read has a form");
    }
}

/// Reads a pose file by a scene; what is read is brought to a body.
///
/// # Panics
/// As [`scene`].
pub fn pose(data: &[u8]) {
    let files = [("scene.toml", WITH_POSES.as_bytes()), ("poses.toml", data)];
    let Some(scene) = sound("scene.toml", &files) else { return };
    let body = sinew_body::humanoid::Body::standard(80.0, 1.7);
    // Circles and targets out of reach may be refused: no panic is all that is asked for.
    let Ok(poses) = sinew_control::pose::resolve_poses(&scene.poses, &body) else { return };
    for pose in poses.values() {
        assert!(pose.rotations.iter().all(|rotation| rotation.is_finite()), "what was read is finite");
    }
}

/// Reads a take; what is read is written to a take that reads the same.
///
/// # Panics
/// If it does not, or an error has no words.
pub fn take(data: &[u8]) {
    let take = match Take::read(data) {
        Ok(take) => take,
        Err(error) => return worded(&error.to_string()),
    };
    let bytes = take.to_bytes().expect("what was read can be written");
    assert_eq!(Take::read(&bytes).expect("what was written can be read"), take);
    match take.to_scene(None) {
        Ok(scene) => through_a_take(&scene),
        Err(error) => worded(&error.to_string()),
    }
}

fn sound(name: &str, files: &[(&str, &[u8])]) -> Option<Scene> {
    let files = files.iter().map(|(name, bytes)| ((*name).to_owned(), bytes.to_vec())).collect();
    match Scene::from_files(name, files) {
        Ok(scene) => Some(scene),
        Err(error) => {
            worded(&error.to_string());
            assert!(error.line.is_none_or(|line| line > 0));
            None
        }
    }
}

fn through_a_take(scene: &Scene) {
    let take = Take::of(scene);
    let again = Take::read(&take.to_bytes().expect("a take is written")).expect("a take is read");
    assert_eq!(again, take);
    assert_eq!(**scene, *again.to_scene(None).expect("the scene comes back"), "the same scene");
}

/// A sentence on one line, of a length that can be read.
fn worded(error: &str) {
    assert!(error.len() > 20 && error.len() < 8_000 && !error.contains('\n'), "{error:?}");
}
