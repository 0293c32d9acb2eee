//! How long each controller takes, and the least time that a body can.

use crate::compose::Composed;
use crate::feet::Feet;
use crate::hand_path::{PRINTED_RATIO, PRINTED_SPEED_M_S};
use crate::plan::Decision;
use crate::reacher::Reacher;
use crate::walk::Step;

/// Time by which the weight moves over the toes before the heels rise \[s\].
pub(crate) const LEANS_SECS: f64 = 0.3;

/// Time for which a body with straight legs shifts its weight before a foot lifts off \[s\].
const SHIFTS_SECS: f64 = 0.15;

/// A bend \[rad\] or a sinking of less than this \[1 of the leg\] is not waited for.
const BARELY: f64 = 0.02;

/// A twist of less than this does not count for the least time \[rad\].
const TURNS_RAD: f64 = 0.3;

/// Who turns by more than this \[rad\] reaches out so long before the last foot lands \[s\].
const ROUND_RAD: f64 = 1.2;
const BEFORE_LANDING_SECS: f64 = 0.3;

/// Share of r_st in a walk of several strides \[1\].
const WALKING_OVERLAP: f64 = 0.4;

/// Acceleration of the hips in a walk that takes its natural time, at most \[m/s²\]. Bends may add to it.
const CALM_M_S2: f64 = 5.2;

/// People walk up to a Froude number v² / (g l) of a half, then they run (Alexander 1989).
const FROUDE: f64 = 0.5;
const GRAVITY_M_S2: f64 = 9.81;

/// Shortest swing of a foot in a walk \[s\].
const QUICKEST_STRIDE_SECS: f64 = 0.3;

/// Fastest peak speed of a hand whose time is given, not its speed \[m/s\].
const QUICKEST_HAND_M_S: f64 = 6.0;

/// Trunk and legs bend at most so many times as fast as they do by themselves \[1\].
const QUICKEST_BEND: f64 = 2.0;

/// Times of a plan.
#[derive(Debug)]
pub(crate) struct Timing {
    /// The feet with the plan's strides, and its steps; `None` when it takes none.
    pub walked: Option<(Feet, Vec<Step>)>,
    /// Times at which arm and twist begin, the swing begins, the hand arrives, and the last foot lands \[s\].
    pub arm: f64,
    pub swing: f64,
    pub end: f64,
    pub landed: f64,
    /// Durations of twist and swing \[s\].
    pub twist: f64,
    pub swings: f64,
    /// Least factor on all times that a body manages \[1\].
    pub least_pace: f64,
}

