//! What the text formats share: scanning, numbers, Euler angles, skeletons without rest rotations.

mod baked;
mod decimals;
mod euler;
mod helper;
mod number;
mod output;
mod scan;
mod values;

pub(super) use baked::Baked;
pub(super) use decimals::{Decimals, fixed, replace};
pub(super) use euler::{Axis, compose, nearest};
pub(super) use helper::without_helpers;
pub(super) use number::number;
pub(super) use output::{Losses, check_finite, check_source, is_root, moved, no_rotation, send, turned};
pub(super) use scan::{Span, fault, is_break, is_space, line_at, line_end, next_line, show, text_start, words};
pub(super) use values::{too_many_frames, too_many_joints};
