//! Joint limits.
//!
//! A joint's rotation is measured from a *centre* of its range and split into a swing of the bone and a twist about
//! it. The swing stays inside an ellipse with a half-axis of its own in each of the four directions (joints are not
//! symmetric: a knee bends one way), the twist inside an interval. Ranges are those of healthy adults, rounded up
//! from clinical tables of range of motion (American Academy of Orthopaedic Surgeons); captured motion exceeds any
//! such table, so a limit is [widened](Limit::widen) to whatever the input itself does.

use super::Node;
use super::rotation::{exp, swing_twist};
use glam::{DQuat, DVec3};
use sinew_snapshot::snapshot;

/// Largest swing from the centre, by direction \[rad\], all positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swing {
    /// About −X: the bone's lower end moves forward.
    pub x_negative: f64,
    /// About +X: the bone's lower end moves backward.
    pub x_positive: f64,
    /// About −Z: the bone's lower end moves to the character's right.
    pub z_negative: f64,
    /// About +Z: the bone's lower end moves to the character's left.
    pub z_positive: f64,
}

/// The range of one joint, in the node's anatomical frame relative to its parent's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// `parent_from_node` in the middle of the range.
    pub centre: DQuat,
    /// The swing ellipse.
    pub swing: Swing,
    /// Smallest and largest twist about the bone \[rad\], from the centre.
    pub twist: (f64, f64),
}

snapshot!(Swing { x_negative, x_positive, z_negative, z_positive });
snapshot!(Limit { centre, swing, twist });

/// Rounding slack on the boundary \[relative\]: a joint widened to the input's pose must count as inside there.
const BOUNDARY_SLACK: f64 = 1e-9;

impl Limit {
    /// No limit at all.
    pub const NONE: Limit = Limit {
        centre: DQuat::IDENTITY,
        swing: Swing { x_negative: 10.0, x_positive: 10.0, z_negative: 10.0, z_positive: 10.0 },
        twist: (-10.0, 10.0),
    };

    /// The adult range of a node's joint, before any input has widened it.
    pub fn of(node: Node) -> Limit {
        // Degrees: centre about X, Y, Z (applied Z first), swing -X +X -Z +Z, twist from, to; for the left side.
        let (centre, swing, twist): ([f64; 3], [f64; 4], [f64; 2]) = match node {
            Node::Hips => ([0.0; 3], [180.0; 4], [-180.0, 180.0]),
            Node::Chest => ([15.0, 0.0, 0.0], [50.0, 60.0, 40.0, 40.0], [-50.0, 50.0]),
            Node::Neck => ([0.0; 3], [55.0, 50.0, 45.0, 45.0], [-50.0, 50.0]),
            Node::Head => ([0.0; 3], [40.0, 35.0, 30.0, 30.0], [-70.0, 70.0]),
            Node::LeftShoulder | Node::RightShoulder => ([0.0; 3], [20.0, 20.0, 12.0, 36.0], [-30.0, 22.0]),
            Node::LeftUpperArm | Node::RightUpperArm => {
                ([0.0, -35.0, 75.0], [100.0, 100.0, 100.0, 100.0], [-100.0, 100.0])
            }
            Node::LeftLowerArm | Node::RightLowerArm => ([-72.0, 0.0, 0.0], [80.0, 77.0, 25.0, 25.0], [-100.0, 100.0]),
            Node::LeftHand | Node::RightHand => ([0.0; 3], [40.0, 40.0, 85.0, 85.0], [-40.0, 40.0]),
            Node::LeftUpperLeg | Node::RightUpperLeg => ([-50.0, 0.0, 0.0], [80.0, 80.0, 45.0, 55.0], [-55.0, 55.0]),
            Node::LeftLowerLeg | Node::RightLowerLeg => ([73.0, 0.0, 0.0], [78.0, 80.0, 20.0, 20.0], [-40.0, 40.0]),
            Node::LeftFoot | Node::RightFoot => ([10.0, 0.0, 0.0], [55.0, 60.0, 45.0, 45.0], [-45.0, 45.0]),
        };
        let right = node.is_right();
        let mirror = if right { -1.0 } else { 1.0 };
        let about = |axis: DVec3, degrees: f64| exp(axis * degrees.to_radians());
        let [z_negative, z_positive] = if right { [swing[3], swing[2]] } else { [swing[2], swing[3]] };
        let twist = if right { (-twist[1], -twist[0]) } else { (twist[0], twist[1]) };
        Limit {
            centre: about(DVec3::X, centre[0])
                * about(DVec3::Y, mirror * centre[1])
                * about(DVec3::Z, mirror * centre[2]),
            swing: Swing {
                x_negative: swing[0].to_radians(),
                x_positive: swing[1].to_radians(),
                z_negative: z_negative.to_radians(),
                z_positive: z_positive.to_radians(),
            },
            twist: (f64::to_radians(twist.0), f64::to_radians(twist.1)),
        }
    }

