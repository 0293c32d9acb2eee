//! The `MOTION`: frame count, frame time, rows.

use super::columns::Columns;
use super::cursor::Cursor;
use super::document::Timing;
use crate::formats::text::{Span, fault, line_at, next_line, number, show, too_many_frames, words};
use crate::{Clip, Error, Limits, Note, Skeleton, Transform};

/// Reads `Frames:` and `Frame Time:`, in either order.
pub(super) fn timing(bytes: &[u8], mut cursor: Cursor, notes: &mut Vec<Note>) -> Result<Timing, Error> {
    let mut frames = None;
    let mut time = None;
    while frames.is_none() || time.is_none() {
        // `Frames` begins with `Frame`: it is tried first.
        if frames.is_none() && cursor.eat("Frames") {
            cursor.eat(":");
            frames = Some(frame_count(&mut cursor)?);
        } else if time.is_none() && cursor.eat("Frame") && cursor.eat("Time") {
            cursor.eat(":");
            time = Some(frame_time(&mut cursor, notes)?);
        } else {
            let (missing, remedy) = if frames.is_none() {
                ("Frames:", "add a line `Frames: n` with the number of rows")
            } else {
                ("Frame Time:", "add a line `Frame Time: t` with the seconds from row to row, such as 0.0083333")
            };
            let Some(word) = cursor.word() else {
                return Err(cursor.ended(missing));
            };
            let problem = format!("{missing} should stand here, not {}", show(word.of(bytes)));
            return Err(fault(bytes, word.start, problem, remedy));
        }
    }
    let ((frames, frames_word), (frame_time_secs, frame_time_word)) = match (frames, time) {
        (Some(frames), Some(time)) => (frames, time),
        _ => return Err(cursor.ended("Frames: and Frame Time:")),
    };
    let (rest, next) = next_line(bytes, cursor.at);
    let end = if words(bytes, rest).next().is_none() { next } else { cursor.at };
    Ok(Timing { frames, frames_word, frame_time_secs, frame_time_word, end })
}

fn frame_count(cursor: &mut Cursor) -> Result<(u64, Span), Error> {
    let Some(word) = cursor.word() else {
        return Err(cursor.ended("the number of frames"));
    };
    let text = word.of(cursor.bytes);
    match std::str::from_utf8(text).ok().and_then(|text| text.parse().ok()) {
        Some(count) => Ok((count, word)),
        None => {
            let problem = format!("Frames: is {}, which is not a count", show(text));
            Err(fault(cursor.bytes, word.start, problem, "write the number of rows after `Frames:`"))
        }
    }
}

fn frame_time(cursor: &mut Cursor, notes: &mut Vec<Note>) -> Result<(f64, Span), Error> {
    const MIN_SECS: f64 = 1e-6;
    const MAX_SECS: f64 = 1e3;
    let bytes = cursor.bytes;
    let Some(word) = cursor.word() else {
        return Err(cursor.ended("the frame time"));
    };
    let secs = number(bytes, word, || "Frame Time:".to_owned())?;
    if !(MIN_SECS..=MAX_SECS).contains(&secs) {
        let problem = format!("Frame Time: is {}; a frame takes between 1e-6 and 1000 s", show(word.of(bytes)));
        let remedy = "write the seconds from frame to frame, such as 0.0083333 for 120 frames per second";
        return Err(fault(bytes, word.start, problem, remedy));
    }
    if secs >= 1.0 {
        let text = format!("a frame takes {secs} s; if {secs} frames per second are meant, write {}", 1.0 / secs);
        notes.push(Note::at_line(line_at(bytes, word.start), text));
    }
    Ok((secs, word))
}

