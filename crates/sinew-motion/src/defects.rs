//! Detection of defects in a motion: a rest pose at the start, frozen frames, jumps, a floor offset, foot sliding,
//! zero-length bones.

use crate::floor::{Feet, contacts, floor_height_m, runs};
use crate::gait::pose_gap;
use crate::pose::quantile;
use crate::{Clip, Humanoid, Part, Side};

/// A kind of defect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DefectKind {
    /// The first frame is a rest pose that does not belong to the motion.
    RestPoseFirst,
    /// Many frames in a row are one and the same pose.
    Frozen,
    /// A joint or the whole body jumps within one frame.
    Jump,
    /// The standing feet are above Y = 0, the floor by convention.
    FloatingFeet,
    /// The standing feet are below Y = 0.
    FeetUnderFloor,
    /// A foot slides while it stands.
    FootSkate,
    /// A bone between two parts has no length.
    ZeroLengthBone,
}

/// A defect of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Defect {
    /// The kind of defect.
    pub kind: DefectKind,
    /// First and last frame of the defect, from 0; `None` if it concerns the whole clip.
    pub frames: Option<(usize, usize)>,
    /// The joint, if the defect concerns one.
    pub joint: Option<usize>,
    /// What, where and how much, as text.
    pub text: String,
}

/// Frozen frames shorter than this are how people stand still \[s\]; also one pose to the bit.
const FROZEN_SECS: f64 = 0.1;
/// Maximum angular speed of a joint relative to its parent: a baseball pitcher's shoulder reaches 130 rad/s, everything
/// else stays below 45.
const MAX_TURN_RAD_S: f64 = 60.0;
/// Maximum speed of the hips: the fastest sprint is 12.4 m/s.
const MAX_TRAVEL_M_S: f64 = 13.0;
/// Maximum number of frames of a transition from the rest pose into the motion.
const GLIDE_FRAMES: usize = 12;
/// Maximum flight time: a jump of 0.9 m takes 0.86 s \[s\].
const MAX_FLIGHT_SECS: f64 = 1.0;
/// Standing feet this far from Y = 0 are reported \[m\].
const OFF_FLOOR_M: f64 = 0.03;
/// Foot sliding within one stance that is reported \[m\].
const SKATE_M: f64 = 0.05;

/// The first frame that belongs to the motion: 0, or the frame after a rest pose at the beginning. CMU's BVH
/// conversions begin with a T-pose in frame 0; those for Daz also blend from it into the motion over up to eight
/// frames.
///
/// Frame 0 is such a pose when it differs from frame 1 by more than 8° (root mean square over the joints) and by six
/// times what later frames (the 90th percentile over about 60) differ by; the transition lasts while frames still
/// differ by four times as much.
pub fn moves_from(clip: &Clip, humanoid: &Humanoid) -> usize {
    let glide = GLIDE_FRAMES.min(clip.frames() / 2);
    if glide < 2 {
        return 0;
    }
    let step = |frame: usize| pose_gap(clip, humanoid, frame, frame + 1).to_degrees();
    let later = (glide..(glide + 60).min(clip.frames() - 1)).map(step).collect();
    let usual = quantile(later, 0.9).unwrap_or(0.0);
    if step(0) < 8.0 || step(0) < 6.0 * usual {
        return 0;
    }
    // Less than a tenth of a degree counts as no motion.
    (0..glide).rev().find(|&frame| step(frame) > 4.0 * usual.max(0.1)).map_or(0, |frame| frame + 1)
}

/// Finds the defects of a clip in metres and Y up, in the order of [`DefectKind`].
pub fn find_defects(clip: &Clip, humanoid: &Humanoid) -> Vec<Defect> {
    let mut defects = Vec::new();
    if clip.frames() == 0 {
        return defects;
    }
    let from = moves_from(clip, humanoid);
    if from > 0 {
        let gap = pose_gap(clip, humanoid, 0, from).to_degrees();
        defects.push(Defect {
            kind: DefectKind::RestPoseFirst,
            frames: Some((0, from - 1)),
            joint: None,
            text: format!("frame 0 is a rest pose, {gap:.0}° from the motion, which begins at frame {from}"),
        });
    }
    frozen(clip, &mut defects);
    jumps(clip, humanoid, from, &mut defects);
    feet(clip, humanoid, from, &mut defects);
    zero_bones(clip, humanoid, &mut defects);
    defects
}

fn frozen(clip: &Clip, defects: &mut Vec<Defect>) {
    let same = |a: usize, b: usize| {
        clip.rotations(a) == clip.rotations(b)
            && clip.moving().iter().all(|&joint| clip.translation(a, joint) == clip.translation(b, joint))
    };
    let repeats: Vec<bool> = (0..clip.frames()).map(|frame| frame > 0 && same(frame - 1, frame)).collect();
    for (first, last) in runs(&repeats) {
        let frames = last + 2 - first;
        let secs = frames as f64 * clip.frame_time_secs();
        if secs >= FROZEN_SECS && frames > 3 {
            defects.push(Defect {
                kind: DefectKind::Frozen,
                frames: Some((first - 1, last)),
                joint: None,
                text: format!("frames {} to {last} ({frames} frames, {secs:.2} s) are one pose", first - 1),
            });
        }
    }
}