    /// Excess of a `parent_from_node` rotation over the range \[rad\]; 0 inside.
    pub fn excess(&self, local: DQuat) -> f64 {
        let (x, z, twist) = swing_twist(self.centre.conjugate() * local);
        let ratio = self.swing_ratio(x, z);
        let swing_excess = if ratio > 1.0 { (x * x + z * z).sqrt() * (1.0 - 1.0 / ratio) } else { 0.0 };
        let twist_excess = (twist - self.twist.1).max(self.twist.0 - twist).max(0.0);
        swing_excess.max(twist_excess)
    }

    /// Whether a `parent_from_node` rotation lies in the range.
    pub fn contains(&self, local: DQuat) -> bool {
        let (x, z, twist) = swing_twist(self.centre.conjugate() * local);
        self.swing_ratio(x, z) <= 1.0 + BOUNDARY_SLACK
            && twist <= self.twist.1 + BOUNDARY_SLACK
            && twist >= self.twist.0 - BOUNDARY_SLACK
    }

    /// Clamps a `parent_from_node` rotation to the range: its swing to the ellipse, in its own direction, and its twist
    /// to the interval.
    pub fn clamp(&self, local: DQuat) -> DQuat {
        let (x, z, twist) = swing_twist(self.centre.conjugate() * local);
        let ratio = self.swing_ratio(x, z);
        let kept = twist.clamp(self.twist.0, self.twist.1.max(self.twist.0));
        if ratio <= 1.0 && kept == twist {
            return local;
        }
        let share = 1.0 / ratio.max(1.0);
        (self.centre * exp(DVec3::new(x * share, 0.0, z * share)) * exp(DVec3::Y * kept)).normalize()
    }

    /// Widens the range, no further than needed, so that it contains a `parent_from_node` rotation.
    pub fn widen(&mut self, local: DQuat) {
        let (x, z, twist) = swing_twist(self.centre.conjugate() * local);
        let ratio = self.swing_ratio(x, z);
        if ratio > 1.0 {
            *self.half_axis_x(x) *= ratio;
            *self.half_axis_z(z) *= ratio;
        }
        self.twist.0 = self.twist.0.min(twist);
        self.twist.1 = self.twist.1.max(twist);
    }

    /// Widens the range by an angle \[rad\] on every side.
    pub fn add_room(&mut self, room: f64) {
        let Swing { x_negative, x_positive, z_negative, z_positive } = &mut self.swing;
        for half_axis in [x_negative, x_positive, z_negative, z_positive] {
            *half_axis += room;
        }
        self.twist = (self.twist.0 - room, self.twist.1 + room);
    }

    /// Length of the swing relative to the ellipse's radius in its direction.
    pub fn swing_ratio(&self, x: f64, z: f64) -> f64 {
        let mut limit = *self;
        let (a, b) = (x / *limit.half_axis_x(x), z / *limit.half_axis_z(z));
        (a * a + b * b).sqrt()
    }

    fn half_axis_x(&mut self, x: f64) -> &mut f64 {
        if x < 0.0 { &mut self.swing.x_negative } else { &mut self.swing.x_positive }
    }

    fn half_axis_z(&mut self, z: f64) -> &mut f64 {
        if z < 0.0 { &mut self.swing.z_negative } else { &mut self.swing.z_positive }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turn(axis: DVec3, degrees: f64) -> DQuat {
        exp(axis * degrees.to_radians())
    }

    #[test]
    fn a_standing_body_is_inside_every_limit() {
        for node in Node::ALL {
            assert!(Limit::of(node).contains(DQuat::IDENTITY), "{node:?}");
        }
    }

    #[test]
    fn elbows_and_knees_bend_one_way() {
        let elbow = Limit::of(Node::LeftLowerArm);
        assert!(elbow.contains(turn(DVec3::X, -140.0)));
        assert!(!elbow.contains(turn(DVec3::X, 15.0)));
        let knee = Limit::of(Node::RightLowerLeg);
        assert!(knee.contains(turn(DVec3::X, 140.0)));
        assert!(!knee.contains(turn(DVec3::X, -15.0)));
    }

    #[test]
    fn left_and_right_are_mirror_images() {
        let mirror = |rotation: DQuat| DQuat::from_xyzw(rotation.x, -rotation.y, -rotation.z, rotation.w);
        for (left, right) in [(Node::LeftUpperArm, Node::RightUpperArm), (Node::LeftShoulder, Node::RightShoulder)] {
            for axis in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::new(0.3, -0.8, 0.5).normalize()] {
                for degrees in [-150.0, -60.0, -20.0, 20.0, 60.0, 150.0] {
                    let rotation = turn(axis, degrees);
                    let (a, b) = (Limit::of(left).excess(rotation), Limit::of(right).excess(mirror(rotation)));
                    assert!((a - b).abs() < 1e-12, "{left:?} {axis} {degrees}: {a} against {b}");
                }
            }
        }
    }

    #[test]
    fn a_widened_limit_contains_what_widened_it_and_no_less_than_before() {
        let mut limit = Limit::of(Node::Neck);
        let far = turn(DVec3::new(1.0, 0.4, -0.3).normalize(), 95.0);
        assert!(!limit.contains(far));
        limit.widen(far);
        assert!(limit.contains(far));
        assert!(limit.contains(turn(DVec3::Z, 44.0)));
    }
}
