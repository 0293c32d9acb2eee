//! Acclaim motion, `.amc`, with its skeleton, `.asf`.
//!
//! # What is read
//!
//! The **skeleton** ([`read_skeleton`]): `:units` (`length`, `angle`), `:root` (`order`, `axis`, `position`,
//! `orientation`), `:bonedata` (`name`, `direction`, `length`, `axis`, `dof`; limits and masses are ignored; the file
//! is kept) and `:hierarchy`. Every bone becomes a joint at the bone's *start*, where its parent ends; bones of the
//! root start at the root. A leaf's [tip](crate::Joint::tip) is its bone's end. Rest rotations are the identity: the
//! zero pose is the rest pose, in the file's axes.
//!
//! The **motion** ([`read`]): per frame a number, which need not start at 1, and a line per bone with the values of
//! its `dof`. Turns about the axes named in `dof` follow one another about *fixed* axes in the order listed, so `rx ry
//! rz` means `M = Rz Ry Rx`, in the frame `C` that the bone's `axis` states: the joint's rotation is `C M C⁻¹`. The
//! root's `TX TY TZ` replace its `position`; those of another bone are added to its rest along the axes of `C`.
//!
//! One unit is `0.0254 / length` metres (CMU: `length 0.45`, 0.0564 m); Y is up. AMC does not state its frame rate:
//! it is taken for 120 frames per second, with a note.
//!
//! # What is written
//!
//! With an AMC behind it ([`WriteJob::source`]): that file again, byte for byte, with only the values replaced whose
//! rotation or translation has changed. Otherwise a new pair: [`write_skeleton`] and [`write()`], with `length 0.45`.
//! Joint frames are turned as for a new BVH; where the children of a joint do not all hang at one place, bones without
//! `dof` lead to them, as CMU's `lhipjoint` does.

mod bone;
mod document;
mod find;
mod fresh;
mod motion;
mod plan;
mod rewrite;
mod section;
mod skeleton;

pub use document::AmcDocument;
pub use find::find_skeleton;
pub use skeleton::Asf;

use super::text::{Losses, check_finite};
use super::{Contents, Document, Parsed, WriteJob};
use crate::{Clip, Error, Limits, Note, Place};
use std::io::Write;
use std::sync::Arc;

/// Reads a skeleton alone.
///
/// ```
/// use sinew_motion::{Limits, formats::amc};
/// let text = ":units\n  length 0.45\n  angle deg\n:root\n  order TX TY TZ RX RY RZ\n:bonedata\n  begin\n  name spine\n  \
///             direction 0 1 0\n  length 10\n  axis 0 0 0 XYZ\n  dof rx ry rz\n  end\n:hierarchy\n  begin\n  root \
///             spine\n  end\n";
/// let asf = amc::read_skeleton(text.as_bytes(), &Limits::default())?;
/// assert_eq!(asf.skeleton.len(), 2);
/// assert_eq!(asf.unit_m, Some(0.0254 / 0.45));
/// # Ok::<(), sinew_motion::Error>(())
/// ```
///
/// # Errors
/// A file that is not an ASF, is invalid, or exceeds the limits: the line, the problem, and the remedy.
pub fn read_skeleton(bytes: &[u8], limits: &Limits) -> Result<Asf, Error> {
    skeleton::read(bytes, limits)
}

/// Reads a skeleton alone as a motion of one frame: its rest pose.
///
/// # Errors
/// As [`read_skeleton`].
pub fn read_rest(asf: &[u8], limits: &Limits) -> Result<Parsed, Error> {
    let skeleton = read_skeleton(asf, limits)?;
    let zeros = " 0".repeat(skeleton.bones.first().map_or(0, |root| root.dof.len()));
    let mut parsed = read(format!(":DEGREES\n1\nroot{zeros}\n").as_bytes(), asf, limits)?;
    parsed.notes.push(Note::new("a skeleton without a motion: the clip is one frame of its rest pose"));
    Ok(parsed)
}