impl Reacher {
    /// When each controller begins and how long it takes, all times longer by a factor.
    pub(crate) fn timing(&self, decision: &Decision, composed: &Composed, now: f64, pace: f64) -> Timing {
        let values = &self.frame.values;
        let (mut arm, mut bends, mut landed) = (now, now, now);
        let mut least_pace: f64 = 0.0;
        let mut walked = None;
        if let Some(walk) = &decision.walk {
            // The weight shifts before a foot lifts off; straight knees give way meanwhile.
            let locked = 1.0 - self.reserve.at(now);
            let free = self.feet.lands_secs().unwrap_or(now).max(now) + SHIFTS_SECS * locked * pace;
            let (mut feet, mut steps) = (self.feet.clone(), Vec::new());
            let before = feet.strides().len();
            crate::walk::walk(&mut feet, &walk.to, walk.first, walk.kind, free, pace, values, &mut steps);
            let fastest_m_s = feet.settle_walk(before, CALM_M_S2 / (pace * pace));
            let strides = &feet.strides()[before..];
            for (step, stride) in steps.iter_mut().zip(strides) {
                step.start_secs = stride.start_secs;
            }
            landed = feet.lands_secs().unwrap_or(free);
            let shortest = strides.iter().map(|stride| stride.for_secs / pace).fold(f64::INFINITY, f64::min);
            let most_m_s = (FROUDE * GRAVITY_M_S2 * values.leg_m).sqrt();
            least_pace = (fastest_m_s * pace / most_m_s).max(QUICKEST_STRIDE_SECS / shortest);
            // Of several steps the last counts.
            let last = strides.len().saturating_sub(2);
            let from = strides.get(last).map_or(now, |stride| stride.start_secs);
            // In a walk the hand comes up while the last steps are still taken.
            let share = if strides.len() > 2 { WALKING_OVERLAP } else { 1.0 };
            let overlap = self.style.overlap_step * (landed - from);
            (arm, bends) = (from + share * overlap, from + overlap);
            // Who turns round has the target before it first.
            let turned = walk.to.yaw_rad - self.feet.support(now).yaw_rad;
            if crate::spine::wrapped(turned).abs() > ROUND_RAD {
                arm = arm.max(landed - BEFORE_LANDING_SECS * pace);
            }
            walked = Some((feet, steps));
        }
        let turn = (decision.aim.twist - self.twist.at(now)).abs();
        let twist = pace * (0.35 + turn / 1.6);
        let bend = (decision.aim.swing - self.swing.at(now)).length();
        let sink = (decision.aim.squat - self.squat.at(now)).abs() / values.leg_m;
        let rise = (decision.aim.tiptoe - self.tiptoe.at(now)).abs();
        let (mut leans, mut swing) = (0.0, bends);
        if rise > 0.0 {
            // Nobody rises on toes that have not landed.
            leans = LEANS_SECS;
            swing = swing.max(landed - 0.5 * LEANS_SECS * pace);
        }
        if turn > 0.01 {
            swing = swing.max(arm + self.style.overlap_twist * twist);
        }
        let swings = pace * (0.45 + (bend / 1.7).max(sink / 0.42).max(leans + rise / 1.3));
        let hands = self.hands_secs(decision, composed);
        let bends = bend.max(sink).max(rise) > BARELY;
        if bends || turn > TURNS_RAD {
            least_pace = least_pace.max(1.0 / QUICKEST_BEND);
        }
        if !self.style.print {
            let way = decision.ways_m.into_iter().fold(0.0, f64::max);
            least_pace = least_pace.max(values.quickest_hand_secs(way, QUICKEST_HAND_M_S) / hands.max(1e-3));
        }
        let mut end = (arm + pace * hands).max(arm + twist).max(swing).max(landed + 0.05 * pace);
        if bends {
            end = end.max(swing + swings);
        }
        if self.style.time_secs.is_none() {
            end = end.max(self.hips[0].end_secs());
        }
        Timing { walked, arm, swing, end, landed, twist, swings, least_pace }
    }

    /// Time of the slower hand \[s\].
    fn hands_secs(&self, decision: &Decision, composed: &Composed) -> f64 {
        let of = |side: usize| {
            if self.style.print {
                let way = (composed.hands[side] - self.arms[side].target).length();
                2.0 * way / (self.style.speed_m_s.unwrap_or(PRINTED_SPEED_M_S) * (1.0 + PRINTED_RATIO))
            } else {
                self.frame.values.hand_secs(decision.ways_m[side], &self.style)
            }
        };
        (0..2).filter(|side| decision.targets[*side].is_some()).map(of).fold(0.0, f64::max)
    }

    /// The plan's times, the factor on them, and whether no body is as fast as asked for: by the style, or in the manner of the seed.
    pub(crate) fn paced(&self, decision: &Decision, composed: &Composed, now: f64) -> (Timing, f64, bool) {
        let natural = self.timing(decision, composed, now, 1.0);
        let natural_secs = (natural.end - now).max(1e-3);
        let (pace, is_late) = match (self.style.time_secs, self.style.speed_m_s) {
            (Some(time), _) => {
                let least = if self.style.print { 0.0 } else { natural.least_pace };
                let wanted = time / natural_secs;
                (wanted.max(least), wanted < least)
            }
            // Whose speed is given has that speed.
            (None, Some(_)) => (1.0, false),
            (None, None) => (self.manner.pace(natural_secs), false),
        };
        if pace == 1.0 { (natural, pace, false) } else { (self.timing(decision, composed, now, pace), pace, is_late) }
    }
}