/// Reads the rows into the clip, and returns where they stand.
pub(super) fn rows(
    bytes: &[u8],
    timing: &Timing,
    columns: &[Columns],
    limits: &Limits,
    clip: &mut Clip,
    notes: &mut Vec<Note>,
) -> Result<Vec<Span>, Error> {
    let width: usize = columns.iter().map(|columns| columns.channels.len()).sum();
    let mut frames = Frames { bytes, columns, limits, width, clip, row: Vec::new(), locals: Vec::new() };
    let mut rows = Vec::new();
    let mut at = timing.end;
    while at < bytes.len() {
        let (line, next) = next_line(bytes, at);
        let count = words(bytes, line).count();
        if count == 0 {
            at = next;
            continue;
        }
        if count != width {
            if rows.is_empty() && wrapped(bytes, timing, at, width) {
                let text = "rows are wrapped over several lines; their values add up to Frames:";
                notes.push(Note::at_line(line_at(bytes, at), text));
                return frames.read_wrapped(at);
            }
            if count < width && !rows.is_empty() && words(bytes, Span::new(next, bytes.len())).next().is_none() {
                let text =
                    format!("the last row has {count} of {width} values: the file is truncated, and the row left out");
                notes.push(Note::at_line(line_at(bytes, at), text));
                break;
            }
            return Err(frames.wrong_length(rows.len(), at, count));
        }
        frames.read(rows.len(), words(bytes, line))?;
        rows.push(Span::new(at, next));
        at = next;
    }
    if rows.len() as u64 != timing.frames {
        let text =
            format!("Frames: says {}, the file has {} complete rows; the rows are taken", timing.frames, rows.len());
        notes.push(Note::at_line(line_at(bytes, timing.frames_word.start), text));
    }
    Ok(rows)
}

/// Whether all values from here on are as many as `Frames:` says, however they stand in lines.
fn wrapped(bytes: &[u8], timing: &Timing, at: usize, width: usize) -> bool {
    let wanted = timing.frames.checked_mul(width as u64);
    let found = words(bytes, Span::new(at, bytes.len())).count() as u64;
    found > 0 && wanted == Some(found)
}

/// Frames as they are read.
struct Frames<'a> {
    bytes: &'a [u8],
    columns: &'a [Columns],
    limits: &'a Limits,
    /// Values in a row.
    width: usize,
    clip: &'a mut Clip,
    row: Vec<f64>,
    locals: Vec<Transform>,
}

impl Frames<'_> {
    /// One row, whose length was checked.
    fn read(&mut self, frame: usize, words: impl Iterator<Item = Span>) -> Result<(), Error> {
        too_many_frames(self.limits, frame + 1, self.width, self.columns.len())?;
        self.row.clear();
        for word in words {
            let column = self.row.len();
            let what = || format!("frame {frame}, {}", self.column_name(column));
            self.row.push(number(self.bytes, word, what)?);
        }
        self.locals.clear();
        let joints = self.clip.skeleton().joints().iter();
        let locals = joints.zip(self.columns).map(|(joint, columns)| columns.local(&self.row, joint.rest.translation));
        self.locals.extend(locals);
        self.clip.push(&self.locals);
        Ok(())
    }

    /// Rows without regard to lines, up to the end of the file.
    fn read_wrapped(&mut self, start: usize) -> Result<Vec<Span>, Error> {
        let mut rows = Vec::new();
        let mut start = start;
        let mut all = words(self.bytes, Span::new(start, self.bytes.len())).peekable();
        let mut row = Vec::with_capacity(self.width);
        while all.peek().is_some() {
            row.clear();
            row.extend(all.by_ref().take(self.width));
            self.read(rows.len(), row.iter().copied())?;
            let mut end = row.last().map_or(start, |word| word.end);
            let (rest, next) = next_line(self.bytes, end);
            if words(self.bytes, rest).next().is_none() {
                end = next;
            }
            rows.push(Span::new(start, end));
            start = end;
        }
        Ok(rows)
    }

    /// The joint and channel of a column, for messages.
    fn column_name(&self, column: usize) -> String {
        let owner = self.columns.iter().position(|own| (own.first..own.first + own.channels.len()).contains(&column));
        match owner {
            Some(joint) => {
                let channel = self.columns[joint].channels[column - self.columns[joint].first];
                format!("joint {}, {}", name(self.clip.skeleton(), joint), channel.name())
            }
            None => format!("value {column}"),
        }
    }

    fn wrong_length(&self, frame: usize, at: usize, count: usize) -> Error {
        let problem = if self.width == 0 {
            format!("the row has {count} values, but no joint has channels")
        } else if count < self.width {
            let missing = self.column_name(count);
            format!("frame {frame} has {count} values, the channels ask for {}: from {missing} on", self.width)
        } else {
            format!("frame {frame} has {count} values, the channels ask for {}", self.width)
        };
        fault(self.bytes, at, problem, "correct the CHANNELS lines, or repair or remove the row")
    }
}

fn name(skeleton: &Skeleton, joint: usize) -> &str {
    &skeleton.joints()[joint].name
}