/// Reads a motion with its skeleton; [`find_skeleton`] finds the skeleton of a motion.
///
/// The clip is in the file's units and axes, see [`Parsed::clip`].
///
/// ```
/// use sinew_motion::{Limits, formats::amc};
/// let asf = ":bonedata\nbegin\nname spine\ndirection 0 1 0\nlength 10\ndof rx\nend\n:hierarchy\nroot spine\n";
/// let motion = ":DEGREES\n1\nroot 0 17 0 0 0 0\nspine 30\n";
/// let parsed = amc::read(motion.as_bytes(), asf.as_bytes(), &Limits::default())?;
/// assert_eq!(parsed.clip.translation(0, 0).y, 17.0);
/// # Ok::<(), sinew_motion::Error>(())
/// ```
///
/// # Errors
/// As [`read_skeleton`] (the message then says that the line is the skeleton's); a motion that is not an AMC, is
/// invalid, belongs to another skeleton, or exceeds the limits.
pub fn read(amc: &[u8], asf: &[u8], limits: &Limits) -> Result<Parsed, Error> {
    let skeleton = read_skeleton(asf, limits).map_err(|error| {
        let line = if let Place::Line(line) = error.place() { format!(" line {line}") } else { String::new() };
        Error::new(Place::File, format!("skeleton (.asf){line}: {}", error.problem()), error.remedy())
    })?;
    let mut notes: Vec<Note> = skeleton.notes.iter().map(|note| Note::new(format!("skeleton (.asf) {note}"))).collect();
    let motion = motion::read(amc, &skeleton, limits, &mut notes)?;
    let unit_m = skeleton.unit_m;
    let document = AmcDocument {
        bytes: Arc::from(amc),
        skeleton_bytes: Arc::from(asf),
        bones: skeleton.bones,
        degrees: motion.degrees,
        present: motion.present,
        frames: motion.frames,
    };
    Ok(Parsed {
        clip: motion.clip,
        unit_m,
        world_from_source: Some(glam::DQuat::IDENTITY),
        document: Document::Amc(Box::new(document)),
        contents: Contents::default(),
        notes,
    })
}

/// Writes an AMC file: the source again with only the changed values replaced where the source is an AMC, a new file
/// otherwise, which belongs to the skeleton that [`write_skeleton`] writes for the same clip.
///
/// # Errors
/// A motion that does not fit its source (joints, rows), that the source's `dof` cannot hold (more than 1e-6 m or
/// 1e-5 rad; see [`write_nearest`]), that has several roots, or that is not finite; and errors of `out`.
pub fn write(out: &mut dyn Write, job: &WriteJob) -> Result<(), Error> {
    write_with(out, job, Losses::refused()).map(|_| ())
}

/// As [`write()`], but what the source's `dof` cannot hold is left out and reported in the notes: a knee with one axis
/// gets the nearest angle about that axis.
///
/// # Errors
/// As [`write()`], losses excepted.
pub fn write_nearest(out: &mut dyn Write, job: &WriteJob) -> Result<Vec<Note>, Error> {
    write_with(out, job, Losses::noted())
}

fn write_with(out: &mut dyn Write, job: &WriteJob, mut losses: Losses) -> Result<Vec<Note>, Error> {
    if let Some(source) = &job.source
        && let Document::Amc(document) = source.document
    {
        rewrite::write(out, job, source, document, &mut losses)?;
        return Ok(losses.notes(job.clip));
    }
    check_finite(job.clip)?;
    fresh::write(out, job.clip)?;
    Ok(Vec::new())
}

/// Writes a new skeleton for a clip in metres and Y up; [`write()`] without an AMC source writes the motion to it.
///
/// # Errors
/// A clip with no joints or with several roots, which an ASF cannot hold; and errors of `out`.
pub fn write_skeleton(out: &mut dyn Write, clip: &Clip) -> Result<(), Error> {
    check_finite(clip)?;
    fresh::write_skeleton(out, clip)
}
