//! The motion, `.amc`.

use super::skeleton::Asf;
use crate::formats::text::{
    Span, fault, is_break, line_at, next_line, number, show, text_start, too_many_frames, words,
};
use crate::{Clip, Error, Limits, Note, Place, Transform};
use std::collections::BTreeMap;

/// AMC does not state its rate; CMU and most Vicon systems of the format's time recorded at this one.
const FRAME_TIME_SECS: f64 = 1.0 / 120.0;

/// What a motion file holds.
pub(super) struct Motion {
    pub(super) clip: Clip,
    pub(super) degrees: bool,
    pub(super) present: Vec<bool>,
    pub(super) frames: Vec<Span>,
}

/// The words of a line up to a comment.
pub(super) fn line_words(bytes: &[u8], line: Span) -> impl Iterator<Item = Span> + '_ {
    words(bytes, line).take_while(|word| bytes[word.start] != b'#')
}

/// A frame's number, if the line is one.
pub(super) fn frame_number(bytes: &[u8], words: &[Span]) -> Option<u64> {
    match words {
        [only] if bytes[only.start].is_ascii_digit() => std::str::from_utf8(only.of(bytes)).ok()?.parse().ok(),
        _ => None,
    }
}

/// Joints by bone name.
pub(super) fn by_name<'a>(names: impl Iterator<Item = &'a str>) -> BTreeMap<&'a [u8], usize> {
    names.enumerate().map(|(joint, name)| (name.as_bytes(), joint)).collect()
}

/// A frame while its lines are read.
struct Frame {
    start: usize,
    end: usize,
    number: u64,
    seen: Vec<bool>,
    locals: Vec<Transform>,
}

struct Reader<'a> {
    bytes: &'a [u8],
    asf: &'a Asf,
    limits: &'a Limits,
    joints: BTreeMap<&'a [u8], usize>,
    degrees: bool,
    rest: Vec<Transform>,
    channels: usize,
    clip: Clip,
    present: Vec<bool>,
    frames: Vec<Span>,
    last_number: u64,
    values: Vec<f64>,
    gaps: usize,
}

/// Reads an AMC to its skeleton.
pub(super) fn read(bytes: &[u8], asf: &Asf, limits: &Limits, notes: &mut Vec<Note>) -> Result<Motion, Error> {
    let start = text_start(bytes, limits, "AMC")?;
    let moving = asf.bones.iter().enumerate().filter(|(_, bone)| bone.moves()).map(|(joint, _)| joint).collect();
    let mut reader = Reader {
        bytes,
        asf,
        limits,
        joints: by_name(asf.bones.iter().map(|bone| bone.name.as_str())),
        degrees: asf.degrees,
        rest: asf.skeleton.joints().iter().map(|joint| joint.rest).collect(),
        channels: asf.bones.iter().map(|bone| bone.dof.len()).sum(),
        clip: Clip::new(asf.skeleton.clone(), FRAME_TIME_SECS, moving),
        present: Vec::new(),
        frames: Vec::new(),
        last_number: 0,
        values: Vec::new(),
        gaps: 0,
    };
    reader.read(start, notes)?;
    if reader.gaps > 0 {
        let text =
            format!("frame numbers do not go up by one at {} place(s); they are read as if they did", reader.gaps);
        notes.push(Note::new(text));
    }
    notes.push(Note::new("an AMC does not state its frame rate; 120 frames per second is taken"));
    let missing = reader.present.iter().zip(&asf.bones).filter(|(present, bone)| !**present && !bone.dof.is_empty());
    let missing: Vec<&str> = missing.map(|(_, bone)| bone.name.as_str()).take(10).collect();
    if !missing.is_empty() {
        notes.push(Note::new(format!("bones without motion data stay at rest: {}", missing.join(", "))));
    }
    Ok(Motion { clip: reader.clip, degrees: reader.degrees, present: reader.present, frames: reader.frames })
}

