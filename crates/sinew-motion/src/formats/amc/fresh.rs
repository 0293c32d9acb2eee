//! A new skeleton with its motion.

use super::plan::{Planned, plan};
use crate::formats::text::{Axis, Baked, fixed, nearest, no_rotation, send, without_helpers};
use crate::{Clip, Error};
use glam::DVec3;
use std::fmt::Write as _;
use std::io::Write;

/// CMU's unit, the most widely supported: `length 0.45`.
const LENGTH: f64 = 0.45;
const UNIT_M: f64 = 0.0254 / LENGTH;
const DECIMALS: usize = 6;
/// `rx ry rz` about fixed axes: the last is outermost.
const OUTERMOST_FIRST: [Axis; 3] = [Axis::Z, Axis::Y, Axis::X];

/// Writes the skeleton of a clip.
pub(super) fn write_skeleton(out: &mut dyn Write, clip: &Clip) -> Result<(), Error> {
    let clip = &*without_helpers(clip);
    let bones = plan(clip, &Baked::new(clip))?;
    let mut text = format!(
        ":version 1.10\n:name Sinew\n:units\n  mass 1.0\n  length {LENGTH}\n  angle deg\n:documentation\n   Written by \
         Sinew\n:root\n   order TX TY TZ RX RY RZ\n   axis XYZ\n   position 0 0 0\n   orientation 0 0 0\n:bonedata\n"
    );
    for (id, bone) in bones.iter().enumerate().skip(1) {
        push_bone(&mut text, id, bone);
    }
    text.push_str(":hierarchy\n  begin\n");
    let mut children = vec![Vec::new(); bones.len()];
    for (index, bone) in bones.iter().enumerate() {
        if let Some(parent) = bone.parent {
            children[parent].push(index);
        }
    }
    for (parent, children) in children.iter().enumerate().filter(|(_, children)| !children.is_empty()) {
        text.push_str("    ");
        text.push_str(&bones[parent].name);
        for &child in children {
            text.push(' ');
            text.push_str(&bones[child].name);
        }
        text.push('\n');
    }
    text.push_str("  end\n");
    send(out, text.as_bytes())
}

fn push_bone(text: &mut String, id: usize, bone: &Planned) {
    let length = bone.span.length();
    let direction = if length > 0.0 { bone.span / length } else { DVec3::Y };
    let [x, y, z] = direction.to_array().map(|value| fixed(value, 9));
    // Writing to a string cannot fail.
    let _ = write!(
        text,
        "  begin\n     id {id}\n     name {}\n     direction {x} {y} {z}\n     length {}\n     axis 0 0 0 XYZ\n",
        bone.name,
        fixed(length / UNIT_M, 9)
    );
    let dof = match (bone.joint, bone.moves) {
        (None, _) => "",
        (Some(_), false) => "rx ry rz",
        (Some(_), true) => "tx ty tz rx ry rz",
    };
    // Readers take limits for granted, one for each degree of freedom.
    for (number, word) in dof.split_whitespace().enumerate() {
        let limit = if word.starts_with('t') { "(-1000 1000)" } else { "(-360 360)" };
        match number {
            0 => _ = writeln!(text, "    dof {dof}\n    limits {limit}"),
            _ => _ = writeln!(text, "           {limit}"),
        }
    }
    text.push_str("  end\n");
}

/// Writes the motion to that skeleton.
pub(super) fn write(out: &mut dyn Write, clip: &Clip) -> Result<(), Error> {
    let clip = &*without_helpers(clip);
    let baked = Baked::new(clip);
    let bones = plan(clip, &baked)?;
    send(out, b"# Written by Sinew\n:FULLY-SPECIFIED\n:DEGREES\n")?;
    // The first frame's angles are those nearest to zero, later ones those nearest to the frame before.
    let mut before = vec![[0.0; 3]; clip.skeleton().len()];
    let mut text = String::new();
    for frame in 0..clip.frames() {
        text.clear();
        let _ = writeln!(text, "{}", frame + 1);
        for bone in &bones {
            let Some(joint) = bone.joint else { continue };
            let local = baked.local(frame, joint);
            text.push_str(&bone.name);
            if bone.moves {
                let rest = if bone.parent.is_some() { baked.offset(joint) } else { DVec3::ZERO };
                push(&mut text, ((local.translation - rest) / UNIT_M).to_array());
            }
            let Some(angles) = nearest(local.rotation, &OUTERMOST_FIRST, &before[joint]) else {
                return Err(no_rotation(clip, frame, joint));
            };
            before[joint] = angles.degrees;
            let [z, y, x] = angles.degrees;
            push(&mut text, [x, y, z]);
            text.push('\n');
        }
        send(out, text.as_bytes())?;
    }
    Ok(())
}

fn push(text: &mut String, values: [f64; 3]) {
    for value in values {
        text.push(' ');
        text.push_str(&fixed(value, DECIMALS));
    }
}
