//! Biovision hierarchy, `.bvh`, in the dialects that exporters write.
//!
//! # What is read
//!
//! A `HIERARCHY` of `ROOT`s (one or several) and `JOINT`s with `OFFSET` and `CHANNELS`, then `MOTION` with `Frames:`,
//! `Frame Time:` and one row of numbers per frame. Keywords in any case; LF, CRLF, CR or a mixture; with or without a
//! byte order mark or a final newline; names with blanks, colons or anything else up to the end of their line.
//!
//! - **Channels** are read joint by joint: none to six, positions and rotations in any order, different in every
//!   joint. Rotations are applied about the turning joint's own axes in the order listed: `Zrotation Xrotation
//!   Yrotation` means `R = Rz Rx Ry`. They are degrees.
//! - **Positions replace the `OFFSET`**, axis by axis, in roots and in other joints alike; joints with position
//!   channels are the clip's [moving](crate::Clip::moving) ones. (Exporters write the position at some frame as the
//!   root's `OFFSET`: added to it, a body stands at twice its height.)
//! - `OFFSET` is the translation of [`Joint::rest`](crate::Joint::rest), whose rotation is the identity; an `End Site`
//!   is the joint's [tip](crate::Joint::tip). Zero-length bones are bones.
//! - **Rows count, not `Frames:`.** When they differ, the complete rows are taken and a note gives both numbers; a
//!   truncated last row is left out with a note. Rows that are wrapped over several lines are read when their values
//!   add up to `Frames:`.
//! - A number that is not finite or beyond 1e12, a frame time that is not positive, a decimal comma, a row of the
//!   wrong length in mid-file, unbalanced braces: an error with the line and the remedy.
//!
//! BVH states neither unit nor axes.
//!
//! # What is written
//!
//! With a BVH behind it ([`WriteJob::source`]): that file again, byte for byte, with only those values replaced that
//! belong to a changed rotation or translation. Angles are those nearest to the source's own in the same frame, with
//! the decimals that the file uses. Otherwise a new file: centimetres, Y up, tabs, `Zrotation Xrotation Yrotation`, a
//! position for roots and for joints that move in their parents. BVH knows no rest rotation, so the joint frames are
//! turned until they stand parallel to the world in the rest pose: every joint keeps its place in the world in every
//! frame, and its orientation relative to the rest.

mod columns;
mod cursor;
mod document;
mod fresh;
mod header;
mod motion;
mod rewrite;

pub use document::BvhDocument;

use super::text::{Losses, check_finite, text_start};
use super::{Contents, Document, Parsed, WriteJob};
use crate::{Clip, Error, Limits, Note, Place};
use glam::DVec3;
use std::io::Write;
use std::sync::Arc;

/// Reads a BVH file.
///
/// The clip is in the file's units and axes, see [`Parsed::clip`].
///
/// ```
/// use sinew_motion::{Limits, formats::bvh};
/// let text = "HIERARCHY\nROOT hips\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation \
///             Yrotation\nEnd Site\n{\nOFFSET 0 10 0\n}\n}\nMOTION\nFrames: 1\nFrame Time: .0083333\n0 90 0 0 0 45\n";
/// let parsed = bvh::read(text.as_bytes(), &Limits::default())?;
/// assert_eq!(parsed.clip.frames(), 1);
/// assert_eq!(parsed.clip.translation(0, 0).y, 90.0);
/// # Ok::<(), sinew_motion::Error>(())
/// ```
///
/// # Errors
/// A file that is not a BVH, is invalid, or exceeds the limits: the line, the problem, and the remedy.
pub fn read(bytes: &[u8], limits: &Limits) -> Result<Parsed, Error> {
    let start = text_start(bytes, limits, "BVH")?;
    let mut notes = Vec::new();
    let (header, cursor) = header::read(bytes, start, limits, &mut notes)?;
    let timing = motion::timing(bytes, cursor, &mut notes)?;
    let moving = header.columns.iter().enumerate().filter(|(_, columns)| columns.moves()).map(|(joint, _)| joint);
    let mut clip = Clip::new(header.skeleton, timing.frame_time_secs, moving.collect());
    let rows = motion::rows(bytes, &timing, &header.columns, limits, &mut clip, &mut notes)?;
    add_offsets(&mut clip, &mut notes);
    let document = BvhDocument { bytes: Arc::from(bytes), columns: header.columns, timing, rows };
    Ok(Parsed {
        clip,
        unit_m: None,
        world_from_source: None,
        document: Document::Bvh(Box::new(document)),
        contents: Contents::default(),
        notes,
    })
}