impl Reader<'_> {
    fn read(&mut self, start: usize, notes: &mut Vec<Note>) -> Result<(), Error> {
        let mut frame: Option<Frame> = None;
        let mut line_words_kept = Vec::new();
        let mut at = start;
        while at < self.bytes.len() {
            let (line, next) = next_line(self.bytes, at);
            line_words_kept.clear();
            line_words_kept.extend(line_words(self.bytes, line));
            if let Some(&first) = line_words_kept.first() {
                let result = self.line(&line_words_kept, first, (at, next), &mut frame);
                // A truncated file ends in the middle of a line: then its last frame is incomplete.
                let cut = next == self.bytes.len() && !self.bytes.last().is_some_and(|&byte| is_break(byte));
                match result {
                    Err(_) if cut && frame.is_some() && !self.frames.is_empty() => {
                        self.left_out(frame.take(), notes);
                        break;
                    }
                    result => result?,
                }
            }
            at = next;
        }
        if let Some(last) = frame {
            if !self.frames.is_empty() && last.seen.iter().zip(&self.present).any(|(&seen, &present)| present && !seen)
            {
                self.left_out(Some(last), notes);
            } else {
                self.finish(last)?;
            }
        }
        if self.frames.is_empty() {
            let remedy = "check that the file is an AMC: frames are a number on a line, then a line per bone";
            return Err(Error::new(Place::File, "the motion has no frames", remedy));
        }
        Ok(())
    }

    fn left_out(&self, frame: Option<Frame>, notes: &mut Vec<Note>) {
        if let Some(frame) = frame {
            let text = format!(
                "the last frame ({}) is incomplete: the file is truncated, and the frame left out",
                frame.number
            );
            notes.push(Note::at_line(line_at(self.bytes, frame.start), text));
        }
    }

    /// One line that holds words.
    fn line(
        &mut self,
        words: &[Span],
        first: Span,
        (start, end): (usize, usize),
        frame: &mut Option<Frame>,
    ) -> Result<(), Error> {
        let bytes = self.bytes;
        if bytes[first.start] == b':' {
            if frame.is_some() {
                let problem = format!("{} stands between frames", show(first.of(bytes)));
                return Err(fault(bytes, first.start, problem, "remove it, or split the file there"));
            }
            let key = first.of(bytes);
            if key.eq_ignore_ascii_case(b":DEGREES") {
                self.degrees = true;
            } else if key.eq_ignore_ascii_case(b":RADIANS") {
                self.degrees = false;
            }
            return Ok(());
        }
        if let Some(number) = frame_number(bytes, words) {
            if let Some(before) = frame.take() {
                self.finish(before)?;
            }
            too_many_frames(self.limits, self.frames.len() + 1, self.channels, self.rest.len())?;
            let seen = vec![false; self.rest.len()];
            *frame = Some(Frame { start, end, number, seen, locals: self.rest.clone() });
            return Ok(());
        }
        let Some(frame) = frame else {
            let problem = format!("{} stands before the first frame's number", show(first.of(bytes)));
            return Err(fault(bytes, first.start, problem, "check that the file is an AMC"));
        };
        self.bone(words, first, frame)?;
        frame.end = end;
        Ok(())
    }

    /// The values of a bone.
    fn bone(&mut self, words: &[Span], first: Span, frame: &mut Frame) -> Result<(), Error> {
        let bytes = self.bytes;
        let number_of_frame = frame.number;
        let Some(&joint) = self.joints.get(first.of(bytes)) else {
            let problem =
                format!("frame {number_of_frame} names {}, which is not a bone of the skeleton", show(first.of(bytes)));
            return Err(fault(bytes, first.start, problem, "name the motion's own .asf in ReadOptions::skeleton"));
        };
        let bone = &self.asf.bones[joint];
        if frame.seen[joint] {
            let problem = format!("frame {number_of_frame} has a second line for bone {}", bone.name);
            return Err(fault(bytes, first.start, problem, "remove one, or restore the frame number between them"));
        }
        if words.len() - 1 != bone.dof.len() {
            let (found, wanted) = (words.len() - 1, bone.dof.len());
            let problem =
                format!("frame {number_of_frame} has {found} values for bone {}, its dof are {wanted}", bone.name);
            return Err(fault(bytes, first.start, problem, "check that the skeleton (.asf) belongs to this motion"));
        }
        self.values.clear();
        for word in &words[1..] {
            let what = || format!("frame {number_of_frame}, bone {}", bone.name);
            self.values.push(number(bytes, *word, what)?);
        }
        frame.seen[joint] = true;
        frame.locals[joint] = bone.local(&self.values, self.degrees, self.rest[joint].translation);
        Ok(())
    }

    /// All lines of a frame were read.
    fn finish(&mut self, frame: Frame) -> Result<(), Error> {
        if self.frames.is_empty() {
            self.present = frame.seen;
        } else if let Some(joint) = (0..self.present.len()).find(|&joint| self.present[joint] != frame.seen[joint]) {
            let (name, number) = (&self.asf.bones[joint].name, frame.number);
            let problem = if self.present[joint] {
                format!("frame {number} has no line for bone {name}")
            } else {
                format!("frame {number} has a line for bone {name}, which the first frame has not")
            };
            return Err(fault(self.bytes, frame.start, problem, "give every frame the same bones, or cut it out"));
        } else if self.last_number.checked_add(1) != Some(frame.number) {
            self.gaps += 1;
        }
        self.last_number = frame.number;
        self.frames.push(Span::new(frame.start, frame.end));
        self.clip.push(&frame.locals);
        Ok(())
    }
}
