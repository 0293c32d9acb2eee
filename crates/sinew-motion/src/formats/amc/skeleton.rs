//! The skeleton, `.asf`.

use super::bone::{Bone, Dof};
use super::section::{Line, lines};
use crate::formats::text::{Axis, compose, line_at, show, text_start, too_many_joints};
use crate::{Error, Joint, Limits, Note, Place, Skeleton, Transform};
use glam::{DQuat, DVec3};
use std::collections::BTreeMap;

/// An Acclaim skeleton.
#[derive(Clone, Debug)]
pub struct Asf {
    /// The root and a joint at the start of every bone, depth first, in the file's unit and axes (Y up).
    pub skeleton: Skeleton,
    /// Length of one file unit \[m\]: 0.0254 / `length`; `None` where `:units` does not state it.
    pub unit_m: Option<f64>,
    /// What was guessed or ignored.
    pub notes: Vec<Note>,
    /// One per joint.
    pub(super) bones: Vec<Bone>,
    /// Whether the angles are degrees; the motion may say otherwise for its own.
    pub(super) degrees: bool,
}

/// A bone as its block states it.
struct Draft {
    name: String,
    at: usize,
    direction: Option<DVec3>,
    length: Option<f64>,
    axis: Option<(DVec3, [Axis; 3])>,
    dof: Vec<Dof>,
}

impl Draft {
    fn new(name: &str, at: usize) -> Draft {
        Draft { name: name.to_owned(), at, direction: None, length: None, axis: None, dof: Vec::new() }
    }

    /// From its start to its end.
    fn span(&self) -> DVec3 {
        self.direction.unwrap_or_default() * self.length.unwrap_or_default()
    }
}

/// What has been read so far.
struct Reader<'a> {
    limits: &'a Limits,
    unit_m: Option<f64>,
    degrees: bool,
    root_position: DVec3,
    /// The root first.
    drafts: Vec<Draft>,
    by_name: BTreeMap<String, usize>,
    children: Vec<Vec<usize>>,
    parents: Vec<Option<usize>>,
    notes: Vec<Note>,
    in_block: bool,
}

const XYZ: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];

/// Reads an ASF.
pub(super) fn read(bytes: &[u8], limits: &Limits) -> Result<Asf, Error> {
    let start = text_start(bytes, limits, "ASF")?;
    let mut reader = Reader {
        limits,
        unit_m: None,
        degrees: true,
        root_position: DVec3::ZERO,
        drafts: vec![Draft::new("root", start)],
        by_name: BTreeMap::from([("root".to_owned(), 0)]),
        children: vec![Vec::new()],
        parents: vec![None],
        notes: Vec::new(),
        in_block: false,
    };
    let mut section = String::new();
    for line in lines(bytes, start) {
        if let Some(name) = line.key().strip_prefix(b":") {
            if reader.in_block {
                return Err(line.fault("a bone's block is not closed", "add the missing `end` above"));
            }
            section = String::from_utf8_lossy(name).to_ascii_lowercase();
            reader.section(&section, &line);
            continue;
        }
        match section.as_str() {
            "" => {
                let problem =
                    format!("an ASF starts with a section such as :version, this one with {}", show(line.key()));
                return Err(line.fault(problem, "check that the file is an ASF skeleton"));
            }
            "units" => reader.units(&line)?,
            "root" => reader.root(&line)?,
            "bonedata" => reader.bone(&line)?,
            "hierarchy" => reader.hang(&line)?,
            _ => {}
        }
    }
    reader.finish(bytes)
}

