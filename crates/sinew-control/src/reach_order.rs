//! A reach as text: the same keys in a scene's source and in a command.

use crate::{OrderError, OrderErrorKind, range};
use serde::{Deserialize, Serialize};
use sinew_snapshot::{Snapshot, snapshot};

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
#[schemars(rename = "ReachOrder")]
pub struct ReachOrder<N = String> {
    /// Which hand.
    pub hand: ReachHand,
    /// The object to reach for: its surface, on the character's side. It is followed as it moves.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub object: Option<N>,
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
    pub avoid: Vec<N>,
    /// Flexibility of the legs, 0.25 to 4: the higher, the sooner the body squats instead of stooping.
    pub flexibility: f64,
    /// Peak speed of the hand \[m/s\]. Default: that of people.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed_m_s: Option<f64>,
    /// Time to the target \[s\], instead of a speed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time_secs: Option<f64>,
}

snapshot!(enum ReachHand { 0: Auto, 1: Left, 2: Right, 3: Both });
snapshot!([N: Snapshot + Default] ReachOrder<N> {
    hand,
    object,
    target_m,
    left_m,
    right_m,
    grasp,
    avoid,
    flexibility,
    speed_m_s,
    time_secs,
});

impl<N> Default for ReachOrder<N> {
    fn default() -> ReachOrder<N> {
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

impl<N> ReachOrder<N> {
    /// The same with other names for objects: `N` is text in a scene, an id on a stage; the first that has none is the error.
    ///
    /// ```
    /// use sinew_control::ReachOrder;
    /// let order = ReachOrder { object: Some("cup"), ..ReachOrder::default() };
    /// assert_eq!(order.try_map(|name| Ok::<_, ()>(name.len()))?.object, Some(3));
    /// # Ok::<(), ()>(())
    /// ```
    ///
    /// # Errors
    /// As `name` says.
    pub fn try_map<M, E>(&self, mut name: impl FnMut(&N) -> Result<M, E>) -> Result<ReachOrder<M>, E> {
        Ok(ReachOrder {
            hand: self.hand,
            object: self.object.as_ref().map(&mut name).transpose()?,
            target_m: self.target_m,
            left_m: self.left_m,
            right_m: self.right_m,
            grasp: self.grasp,
            avoid: self.avoid.iter().map(name).collect::<Result<_, E>>()?,
            flexibility: self.flexibility,
            speed_m_s: self.speed_m_s,
            time_secs: self.time_secs,
        })
    }

    /// Checks it by itself: one kind of target, numbers in range.
    ///
    /// # Errors
    /// [`OrderErrorKind::Contradiction`], [`OrderErrorKind::OutOfRange`] or [`OrderErrorKind::TooLarge`].
    pub fn check(&self) -> Result<(), OrderError> {
        let contradiction = |problem: String| Err(OrderError::new(OrderErrorKind::Contradiction, problem));
        let pair = self.left_m.is_some() || self.right_m.is_some();
        let kinds = usize::from(self.object.is_some()) + usize::from(self.target_m.is_some()) + usize::from(pair);
        if kinds != 1 {
            return contradiction(format!(
                "{kinds} of object, target_m and the pair left_m, right_m are stated; keep exactly one"
            ));
        }
        if self.hand == ReachHand::Both && self.object.is_none() {
            return contradiction(
                "both hands reach for an object, or for left_m and right_m; state one of them".to_owned(),
            );
        }
        if self.grasp && self.object.is_none() {
            return contradiction("only an object can be held; add object, or remove grasp".to_owned());
        }
        let points = [self.target_m, self.left_m, self.right_m];
        if !points.iter().flatten().flatten().all(|value| range::REACH_M.contains(*value)) {
            let problem = "a point is out of range; give metres, at most 10000";
            return Err(OrderError::new(OrderErrorKind::OutOfRange, problem));
        }
        range::REACH_FLEXIBILITY.check("flexibility", self.flexibility)?;
        range::REACH_SPEED_M_S.check_some("speed_m_s", self.speed_m_s)?;
        range::REACH_SECS.check_some("time_secs", self.time_secs)?;
        if self.avoid.len() > MAX_AVOIDED {
            let problem = format!("avoid lists {} objects; keep at most {MAX_AVOIDED}", self.avoid.len());
            return Err(OrderError::new(OrderErrorKind::TooLarge, problem));
        }
        Ok(())
    }
}

/// Objects that the arms keep clear of.
const MAX_AVOIDED: usize = 64;
