//! The report of a run.

use super::actors::{self, ActorReport};
use super::external_force::{ExternalForceReport, Meter};
use super::reaches::ReachWatch;
use crate::jobs::reach::ReachReport;
use serde::Serialize;
use sinew_control::tracker::TrackerKind;
use sinew_live::Performers;
use sinew_stage::{Event, Observer, Stage};
use sinew_world::Entity;
use std::collections::BTreeMap;

/// The report of `sinew run` and `sinew replay`. Keys carry their units.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RunReport {
    /// The scene file.
    pub scene: String,
    /// Physics steps done.
    pub steps: u64,
    /// Time simulated \[s\].
    pub duration_s: f64,
    /// Hash over all physics steps, hexadecimal.
    pub hash: String,
    /// What happened, with causes.
    pub events: Vec<Event>,
    /// Events that are not listed because there were so many.
    pub events_dropped: u64,
    /// Every character by name.
    pub characters: BTreeMap<String, CharacterReport>,
    /// Every live performer, by the character's name.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub actors: BTreeMap<String, ActorReport>,
    /// Largest gap between two parts at their joint \[m\].
    pub joint_gap_max_m: f64,
}

/// One character.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct CharacterReport {
    /// Smallest height of the hips \[m\].
    pub hips_height_min_m: f64,
    /// Height of the hips at the end \[m\].
    pub hips_height_end_m: f64,
    /// Position of the centre of mass at the end \[m\].
    pub centre_end_m: [f64; 3],
    /// Distance of the centre of mass inside the support polygon at the end \[m\]; null in the air.
    pub com_margin_end_m: Option<f64>,
    /// When it first fell \[s\]: its trunk or head touched the ground after it had not; null if it never did.
    pub fell_at_s: Option<f64>,
    /// Number of foot contacts: new contacts of a foot with the ground after a swing phase.
    pub steps: u64,
    /// Maximum impulse of a contact with anything except the ground, in one physics step \[N s\].
    pub hit_impulse_max_n_s: f64,
    /// Number of resets because its body became invalid (not finite).
    pub resets: u64,
    /// Every reach, in order, the first thousand.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub reaches: Vec<ReachReport>,
    /// External forces of pins, by part, and of the whole body under `all`; the carried weight included.
    pub pins: BTreeMap<String, ExternalForceReport>,
    /// Other external forces: physics switched off, planes, attachments to fixed bodies.
    pub held: BTreeMap<String, ExternalForceReport>,
    #[serde(skip)]
    meters: [Meter; 2],
    #[serde(skip)]
    reach: ReachWatch,
    #[serde(skip)]
    in_the_air: [u64; 2],
    /// It was once off the ground with trunk and head.
    #[serde(skip)]
    was_up: bool,
    /// Its tracker shows its motion without physics at the end: it has no contacts.
    #[serde(skip)]
    is_kinematic: bool,
}

/// Physics steps that a foot must have been off the ground for its touch to count as a step: a twentieth of a second at 240 Hz.
const OFF_STEPS: u64 = 12;

impl RunReport {
    /// An empty report of a stage that begins.
    pub fn of(stage: &Stage) -> RunReport {
        let characters = stage.cast().characters().map(|(_, name)| (name.to_owned(), CharacterReport::new()));
        RunReport {
            scene: stage.scene().file_name().to_owned(),
            steps: 0,
            duration_s: 0.0,
            hash: String::new(),
            events: Vec::new(),
            events_dropped: 0,
            characters: characters.collect(),
            actors: BTreeMap::new(),
            joint_gap_max_m: 0.0,
        }
    }

    /// Adds what only the ports of live performers know.
    pub fn add_ports(&mut self, performers: &Performers) {
        actors::add_ports(&mut self.actors, performers);
    }

    /// Fills in what is known at the end.
    pub fn finish(&mut self, stage: &Stage) {
        let frame = stage.frame();
        self.steps = frame.step;
        self.duration_s = frame.time_secs;
        self.hash = format!("{:016x}", stage.hash());
        self.events = stage.events().list().to_vec();
        self.events_dropped = stage.events().dropped();
        self.actors = actors::of(stage);
        for (name, character) in &mut self.characters {
            if let Some(seen) = stage.cast().character(name).and_then(|id| frame.character(id)) {
                character.hips_height_end_m = seen.parts[0].position.y;
                character.centre_end_m = seen.centre_of_mass.into();
                character.com_margin_end_m = seen.support_margin_m();
                let id = stage.cast().character(name);
                let tracker = id.and_then(|id| stage.state_of(id)).map(|actor| actor.tracker().kind());
                character.is_kinematic = tracker == Some(TrackerKind::Kinematic);
            }
            character.pins = character.meters[0].report();
            character.held = character.meters[1].report();
        }
    }
}

impl CharacterReport {
    /// How it ends, in words: whether it fell, and where its weight is.
    pub fn ending(&self) -> String {
        let fell = self.fell_at_s.map_or(String::new(), |secs| format!("fell at {secs:.2} s, "));
        let weight = match self.com_margin_end_m {
            Some(margin) if margin < 0.0 => format!("centre of mass {:.0} mm outside its support", -margin * 1e3),
            Some(margin) => format!("centre of mass {:.0} mm inside its support", margin * 1e3),
            None if self.is_kinematic => "shown without physics".to_owned(),
            None => "in the air".to_owned(),
        };
        format!("{fell}{weight}")
    }

    /// Of a character that has just come.
    fn new() -> CharacterReport {
        CharacterReport { hips_height_min_m: f64::INFINITY, ..CharacterReport::default() }
    }
}

impl Observer for RunReport {
    /// Looks at the stage after a step.
    fn after_step(&mut self, stage: &Stage) {
        use sinew_body::humanoid::Node;
        let frame = stage.frame();
        self.joint_gap_max_m = self.joint_gap_max_m.max(stage.world().largest_joint_gap_m());
        for (id, name) in stage.cast().characters() {
            let Some(seen) = frame.character(id) else { continue };
            if !self.characters.contains_key(name) {
                self.characters.insert(name.to_owned(), CharacterReport::new());
            }
            let Some(character) = self.characters.get_mut(name) else { continue };
            character.hips_height_min_m = character.hips_height_min_m.min(seen.parts[0].position.y);
            character.resets += u64::from(seen.was_reset);
            let step_secs = stage.world().settings().step_secs();
            character.meters[0].watch(seen, step_secs, |spent| spent.pin);
            character.meters[1].watch(seen, step_secs, |spent| spent.held);
            character.reach.watch(stage, id, &mut character.reaches);
            let is_own = |entity: Entity| matches!(entity, Entity::Part(owner, _) if owner == id);
            for contact in &frame.contacts {
                if is_own(contact.a) != is_own(contact.b) && contact.a != Entity::Floor {
                    character.hit_impulse_max_n_s = character.hit_impulse_max_n_s.max(contact.impulse.length());
                }
            }
            let lies = [Node::Hips, Node::Chest, Node::Head]
                .into_iter()
                .any(|part| frame.are_touching(Entity::Floor, Entity::Part(id, part)));
            if lies && character.was_up && character.fell_at_s.is_none() {
                character.fell_at_s = Some(frame.time_secs);
            }
            character.was_up |= !lies;
            for (side, foot) in [Node::LeftFoot, Node::RightFoot].into_iter().enumerate() {
                if frame.are_touching(Entity::Floor, Entity::Part(id, foot)) {
                    character.steps += u64::from(character.in_the_air[side] >= OFF_STEPS);
                    character.in_the_air[side] = 0;
                } else {
                    character.in_the_air[side] += 1;
                }
            }
        }
    }
}
