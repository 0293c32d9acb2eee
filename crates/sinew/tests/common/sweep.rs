//! Many pushes.

use super::push::{DIRECTIONS, Outcome, PARTS, PHASES, push, starts};
use super::{Case, WALKS, mocap, work};
use sinew::body::humanoid::Person;
use sinew::response::Settings;
use std::fmt::Write;

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
    pub fn name(&self, cases: &[Case]) -> String {
        let (part, direction) = (PARTS[self.part].0, DIRECTIONS[self.direction].0);
        format!("{}, {part} to the {direction} at phase {}", cases[self.case].name, self.phase)
    }
}

/// Some walks, or all; with room for the longest sweep.
pub fn walks(names: &[&str], person: Person) -> Option<Vec<Case>> {
    let mocap = mocap()?;
    Some(work(names, |name| Case::of_person(&mocap, name, 14.0, person)))
}

/// All of them.
pub fn every_walk(person: Person) -> Option<Vec<Case>> {
    walks(&WALKS, person)
}

/// Pushes every part of every clip in every direction at every phase, as far as the kind says.
pub fn sweep(cases: &[Case], settings: Settings, kind: Kind) -> Vec<Run> {
    let indices: Vec<usize> = (0..cases.len()).collect();
    let runs = work(&indices, |&index| {
        let case = &cases[index];
        let newtons = kind.newtons * case.body.mass_kg() / 80.0;
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

/// Fails, showing some of what failed, unless nothing did.
#[track_caller]
pub fn none_of(total: usize, failures: &[String]) {
    let mut text = String::new();
    for failure in failures.iter().take(30) {
        let _ = writeln!(text, "  {failure}");
    }
    assert!(failures.is_empty(), "{} of {total} fail:\n{text}", failures.len());
    assert!(total > 0, "nothing was tried");
}
