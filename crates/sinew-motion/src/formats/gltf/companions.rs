//! Animation of other nodes and of scales, resampled to the times of the new frames.

use super::animation;
use super::append::Append;
use super::data::Data;
use super::rewrite::set_channel;
use super::schema::Root;
use super::track::Track;
use crate::Error;
use serde_json::{Map, Value};
use std::collections::BTreeSet;

/// Samples the scales of all nodes, and the translations and rotations of the nodes that are not joints, at the times
/// (in the file, \[s\]) that the new frames came from. `input` is the accessor of the new frames' times.
pub(super) fn retime(
    file: &mut Map<String, Value>,
    append: &mut Append,
    root: &Root,
    data: &Data<'_>,
    joints: &BTreeSet<usize>,
    input: usize,
    times_in_file_secs: &[f64],
) -> Result<(), Error> {
    let tracks = animation::tracks(root, data, &vec![true; root.nodes.len()], &mut Vec::new())?;
    for (&node, tracks) in &tracks {
        let mut add = |path: &str, track: &Option<Track>| -> Result<(), Error> {
            let Some(track) = track else { return Ok(()) };
            let mut values = Vec::with_capacity(times_in_file_secs.len() * track.width);
            for &time_secs in times_in_file_secs {
                if track.width == 4 {
                    values.extend(track.rotation(time_secs).to_array().map(|value| value as f32));
                } else {
                    values.extend(track.vector(time_secs).as_vec3().to_array());
                }
            }
            let shape = if track.width == 4 { "VEC4" } else { "VEC3" };
            let output = append.floats(shape, &values, false, None);
            set_channel(file, root.chosen, node, path, input, output)
        };
        add("scale", &tracks.scale)?;
        if !joints.contains(&node) {
            add("translation", &tracks.translation)?;
            add("rotation", &tracks.rotation)?;
        }
    }
    Ok(())
}
