//! A new BVH file.

use crate::formats::text::{Axis, Baked, fixed, nearest, no_rotation, send, without_helpers};
use crate::{Clip, Error};
use glam::DVec3;
use std::io::Write;

/// Centimetres: what most programs assume for a BVH, which has no unit.
const UNITS_PER_M: f64 = 100.0;
const DECIMALS: usize = 6;
const ORDER: [Axis; 3] = [Axis::Z, Axis::X, Axis::Y];

/// Writes a clip with at least one joint.
pub(super) fn write(out: &mut dyn Write, clip: &Clip) -> Result<(), Error> {
    let clip = &*without_helpers(clip);
    let baked = Baked::new(clip);
    let order = baked.depth_first();
    let moves: Vec<bool> = (0..clip.skeleton().len())
        .map(|joint| baked.roots().contains(&joint) || clip.moving().binary_search(&joint).is_ok())
        .collect();
    send(out, hierarchy(clip, &baked, &order, &moves).as_bytes())?;
    let head = format!("MOTION\nFrames: {}\nFrame Time: {}\n", clip.frames(), clip.frame_time_secs());
    send(out, head.as_bytes())?;
    // The first frame's angles are those nearest to zero, later ones those nearest to the frame before.
    let mut before = vec![[0.0; 3]; clip.skeleton().len()];
    let mut row = String::new();
    for frame in 0..clip.frames() {
        row.clear();
        for &(joint, _) in &order {
            let local = baked.local(frame, joint);
            if moves[joint] {
                push(&mut row, (local.translation * UNITS_PER_M).to_array());
            }
            let Some(angles) = nearest(local.rotation, &ORDER, &before[joint]) else {
                return Err(no_rotation(clip, frame, joint));
            };
            before[joint] = angles.degrees;
            push(&mut row, angles.degrees);
        }
        row.push('\n');
        send(out, row.as_bytes())?;
    }
    Ok(())
}

fn push(row: &mut String, values: [f64; 3]) {
    for value in values {
        if !row.is_empty() {
            row.push(' ');
        }
        row.push_str(&fixed(value, DECIMALS));
    }
}

fn hierarchy(clip: &Clip, baked: &Baked, order: &[(usize, usize)], moves: &[bool]) -> String {
    let mut text = "HIERARCHY\n".to_owned();
    let close = |text: &mut String, from: usize, to: usize| {
        for depth in (to..from).rev() {
            indent(text, depth, "}");
        }
    };
    let mut open = 0;
    for &(joint, depth) in order {
        close(&mut text, open, depth);
        let keyword = if depth == 0 { "ROOT" } else { "JOINT" };
        indent(&mut text, depth, &format!("{keyword} {}", printable(&clip.skeleton().joints()[joint].name, joint)));
        indent(&mut text, depth, "{");
        // Readers that add the positions to the root's offset get the right height as well.
        let offset = if depth == 0 { DVec3::ZERO } else { baked.offset(joint) };
        indent(&mut text, depth + 1, &format!("OFFSET {}", triple(offset)));
        let channels = if moves[joint] { "6 Xposition Yposition Zposition" } else { "3" };
        indent(&mut text, depth + 1, &format!("CHANNELS {channels} Zrotation Xrotation Yrotation"));
        let leaf = baked.children(joint).is_empty();
        // Many readers insist on an End Site in every leaf.
        if let Some(tip) = baked.tip(joint).or(leaf.then_some(DVec3::ZERO)) {
            indent(&mut text, depth + 1, "End Site");
            indent(&mut text, depth + 1, "{");
            indent(&mut text, depth + 2, &format!("OFFSET {}", triple(tip)));
            indent(&mut text, depth + 1, "}");
        }
        open = depth + 1;
    }
    close(&mut text, open, 0);
    text
}

fn indent(text: &mut String, depth: usize, line: &str) {
    text.extend(std::iter::repeat_n('\t', depth));
    text.push_str(line);
    text.push('\n');
}

fn triple(metres: DVec3) -> String {
    let [x, y, z] = (metres * UNITS_PER_M).to_array().map(|value| fixed(value, DECIMALS));
    format!("{x} {y} {z}")
}

/// The name, without what would break the line or open a block.
fn printable(name: &str, joint: usize) -> String {
    let safe = |letter: char| if letter.is_control() || matches!(letter, '{' | '}') { '_' } else { letter };
    let name: String = name.trim().chars().map(safe).collect();
    if name.is_empty() { format!("joint{joint}") } else { name }
}
