//! External forces on a character, summed over a run.

use serde::Serialize;
use sinew_body::humanoid::Node;
use sinew_world::{CharacterFrame, ExternalForce, ExternalForces};
use std::collections::BTreeMap;

/// Force, power and work of external forces over a run. Keys carry their units.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct ExternalForceReport {
    /// Mean magnitude of the force \[N\].
    pub force_mean_n: f64,
    /// Maximum magnitude of the force in a step \[N\].
    pub force_peak_n: f64,
    /// Mean magnitude of the power \[W\], of either sign.
    pub power_mean_w: f64,
    /// Maximum magnitude of the power in a step \[W\].
    pub power_peak_w: f64,
    /// Net work \[J\].
    pub work_j: f64,
}

/// Sums over the parts of a character: by part, and of the whole body under `all`. Parts without external forces are
/// not listed.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Meter {
    steps: u64,
    parts: [ExternalForceReport; Node::COUNT],
    all: ExternalForceReport,
}

impl ExternalForceReport {
    fn add(&mut self, force_n: f64, power_w: f64, step_secs: f64) {
        self.force_mean_n += force_n;
        self.force_peak_n = self.force_peak_n.max(force_n);
        self.power_mean_w += power_w.abs();
        self.power_peak_w = self.power_peak_w.max(power_w.abs());
        self.work_j += power_w * step_secs;
    }

    fn over(mut self, steps: u64) -> ExternalForceReport {
        self.force_mean_n /= steps.max(1) as f64;
        self.power_mean_w /= steps.max(1) as f64;
        self
    }
}

impl Meter {
    /// Adds a step; `of` selects the external force.
    pub fn watch(&mut self, character: &CharacterFrame, step_secs: f64, of: impl Fn(&ExternalForces) -> ExternalForce) {
        self.steps += 1;
        let (mut forces_n, mut powers_w) = (0.0, 0.0);
        for (part, spent) in self.parts.iter_mut().zip(&character.external) {
            let effort = of(spent);
            let force_n = effort.force.length();
            part.add(force_n, effort.power_w, step_secs);
            forces_n += force_n;
            powers_w += effort.power_w;
        }
        self.all.add(forces_n, powers_w, step_secs);
    }

    /// By the names of parts.
    pub fn report(&self) -> BTreeMap<String, ExternalForceReport> {
        let parts = Node::ALL.into_iter().map(|node| (node.part().name().to_owned(), self.parts[node.index()]));
        let all = std::iter::once(("all".to_owned(), self.all));
        all.chain(parts)
            .filter(|(_, spent)| spent.force_peak_n > 0.0)
            .map(|(name, spent)| (name, spent.over(self.steps)))
            .collect()
    }
}
