//! Standing balance by ankles, hips and arms, as long as no step is needed.
//!
//! The body is modelled as an inverted pendulum. Its *capture point* ξ = c + v/ω, with ω = √(g/h), is where the centre
//! of mass would come to rest over; it runs away from the centre of pressure p by dξ/dt = ω (ξ − p). So:
//!
//! 1. `stance.rs`: which feet stand, where the weight should rest between them, and ξ over the ground they stand on.
//! 2. The wanted p lies beyond ξ, seen from the resting point, and is brought to the nearest point of the polygon of both soles
//!    (`polygon.rs`, `sole.rs`).
//! 3. The rest is produced by angular momentum (hip strategy): the hips pitch, the chest bends sideways
//!    (`trunk.rs`), arms swing (`arms.rs`), all in the direction of the fall, and return. A moment M of the ground
//!    about the centre of mass shifts the ground's force by M/h as a centre of pressure outside the soles would.
//! 4. p and M give the ground's force; `split.rs` distributes it over the feet, `pair.rs` adds their opposed forces.
//! 5. `legs.rs`: each joint of a leg gets the torque that transmits that force, with the weight and inertia of the
//!    parts below it. Ankles and hips yield to these torques, knees keep their springs.
//!
//! The pose decides the rest: knee flexion, foot placement, lean of the hips on level feet, arms.
//!
//! A body of 80 kg and 1.7 m that stands straight, pushed for 0.1 s on the hips at the height of its centre of mass,
//! withstands the impulses below (example `balance`). The bound is m √(g/h) times the distance from the centre of mass
//! to the edge of the ground under the soles: the limit of a stiff body without a step.
//!
//! | towards | distance (m) | bound (N s) | withstands (N s) | share |
//! |---|---|---|---|---|
//! | front | 0.131 | 33.3 | 39.0 | 117 % |
//! | front left, front right | 0.186 | 47.1 | 49.3, 48.9 | 105 %, 104 % |
//! | left, right | 0.134 | 34.0 | 35.2, 35.0 | 104 %, 103 % |
//! | back left, back right | 0.135 | 34.1 | 37.4, 38.6 | 110 %, 113 % |
//! | back | 0.095 | 24.1 | 27.3 | 113 % |
//!
//! On the chest, 0.3 m above the centre of mass, the push first rotates the trunk in the wrong direction: 80 to 85 % in
//! all directions.

mod arms;
mod flywheel;
mod legs;
mod pair;
mod polygon;
mod settings;
mod sole;
mod split;
mod stance;
mod trunk;

pub use settings::BalanceSettings;

use super::{Reflex, Sense};
use crate::Wanted;
use arms::Arms;
use glam::DVec2;
use legs::{Ground, smooth};
use pair::Pair;
use sinew_body::humanoid::{Body, LEGS};
use sinew_snapshot::snapshot;
use sole::{Footing, Sole};
use stance::Stance;
use trunk::Trunk;

/// The balance reflex.
#[derive(Clone, Debug)]
pub struct Balance {
    settings: BalanceSettings,
    soles: [Sole; 2],
    trunk: Trunk,
    arms: Arms,
    pair: Pair,
    /// Upward forces on the feet, smoothed \[N\].
    load_n: [f64; 2],
    /// Contact estimate of each foot, 0 to 1.
    bearing: Option<[f64; 2]>,
    /// Last placement of each foot.
    prints: Option<[Footing; 2]>,
    /// Velocity of the ground under the feet, smoothed \[m/s\].
    ground_velocity: DVec2,
}

snapshot!(Balance { trunk, arms, load_n, bearing, prints, ground_velocity } fixed { settings, soles, pair });

/// Time over which the ground's velocity is smoothed \[s\]: feet that tip or slip for a moment do not count as moving
/// ground.
const GROUND_SECS: f64 = 0.1;

