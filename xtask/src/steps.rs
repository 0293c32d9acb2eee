//! The check's steps and what each took.

use std::fmt::Write;
use std::time::{Duration, Instant};

/// Steps that have ended, in their order.
#[derive(Debug, Default)]
pub struct Steps(Vec<(&'static str, Duration)>);

impl Steps {
    /// Does a step and keeps how long it took, whether it fails or not.
    ///
    /// ```
    /// let mut steps = xtask::steps::Steps::default();
    /// assert_eq!(steps.run("format", || Err("a line is too long".to_owned())), Err("a line is too long".to_owned()));
    /// assert!(steps.table().contains("format"));
    /// ```
    ///
    /// # Errors
    /// That of the step.
    pub fn run(&mut self, name: &'static str, step: impl FnOnce() -> Result<(), String>) -> Result<(), String> {
        let began = Instant::now();
        let done = step();
        self.0.push((name, began.elapsed()));
        done
    }

    /// A row for each step, in seconds of the clock, and their sum.
    pub fn table(&self) -> String {
        let total = self.0.iter().map(|(_, took)| *took).sum::<Duration>();
        let mut table = String::from("\n   seconds  step\n");
        for (name, took) in self.0.iter().chain([&("total", total)]) {
            let _ = writeln!(table, "{:>10.1}  {name}", took.as_secs_f64());
        }
        table
    }
}
