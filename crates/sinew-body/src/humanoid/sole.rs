//! The sole of a foot.

use super::{Body, Node, Pose};
use glam::DVec3;

/// The sole of a foot: a rectangle under the ankle, in the foot's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sole {
    /// Height of the ankle above it \[m\].
    pub ankle_m: f64,
    /// Its breadth \[m\].
    pub breadth_m: f64,
    /// Position of its centre line along X \[m\].
    pub middle_m: f64,
    /// Position of the end of the heel along Z; behind the ankle, so negative \[m\].
    pub heel_m: f64,
    /// Position of the end of the toes along Z \[m\].
    pub toes_m: f64,
}

impl Sole {
    /// The sole of a foot of the body.
    ///
    /// ```
    /// use sinew_body::humanoid::{Body, Node, Sole};
    /// let sole = Sole::of(&Body::standard(80.0, 1.7), Node::LeftFoot);
    /// assert!(sole.toes_m - sole.heel_m > 0.2);
    /// ```
    pub fn of(body: &Body, foot: Node) -> Sole {
        let link = body.link(foot);
        let length = link.tip.z.max(0.05);
        Sole {
            ankle_m: (-link.tip.y).max(0.0) + link.shape.to_radius_m,
            breadth_m: 1.2 * (link.shape.from_radius_m + link.shape.to_radius_m),
            middle_m: link.tip.x * 0.5,
            heel_m: -0.28 * length,
            toes_m: length + 0.3 * link.shape.to_radius_m,
        }
    }

    /// Position of the ball of the foot along Z \[m\]: with the heel raised, the foot is supported from there forward.
    /// 0.62 of the sole from the heel.
    pub fn ball_m(&self) -> f64 {
        self.heel_m + 0.62 * (self.toes_m - self.heel_m)
    }

    /// The middle of its front edge, in the foot's frame \[m\]: the pivot while the heel rises.
    pub fn toe(&self) -> DVec3 {
        DVec3::new(self.middle_m, -self.ankle_m, self.toes_m)
    }

    /// Its corners in the foot's frame \[m\], in the order of going around it.
    pub fn corners(&self) -> [DVec3; 4] {
        let (left, right) = (self.middle_m + self.breadth_m / 2.0, self.middle_m - self.breadth_m / 2.0);
        let corner = |x: f64, z: f64| DVec3::new(x, -self.ankle_m, z);
        [corner(left, self.heel_m), corner(left, self.toes_m), corner(right, self.toes_m), corner(right, self.heel_m)]
    }

    /// Its corners in the world, in a pose \[m\].
    pub fn world_corners(body: &Body, pose: &Pose, foot: Node) -> [DVec3; 4] {
        let ankle = pose.positions(body)[foot.index()];
        Sole::of(body, foot).corners().map(|corner| ankle + pose.world[foot.index()] * corner)
    }
}