impl Balance {
    /// For a body.
    pub fn new(body: &Body, settings: BalanceSettings) -> Balance {
        let margin_m = settings.edge_margin * body.stature_m();
        let sole = |side: usize| Sole::of(body, LEGS[side].2, margin_m, settings.rest_share);
        Balance {
            settings,
            soles: [sole(0), sole(1)],
            trunk: Trunk::of(body),
            arms: Arms::default(),
            pair: Pair::of(body),
            load_n: [0.0; 2],
            bearing: None,
            prints: None,
            ground_velocity: DVec2::ZERO,
        }
    }
}

impl Reflex for Balance {
    fn cloned(&self) -> Box<dyn Reflex> {
        Box::new(self.clone())
    }

    fn name(&self) -> &'static str {
        "balance"
    }

    fn step(&mut self, sense: &Sense, target: &mut Wanted) {
        if sense.gravity_m_s2 < 0.1 || sense.frame.character(sense.own).is_none() {
            return;
        }
        stance::follow_loads(sense, &mut self.load_n);
        let bearing = stance::follow_bearing(sense, &self.soles, &self.load_n, target, &mut self.bearing);
        let lifted_m = self.follow_prints(sense, &bearing);
        let Some(prints) = &self.prints else { return };
        let stance = Stance::of(sense, prints, &bearing, self.ground_velocity);
        let strength = self.strength(sense, &stance);
        if strength <= 0.0 {
            self.trunk.reset();
            self.arms = Arms::default();
            return;
        }
        let wanted = stance.capture + (stance.capture - stance.rest) * self.settings.firmness;
        let pressure = stance.polygon.nearest(wanted);
        let beyond = wanted - pressure;
        let upright = trunk::wanted_up(&stance, target);
        let moment = self.trunk.moment(sense, &stance, &self.settings, beyond, lifted_m, upright);
        let pair = self.pair.force(sense, &stance, &self.load_n, target);
        let ground = Ground::under(sense, &stance, pressure, moment, pair);
        legs::drive(sense, &stance, &ground, &self.load_n, strength, target);
        let off = self.trunk.drive(sense, upright, strength, target);
        arms::level_head(sense, off, strength, target);
        self.arms.step(sense, beyond, self.settings.arm_swing);
        self.arms.drive(sense, strength, target);
    }

    fn reset(&mut self) {
        self.load_n = [0.0; 2];
        self.bearing = None;
        self.prints = None;
        self.ground_velocity = DVec2::ZERO;
        self.trunk.reset();
        self.arms = Arms::default();
    }
}

impl Balance {
    /// Strength of the reflex: 0 in the air, and 0 when the fall cannot be stopped.
    fn strength(&self, sense: &Sense, stance: &Stance) -> f64 {
        let weight = sense.body.mass_kg() * sense.gravity_m_s2;
        let borne = (self.load_n[0] + self.load_n[1]) / weight;
        let over = stance.polygon.nearest(stance.centre);
        let out = over.distance(stance.centre) / stance.height_m;
        smooth(borne / 0.3) * (1.0 - smooth((out - 0.2) / 0.15))
    }

    /// Stores the placements of feet; a foot that tips or is lifted unintentionally keeps its placement and returns
    /// there. Returns the height of such a foot above its placement \[m\].
    fn follow_prints(&mut self, sense: &Sense, bearing: &[f64; 2]) -> f64 {
        let me = sense.character();
        let now = [0, 1].map(|side| self.soles[side].under(me.part(LEGS[side].2)));
        let least = 0.25 * sense.body.mass_kg() * sense.gravity_m_s2;
        let prints = self.prints.get_or_insert(now);
        let (mut lifted_m, mut velocity, mut standing) = (0.0, DVec2::ZERO, 0.0);
        for side in 0..2 {
            if self.load_n[side] > least {
                velocity += polygon::flat(me.part(LEGS[side].2).velocity);
                standing += 1.0;
            }
            if self.load_n[side] > least || bearing[side] < 0.5 {
                prints[side] = now[side];
            } else {
                lifted_m = f64::max(lifted_m, now[side].height_m - prints[side].height_m);
            }
        }
        if standing > 0.0 {
            let share = sense.step_secs / (GROUND_SECS + sense.step_secs);
            self.ground_velocity += (velocity / standing - self.ground_velocity) * share;
        }
        lifted_m
    }
}
