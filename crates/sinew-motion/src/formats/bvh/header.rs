//! The `HIERARCHY`.

use super::columns::{Channel, Columns};
use super::cursor::Cursor;
use crate::formats::text::{Span, fault, line_at, show, too_many_joints};
use crate::{Error, Joint, Limits, Note, Skeleton, Transform};
use glam::DVec3;

/// What the hierarchy says.
pub(super) struct Header {
    pub(super) skeleton: Skeleton,
    /// One per joint.
    pub(super) columns: Vec<Columns>,
}

/// A joint while its block is read.
struct Draft {
    name: String,
    parent: Option<usize>,
    /// Where its keyword stands.
    at: usize,
    offset: Option<DVec3>,
    channels: Option<Columns>,
    tip: Option<DVec3>,
}

/// Reads up to `MOTION`, and returns the place after it. Nothing recurses: depth costs only a list entry.
pub(super) fn read<'a>(
    bytes: &'a [u8],
    start: usize,
    limits: &Limits,
    notes: &mut Vec<Note>,
) -> Result<(Header, Cursor<'a>), Error> {
    let mut cursor = Cursor { bytes, at: start };
    match cursor.word() {
        Some(word) if is(bytes, word, "HIERARCHY") => {}
        Some(word) => {
            let problem = format!("a BVH file starts with HIERARCHY, this one with {}", show(word.of(bytes)));
            return Err(fault(bytes, word.start, problem, "check that the file is a BVH"));
        }
        None => return Err(cursor.ended("HIERARCHY")),
    }
    let mut drafts: Vec<Draft> = Vec::new();
    let mut open: Vec<usize> = Vec::new();
    let mut columns = 0;
    loop {
        let Some(word) = cursor.word() else {
            return Err(cursor.ended("MOTION"));
        };
        let joint = open.last().copied();
        match joint {
            None if is(bytes, word, "MOTION") => break,
            Some(joint) if is(bytes, word, "MOTION") => {
                let problem = format!("MOTION begins inside joint {}", drafts[joint].name);
                let remedy = format!("add {} closing brace(s) before MOTION", open.len());
                return Err(fault(bytes, word.start, problem, remedy));
            }
            None if is(bytes, word, "ROOT") => open_joint(&mut cursor, word, &mut drafts, &mut open, limits, notes)?,
            Some(_) if is(bytes, word, "JOINT") => {
                open_joint(&mut cursor, word, &mut drafts, &mut open, limits, notes)?;
            }
            Some(joint) if is(bytes, word, "OFFSET") => {
                once(bytes, word, &drafts[joint], drafts[joint].offset.is_some(), "OFFSET")?;
                drafts[joint].offset = Some(offset(&mut cursor, &drafts[joint].name)?);
            }
            Some(joint) if is(bytes, word, "CHANNELS") => {
                once(bytes, word, &drafts[joint], drafts[joint].channels.is_some(), "CHANNELS")?;
                let found = channels(&mut cursor, &drafts[joint].name, columns)?;
                columns += found.channels.len();
                drafts[joint].channels = Some(found);
            }
            Some(joint) if is(bytes, word, "End") => {
                let tip = end_site(&mut cursor, &drafts[joint].name)?;
                if drafts[joint].tip.is_none() {
                    drafts[joint].tip = Some(tip);
                } else {
                    let text = format!("joint {} has a second End Site, which is left out", drafts[joint].name);
                    notes.push(Note::at_line(line_at(bytes, word.start), text));
                }
            }
            Some(_) if word.of(bytes) == b"}" => {
                open.pop();
            }
            _ => return Err(misplaced(bytes, word, joint.map(|joint| &drafts[joint]))),
        }
    }
    Ok((build(bytes, drafts, &cursor)?, cursor))
}

fn is(bytes: &[u8], word: Span, keyword: &str) -> bool {
    word.of(bytes).eq_ignore_ascii_case(keyword.as_bytes())
}

/// The keyword of a joint was taken: its name and opening brace.
fn open_joint(
    cursor: &mut Cursor,
    word: Span,
    drafts: &mut Vec<Draft>,
    open: &mut Vec<usize>,
    limits: &Limits,
    notes: &mut Vec<Note>,
) -> Result<(), Error> {
    let bytes = cursor.bytes;
    let span = cursor.name();
    let raw = span.of(bytes);
    if raw.len() > limits.name_bytes {
        let problem = format!("a joint's name has {} bytes, the limit is {}", raw.len(), limits.name_bytes);
        return Err(fault(bytes, span.start, problem, "put the opening brace after the name, or shorten the name"));
    }
    if let Some((problem, remedy)) = too_many_joints(limits, drafts.len() + 1, open.len() + 1) {
        return Err(fault(bytes, word.start, problem, remedy));
    }
    let mut name = String::from_utf8_lossy(raw).into_owned();
    if name.is_empty() {
        name = format!("joint{}", drafts.len());
        notes.push(Note::at_line(line_at(bytes, word.start), format!("a joint without a name is called {name}")));
    } else if std::str::from_utf8(raw).is_err() {
        let text = format!("the name {name} is not UTF-8: its foreign letters are replaced (not in the file itself)");
        notes.push(Note::at_line(line_at(bytes, word.start), text));
    }
    cursor.open_brace(&format!("the name {}", show(raw)))?;
    let parent = open.last().copied();
    open.push(drafts.len());
    drafts.push(Draft { name, parent, at: word.start, offset: None, channels: None, tip: None });
    Ok(())
}

