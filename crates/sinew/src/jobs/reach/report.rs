//! The report of a reach.

use serde::Serialize;
use sinew_reach::{ReachMeter, Reacher};

/// One reach in the report of `sinew reach` and `sinew run`. Keys carry their units.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReachReport {
    /// Whether the hand arrived and stays at its target, within 2 cm for a physically tracked body.
    pub reached: bool,
    /// Why not, if it did not.
    pub reason: Option<String>,
    /// Which hands reached.
    pub hands: Vec<&'static str>,
    /// Distance of the hand from its target at the end \[m\]; of the worse of two.
    pub hand_error_m: f64,
    /// From the start until the hand arrives \[s\].
    pub duration_s: f64,
    /// Whether no body can be there in the time that was asked for; it takes the least that one can.
    pub late: bool,
    /// The steps, in order.
    pub steps: Vec<StepReport>,
    /// Twist of the spine θ \[degrees about the upward axis\].
    pub twist_deg: f64,
    /// Swing of the spine φ \[degrees\], below 0 away from the target.
    pub swing_deg: f64,
    /// Squat depth \[m\].
    pub squat_m: f64,
    /// Minimum distance of the centre of mass inside the support polygon while both feet stand \[m\].
    pub com_margin_m: Option<f64>,
    /// Maximum displacement of the toes of a planted foot \[m\].
    pub planted_slip_m: f64,
    /// Maximum speed of the hand \[m/s\].
    pub hand_speed_max_m_s: f64,
    /// Seed of all random choices.
    pub seed: u64,
}

/// One step.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StepReport {
    /// `left` or `right`: which foot goes first.
    pub foot: &'static str,
    /// `half`: the other stays; `full`: it follows.
    pub kind: &'static str,
    /// Length of its stride \[m\].
    pub length_m: f64,
}

/// Names of the two sides.
const SIDES: [&str; 2] = ["left", "right"];

impl ReachReport {
    /// What a meter saw, with what the plan says; `since_secs` is when the goal was given, `now_secs` the last frame, both in the
    /// reacher's time \[s\].
    pub fn of(meter: &ReachMeter, reacher: &Reacher, since_secs: f64, now_secs: f64) -> ReachReport {
        let outcome = reacher.outcome();
        let steps = outcome.steps.iter().filter(|step| step.start_secs >= since_secs - 1e-9);
        ReachReport {
            reached: outcome.is_reached() && meter.is_there(),
            reason: meter.reason(reacher, now_secs).map(str::to_owned),
            hands: (0..2).filter(|side| outcome.hands[*side]).map(|side| SIDES[side]).collect(),
            hand_error_m: meter.hand_error_m(),
            duration_s: outcome.arrives_secs - since_secs,
            late: outcome.is_late,
            steps: steps
                .map(|step| StepReport { foot: SIDES[step.side], kind: step.kind.name(), length_m: step.length_m })
                .collect(),
            twist_deg: outcome.twist_rad.to_degrees(),
            swing_deg: outcome.swing_rad.to_degrees(),
            squat_m: outcome.squat_m,
            com_margin_m: meter.com_margin_m(),
            planted_slip_m: meter.planted_slip_m(),
            hand_speed_max_m_s: meter.hand_speed_max_m_s(),
            seed: reacher.style().seed,
        }
    }

    /// As one line of text.
    pub fn words(&self) -> String {
        let steps: Vec<String> =
            self.steps.iter().map(|step| format!("{} {} {:.2} m", step.kind, step.foot, step.length_m)).collect();
        let hands = self.hands.join(" and ");
        let end = match &self.reason {
            None => format!("{hands} hand there within {:.2} mm in {:.2} s", self.hand_error_m * 1e3, self.duration_s),
            Some(reason) => format!("{hands} hand {:.3} m short: {reason}", self.hand_error_m),
        };
        let late = if self.late { ", the least time that a body can" } else { "" };
        let margin = self.com_margin_m.map_or(String::new(), |margin| {
            format!(
                "; centre of mass {:.0} mm {} its support",
                margin.abs() * 1e3,
                if margin < 0.0 { "outside" } else { "inside" }
            )
        });
        format!(
            "{end}{late}; twist {:.0}°, swing {:.0}°, squat {:.2} m; {}{margin}",
            self.twist_deg,
            self.swing_deg,
            self.squat_m,
            match steps.len() {
                0 => "no step".to_owned(),
                1..=3 => steps.join(", "),
                // The report has each.
                many =>
                    format!("{many} steps, {:.2} m in all", self.steps.iter().map(|step| step.length_m).sum::<f64>()),
            }
        )
    }
}
