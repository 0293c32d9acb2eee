//! Standing balance by ankles, hips and arms.

mod legs;
mod polygon;
mod settings;
mod sole;
mod stance;
mod trunk;

pub use settings::BalanceSettings;

use super::{Reflex, Sense};
use crate::Target;
use glam::DVec2;
use legs::{Ground, smooth};
use sinew_body::humanoid::{Body, LEGS, Node};
use sole::Sole;
use stance::Stance;
use trunk::Trunk;

/// Keeps a standing character up.
#[derive(Clone, Debug)]
pub struct Balance {
    settings: BalanceSettings,
    soles: [Sole; 2],
    trunk: Trunk,
    load_n: [f64; 2],
}

impl Balance {
    /// For a body.
    pub fn new(body: &Body, settings: BalanceSettings) -> Balance {
        let margin_m = settings.edge_margin * body.stature_m();
        let sole = |side: usize| Sole::of(body, LEGS[side].2, margin_m, settings.rest_share);
        Balance { settings, soles: [sole(0), sole(1)], trunk: Trunk::of(body), load_n: [0.0; 2] }
    }
}

impl Reflex for Balance {
    fn name(&self) -> &'static str {
        "balance"
    }

    fn step(&mut self, sense: &Sense, target: &mut Target) {
        if sense.gravity_m_s2 < 0.1 || sense.frame.characters.len() <= sense.own {
            return;
        }
        stance::follow_loads(sense, &mut self.load_n);
        let stance = Stance::of(sense, &self.soles, &self.load_n);
        let strength = self.strength(sense, &stance);
        if strength <= 0.0 {
            return;
        }
        let wanted = stance.capture + (stance.capture - stance.rest) * self.settings.firmness;
        let pressure = stance.polygon.nearest(wanted);
        let moment = self.trunk.moment(sense, &stance, &self.settings, wanted - pressure, target);
        let ground = Ground::under(sense, &stance, pressure, moment);
        legs::drive(sense, &stance, &ground, &self.load_n, strength, target);
        for node in [Node::Chest, Node::Neck, Node::Head] {
            let joint = target.joint_mut(node);
            joint.gain = joint.gain.max(strength);
        }
    }

    fn reset(&mut self) {
        self.load_n = [0.0; 2];
    }
}

impl Balance {
    /// How much of the reflex acts: none in the air, and none when the fall is beyond it.
    fn strength(&self, sense: &Sense, stance: &Stance) -> f64 {
        let weight = sense.body.mass_kg() * sense.gravity_m_s2;
        let borne = (self.load_n[0] + self.load_n[1]) / weight;
        let over: DVec2 = stance.polygon.nearest(stance.centre);
        let out = over.distance(stance.centre) / stance.height_m;
        smooth(borne / 0.3) * (1.0 - smooth((out - 0.2) / 0.15))
    }
}
