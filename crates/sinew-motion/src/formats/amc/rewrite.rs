//! An AMC file written again: its own text, with only the changed values replaced.

use super::bone::{Bone, Dof};
use super::document::AmcDocument;
use super::motion::{by_name, frame_number, line_words};
use crate::formats::text::{
    Decimals, Losses, Span, check_source, is_break, is_root, line_end, moved, nearest, next_line, no_rotation, number,
    replace, send, turned,
};
use crate::formats::{Source, WriteJob};
use crate::{Clip, Error};
use std::collections::BTreeMap;
use std::io::Write;

/// Writes the document's file with the values of the job's clip.
pub(super) fn write(
    out: &mut dyn Write,
    job: &WriteJob,
    source: &Source,
    document: &AmcDocument,
    losses: &mut Losses,
) -> Result<(), Error> {
    check_source(job, source, document.bones.len(), document.frames.len())?;
    let bytes = &document.bytes[..];
    let verbatim = source.rows.iter().copied().eq(0..document.frames.len());
    // Frames cut out in one piece keep their numbers; others are counted on from the first.
    let contiguous = source.rows.windows(2).all(|pair| pair[1] == pair[0] + 1);
    let joints = by_name(document.bones.iter().map(|bone| bone.name.as_str()));
    let mut editor = Editor { job, source, document, joints, precision: None };
    let mut at = document.frames.first().map_or(bytes.len(), |span| span.start);
    send(out, &bytes[..at])?;
    let mut ended = true;
    let mut first_number = None;
    let mut text = Vec::new();
    for (frame, &row) in source.rows.iter().enumerate() {
        let span = document.frames[row];
        if verbatim {
            send(out, &bytes[at..span.start])?;
            at = span.end;
        } else if !ended {
            send(out, line_end(bytes))?;
        }
        text.clear();
        let count = *first_number.get_or_insert_with(|| editor.number(span)) + frame as u64;
        editor.frame((frame, row), (!contiguous).then_some(count), losses, &mut text)?;
        send(out, &text)?;
        ended = text.last().is_some_and(|&byte| is_break(byte));
    }
    if verbatim { send(out, &bytes[at..]) } else { Ok(()) }
}

/// Decimals of positions and of rotations.
#[derive(Clone, Copy)]
struct Precision {
    shifts: usize,
    turns: usize,
}

/// Frames of the source with the changes of the job.
struct Editor<'a> {
    job: &'a WriteJob<'a>,
    source: &'a Source<'a>,
    document: &'a AmcDocument,
    joints: BTreeMap<&'a [u8], usize>,
    /// Found when the first change needs it: it takes a pass over the file.
    precision: Option<Precision>,
}

