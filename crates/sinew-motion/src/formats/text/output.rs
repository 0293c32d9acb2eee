//! Shared parts of the text writers.

use crate::formats::{Source, WriteJob};
use crate::{Clip, Error, Note, Place};
use std::collections::BTreeMap;
use std::io::Write;

/// Maximum rotation that may be lost without a note \[rad\]: below the last digit of every file.
const UNSEEN_RAD: f64 = 1e-5;
/// Maximum translation that may be lost without a note \[m\].
const UNSEEN_M: f64 = 1e-6;

/// Writes bytes.
pub(crate) fn send(out: &mut dyn Write, bytes: &[u8]) -> Result<(), Error> {
    out.write_all(bytes).map_err(|error| {
        Error::new(
            Place::File,
            format!("writing failed: {error}"),
            "check the path, its permissions and the free space",
        )
    })
}

/// Checks that a clip matches the file into which it is written: joints, rows, finite values.
pub(crate) fn check_source(job: &WriteJob, source: &Source, joints: usize, rows: usize) -> Result<(), Error> {
    let remedy = "write the motion without its source, as a new file";
    let complain = |problem: String| Err(Error::new(Place::File, problem, remedy));
    if job.clip.skeleton().len() != joints || source.clip.skeleton().len() != joints {
        return complain(format!("the motion has {} joints, its file has {joints}", job.clip.skeleton().len()));
    }
    if source.clip.frames() != rows {
        return complain(format!("the motion as it was read has {} frames, its file {rows}", source.clip.frames()));
    }
    if source.rows.len() != job.clip.frames() {
        let (named, frames) = (source.rows.len(), job.clip.frames());
        return complain(format!("source rows are named for {named} frames, the motion has {frames}"));
    }
    if let Some(row) = source.rows.iter().find(|&&row| row >= rows) {
        return complain(format!("source row {row} is named, but the file has {rows}, from 0"));
    }
    check_finite(job.clip)
}

/// Checks that every value of a clip is finite.
pub(crate) fn check_finite(clip: &Clip) -> Result<(), Error> {
    match clip.first_non_finite() {
        None => Ok(()),
        Some((frame, joint)) => Err(Error::new(
            Place::File,
            format!("frame {frame} of joint {} is not finite", clip.skeleton().joints()[joint].name),
            "the computed motion is invalid; nothing was written",
        )),
    }
}

/// Whether the joint's rotation differs, bit for bit, from the one that was read. `frames` are those of the motion to
/// write and of its source.
pub(crate) fn turned(job: &WriteJob, source: &Source, frames: (usize, usize), joint: usize) -> bool {
    let bits = |clip: &Clip, frame| clip.rotation(frame, joint).to_array().map(f64::to_bits);
    bits(job.clip, frames.0) != bits(source.clip, frames.1)
}

/// As [`turned`], for the translation.
pub(crate) fn moved(job: &WriteJob, source: &Source, frames: (usize, usize), joint: usize) -> bool {
    let bits = |clip: &Clip, frame| clip.translation(frame, joint).to_array().map(f64::to_bits);
    bits(job.clip, frames.0) != bits(source.clip, frames.1)
}

/// Whether the joint has no parent.
pub(crate) fn is_root(clip: &Clip, joint: usize) -> bool {
    clip.skeleton().joints()[joint].parent.is_none()
}

/// The error for an invalid quaternion.
pub(crate) fn no_rotation(clip: &Clip, frame: usize, joint: usize) -> Error {
    let name = &clip.skeleton().joints()[joint].name;
    let problem = format!("frame {frame} of joint {name} has a quaternion of length zero");
    Error::new(Place::File, problem, "the computed motion is invalid")
}

/// The part of a motion that the channels of a file cannot hold: an error, or collected per joint.
pub(crate) struct Losses {
    refuse: bool,
    /// Per joint: the largest rotation \[rad\] and translation \[m\] lost.
    worst: BTreeMap<usize, (f64, f64)>,
}

impl Losses {
    /// A loss is an error.
    pub(crate) fn refused() -> Losses {
        Losses { refuse: true, worst: BTreeMap::new() }
    }

    /// A loss is a note.
    pub(crate) fn noted() -> Losses {
        Losses { refuse: false, worst: BTreeMap::new() }
    }

    /// Reports a rotation of a joint \[rad\] for which the file has no channel.
    pub(crate) fn rotation(&mut self, clip: &Clip, frame: usize, joint: usize, lost_rad: f64) -> Result<(), Error> {
        if lost_rad <= UNSEEN_RAD {
            return Ok(());
        }
        if !self.refuse {
            let worst = self.worst.entry(joint).or_default();
            worst.0 = worst.0.max(lost_rad);
            return Ok(());
        }
        Err(Error::new(
            Place::File,
            format!(
                "frame {frame} turns joint {} by {:.4} degrees for which its file has no rotation channel",
                clip.skeleton().joints()[joint].name,
                lost_rad.to_degrees()
            ),
            "write a new file (BVH, GLB), or accept the nearest rotation",
        ))
    }

    /// Reports a translation of a joint \[m\] for which the file has no channel.
    pub(crate) fn translation(&mut self, clip: &Clip, frame: usize, joint: usize, lost_m: f64) -> Result<(), Error> {
        if lost_m <= UNSEEN_M {
            return Ok(());
        }
        if !self.refuse {
            let worst = self.worst.entry(joint).or_default();
            worst.1 = worst.1.max(lost_m);
            return Ok(());
        }
        Err(Error::new(
            Place::File,
            format!(
                "frame {frame} moves joint {} by {lost_m:.6} m for which its file has no position channel",
                clip.skeleton().joints()[joint].name
            ),
            "write a new file (BVH, GLB), which can hold another skeleton",
        ))
    }

    /// What was lost, joint by joint.
    pub(crate) fn notes(&self, clip: &Clip) -> Vec<Note> {
        let told = |(&joint, &(rad, metres)): (&usize, &(f64, f64))| {
            Note::new(format!(
                "joint {}: the file has no channels for up to {:.3} degrees and {metres:.6} m of its motion",
                clip.skeleton().joints()[joint].name,
                rad.to_degrees()
            ))
        };
        self.worst.iter().map(told).collect()
    }
}
