//! The state behind the functions of a script: names, snapshot, commands. One per process, in the interpreter's thread.

use super::{MAX_TEXT, cut};
use sinew_control::{Action, Command};
use sinew_script::{CharacterState, Limits, Names, PartState, Snapshot, StartInfo, Thing};
use std::cell::RefCell;

/// Names that an error lists before it says "...".
const LISTED: usize = 30;

pub(super) struct Stage {
    pub names: Names,
    /// The script's own character; none when it runs a prop.
    pub own: Option<usize>,
    /// The name of that character or prop.
    pub me: String,
    pub snapshot: Snapshot,
    /// State of the random numbers.
    pub random: u64,
    limits: Limits,
    /// Inside `start()` or `step()`: a snapshot is there and commands are accepted.
    is_stepping: bool,
    commands: Vec<Command>,
    printed: Vec<String>,
    /// The line that is being printed.
    line: String,
    /// Lines printed beyond the limit.
    unprinted: usize,
}

/// A resolved name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Found {
    Character(usize),
    Thing(Thing),
}

thread_local! {
    static STAGE: RefCell<Stage> = RefCell::new(Stage::new(&StartInfo::default(), Limits::default()));
}

/// Called before any text is compiled.
pub(super) fn set_up(info: &StartInfo, limits: Limits) {
    STAGE.set(Stage::new(info, limits));
}

/// Borrows the state; the closure must not call Python.
pub(super) fn with<R>(use_it: impl FnOnce(&mut Stage) -> R) -> R {
    STAGE.with_borrow_mut(use_it)
}

/// "there is no pose 'Hop'; there are: Stand, Walk".
fn unknown<'a>(kind: &str, name: &str, known: impl Iterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.filter(|known| !known.is_empty()).collect();
    let name = cut(name, 60);
    if known.is_empty() {
        return format!("there is no {kind} '{name}': the scene has none");
    }
    let more = if known.len() > LISTED { ", ..." } else { "" };
    format!("there is no {kind} '{name}'; there are: {}{more}", known[..known.len().min(LISTED)].join(", "))
}

impl Stage {
    fn new(info: &StartInfo, limits: Limits) -> Stage {
        Stage {
            names: info.names.clone(),
            own: own(&info.names, &info.own),
            me: info.own.clone(),
            snapshot: Snapshot::default(),
            random: info.seed,
            limits,
            is_stepping: false,
            commands: Vec::new(),
            printed: Vec::new(),
            line: String::new(),
            unprinted: 0,
        }
    }

    /// Replaces the names: the scene was edited.
    pub fn rename(&mut self, names: Names) {
        self.own = own(&names, &self.me);
        self.names = names;
    }

    /// A step begins.
    pub fn begin(&mut self, snapshot: Snapshot) {
        self.snapshot = snapshot;
        self.is_stepping = true;
    }

    /// A step is over.
    pub fn end(&mut self) {
        self.is_stepping = false;
    }

    /// Takes the commands and printed lines for the reply.
    pub fn take(&mut self) -> (Vec<Command>, Vec<String>) {
        if !self.line.is_empty() {
            self.end_line();
        }
        if self.unprinted > 0 {
            self.printed.push(format!("... and {} more lines", self.unprinted));
            self.unprinted = 0;
        }
        (std::mem::take(&mut self.commands), std::mem::take(&mut self.printed))
    }

    /// Prints.
    pub fn print(&mut self, text: &str) {
        for piece in text.split_inclusive('\n') {
            let (words, is_end) = piece.strip_suffix('\n').map_or((piece, false), |words| (words, true));
            // Four bytes at most for each character that will be kept.
            if self.line.len() <= 4 * MAX_TEXT {
                self.line.push_str(&cut(words, MAX_TEXT));
            }
            if is_end {
                self.end_line();
            }
        }
    }

    fn end_line(&mut self) {
        let line = cut(&std::mem::take(&mut self.line), MAX_TEXT);
        if self.printed.len() < self.limits.printed_lines {
            self.printed.push(line);
        } else {
            self.unprinted += 1;
        }
    }

    /// Checks that the script is inside `start()` or `step()`.
    pub fn ready(&self) -> Result<(), String> {
        if self.is_stepping {
            Ok(())
        } else {
            Err("nothing to sense or to steer yet: call this from start() or step()".to_owned())
        }
    }

    /// Adds a command for a character, or for the stage.
    pub fn act(&mut self, character: Option<usize>, action: Action) -> Result<(), String> {
        self.ready()?;
        if self.commands.len() >= self.limits.commands {
            return Err(format!("more than {} commands in one step", self.limits.commands));
        }
        let character = match character {
            Some(place) if Some(place) != self.own => {
                let (own, other) = (&self.me, self.names.characters.get(place).map_or("", |names| &names.name));
                return Err(format!("this script controls '{own}'; it can watch '{other}' but not steer it"));
            }
            Some(place) => self.names.characters.get(place).map(|names| names.name.clone()),
            None => None,
        };
        self.commands.push(Command { character, action });
        Ok(())
    }

