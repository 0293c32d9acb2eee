//! The facing direction of a body.

use crate::{Clip, Humanoid, Side, Transform};
use glam::{DQuat, DVec3};

/// The horizontal unit vector in which a body faces: left × up, with left from the lines through the hip joints and
/// through the shoulder joints, each counted by its direction. `None` when both stand upright.
///
/// `world` holds `world_from_joint` of every joint, Y up.
pub fn facing(world: &[Transform], humanoid: &Humanoid) -> Option<DVec3> {
    let across = |left: usize, right: usize| (world[left].translation - world[right].translation).normalize_or_zero();
    let hips = across(humanoid.leg(Side::Left)[0], humanoid.leg(Side::Right)[0]);
    let shoulders = across(humanoid.arm(Side::Left)[0], humanoid.arm(Side::Right)[0]);
    let forward = (hips + shoulders).cross(DVec3::Y);
    // Both lines within 3° of upright, or against each other: no direction.
    (forward.length() > 0.1).then(|| forward.normalize())
}

/// [`facing`] in every frame of a clip in metres and Y up; a frame without a direction gets that of the last frame with
/// one (+Z before any).
pub fn facings(clip: &Clip, humanoid: &Humanoid) -> Vec<DVec3> {
    let mut world = Vec::new();
    let mut known = None;
    let mut all: Vec<Option<DVec3>> = (0..clip.frames())
        .map(|frame| {
            clip.world_into(frame, &mut world);
            known = facing(&world, humanoid).or(known);
            known
        })
        .collect();
    let first = all.iter().flatten().next().copied().unwrap_or(DVec3::Z);
    all.drain(..).map(|facing| facing.unwrap_or(first)).collect()
}

/// The turn about Y that brings +Z to a horizontal direction.
pub fn heading(direction: DVec3) -> DQuat {
    let yaw = libm::atan2(direction.x, direction.z);
    let (sin, cos) = (libm::sin(0.5 * yaw), libm::cos(0.5 * yaw));
    DQuat::from_xyzw(0.0, sin, 0.0, cos)
}