impl Editor<'_> {
    /// The number of the frame that stands there.
    fn number(&self, span: Span) -> u64 {
        let bytes = &self.document.bytes[..];
        let words: Vec<Span> = line_words(bytes, next_line(bytes, span.start).0).collect();
        // Low enough to be counted on from, whatever the file says.
        frame_number(bytes, &words).unwrap_or(1).min(u64::from(u32::MAX))
    }

    /// One frame, into `text`; `frames` are those of the clip and of the file, `number` its number if it is a new one.
    fn frame(
        &mut self,
        frames: (usize, usize),
        number: Option<u64>,
        losses: &mut Losses,
        text: &mut Vec<u8>,
    ) -> Result<(), Error> {
        let bytes = &self.document.bytes[..];
        let span = self.document.frames[frames.1];
        let changes: Vec<(bool, bool)> = (0..self.document.bones.len())
            .map(|joint| (turned(self.job, self.source, frames, joint), moved(self.job, self.source, frames, joint)))
            .collect();
        let any = changes.iter().any(|&(turned, moved)| turned || moved);
        if !any && number.is_none() {
            text.extend_from_slice(span.of(bytes));
            return Ok(());
        }
        if any {
            self.check_absent(frames, &changes, losses)?;
        }
        let mut at = span.start;
        let mut copied = span.start;
        let mut words = Vec::new();
        while at < span.end {
            let (line, next) = next_line(bytes, at);
            at = next;
            words.clear();
            words.extend(line_words(bytes, line));
            let Some(&first) = words.first() else { continue };
            if frame_number(bytes, &words).is_some() {
                if let Some(number) = number {
                    text.extend_from_slice(&bytes[copied..first.start]);
                    text.extend_from_slice(number.to_string().as_bytes());
                    copied = first.end;
                }
                continue;
            }
            let Some(&joint) = self.joints.get(first.of(bytes)) else { continue };
            if changes[joint] == (false, false) {
                continue;
            }
            let new = self.values(frames, joint, changes[joint], &words[1..], losses)?;
            let precision = *self.precision.get_or_insert_with(|| measure(self.document));
            for ((word, dof), (old, value)) in words[1..].iter().zip(&self.document.bones[joint].dof).zip(new) {
                let Some(value) = value else { continue };
                let decimals = if matches!(dof, Dof::Turn(_)) { precision.turns } else { precision.shifts };
                text.extend_from_slice(&bytes[copied..word.start]);
                replace(text, word.of(bytes), old, value, decimals);
                copied = word.end;
            }
        }
        text.extend_from_slice(&bytes[copied..span.end]);
        Ok(())
    }

    /// Bones that the motion has no lines for: whatever changed in them is lost.
    fn check_absent(&self, frames: (usize, usize), changes: &[(bool, bool)], losses: &mut Losses) -> Result<(), Error> {
        let absent = Bone { name: String::new(), axes: glam::DQuat::IDENTITY, dof: Vec::new(), is_root: false };
        for (joint, &changed) in changes.iter().enumerate() {
            if changed != (false, false) && !self.document.present[joint] {
                self.changed(frames, joint, changed, &absent, &[], losses)?;
            }
        }
        Ok(())
    }

    /// Per value of a bone's line: the old one, and the new one where it changes.
    fn values(
        &self,
        frames: (usize, usize),
        joint: usize,
        changed: (bool, bool),
        words: &[Span],
        losses: &mut Losses,
    ) -> Result<Vec<(f64, Option<f64>)>, Error> {
        let bytes = &self.document.bytes[..];
        let bone = &self.document.bones[joint];
        let old: Vec<f64> =
            words.iter().map(|word| number(bytes, *word, || bone.name.clone())).collect::<Result<_, _>>()?;
        let new = self.changed(frames, joint, changed, bone, &old, losses)?;
        Ok(old.into_iter().zip(new).collect())
    }

    fn changed(
        &self,
        frames: (usize, usize),
        joint: usize,
        (turned, moved): (bool, bool),
        bone: &Bone,
        old: &[f64],
        losses: &mut Losses,
    ) -> Result<Vec<Option<f64>>, Error> {
        let mut new = vec![None; old.len()];
        let root = is_root(self.job.clip, joint);
        let to_source = |clip: &Clip, frame: usize| self.source.space.to_source(clip.local(frame, joint), root);
        let local = to_source(self.job.clip, frames.0);
        if turned {
            let turns = bone.turns(old, self.document.degrees);
            let Some(angles) = nearest(bone.turn(local.rotation), turns.axes(), turns.degrees()) else {
                return Err(no_rotation(self.job.clip, frames.0, joint));
            };
            losses.rotation(self.job.clip, frames.0, joint, angles.loss_rad)?;
            for (&value, degrees) in turns.values().iter().zip(angles.degrees) {
                new[value] = Some(if self.document.degrees { degrees } else { degrees.to_radians() });
            }
        }
        if moved {
            let before = to_source(self.source.clip, frames.1);
            let rest = self.source.space.to_source(self.source.clip.skeleton().joints()[joint].rest, root).translation;
            let shift = bone.shift(local.translation, rest);
            let mut lost = shift - bone.shift(before.translation, rest);
            for (index, dof) in bone.dof.iter().enumerate() {
                if let Dof::Shift(axis) = dof {
                    lost[axis.index()] = 0.0;
                    new[index] = Some(shift[axis.index()]);
                }
            }
            losses.translation(self.job.clip, frames.0, joint, lost.length() * self.source.space.unit_m)?;
        }
        Ok(new)
    }
}

/// Goes through the file for the decimals that it uses.
fn measure(document: &AmcDocument) -> Precision {
    let bytes = &document.bytes[..];
    let joints = by_name(document.bones.iter().map(|bone| bone.name.as_str()));
    let (mut shifts, mut turns) = (Decimals::default(), Decimals::default());
    for span in &document.frames {
        let mut at = span.start;
        while at < span.end {
            let (line, next) = next_line(bytes, at);
            at = next;
            let mut words = line_words(bytes, line);
            let Some(&joint) = words.next().and_then(|first| joints.get(first.of(bytes))) else { continue };
            for (word, dof) in words.zip(&document.bones[joint].dof) {
                if matches!(dof, Dof::Turn(_)) { &mut turns } else { &mut shifts }.add(word.of(bytes));
            }
        }
    }
    Precision { shifts: shifts.count(), turns: turns.count() }
}