    /// A character's state now.
    pub fn character(&self, place: usize) -> Result<&CharacterState, String> {
        self.ready()?;
        let is_there = self.names.characters.get(place).is_some_and(|names| !names.name.is_empty());
        let seen = self.snapshot.characters.get(place).filter(|_| is_there);
        seen.ok_or_else(|| "the scene has no character for this script, or has it no more".to_owned())
    }

    /// The place of a part by its name or alias.
    pub fn part(&self, character: usize, name: &str) -> Result<usize, String> {
        let aliases = self.names.characters.get(character).map_or(&[][..], |names| &names.aliases);
        let part = aliases.iter().find(|(alias, _)| alias == name).map_or(name, |(_, part)| part);
        self.names.parts.iter().position(|known| known == part).ok_or_else(|| {
            let known = self.names.parts.iter().chain(aliases.iter().map(|(alias, _)| alias));
            unknown("part", name, known.map(String::as_str))
        })
    }

    /// A part's name by its name or alias.
    pub fn part_name(&self, character: usize, name: &str) -> Result<String, String> {
        self.part(character, name).map(|place| self.names.parts[place].clone())
    }

    /// A part's state; the first part's, the hips', when none is named.
    pub fn part_state(&self, character: usize, name: Option<&str>) -> Result<PartState, String> {
        let place = name.map_or(Ok(0), |name| self.part(character, name))?;
        self.character(character)?.parts.get(place).copied().ok_or_else(|| "the character has no parts".to_owned())
    }

    /// The place of a character by its name.
    pub fn character_place(&self, name: &str) -> Result<usize, String> {
        let names = || self.names.characters.iter().map(|character| character.name.as_str());
        let place = names().position(|known| known == name).filter(|_| !name.is_empty());
        place.ok_or_else(|| unknown("character", name, names()))
    }

    /// The place of a prop by its name.
    pub fn object(&self, name: &str) -> Result<usize, String> {
        one_of("object", name, &self.names.objects)
    }

    /// The place of a joint by its name.
    pub fn joint(&self, name: &str) -> Result<usize, String> {
        let known = self.names.joints.iter().position(|joint| joint.name == name);
        known.ok_or_else(|| unknown("joint", name, self.names.joints.iter().map(|joint| joint.name.as_str())))
    }

    /// Resolves a name: the ground, a prop, a character, `character.part`, or a part of the own character.
    pub fn find(&self, name: &str) -> Result<Found, String> {
        if name == "ground" {
            return Ok(Found::Thing(Thing::Ground));
        }
        if let Ok(object) = self.object(name) {
            return Ok(Found::Thing(Thing::Object(object)));
        }
        if let Ok(character) = self.character_place(name) {
            return Ok(Found::Character(character));
        }
        // Names may hold dots themselves.
        for (dot, _) in name.match_indices('.') {
            if let Ok(character) = self.character_place(&name[..dot]) {
                return self.part(character, &name[dot + 1..]).map(|part| Found::Thing(Thing::Part(character, part)));
            }
        }
        if let Some(own) = self.own
            && let Ok(part) = self.part(own, name)
        {
            return Ok(Found::Thing(Thing::Part(own, part)));
        }
        let names = self.names.characters.iter().map(|character| character.name.as_str());
        let known = self.names.objects.iter().map(String::as_str).chain(names).chain(["ground"]);
        let parts = self.names.parts.iter().map(String::as_str);
        Err(unknown("object, character or part", name, known.chain(parts)))
    }

    /// Whether a thing is the resolved one, or a part of it.
    pub fn is(thing: Thing, found: Found) -> bool {
        match found {
            Found::Thing(other) => thing == other,
            Found::Character(place) => matches!(thing, Thing::Part(character, _) if character == place),
        }
    }

    /// The name of a thing and, for a part, the part's name.
    pub fn called(&self, thing: Thing) -> (String, Option<String>) {
        let name = |names: &[String], place: usize| names.get(place).cloned().unwrap_or_default();
        match thing {
            Thing::Ground => ("ground".to_owned(), None),
            Thing::Object(place) => (name(&self.names.objects, place), None),
            Thing::Part(character, part) => {
                let character = self.names.characters.get(character).map(|names| names.name.clone());
                (character.unwrap_or_default(), Some(name(&self.names.parts, part)))
            }
        }
    }
}

/// The place of a name among the known ones.
pub(super) fn one_of(kind: &str, name: &str, known: &[String]) -> Result<usize, String> {
    // An empty name is that of a vacant slot.
    let place = known.iter().position(|known| known == name).filter(|_| !name.is_empty());
    place.ok_or_else(|| unknown(kind, name, known.iter().map(String::as_str)))
}

/// The index of the character that a script controls; the first one if the script names none.
fn own(names: &Names, me: &str) -> Option<usize> {
    let own = names.characters.iter().position(|character| character.name == me);
    own.or_else(|| (!names.objects.iter().any(|object| object == me)).then_some(0))
}
