//! A goal whose targets move along a known way.

use crate::reacher::Goal;
use glam::DVec3;

/// Why the way of a target is refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MovingGoalError {
    /// A target or waypoint is NaN, infinite or too far off.
    #[error("a target of {0} is out of range; give metres, at most {max:.0}", max = MovingGoal::MAX_M)]
    Place(DVec3),
    /// A waypoint's time is out of range.
    #[error("a time of {0} s is out of range; it is 0 to {max:.0}", max = MovingGoal::MAX_SECS)]
    Time(f64),
    /// Waypoints are not in the order of their times.
    #[error(
        "the times of a moving target's waypoints must grow from point to point; {0} s does not come after the one before"
    )]
    Order(f64),
}

/// Where a target is to be at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Waypoint {
    /// How far from where it began \[m\], world.
    pub shift: DVec3,
    /// When \[s\], 0 to [`MovingGoal::MAX_SECS`].
    pub secs: f64,
}

/// Where the targets of a goal are at any time: they move together, from rest to rest between waypoints along the minimum-jerk
/// profile (Flash and Hogan 1985), and stay at the last one.
///
/// ```
/// use glam::DVec3;
/// use sinew_reach::{Goal, MovingGoal, Waypoint};
///
/// let goal = Goal { right: Some(DVec3::Y), ..Goal::default() };
/// let away = Waypoint { shift: DVec3::X * 0.4, secs: 2.0 };
/// let moving = MovingGoal::new(goal, vec![away])?;
/// assert_eq!(moving.at(1.0).right, Some(DVec3::new(0.2, 1.0, 0.0)));
/// assert_eq!(moving.at(9.0).right, Some(DVec3::new(0.4, 1.0, 0.0)));
/// # Ok::<(), sinew_reach::MovingGoalError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MovingGoal {
    pub(crate) start: Goal,
    waypoints: Vec<Waypoint>,
}

impl MovingGoal {
    /// Farthest target from the world's origin \[m\].
    pub const MAX_M: f64 = 1e4;
    /// Latest waypoint \[s\].
    pub const MAX_SECS: f64 = 600.0;

    /// Targets that begin at `start` and move along waypoints; without waypoints they stay.
    ///
    /// # Errors
    /// When a place or time is out of range, or times do not grow.
    pub fn new(start: Goal, waypoints: Vec<Waypoint>) -> Result<MovingGoal, MovingGoalError> {
        let places = [start.left, start.right].into_iter().flatten();
        for place in places.chain(waypoints.iter().map(|point| point.shift)) {
            if !place.is_finite() || place.abs().max_element() > MovingGoal::MAX_M {
                return Err(MovingGoalError::Place(place));
            }
        }
        if let Some(point) = waypoints.iter().find(|point| !(0.0..=MovingGoal::MAX_SECS).contains(&point.secs)) {
            return Err(MovingGoalError::Time(point.secs));
        }
        if let Some(pair) = waypoints.windows(2).find(|pair| pair[1].secs <= pair[0].secs) {
            return Err(MovingGoalError::Order(pair[1].secs));
        }
        Ok(MovingGoal { start, waypoints })
    }

    /// Where the targets are at a time \[s\].
    pub fn at(&self, secs: f64) -> Goal {
        let shift = self.shift(secs);
        let moved = |target: Option<DVec3>| target.map(|target| target + shift);
        Goal { left: moved(self.start.left), right: moved(self.start.right) }
    }

    /// Whether they move at all.
    pub fn moves(&self) -> bool {
        !self.waypoints.is_empty()
    }

    /// When they come to rest \[s\].
    pub fn rests_secs(&self) -> f64 {
        self.waypoints.last().map_or(0.0, |point| point.secs)
    }

    fn shift(&self, secs: f64) -> DVec3 {
        let mut from = Waypoint { shift: DVec3::ZERO, secs: 0.0 };
        for to in &self.waypoints {
            if secs < to.secs {
                let share = (secs - from.secs) / (to.secs - from.secs).max(1e-6);
                let share = share * share * share * (10.0 + share * (6.0 * share - 15.0));
                return from.shift.lerp(to.shift, share.clamp(0.0, 1.0));
            }
            from = *to;
        }
        from.shift
    }
}