fn offset(cursor: &mut Cursor, name: &str) -> Result<DVec3, Error> {
    let mut numbers = [0.0; 3];
    for (number, axis) in numbers.iter_mut().zip(['X', 'Y', 'Z']) {
        *number = cursor.number(|| format!("OFFSET {axis} of {name}"))?;
    }
    Ok(DVec3::from_array(numbers))
}

fn channels(cursor: &mut Cursor, name: &str, first: usize) -> Result<Columns, Error> {
    let bytes = cursor.bytes;
    let Some(word) = cursor.word() else {
        return Err(cursor.ended(&format!("the channel count of {name}")));
    };
    let count = std::str::from_utf8(word.of(bytes)).ok().and_then(|text| text.parse::<usize>().ok());
    let Some(count) = count.filter(|&count| count <= 6) else {
        let problem = format!("joint {name} has {} channels; a joint has 0 to 6", show(word.of(bytes)));
        return Err(fault(bytes, word.start, problem, "correct the number after CHANNELS"));
    };
    let mut channels = Vec::with_capacity(count);
    for _ in 0..count {
        let Some(word) = cursor.word() else {
            return Err(cursor.ended(&format!("the channels of {name}")));
        };
        let Some(channel) = Channel::of(word.of(bytes)) else {
            let problem = format!("CHANNELS of {name} names {}, which is not a channel", show(word.of(bytes)));
            let remedy = "channels are Xposition, Yposition, Zposition, Xrotation, Yrotation, Zrotation; \
                          correct the names or their count";
            return Err(fault(bytes, word.start, problem, remedy));
        };
        if channels.contains(&channel) {
            let problem = format!("joint {name} has the channel {} twice", channel.name());
            return Err(fault(bytes, word.start, problem, "name each channel of a joint once"));
        }
        channels.push(channel);
    }
    Ok(Columns { first, channels })
}

/// `End` was taken: the rest of its line, an offset in braces.
fn end_site(cursor: &mut Cursor, name: &str) -> Result<DVec3, Error> {
    let bytes = cursor.bytes;
    cursor.name();
    cursor.open_brace(&format!("the End Site of {name}"))?;
    let mut tip = None;
    loop {
        let Some(word) = cursor.word() else {
            return Err(cursor.ended(&format!("the end of the End Site of {name}")));
        };
        if is(bytes, word, "OFFSET") && tip.is_none() {
            tip = Some(offset(cursor, &format!("the End Site of {name}"))?);
        } else if is(bytes, word, "CHANNELS") && channels(cursor, "an End Site", 0)?.channels.is_empty() {
            continue;
        } else if word.of(bytes) == b"}" {
            return tip.ok_or_else(|| {
                fault(bytes, word.start, format!("the End Site of {name} has no OFFSET"), "add a line OFFSET x y z")
            });
        } else {
            let problem = format!("{} does not belong in the End Site of {name}", show(word.of(bytes)));
            return Err(fault(bytes, word.start, problem, "an End Site holds one OFFSET and ends with `}`"));
        }
    }
}

fn once(bytes: &[u8], word: Span, draft: &Draft, known: bool, keyword: &str) -> Result<(), Error> {
    if !known {
        return Ok(());
    }
    let problem = format!("joint {} has a second {keyword}", draft.name);
    Err(fault(bytes, word.start, problem, "remove one of them, or add the missing JOINT line before it"))
}

fn misplaced(bytes: &[u8], word: Span, joint: Option<&Draft>) -> Error {
    let shown = show(word.of(bytes));
    let (problem, remedy) = match joint {
        None if word.of(bytes) == b"}" => {
            ("a closing brace has no opening one".to_owned(), "remove it, or restore the `{` that is missing above")
        }
        None => {
            (format!("{shown} stands outside the skeleton"), "expected ROOT or MOTION here: check the braces above")
        }
        Some(draft) if Channel::of(word.of(bytes)).is_some() => (
            format!("joint {} names more channels than its CHANNELS count says", draft.name),
            "correct the number after CHANNELS",
        ),
        Some(draft) if is(bytes, word, "ROOT") => {
            (format!("ROOT begins inside joint {}", draft.name), "close the joints above with `}`, or write JOINT")
        }
        Some(draft) => (
            format!("{shown} does not belong in joint {}", draft.name),
            "a joint holds OFFSET, CHANNELS, JOINT and End Site, and ends with `}`",
        ),
    };
    fault(bytes, word.start, problem, remedy)
}

fn build(bytes: &[u8], drafts: Vec<Draft>, cursor: &Cursor) -> Result<Header, Error> {
    if drafts.is_empty() {
        let remedy = "add a ROOT, or check that the file is a BVH";
        return Err(fault(bytes, cursor.at, "the hierarchy has no joints", remedy));
    }
    let mut header = Header { skeleton: Skeleton::new(), columns: Vec::with_capacity(drafts.len()) };
    for draft in drafts {
        let Some(offset) = draft.offset else {
            let problem = format!("joint {} has no OFFSET", draft.name);
            return Err(fault(bytes, draft.at, problem, "add a line OFFSET x y z to it"));
        };
        let rest = Transform::new(glam::DQuat::IDENTITY, offset);
        header.skeleton.push(Joint { name: draft.name, parent: draft.parent, rest, tip: draft.tip });
        header.columns.push(draft.channels.unwrap_or_default());
    }
    Ok(header)
}
