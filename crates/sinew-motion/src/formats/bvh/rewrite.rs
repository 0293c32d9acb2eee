//! A BVH file written again: its own text, with only the changed values replaced.

use super::document::BvhDocument;
use crate::formats::text::{
    Decimals, Losses, Span, check_source, is_break, is_root, line_end, moved, nearest, no_rotation, number, replace,
    send, turned, words,
};
use crate::formats::{Source, WriteJob};
use crate::{Clip, Error};
use std::io::Write;

/// Writes the document's file with the values of the job's clip.
pub(super) fn write(
    out: &mut dyn Write,
    job: &WriteJob,
    source: &Source,
    document: &BvhDocument,
    losses: &mut Losses,
) -> Result<(), Error> {
    check_source(job, source, document.columns.len(), document.rows.len())?;
    let bytes = &document.bytes[..];
    let verbatim = source.rows.iter().copied().eq(0..document.rows.len());
    write_head(out, job, source, document)?;
    let mut editor = Editor::new(job, source, document);
    let mut at = document.timing.end;
    let mut ended = bytes[..at].last().is_some_and(|&byte| is_break(byte));
    let mut text = Vec::new();
    for (frame, &row) in source.rows.iter().enumerate() {
        let span = document.rows[row];
        if verbatim {
            // Blank lines between the rows.
            send(out, &bytes[at..span.start])?;
            at = span.end;
        } else if !ended {
            // The file's last row may lack a line end and now stand before others.
            send(out, line_end(bytes))?;
        }
        text.clear();
        editor.row(frame, row, losses, &mut text)?;
        send(out, &text)?;
        ended = text.last().is_some_and(|&byte| is_break(byte));
    }
    if verbatim {
        send(out, &bytes[at..])?;
    } else if let Some(last) = document.rows.last() {
        // What follows the rows is kept, unless it is the rest of a truncated row.
        let tail = Span::new(last.end, bytes.len());
        if ended && words(bytes, tail).next().is_none() {
            send(out, tail.of(bytes))?;
        }
    }
    Ok(())
}

/// Everything before the rows: with another frame count or frame time where those have changed.
fn write_head(out: &mut dyn Write, job: &WriteJob, source: &Source, document: &BvhDocument) -> Result<(), Error> {
    let (bytes, timing) = (&document.bytes[..], &document.timing);
    let mut edits: Vec<(Span, String)> = Vec::new();
    if job.clip.frames() != document.rows.len() {
        edits.push((timing.frames_word, job.clip.frames().to_string()));
    }
    if job.clip.frame_time_secs().to_bits() != source.clip.frame_time_secs().to_bits() {
        edits.push((timing.frame_time_word, job.clip.frame_time_secs().to_string()));
    }
    edits.sort_by_key(|(span, _)| span.start);
    let mut at = 0;
    for (span, text) in edits {
        send(out, &bytes[at..span.start])?;
        send(out, text.as_bytes())?;
        at = span.end;
    }
    send(out, &bytes[at..timing.end])
}

/// Decimals of positions and of rotations.
#[derive(Clone, Copy)]
struct Precision {
    positions: usize,
    rotations: usize,
}

/// Rows of the source with the changes of the job.
struct Editor<'a> {
    job: &'a WriteJob<'a>,
    source: &'a Source<'a>,
    document: &'a BvhDocument,
    /// Per column.
    is_position: Vec<bool>,
    /// Found when the first change needs it: it takes a pass over the file.
    precision: Option<Precision>,
    /// The values of the source's row.
    old: Vec<f64>,
    /// Per column the value to print, where it is another.
    new: Vec<Option<f64>>,
}

