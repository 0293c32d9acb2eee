//! An arm over time.

use crate::compose::{ARMS, ArmNow};
use crate::glide::Glide;
use crate::hand_path::HandPath;
use glam::DVec3;
use sinew_body::humanoid::{Pose, exp, log};

/// An arm over time.
#[derive(Clone, Debug)]
pub(crate) struct Arm {
    pub share: Glide<f64>,
    /// Where the target is now, and what is left of where it was.
    pub target: DVec3,
    pub offset: Glide<DVec3>,
    pub bow: Glide<DVec3>,
    pub swivel: Glide<f64>,
    pub girdle: Glide<DVec3>,
    /// Rotation vectors of shoulder, upper arm, lower arm and hand, carried.
    pub carried: [Glide<DVec3>; 4],
    /// The hand's way under `print`, with its start \[s\].
    pub printed: Option<(HandPath, f64)>,
}

impl Arm {
    /// An arm that is carried as in a pose.
    pub fn carried(side: usize, pose: &Pose) -> Arm {
        let rest = Glide::rest(DVec3::ZERO);
        Arm {
            share: Glide::rest(0.0),
            target: DVec3::ZERO,
            offset: rest,
            bow: rest,
            swivel: Glide::rest(0.0),
            girdle: rest,
            carried: ARMS[side].map(|node| Glide::rest(log(pose.local(node)))),
            printed: None,
        }
    }

    /// Its controls at a time \[s\].
    pub fn at(&self, secs: f64) -> ArmNow {
        let share = match &self.printed {
            Some((path, start)) => path.share_at(secs - start).clamp(0.0, 1.0),
            None => self.share.at(secs),
        };
        ArmNow {
            share,
            target: self.target + self.offset.at(secs),
            bow: self.bow.at(secs),
            swivel: self.swivel.at(secs),
            pronation: 0.0,
            girdle: self.girdle.at(secs),
            carried: self.carried.map(|turn| exp(turn.at(secs))),
        }
    }
}