impl Reader<'_> {
    fn section(&mut self, name: &str, line: &Line) {
        const KNOWN: [&str; 7] = ["version", "name", "units", "documentation", "root", "bonedata", "hierarchy"];
        if !KNOWN.contains(&name) {
            let text = format!("the section :{} is ignored", show(name.as_bytes()).trim_matches('"'));
            self.notes.push(Note::at_line(line_at(line.bytes, line.words[0].start), text));
        }
    }

    fn units(&mut self, line: &Line) -> Result<(), Error> {
        const INCH_M: f64 = 0.0254;
        if line.is("length") {
            let length = line.number(1, "the unit of length")?;
            if !(1e-6..=1e6).contains(&length) {
                let problem = format!("the unit of length is {length}, which is not between 1e-6 and 1e6");
                return Err(line.fault(problem, "write the length that one inch has in the file, such as 0.45"));
            }
            self.unit_m = Some(INCH_M / length);
        } else if line.is("angle") {
            self.degrees = match line.word(1, "the unit of angles")?.to_ascii_lowercase().as_slice() {
                b"deg" | b"degree" | b"degrees" => true,
                b"rad" | b"radian" | b"radians" => false,
                other => {
                    return Err(line.fault(format!("the unit of angles is {}", show(other)), "write `deg` or `rad`"));
                }
            };
        }
        Ok(())
    }

    fn root(&mut self, line: &Line) -> Result<(), Error> {
        if line.is("order") {
            self.drafts[0].dof = degrees_of_freedom(line)?;
        } else if line.is("axis") {
            let order = order(line, 1)?;
            let angles = self.drafts[0].axis.map_or(DVec3::ZERO, |(angles, _)| angles);
            self.drafts[0].axis = Some((angles, order));
        } else if line.is("position") {
            self.root_position = line.triple("the root's position")?;
        } else if line.is("orientation") {
            let order = self.drafts[0].axis.map_or(XYZ, |(_, order)| order);
            self.drafts[0].axis = Some((line.triple("the root's orientation")?, order));
        }
        Ok(())
    }

    fn bone(&mut self, line: &Line) -> Result<(), Error> {
        if line.is("begin") {
            if self.in_block {
                return Err(line.fault("a bone begins inside another", "add the missing `end` above"));
            }
            if let Some((problem, remedy)) = too_many_joints(self.limits, self.drafts.len() + 1, 0) {
                return Err(line.fault(problem, remedy));
            }
            self.in_block = true;
            self.drafts.push(Draft::new("", line.words[0].start));
            return Ok(());
        }
        let index = self.drafts.len() - 1;
        if !self.in_block {
            let problem = format!("{} stands outside a bone", show(line.key()));
            return Err(line.fault(problem, "bones stand between `begin` and `end`"));
        }
        let draft = &mut self.drafts[index];
        if line.is("end") {
            self.in_block = false;
            return self.close(line);
        } else if line.is("name") {
            let raw = line.word(1, "the bone's name")?;
            if raw.len() > self.limits.name_bytes {
                let problem = format!("a bone's name has {} bytes, the limit is {}", raw.len(), self.limits.name_bytes);
                return Err(line.fault(problem, "shorten the name"));
            }
            draft.name = String::from_utf8_lossy(raw).into_owned();
        } else if line.is("direction") {
            draft.direction = Some(line.triple("the bone's direction")?);
        } else if line.is("length") {
            draft.length = Some(line.number(1, "the bone's length")?);
        } else if line.is("axis") {
            let order = if line.words.len() > 4 { order(line, 4)? } else { XYZ };
            draft.axis = Some((line.triple("the bone's axis")?, order));
        } else if line.is("dof") {
            draft.dof = degrees_of_freedom(line)?;
        }
        // id, limits (over several lines), masses: nothing that a motion needs.
        Ok(())
    }

    /// A bone's block has ended.
    fn close(&mut self, line: &Line) -> Result<(), Error> {
        self.children.push(Vec::new());
        self.parents.push(None);
        let index = self.drafts.len() - 1;
        let draft = &self.drafts[index];
        if draft.name.is_empty() {
            return Err(line.fault("a bone has no name", "add a line `name ...` to it"));
        }
        for (missing, known) in [("direction", draft.direction.is_some()), ("length", draft.length.is_some())] {
            if !known {
                return Err(line.fault(format!("bone {} has no {missing}", draft.name), format!("add its `{missing}`")));
            }
        }
        let length = draft.direction.unwrap_or_default().length();
        if draft.length != Some(0.0) && (length - 1.0).abs() > 0.01 {
            let text =
                format!("the direction of bone {} has length {length:.4}, not 1; it is taken as it is", draft.name);
            self.notes.push(Note::at_line(line_at(line.bytes, draft.at), text));
        }
        let (_, order) = draft.axis.unwrap_or((DVec3::ZERO, XYZ));
        let listed: Vec<Axis> = draft.dof.iter().filter_map(turn_axis).collect();
        let expected: Vec<Axis> = order.into_iter().filter(|axis| listed.contains(axis)).collect();
        if listed != expected {
            let text = format!("bone {} lists its dof in another order than its axis; the dof's is used", draft.name);
            self.notes.push(Note::at_line(line_at(line.bytes, draft.at), text));
        }
        if self.by_name.insert(draft.name.clone(), index).is_some() {
            return Err(line.fault(format!("a second bone is called {}", draft.name), "give every bone its own name"));
        }
        Ok(())
    }

    /// A line of the hierarchy: a parent and its children.
    fn hang(&mut self, line: &Line) -> Result<(), Error> {
        if line.words.len() == 1 && (line.is("begin") || line.is("end")) {
            return Ok(());
        }
        let find = |name: &[u8]| {
            std::str::from_utf8(name).ok().and_then(|name| self.by_name.get(name)).copied().ok_or_else(|| {
                line.fault(format!("the hierarchy names {}, which is not a bone", show(name)), "add it to :bonedata")
            })
        };
        let parent = find(line.key())?;
        let children: Vec<usize> = line.rest().map(find).collect::<Result<_, _>>()?;
        for child in children {
            if child == 0 || self.parents[child].is_some() {
                let problem = format!("bone {} hangs from two places", self.drafts[child].name);
                return Err(line.fault(problem, "name each bone once as a child in :hierarchy, and never the root"));
            }
            self.parents[child] = Some(parent);
            self.children[parent].push(child);
        }
        Ok(())
    }

    fn finish(mut self, bytes: &[u8]) -> Result<Asf, Error> {
        let whole = |problem: &str, remedy: &str| Err(Error::new(Place::File, problem, remedy));
        if self.in_block {
            return whole("the file ends inside a bone", "the file is truncated: export or copy it again");
        }
        if self.drafts.len() == 1 {
            return whole("the skeleton has no bones", "check that the file is an ASF skeleton");
        }
        if self.drafts[0].dof.is_empty() {
            let axes = [Axis::X, Axis::Y, Axis::Z];
            self.drafts[0].dof = axes.map(Dof::Shift).into_iter().chain(axes.map(Dof::Turn)).collect();
            self.notes.push(Note::new("the root states no order; TX TY TZ RX RY RZ is used"));
        }
        let mut asf = Asf {
            skeleton: Skeleton::new(),
            unit_m: self.unit_m,
            notes: Vec::new(),
            bones: Vec::with_capacity(self.drafts.len()),
            degrees: self.degrees,
        };
        let mut placed = vec![None; self.drafts.len()];
        let mut open = vec![(0, 1)];
        while let Some((index, depth)) = open.pop() {
            if let Some((problem, remedy)) = too_many_joints(self.limits, 0, depth) {
                return whole(&problem, remedy);
            }
            open.extend(self.children[index].iter().rev().map(|&child| (child, depth + 1)));
            let parent = self.parents[index].and_then(|parent| placed[parent]);
            placed[index] = Some(self.place(&mut asf, index, parent));
        }
        if let Some(index) = placed.iter().position(Option::is_none) {
            let (name, line) = (&self.drafts[index].name, line_at(bytes, self.drafts[index].at));
            let problem = format!("bone {name} does not hang from the root");
            return Err(Error::new(Place::Line(line), problem, "add it to :hierarchy, below the root"));
        }
        asf.notes = self.notes;
        Ok(asf)
    }

    /// Makes a joint at the start of a bone.
    fn place(&self, asf: &mut Asf, index: usize, parent: Option<usize>) -> usize {
        let draft = &self.drafts[index];
        let start = match self.parents[index] {
            Some(parent) => self.drafts[parent].span(),
            None => self.root_position,
        };
        let (angles, order) = draft.axis.unwrap_or((DVec3::ZERO, XYZ));
        // The angles stand as x y z; the order says about which fixed axis to turn first.
        let turns = [order[2], order[1], order[0]];
        let angles = turns.map(|axis| angles[axis.index()]);
        let angles = if self.degrees { angles } else { angles.map(f64::to_degrees) };
        let axes = compose(&turns, &angles);
        let tip = self.children[index].is_empty().then(|| draft.span());
        asf.bones.push(Bone { name: draft.name.clone(), axes, dof: draft.dof.clone(), is_root: index == 0 });
        let rest = Transform::new(DQuat::IDENTITY, start);
        asf.skeleton.push(Joint { name: draft.name.clone(), parent, rest, tip })
    }
}

fn turn_axis(dof: &Dof) -> Option<Axis> {
    if let Dof::Turn(axis) = dof { Some(*axis) } else { None }
}

/// The words after `dof` or `order`.
fn degrees_of_freedom(line: &Line) -> Result<Vec<Dof>, Error> {
    let mut found = Vec::new();
    for word in line.rest() {
        let Some(dof) = Dof::of(word) else {
            let problem = format!("{} is not a degree of freedom", show(word));
            return Err(line.fault(problem, "write some of tx ty tz rx ry rz l"));
        };
        if found.contains(&dof) {
            return Err(line.fault(format!("{} is there twice", show(word)), "name each degree of freedom once"));
        }
        found.push(dof);
    }
    Ok(found)
}

/// A word such as `XYZ`.
fn order(line: &Line, index: usize) -> Result<[Axis; 3], Error> {
    let word = line.word(index, "the order of the axes")?;
    if let &[a, b, c] = word
        && let (Some(a), Some(b), Some(c)) = (Axis::of(a), Axis::of(b), Axis::of(c))
        && a != b
        && b != c
        && a != c
    {
        return Ok([a, b, c]);
    }
    Err(line.fault(format!("{} is not an order of axes", show(word)), "write the three axes, such as XYZ"))
}