impl<'a> Editor<'a> {
    fn new(job: &'a WriteJob<'a>, source: &'a Source<'a>, document: &'a BvhDocument) -> Editor<'a> {
        let mut is_position = vec![false; document.columns.iter().map(|columns| columns.channels.len()).sum()];
        for columns in &document.columns {
            columns.positions().for_each(|(column, _)| is_position[column] = true);
        }
        Editor { job, source, document, is_position, precision: None, old: Vec::new(), new: Vec::new() }
    }

    /// One row, into `text`.
    fn row(&mut self, frame: usize, row: usize, losses: &mut Losses, text: &mut Vec<u8>) -> Result<(), Error> {
        let bytes = &self.document.bytes[..];
        let span = self.document.rows[row];
        self.new.clear();
        for joint in 0..self.document.columns.len() {
            let turned = turned(self.job, self.source, (frame, row), joint);
            let moved = moved(self.job, self.source, (frame, row), joint);
            if (turned || moved) && self.new.is_empty() {
                self.read_old(span)?;
            }
            if turned {
                self.turn(frame, joint, losses)?;
            }
            if moved {
                self.shift(frame, row, joint, losses)?;
            }
        }
        if self.new.iter().all(Option::is_none) {
            text.extend_from_slice(span.of(bytes));
            return Ok(());
        }
        let precision = *self.precision.get_or_insert_with(|| measure(self.document, &self.is_position));
        let mut at = span.start;
        for (column, word) in words(bytes, span).enumerate() {
            text.extend_from_slice(&bytes[at..word.start]);
            let decimals = if self.is_position[column] { precision.positions } else { precision.rotations };
            match self.new[column] {
                Some(value) => replace(text, word.of(bytes), self.old[column], value, decimals),
                None => text.extend_from_slice(word.of(bytes)),
            }
            at = word.end;
        }
        text.extend_from_slice(&bytes[at..span.end]);
        Ok(())
    }

    fn read_old(&mut self, span: Span) -> Result<(), Error> {
        let bytes = &self.document.bytes[..];
        self.old.clear();
        for word in words(bytes, span) {
            self.old.push(number(bytes, word, || "a value".to_owned())?);
        }
        self.new.resize(self.old.len(), None);
        Ok(())
    }

    /// A rotation has changed: its angles on the branch nearest to the source's.
    fn turn(&mut self, frame: usize, joint: usize, losses: &mut Losses) -> Result<(), Error> {
        let columns = &self.document.columns[joint];
        let local = self.source.space.to_source(self.job.clip.local(frame, joint), is_root(self.job.clip, joint));
        let turns = columns.turns(&self.old);
        let Some(angles) = nearest(local.rotation, turns.axes(), turns.degrees()) else {
            return Err(no_rotation(self.job.clip, frame, joint));
        };
        losses.rotation(self.job.clip, frame, joint, angles.loss_rad)?;
        for ((column, _), degrees) in columns.rotations().zip(angles.degrees) {
            self.new[column] = Some(degrees);
        }
        Ok(())
    }

    /// A translation has changed: along axes with a channel it is written, along the others it must not matter.
    fn shift(&mut self, frame: usize, row: usize, joint: usize, losses: &mut Losses) -> Result<(), Error> {
        let root = is_root(self.job.clip, joint);
        let to_source = |clip: &Clip, frame| self.source.space.to_source(clip.local(frame, joint), root).translation;
        let (to, from) = (to_source(self.job.clip, frame), to_source(self.source.clip, row));
        let mut lost = to - from;
        for (column, axis) in self.document.columns[joint].positions() {
            lost[axis.index()] = 0.0;
            self.new[column] = Some(to[axis.index()]);
        }
        losses.translation(self.job.clip, frame, joint, lost.length() * self.source.space.unit_m)
    }
}

/// Goes through the file for the decimals that it uses.
fn measure(document: &BvhDocument, is_position: &[bool]) -> Precision {
    let bytes = &document.bytes[..];
    let (mut positions, mut rotations) = (Decimals::default(), Decimals::default());
    for row in &document.rows {
        for (word, &position) in words(bytes, *row).zip(is_position) {
            if position { &mut positions } else { &mut rotations }.add(word.of(bytes));
        }
    }
    Precision { positions: positions.count(), rotations: rotations.count() }
}