fn jumps(clip: &Clip, humanoid: &Humanoid, from: usize, defects: &mut Vec<Defect>) {
    let fps = clip.fps();
    let name = |joint: usize| &clip.skeleton().joints()[joint].name;
    let mut world = Vec::new();
    let mut before = None;
    for frame in from..clip.frames() {
        clip.world_into(frame, &mut world);
        let hips = world[humanoid.hips()].translation;
        if let Some(before) = before.replace(hips) {
            let speed = hips.distance(before) * fps;
            if speed > MAX_TRAVEL_M_S {
                defects.push(Defect {
                    kind: DefectKind::Jump,
                    frames: Some((frame - 1, frame)),
                    joint: Some(humanoid.hips()),
                    text: format!("the hips jump {:.2} m from frame {} to {frame}", hips.distance(before), frame - 1),
                });
            }
        }
    }
    for (part, joint) in humanoid.parts() {
        let mut usual: Vec<f64> = Vec::with_capacity(clip.frames());
        for frame in from + 1..clip.frames() {
            usual.push(clip.rotation(frame - 1, joint).angle_between(clip.rotation(frame, joint)));
        }
        for (at, &turn) in usual.iter().enumerate() {
            // A fast movement has fast neighbouring frames, a jump (there, or there and back) does not.
            let around = usual[at.saturating_sub(3)..(at + 4).min(usual.len())].to_vec();
            let neighbours = quantile(around, 0.5).unwrap_or(0.0);
            if turn * fps > MAX_TURN_RAD_S || turn.to_degrees() > 20.0 && turn > 6.0 * neighbours {
                let frame = from + at;
                let text = format!(
                    "{part} ({:?}) turns {:.0}° from frame {frame} to {}",
                    name(joint),
                    turn.to_degrees(),
                    frame + 1
                );
                defects.push(Defect {
                    kind: DefectKind::Jump,
                    frames: Some((frame, frame + 1)),
                    joint: Some(joint),
                    text,
                });
            }
        }
    }
}

fn feet(clip: &Clip, humanoid: &Humanoid, from: usize, defects: &mut Vec<Defect>) {
    let floor = floor_height_m(clip, humanoid);
    if floor > OFF_FLOOR_M {
        let text = format!("standing feet are {:.0} mm above Y = 0", 1e3 * floor);
        defects.push(Defect { kind: DefectKind::FloatingFeet, frames: None, joint: None, text });
    }
    if floor < -OFF_FLOOR_M {
        let text = format!("standing feet are {:.0} mm below Y = 0", -1e3 * floor);
        defects.push(Defect { kind: DefectKind::FeetUnderFloor, frames: None, joint: None, text });
    }
    let feet = Feet::of(clip, humanoid);
    let high: Vec<bool> = (0..clip.frames())
        .map(|frame| {
            feet.sides.iter().flatten().all(|point| point.positions[frame].y > floor + 2.0 * OFF_FLOOR_M * feet.scale)
        })
        .collect();
    for (first, last) in runs(&high) {
        let secs = (last + 1 - first) as f64 * clip.frame_time_secs();
        if secs > MAX_FLIGHT_SECS {
            let text = format!("both feet float for {secs:.1} s, in frames {first} to {last}");
            defects.push(Defect { kind: DefectKind::FloatingFeet, frames: Some((first, last)), joint: None, text });
        }
    }
    let contacts = contacts(clip, humanoid);
    for side in [Side::Left, Side::Right] {
        for (first, last) in contacts.stances(side) {
            let first = first.max(from);
            // The supporting point is the one that moves least in the middle half of the stance: at landing and
            // lift-off the foot rolls.
            let quarter = last.saturating_sub(first) / 4;
            let middle = first + quarter..=last.saturating_sub(quarter).max(first + quarter);
            let slide = |point: &crate::floor::FootPoint| {
                let level = |frame: usize| glam::DVec2::new(point.positions[frame].x, point.positions[frame].z);
                middle.clone().map(|frame| level(frame).distance(level(*middle.start()))).fold(0.0, f64::max)
            };
            let least = feet.sides[side as usize]
                .iter()
                .map(|point| (slide(point), point.joint))
                .min_by(|a, b| a.0.total_cmp(&b.0));
            if let Some((slide, joint)) = least.filter(|(slide, _)| *slide > SKATE_M * feet.scale) {
                let foot = if side == Side::Left { "left" } else { "right" };
                let text =
                    format!("the {foot} foot slides {:.0} mm while it stands in frames {first} to {last}", 1e3 * slide);
                defects.push(Defect {
                    kind: DefectKind::FootSkate,
                    frames: Some((first, last)),
                    joint: Some(joint),
                    text,
                });
            }
        }
    }
}

fn zero_bones(clip: &Clip, humanoid: &Humanoid, defects: &mut Vec<Defect>) {
    let skeleton = clip.skeleton();
    let lengths: Vec<f64> =
        (0..skeleton.len()).map(|joint| clip.translation(clip.frames() / 2, joint).length()).collect();
    let typical = quantile(lengths.clone(), 0.75).unwrap_or(0.0);
    for (joint, bone) in skeleton.joints().iter().enumerate() {
        let Some(parent) = bone.parent else { continue };
        if lengths[joint] > 1e-4 * typical {
            continue;
        }
        let of = humanoid.part(joint).map(Part::name).map_or(String::new(), |part| format!(" ({part})"));
        let text =
            format!("joint {:?}{of} is at the place of its parent {:?}", bone.name, skeleton.joints()[parent].name);
        defects.push(Defect { kind: DefectKind::ZeroLengthBone, frames: None, joint: Some(joint), text });
    }
}