/// Joints whose positions are all 0 beside an OFFSET: some exporters mean positions from there, and without it a body collapses.
fn add_offsets(clip: &mut Clip, notes: &mut Vec<Note>) {
    let offset = |clip: &Clip, joint: usize| clip.skeleton().joints()[joint].rest.translation;
    let collapsed: Vec<usize> = clip
        .moving()
        .iter()
        .copied()
        .filter(|&joint| clip.skeleton().joints()[joint].parent.is_some() && offset(clip, joint) != DVec3::ZERO)
        .filter(|&joint| (0..clip.frames()).all(|frame| clip.translation(frame, joint) == DVec3::ZERO))
        .collect();
    for &joint in &collapsed {
        let offset = offset(clip, joint);
        (0..clip.frames()).for_each(|frame| clip.set_translation(frame, joint, offset));
    }
    if let Some(&first) = collapsed.first().filter(|_| clip.frames() > 0) {
        let (count, name) = (collapsed.len(), &clip.skeleton().joints()[first].name);
        notes.push(Note::new(format!(
            "the positions of {count} joints ({name} first) are 0 in every frame, where their OFFSET is not: the OFFSET is added"
        )));
    }
}

/// Writes a BVH file: the source again with only the changed values replaced where the source is a BVH, a new file
/// otherwise (see the [module](self)).
///
/// ```
/// use sinew_motion::{Clip, Joint, Limits, Skeleton, Transform, formats::{WriteJob, bvh}};
/// let mut skeleton = Skeleton::new();
/// let hips = skeleton.push(Joint { name: "hips".into(), parent: None, rest: Transform::IDENTITY, tip: None });
/// let mut clip = Clip::new(skeleton, 1.0 / 60.0, vec![hips]);
/// clip.push(&[Transform::new(glam::DQuat::IDENTITY, glam::DVec3::Y)]);
/// let mut file = Vec::new();
/// bvh::write(&mut file, &WriteJob { clip: &clip, source: None })?;
/// let again = bvh::read(&file, &Limits::default())?;
/// assert_eq!(again.clip.translation(0, hips).y, 100.0, "centimetres");
/// # Ok::<(), sinew_motion::Error>(())
/// ```
///
/// # Errors
/// A motion that does not fit its source (joints, rows), that the source has no channels for (more than 1e-6 m or
/// 1e-5 rad; see [`write_nearest`]), or that is not finite; and errors of `out`.
pub fn write(out: &mut dyn Write, job: &WriteJob) -> Result<(), Error> {
    write_with(out, job, Losses::refused()).map(|_| ())
}

/// As [`write()`], but what the source has no channels for is left out and reported in the notes.
///
/// # Errors
/// As [`write()`], losses excepted.
pub fn write_nearest(out: &mut dyn Write, job: &WriteJob) -> Result<Vec<Note>, Error> {
    write_with(out, job, Losses::noted())
}

fn write_with(out: &mut dyn Write, job: &WriteJob, mut losses: Losses) -> Result<Vec<Note>, Error> {
    if let Some(source) = &job.source
        && let Document::Bvh(document) = source.document
    {
        rewrite::write(out, job, source, document, &mut losses)?;
        return Ok(losses.notes(job.clip));
    }
    if job.clip.skeleton().is_empty() {
        return Err(Error::new(Place::File, "the motion has no joints", "there is nothing to write as BVH"));
    }
    check_finite(job.clip)?;
    fresh::write(out, job.clip)?;
    Ok(Vec::new())
}
