//! What happens in a run, for its pictures: pushes, impacts, events.

use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_stage::scene::SceneSpec;
use sinew_stage::{Cast, Event, Observer, Stage};
use sinew_world::{Contact, Entity, Frame};

/// What happens in a run, by the frame of its recording that shows it.
#[derive(Clone, Debug, Default)]
pub struct Marks {
    frames: Vec<FrameMarks>,
    /// Events by time \[s\], in words.
    events: Vec<(f64, String)>,
    steps_per_frame: u64,
    /// Impacts whose impulse still grows: frame, place in it, and the step after which it is complete.
    growing: Vec<(usize, usize, u64)>,
}

/// What happens in one frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrameMarks {
    /// Pushes that act.
    pub pushes: Vec<PushMark>,
    /// Impacts that begin.
    pub hits: Vec<HitMark>,
}

/// A push that acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PushMark {
    /// On what.
    pub on: Entity,
    /// Where \[m\], world.
    pub at: DVec3,
    /// Its force \[N\], world.
    pub force_n: DVec3,
}

/// An impact on a character.
#[derive(Clone, Debug, PartialEq)]
pub struct HitMark {
    /// The two that meet, in the order of [`Entity`].
    pub between: [Entity; 2],
    /// What they are called: `ball`, `left's lower arm`, `the ground`.
    pub names: [String; 2],
    /// Where \[m\], world.
    pub at: DVec3,
    /// Impulse of its first twentieth of a second \[N s\].
    pub impulse_n_s: f64,
}

/// What a body is called in a sentence.
fn name(cast: &Cast, entity: Entity) -> String {
    let name = cast.name_of(entity);
    match (entity, name.rsplit_once('.')) {
        (Entity::Floor, _) => "the ground".to_owned(),
        (Entity::Part(_, node), Some((owner, _))) => format!("{owner}'s {}", node.part().words()),
        _ => name,
    }
}

impl HitMark {
    /// The impact in words.
    pub fn words(&self) -> String {
        let [one, other] = &self.names;
        // The ground is never what moves.
        let (one, other) = if self.between[0] == Entity::Floor { (other, one) } else { (one, other) };
        format!("{one} hits {other}, {:.0} N s", self.impulse_n_s)
    }

    /// Whether two impacts are of the same two bodies, whichever of their parts.
    pub(super) fn is_of_the_same(&self, other: &HitMark) -> bool {
        let whole = |entity: Entity| match entity {
            Entity::Part(owner, _) => Entity::Part(owner, Node::Hips),
            other => other,
        };
        self.between.map(whole) == other.between.map(whole)
    }
}

/// Pushes and impacts of a frame; further ones are not drawn.
const MAX_MARKS: usize = 32;

/// Impacts below this are touches \[N s\]: a football that is dropped from a metre.
pub(super) const HIT_N_S: f64 = 2.0;

impl Marks {
    /// Nothing yet, of a stage that begins.
    pub fn of(stage: &Stage) -> Marks {
        Marks::of_scene(stage.scene())
    }

    /// Nothing yet, of a scene whose stage runs elsewhere; [`Marks::watch_frame`] fills it.
    pub fn of_scene(scene: &SceneSpec) -> Marks {
        let steps_per_frame = u64::from(scene.stage.steps_per_frame()).max(1);
        Marks { steps_per_frame, ..Marks::default() }
    }

    /// Adds the events of a run.
    pub fn finish(&mut self, events: &[Event]) {
        self.events = events.iter().map(|event| (event.time_secs, event.effect.to_string())).collect();
    }

    /// A frame of the recording.
    pub fn frame(&self, index: usize) -> Option<&FrameMarks> {
        self.frames.get(index)
    }

    /// All frames, up to the last in which something happens.
    pub fn frames(&self) -> &[FrameMarks] {
        &self.frames
    }

    /// The events from one time until another \[s\], that not included: an event shows in the frame after it.
    pub fn events_between(&self, from_secs: f64, until_secs: f64) -> impl Iterator<Item = &str> {
        let within = move |secs: f64| secs >= from_secs && secs < until_secs;
        self.events.iter().filter(move |(secs, _)| within(*secs)).map(|(_, words)| words.as_str())
    }

    /// Times of all events \[s\].
    pub(super) fn event_times(&self) -> impl Iterator<Item = f64> {
        self.events.iter().map(|(secs, _)| *secs)
    }

    /// Adds the impacts of a step, which the recording shows in its frame `index`.
    pub fn watch_frame(&mut self, index: usize, frame: &Frame, cast: &Cast) {
        if self.frames.len() <= index {
            self.frames.resize(index + 1, FrameMarks::default());
        }
        let complete_after = self.steps_per_frame * 3;
        self.growing.retain(|(.., until)| frame.step <= *until);
        for contact in frame.contacts.iter().filter(|contact| is_impact(contact)) {
            let pair = [contact.a, contact.b];
            let known = self.growing.iter().find(|(at, place, _)| self.frames[*at].hits[*place].between == pair);
            match known.copied() {
                Some((at, place, _)) => self.frames[at].hits[place].impulse_n_s += contact.impulse.length(),
                None if contact.begins && self.frames[index].hits.len() < MAX_MARKS => {
                    let impulse_n_s = contact.impulse.length();
                    let names = pair.map(|entity| name(cast, entity));
                    self.frames[index].hits.push(HitMark { between: pair, names, at: contact.point, impulse_n_s });
                    self.growing.push((index, self.frames[index].hits.len() - 1, frame.step + complete_after));
                }
                None => {}
            }
        }
    }
}

/// Whether a contact can be an impact that is worth a mark: of a character with something else, except its feet with what it stands on.
fn is_impact(contact: &Contact) -> bool {
    let is_foot = |entity: Entity| matches!(entity, Entity::Part(_, Node::LeftFoot | Node::RightFoot));
    let is_upright = contact.impulse.y.abs() > 0.8 * contact.impulse.length();
    if is_upright && (is_foot(contact.a) || is_foot(contact.b)) {
        return false;
    }
    match (contact.a, contact.b) {
        (Entity::Floor, entity) => matches!(entity, Entity::Part(..)) && !is_foot(entity),
        (Entity::Part(one, _), Entity::Part(other, _)) => one != other,
        (one, other) => [one, other].iter().any(|entity| matches!(entity, Entity::Part(..))),
    }
}

impl Observer for Marks {
    fn after_step(&mut self, stage: &Stage) {
        let frame = stage.frame();
        let index = frame.step.div_ceil(self.steps_per_frame) as usize;
        self.watch_frame(index, frame, stage.cast());
        for (on, at, force_n) in stage.pushes() {
            let pushes = &mut self.frames[index].pushes;
            match pushes.iter().position(|push| push.on == on) {
                Some(known) if pushes[known].force_n.length() < force_n.length() => {
                    pushes[known] = PushMark { on, at, force_n };
                }
                None if pushes.len() < MAX_MARKS => pushes.push(PushMark { on, at, force_n }),
                _ => {}
            }
        }
    }
}
