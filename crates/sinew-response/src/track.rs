//! A response over a whole motion.

use crate::basis::Basis;
use crate::force::PointForce;
use crate::motion::Motion;
use crate::push::{GroundJerk, Push, Span, in_world};
use crate::response::{Report, Response};
use crate::settings::Settings;
use glam::DVec3;
use sinew_body::humanoid::{Body, Deviation, Node, Pose, log};

/// The disturbances of a character.
#[derive(Clone, Copy, Debug, Default)]
pub struct Disturbances<'a> {
    /// Forces on its parts.
    pub pushes: &'a [Push],
    /// Accelerations of the ground on which it stands.
    pub ground: &'a [GroundJerk],
}

/// The response over a motion: a pose, a deviation and a report for each of the motion's poses.
#[derive(Clone, Debug)]
pub struct Track {
    poses: Vec<Pose>,
    deviations: Vec<Deviation>,
    reports: Vec<Report>,
    forces: Vec<Option<DVec3>>,
    start_secs: f64,
    time_step_secs: f64,
}

impl Track {
    /// Runs the response through a motion.
    pub fn run(body: &Body, basis: &Basis, settings: &Settings, motion: &Motion, happens: Disturbances) -> Track {
        let dt = settings.time_step_secs;
        let start = motion.start_secs();
        let input = motion.poses();
        let mut track = Track {
            poses: input.first().copied().into_iter().collect(),
            deviations: input.first().map(|_| Deviation::NONE).into_iter().collect(),
            reports: input.first().map(|_| Report::default()).into_iter().collect(),
            forces: vec![None; happens.pushes.len()],
            start_secs: start,
            time_step_secs: dt,
        };
        let [first, second, ..] = input else { return track };
        let mut response = Response::new(body.clone(), basis.clone(), *settings, first);
        // The frame before the first is taken to continue the motion backward.
        response.restart(&backward(first, second), first);
        let pushes: Vec<Span> =
            happens.pushes.iter().map(|push| Span::of(push.at_secs, push.for_secs, start, dt)).collect();
        let jerks: Vec<Span> =
            happens.ground.iter().map(|jerk| Span::of(jerk.at_secs, jerk.for_secs, start, dt)).collect();
        let mut accelerations = vec![DVec3::ZERO; jerks.len()];
        let mut forces: Vec<Option<PointForce>> = vec![None; pushes.len()];
        let mut acting: Vec<PointForce> = Vec::with_capacity(pushes.len());
        for (now, wanted) in input.iter().enumerate().skip(1).map(|(next, wanted)| (next - 1, wanted)) {
            acting.clear();
            for (index, span) in pushes.iter().enumerate().filter(|(_, span)| span.holds(now)) {
                let shown = &track.poses[now];
                let force = forces[index].get_or_insert_with(|| happens.pushes[index].on(shown, span.scale));
                track.forces[index] = Some(force.force_n / span.scale);
                acting.push(*force);
            }
            let mut ground = DVec3::ZERO;
            for (index, span) in jerks.iter().enumerate().filter(|(_, span)| span.holds(now)) {
                let jerk = &happens.ground[index];
                if now == span.first {
                    accelerations[index] = in_world(jerk.acceleration, jerk.frame, &track.poses[now]) * span.scale;
                }
                ground += accelerations[index];
            }
            track.poses.push(response.step_on_moving_ground(wanted, &acting, ground));
            track.deviations.push(response.deviation());
            track.reports.push(response.report());
        }
        track
    }

    /// The returned poses, one per pose of the motion.
    pub fn poses(&self) -> &[Pose] {
        &self.poses
    }

    /// Deviation of each from the motion; shifts in metres of the body.
    pub fn deviations(&self) -> &[Deviation] {
        &self.deviations
    }

    /// Report of each step; the first pose has none.
    pub fn reports(&self) -> &[Report] {
        &self.reports
    }

    /// Each push's force in the world \[N\]; `None` for one that never acted (it began after the end).
    pub fn forces(&self) -> &[Option<DVec3>] {
        &self.forces
    }

    /// Time of a pose, from the clip's first frame \[s\].
    pub fn secs(&self, index: usize) -> f64 {
        self.start_secs + index as f64 * self.time_step_secs
    }

    /// The deviation at a time from the clip's first frame \[s\], between poses by a cubic through its neighbours
    /// (Catmull-Rom), before the first and after the last that of the nearest pose.
    pub fn deviation_at(&self, secs: f64) -> Deviation {
        let Some(last) = self.deviations.len().checked_sub(1) else { return Deviation::NONE };
        let at = ((secs - self.start_secs) / self.time_step_secs).clamp(0.0, last as f64);
        let index = (at.floor() as usize).min(last);
        let fraction = at - index as f64;
        // Frame times are sums of rounded numbers: what lies on a pose is that pose.
        if fraction < 1e-6 || index == last {
            return self.deviations[index];
        }
        if fraction > 1.0 - 1e-6 {
            return self.deviations[index + 1];
        }
        // A cubic would begin to bend one pose before a push: without a deviation the clip stays unchanged.
        if self.deviations[index..=index + 1].iter().all(|deviation| *deviation == Deviation::NONE) {
            return Deviation::NONE;
        }
        // Beyond the ends it goes on evenly.
        let (from, to) = (&self.deviations[index], &self.deviations[index + 1]);
        let before = index.checked_sub(1).map_or_else(|| from.beyond(to), |before| self.deviations[before]);
        let after = self.deviations.get(index + 2).copied().unwrap_or_else(|| to.beyond(from));
        Deviation::cubic([&before, from, to, &after], fraction)
    }

    /// Per node the angle \[rad\] of its joint from another run's, in one pose.
    pub fn deflection(&self, other: &Track, index: usize) -> [f64; Node::COUNT] {
        let (ours, theirs) = (&self.poses[index], &other.poses[index]);
        Node::ALL.map(|node| {
            let (a, b) = if node == Node::Hips {
                (ours.world[0], theirs.world[0])
            } else {
                (ours.local(node), theirs.local(node))
            };
            log(b.conjugate() * a).length()
        })
    }

    /// The largest turn of any joint from the motion \[rad\].
    pub fn largest_departure_rad(&self) -> f64 {
        let turns = self.deviations.iter().flat_map(|deviation| deviation.turns.iter().chain([&deviation.hips_turn]));
        turns.map(|turn| turn.length()).fold(0.0, f64::max)
    }

    /// Whether every pose is finite.
    pub fn is_finite(&self) -> bool {
        self.poses.iter().all(Pose::is_finite)
    }
}

/// The pose before `first`, extrapolated from `first` and `second`.
fn backward(first: &Pose, second: &Pose) -> Pose {
    let locals = Node::ALL.map(|node| {
        let (a, b) = (first.local(node), second.local(node));
        (a * (b.conjugate() * a)).normalize()
    });
    Pose::from_locals(first.hips_position * 2.0 - second.hips_position, &locals)
}
