//! The head stays level in space.
//!
//! A pushed trunk takes the head along only in part: the vestibular reflex turns the neck against the trunk within a tenth of a
//! second (E. Keshner, *Head-trunk coordination during linear anterior-posterior translations*, 2003). By itself an inert head
//! whips beyond the chest. Here neck and head are drawn to where they take over a share of the chest's turn, firmly, except
//! while and for some time after a force acts on the head itself: then the neck yields by its own dynamics.

use crate::force::PointForce;
use crate::upper_body::{Coordinates24, DOFS};
use glam::DQuat;
use sinew_body::humanoid::{Node, Pose, UPPER_DOFS, log};
use sinew_snapshot::snapshot;

/// Share of the chest's turn in the world that the head takes over.
const SHARE: f64 = 0.45;

/// Time in which neck and head come to be there to 1/e \[s\].
const WITHIN_SECS: f64 = 0.04;

/// Weight with which they are drawn there, relative to that of a joint at its limit.
const FIRMNESS: f64 = 1e-4;

/// Time in which the reflex comes back after a force on the head to 1/e \[s\].
const RETURN_SECS: f64 = 0.5;

/// Force on head and neck at which half of the reflex is gone \[1 of the body's weight\].
const YIELDS_AT: f64 = 0.02;

/// Turns below this are none \[rad\]: an undisturbed head is exactly the input's.
const NOTHING: f64 = 1e-9;

/// How far the reflex is switched off by forces on the head, from 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct HeadReflex {
    yields: f64,
}

snapshot!(HeadReflex { yields });

impl HeadReflex {
    /// Advances by a step under forces on a body of so many newtons.
    pub(crate) fn advance(&mut self, forces: &[PointForce], weight_n: f64, time_step_secs: f64) {
        let on_head = forces.iter().filter(|force| matches!(force.node, Node::Head | Node::Neck));
        let force: f64 = on_head.map(|force| force.tamed().force_n.length()).sum();
        let now = force / (force + YIELDS_AT * weight_n.max(1e-9));
        self.yields = now.max(self.yields * libm::exp(-time_step_secs / RETURN_SECS));
        if self.yields < NOTHING {
            self.yields = 0.0;
        }
    }

    /// How firmly neck and head are drawn in this step, and by how much they turn \[rad\]: `chest` is `world_from_chest` in the
    /// next pose with an unchanged deviation, `wanted` the input's pose, `deviation` that of the joints. `None` while nothing
    /// turns them.
    pub(crate) fn draws(
        &self,
        chest: DQuat,
        wanted: &Pose,
        deviation: &Coordinates24,
        time_step_secs: f64,
    ) -> Option<(Coordinates24, Coordinates24)> {
        let turn = log(chest * wanted.world[Node::Chest.index()].conjugate());
        let is_still = |dof: usize| deviation[dof].abs() < NOTHING;
        let mut all_still = turn.length() < NOTHING;
        let (mut firm, mut steps) = ([0.0; UPPER_DOFS], [0.0; UPPER_DOFS]);
        let along = -libm::expm1(-time_step_secs / WITHIN_SECS);
        for (dof, of) in DOFS.iter().enumerate().filter(|(_, of)| matches!(of.node, Node::Neck | Node::Head)) {
            all_still &= is_still(dof);
            // Against the chest, in the node's own frame.
            let back = wanted.world[of.node.index()].conjugate() * (turn * (SHARE - 1.0));
            let free = 1.0 - self.yields;
            firm[dof] = FIRMNESS * free * free * free;
            steps[dof] = (back[of.axis as usize] - deviation[dof]) * along;
        }
        (!all_still).then_some((firm, steps))
    }
}
