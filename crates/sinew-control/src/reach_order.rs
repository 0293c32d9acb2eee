//! A reach as text: the same keys in a scene's source and in a command.

use serde::{Deserialize, Serialize};

/// Which hand reaches.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ReachHand {
    /// The one on the target's side.
    #[default]
    Auto,
    /// The left one.
    Left,
    /// The right one.
    Right,
    /// Both, from two sides of the object.
    Both,
}

/// A reach with arms, spine, head and legs (Huang, Kapadia, Terzopoulos 2011). Of `object`, `target_m`, and the pair
/// `left_m` and `right_m`, one is stated.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ReachOrder {
    /// Which hand.
    pub hand: ReachHand,
    /// The object to reach for: its surface, on the character's side. It is followed as it moves.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub object: Option<String>,
    /// A point in the world \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub target_m: Option<[f64; 3]>,
    /// A point for the left hand \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_m: Option<[f64; 3]>,
    /// A point for the right hand \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub right_m: Option<[f64; 3]>,
    /// Attach the object when the hand arrives.
    pub grasp: bool,
    /// Obstacles of the arms.
    pub avoid: Vec<String>,
    /// Flexibility of the legs, 0.25 to 4: the higher, the sooner the body squats instead of stooping.
    pub flexibility: f64,
    /// Peak speed of the hand \[m/s\]. Default: that of people.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed_m_s: Option<f64>,
    /// Time to the target \[s\], instead of a speed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time_secs: Option<f64>,
}

impl Default for ReachOrder {
    fn default() -> ReachOrder {
        ReachOrder {
            hand: ReachHand::Auto,
            object: None,
            target_m: None,
            left_m: None,
            right_m: None,
            grasp: false,
            avoid: Vec::new(),
            flexibility: 1.0,
            speed_m_s: None,
            time_secs: None,
        }
    }
}

impl ReachOrder {
    /// Checks it by itself: one kind of target, numbers in range.
    ///
    /// # Errors
    /// What is wrong and what to do.
    pub fn check(&self) -> Result<(), String> {
        let pair = self.left_m.is_some() || self.right_m.is_some();
        let kinds = usize::from(self.object.is_some()) + usize::from(self.target_m.is_some()) + usize::from(pair);
        if kinds != 1 {
            return Err(format!(
                "{kinds} of object, target_m and the pair left_m, right_m are stated; keep exactly one"
            ));
        }
        if self.hand == ReachHand::Both && self.object.is_none() {
            return Err("both hands reach for an object, or for left_m and right_m; state one of them".to_owned());
        }
        if self.grasp && self.object.is_none() {
            return Err("only an object can be held; add object, or remove grasp".to_owned());
        }
        let points = [self.target_m, self.left_m, self.right_m];
        if points.iter().flatten().flatten().any(|value| !(-1e4..=1e4).contains(value)) {
            return Err("a point is out of range; give metres, at most 10000".to_owned());
        }
        let within = |name: &str, value: f64, from: f64, to: f64| {
            if (from..=to).contains(&value) {
                Ok(())
            } else {
                Err(format!("{name} of {value} is out of range {from} to {to}"))
            }
        };
        within("flexibility", self.flexibility, 0.25, 4.0)?;
        within("speed_m_s", self.speed_m_s.unwrap_or(1.0), 0.05, 10.0)?;
        within("time_secs", self.time_secs.unwrap_or(1.0), 0.2, 600.0)?;
        within("the number of objects in avoid", self.avoid.len() as f64, 0.0, 64.0)
    }
}
