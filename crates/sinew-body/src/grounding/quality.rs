//! How well a motion stands on its floor, as numbers.

use super::stance::{FEET, Feet, Stands};
use crate::gravity::STANDARD_GRAVITY_M_S2;
use crate::humanoid::{Body, Node, Pose, Sole, keep_support_hull, log, support_margin_m};
use glam::{DMat3, DVec3};
use sinew_motion::LowPass;

/// How well a motion stands on its floor. Means are weighed by how surely a foot stands flat.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Quality {
    /// Mean speed over the ground of feet that stand flat \[m/s\].
    pub slide_mean_m_s: f64,
    /// 95th percentile of that speed \[m/s\].
    pub slide_95_m_s: f64,
    /// Root mean square of the height of standing feet over the floor \[m\].
    pub height_rms_m: f64,
    /// Largest height over the floor of a foot that stands \[m\].
    pub float_m: f64,
    /// Largest depth in the floor of the heel or of the joint of the toes, which are on it when they stand \[m\].
    pub penetration_m: f64,
    /// Residual root force: what no contact can give, root mean square over the motion \[1 of the body's weight\]. A foot that stands
    /// or rolls gives any push with friction up to [`Quality::FRICTION`]; in flight nothing gives any.
    pub residual_force: f64,
    /// Residual root moment, likewise \[1 of weight times stature\]: that by which the centre of pressure would leave the soles.
    pub residual_moment: f64,
}

/// A foot stands from this weight on.
const STANDS: f64 = 0.5;

/// A foot whose sole comes as near to the floor as this may push against it \[m\], for a stature of 1.7 m: it rolls.
const TOUCHES_M: f64 = 0.03;

/// Accelerations are of the motion low-passed at this frequency \[Hz\], without delay.
const CUTOFF_HZ: f64 = 10.0;

impl Quality {
    /// Friction of soles on the ground, for the residual force \[1\].
    pub const FRICTION: f64 = 1.0;

    pub(super) fn of(body: &Body, poses: &[Pose], fps: f64, stands: &Stands, standing_m: [f64; 2]) -> Quality {
        let feet = Feet::of(body, poses, fps);
        let middle_m = 0.5 * (standing_m[0] + standing_m[1]);
        let (mut slides, mut height, mut total) = (Vec::new(), 0.0, 0.0);
        let mut quality = Quality::default();
        for (foot, stands) in stands.iter().enumerate() {
            for (frame, stands) in stands.iter().enumerate() {
                let at = feet.middle(foot, frame);
                if frame + 1 < feet.frames() {
                    slides.push(((feet.middle(foot, frame + 1) - at).with_y(0.0).length() * fps, *stands));
                }
                let over = at.y - middle_m;
                height += stands * over * over;
                total += stands;
                if *stands > STANDS {
                    quality.float_m = quality.float_m.max(over);
                }
                for point in 0..2 {
                    quality.penetration_m = quality.penetration_m.max(feet.depth_m(foot, point, frame, standing_m));
                }
            }
        }
        let slid: f64 = slides.iter().map(|(_, stands)| stands).sum();
        if slid > 0.0 {
            quality.slide_mean_m_s = slides.iter().map(|(speed, stands)| speed * stands).sum::<f64>() / slid;
            slides.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut sum = 0.0;
            let high = slides.iter().find(|(_, stands)| {
                sum += stands;
                sum >= 0.95 * slid
            });
            quality.slide_95_m_s = high.map_or(0.0, |(speed, _)| *speed);
        }
        quality.height_rms_m = if total > 0.0 { (height / total).sqrt() } else { 0.0 };
        (quality.residual_force, quality.residual_moment) = residual(body, poses, fps, standing_m);
        quality
    }
}

