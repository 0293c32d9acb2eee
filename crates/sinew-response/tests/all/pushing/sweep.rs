//! Many pushes.

use super::push::{DIRECTIONS, Outcome, PARTS, PHASES, push, starts};
use super::{Case, PERSON};
use sinew_body::humanoid::Person;
use sinew_response::Settings;
use sinew_testkit::{WALKS, mocap, work};
use std::borrow::Borrow;
use std::sync::OnceLock;

/// The child of the two subjects.
const CHILD: Person = Person { mass_kg: 40.0, height_m: Some(1.5) };

/// What kind of push a sweep makes.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    /// Size of the force on an 80 kg body \[N\]; in proportion for others.
    pub newtons: f64,
    /// Poses for which it lasts, 60 a second.
    pub frames: usize,
    /// How long to look on after its end \[s\].
    pub window_secs: f64,
    /// All four directions at all eight phases; else two at each phase, left and right at the even ones, forward and backward
    /// at the odd ones.
    pub all: bool,
}

/// One push of a sweep.
pub struct Run {
    pub case: usize,
    pub part: usize,
    pub direction: usize,
    pub phase: usize,
    pub outcome: Outcome,
}

impl Run {
    pub fn name<C: Borrow<Case>>(&self, cases: &[C]) -> String {
        let (part, direction) = (PARTS[self.part].0, DIRECTIONS[self.direction].0);
        format!("{}, {part} to the {direction} at phase {}", cases[self.case].borrow().name, self.phase)
    }
}

/// Every walk of somebody of 80 kg, with room for the longest sweep; read once for all claims of the program.
pub fn every_adult() -> Option<&'static [Case]> {
    static CASES: OnceLock<Option<Vec<Case>>> = OnceLock::new();
    CASES.get_or_init(|| every_walk(PERSON)).as_deref()
}

/// Every walk of a child of half the weight, as [`every_adult`].
pub fn every_child() -> Option<&'static [Case]> {
    static CASES: OnceLock<Option<Vec<Case>>> = OnceLock::new();
    CASES.get_or_init(|| every_walk(CHILD)).as_deref()
}

/// Some of [`every_adult`], by the names of their files.
pub fn adults(names: &[&str]) -> Option<Vec<&'static Case>> {
    let cases = every_adult()?;
    Some(names.iter().map(|name| cases.iter().find(|case| case.name == *name).unwrap()).collect())
}

fn every_walk(person: Person) -> Option<Vec<Case>> {
    let mocap = mocap()?;
    Some(work(&WALKS, |name| Case::of_person(&mocap, name, 14.0, person)))
}

/// Pushes every part of every clip in every direction at every phase, as far as the kind says.
pub fn sweep<C: Borrow<Case> + Sync>(cases: &[C], settings: Settings, kind: Kind) -> Vec<Run> {
    let indices: Vec<usize> = (0..cases.len()).collect();
    let runs = work(&indices, |&index| {
        let case = cases[index].borrow();
        let newtons = kind.newtons * case.body().mass_kg() / 80.0;
        let mut unpushed = Vec::new();
        let starts = starts(case, &case.stable(settings), &case.onsets(PHASES), &mut unpushed);
        let mut runs = Vec::new();
        for (part, (_, node)) in PARTS.into_iter().enumerate() {
            for (phase, start) in starts.iter().enumerate() {
                for (direction, (_, axis)) in DIRECTIONS.into_iter().enumerate() {
                    if kind.all || direction / 2 == phase % 2 {
                        let outcome = push(start, node, axis * newtons, kind.frames, kind.window_secs);
                        runs.push(Run { case: index, part, direction, phase, outcome });
                    }
                }
            }
        }
        runs
    });
    runs.into_iter().flatten().collect()
}

/// The mean of something over runs; NaN for none.
pub fn mean<'a>(runs: impl Iterator<Item = &'a Run>, of: impl Fn(&Outcome) -> f64) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for run in runs {
        sum += of(&run.outcome);
        count += 1.0;
    }
    sum / count
}