/// Residual root force and moment, root mean squares \[1 of weight, 1 of weight times stature\].
fn residual(body: &Body, poses: &[Pose], fps: f64, standing_m: [f64; 2]) -> (f64, f64) {
    let poses = &smooth(poses, fps)[..];
    let lift_m = TOUCHES_M * body.stature_m() / 1.7;
    let weight = body.mass_kg() * STANDARD_GRAVITY_M_S2;
    let feet = Feet::of(body, poses, fps);
    let (mut force, mut moment, mut count) = (0.0, 0.0, 0.0);
    let (mut corners, mut scratch) = (Vec::new(), Vec::new());
    for (at, three) in poses.windows(3).enumerate() {
        let frame = at + 1;
        let needed = needed(body, [&three[0], &three[1], &three[2]], fps);
        corners.clear();
        for (foot, node) in FEET.into_iter().enumerate() {
            let near = |point: usize| feet.points[foot][point][frame].y < standing_m[point] + lift_m;
            if near(0) || near(1) {
                corners.extend(Sole::world_corners(body, &three[1], node));
            }
        }
        let given = if corners.is_empty() { DVec3::ZERO } else { in_cone(needed.force) };
        force += (needed.force - given).length_squared() / (weight * weight);
        if given.y > 0.05 * weight {
            // Where a force through the ground would have to act to give the moment about level axes.
            let floor = corners.iter().map(|corner| corner.y).sum::<f64>() / corners.len() as f64;
            let arm = needed.centre.y - floor;
            let pressure = DVec3::new(
                needed.centre.x + (needed.moment.z - given.x * arm) / given.y,
                floor,
                needed.centre.z - (needed.moment.x + given.z * arm) / given.y,
            );
            keep_support_hull(&mut corners, &mut scratch);
            let outside = (-support_margin_m(&corners, pressure)).max(0.0);
            let share = outside * given.y / (weight * body.stature_m());
            moment += share * share;
        }
        count += 1.0;
    }
    if count > 0.0 { ((force / count).sqrt(), (moment / count).sqrt()) } else { (0.0, 0.0) }
}

/// The motion, low-passed without delay.
fn smooth(poses: &[Pose], fps: f64) -> Vec<Pose> {
    let filter = LowPass::new(CUTOFF_HZ.min(0.4 * fps), fps);
    let mut hips: Vec<[f64; 3]> = poses.iter().map(|pose| pose.hips_position.to_array()).collect();
    filter.zero_phase(&mut hips);
    let mut rotations = Node::ALL.map(|node| poses.iter().map(|pose| pose.local(node)).collect::<Vec<_>>());
    rotations.iter_mut().for_each(|rotations| filter.zero_phase_rotations(rotations));
    let pose = |(frame, hips): (usize, [f64; 3])| {
        Pose::from_locals(hips.into(), &Node::ALL.map(|node| rotations[node.index()][frame]))
    };
    hips.into_iter().enumerate().map(pose).collect()
}

/// The nearest force that a foot can give.
fn in_cone(force: DVec3) -> DVec3 {
    let level = force.with_y(0.0);
    let slope = Quality::FRICTION;
    let length = level.length();
    if length <= slope * force.y {
        return force;
    }
    // Onto the side of the cone, or its tip.
    let along = (force.y + slope * length) / (1.0 + slope * slope);
    if along <= 0.0 { DVec3::ZERO } else { DVec3::Y * along + level * (slope * along / length) }
}

/// What the ground would have to give.
struct Needed {
    force: DVec3,
    /// About the centre of mass.
    moment: DVec3,
    centre: DVec3,
}

/// By differences of three poses: m (a + g), and the change of angular momentum.
fn needed(body: &Body, poses: [&Pose; 3], fps: f64) -> Needed {
    let [before, now, after] = poses.map(|pose| body.centre_of_mass(pose));
    let acceleration = (after - 2.0 * now + before) * (fps * fps);
    let momentum = |from: &Pose, to: &Pose| {
        let at = [from.positions(body), to.positions(body)];
        let middle = (body.centre_of_mass(from) + body.centre_of_mass(to)) * 0.5;
        let speed = (body.centre_of_mass(to) - body.centre_of_mass(from)) * fps;
        Node::ALL
            .into_iter()
            .map(|node| {
                let (link, index) = (body.link(node), node.index());
                let centre = |pose: &Pose, at: &[DVec3; Node::COUNT]| at[index] + pose.world[index] * link.centre;
                let (then, next) = (centre(from, &at[0]), centre(to, &at[1]));
                let arm = (then + next) * 0.5 - middle;
                let own = (next - then) * fps - speed;
                let turn = log(to.world[index] * from.world[index].conjugate()) * fps;
                let axes = DMat3::from_quat(from.world[index]);
                let spin = axes * (DMat3::from_diagonal(link.inertia) * (axes.transpose() * turn));
                arm.cross(own) * link.mass_kg + spin
            })
            .sum::<DVec3>()
    };
    Needed {
        force: (acceleration + DVec3::Y * STANDARD_GRAVITY_M_S2) * body.mass_kg(),
        moment: (momentum(poses[1], poses[2]) - momentum(poses[0], poses[1])) * fps,
        centre: now,
    }
}
