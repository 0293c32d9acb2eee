//! Single moments of a response.

use super::answer::Answer;
use super::job::RespondJob;
use crate::figure::figure;
use crate::jobs::camera::across;
use glam::DVec3;
use sinew_body::humanoid::{Node, Shape};
use sinew_motion::{Clip, Humanoid, Part, Side, Transform, facing};
use sinew_picture::{Arrow, Camera, Panel};
use sinew_response::{Push, PushFrame};

/// The moments of an answer, at the rate of the clips given.
pub(super) struct Panels<'a> {
    pub answer: &'a Answer,
    pub job: &'a RespondJob,
    /// The answered clip, and the input at the same rate.
    pub ours: &'a Clip,
    pub input: &'a Clip,
    /// The least time for which a push is shown \[s\].
    pub shown_secs: f64,
}

/// A body this near to its ghost hides it \[m\].
const SAME_M: f64 = 0.005;

/// Azimuth from which a body that faces +Z is seen when nothing else tells \[rad\]: half in front, at its right hand.
const USUAL_RAD: f64 = -0.92;

impl Panels<'_> {
    /// All frames of a stretch of time, both ends in.
    pub fn frames_between(&self, from_secs: f64, to_secs: f64) -> Vec<usize> {
        let last = self.ours.frames().saturating_sub(1);
        let frame = |secs: f64| ((secs / self.ours.frame_time_secs()).round() as usize).min(last);
        (frame(from_secs)..=frame(to_secs)).collect()
    }

    /// Joints of the answer, seen from the ground, which may have been jerked, and of the input.
    fn worlds(&self, frame: usize) -> (Vec<Transform>, Vec<Transform>) {
        let time_secs = frame as f64 * self.ours.frame_time_secs();
        let prepared = &self.answer.prepared;
        let ground = self.answer.pushed.deviation_at(time_secs).ground_shift / prepared.reduction().scale();
        let mut ours = self.ours.world(frame);
        for joint in &mut ours {
            joint.translation -= ground;
        }
        (ours, self.input.world(frame))
    }

    /// For every body its distance from where the input has it \[m\].
    fn apart(&self, shapes: &[(Node, usize, Shape)], (ours, input): &(Vec<Transform>, Vec<Transform>)) -> Vec<DVec3> {
        shapes.iter().map(|(_, joint, shape)| ours[*joint].point(shape.to) - input[*joint].point(shape.to)).collect()
    }

    /// How much what differs from the input has changed in each of some frames since the one before \[m\], the mean over all bodies; and a
    /// tenth of how far the body has moved, so that the input's own motion shows where nothing differs.
    pub fn change_m(&self, frames: &[usize]) -> Vec<f64> {
        let shapes = self.answer.prepared.reduction().shapes();
        let mut before: Option<Vec<(DVec3, DVec3)>> = None;
        let change = |&frame: &usize| {
            let worlds = self.worlds(frame);
            let ends = shapes.iter().map(|(_, joint, shape)| worlds.0[*joint].point(shape.to));
            let now: Vec<(DVec3, DVec3)> = self.apart(&shapes, &worlds).into_iter().zip(ends).collect();
            let change = before.as_ref().map_or(0.0, |before| {
                let each = now.iter().zip(before);
                each.map(|(now, before)| now.0.distance(before.0) + 0.1 * now.1.distance(before.1)).sum::<f64>()
            });
            before = Some(now);
            change / shapes.len().max(1) as f64
        };
        frames.iter().map(change).collect()
    }

    /// The middle of every push and jerk, and where the body is farthest from its input; as places in `frames`.
    pub fn happens(&self, frames: &[usize]) -> Vec<(usize, f64)> {
        let spans = self.job.pushes.iter().map(|push| (push.at_secs, push.for_secs));
        let spans = spans.chain(self.job.ground.iter().map(|jerk| (jerk.at_secs, jerk.for_secs)));
        let place = |secs: f64| {
            let frame = (secs / self.ours.frame_time_secs()).round().max(0.0) as usize;
            frames.iter().position(|&other| other == frame)
        };
        let pushes = spans.filter_map(|(at, lasts)| Some((place(at + lasts.min(1.0) / 2.0)?, 2.0)));
        let shapes = self.answer.prepared.reduction().shapes();
        let apart = |&frame: &usize| {
            self.apart(&shapes, &self.worlds(frame)).iter().map(|apart| apart.length()).fold(0.0, f64::max)
        };
        let apart: Vec<f64> = frames.iter().map(apart).collect();
        let peak = (0..apart.len()).max_by(|&a, &b| apart[a].total_cmp(&apart[b])).map(|peak| (peak, 1.0));
        pushes.chain(peak).collect()
    }

    /// The picture of a frame.
    pub fn panel(&self, frame: usize) -> Panel {
        let shapes = self.answer.prepared.reduction().shapes();
        let worlds = self.worlds(frame);
        let differs = self.apart(&shapes, &worlds).iter().any(|apart| apart.length() > SAME_M);
        let (ours, input) = worlds;
        let time_secs = frame as f64 * self.ours.frame_time_secs();
        let acting = |push: &Push| {
            let half = 0.5 * self.ours.frame_time_secs();
            (push.at_secs - half..=push.at_secs + push.for_secs.max(self.shown_secs) + half).contains(&time_secs)
        };
        let (mut arrows, mut captions) = (Vec::new(), Vec::new());
        for (index, push) in self.job.pushes.iter().enumerate().filter(|(_, push)| acting(push)) {
            let node = Node::of(push.part);
            let shape = shapes.iter().find(|(other, _, _)| *other == node);
            let (Some(force_n), Some((_, joint, shape))) = (self.answer.pushed.forces()[index], shape) else {
                continue;
            };
            let middle = (shape.from + shape.to) * 0.5;
            arrows.push(Arrow { at: ours[*joint].point(middle), force_n, label: String::new() });
            captions.push(format!("{:.0} N on the {} for {:.2} s", force_n.length(), push.part.words(), push.for_secs));
        }
        let hips = self.answer.prepared.reduction().joint(Node::Hips).unwrap_or(0);
        Panel {
            time_secs,
            figure: figure(&shapes, &ours),
            ghost: differs.then(|| figure(&shapes, &input)),
            arrows,
            follow: Some(input[hips].translation),
            caption: captions.join("; "),
            ..Panel::default()
        }
    }

    /// Across the strongest disturbance; where there is none, half in front of the body.
    pub fn camera(&self, humanoid: &Humanoid) -> Camera {
        let clip = self.answer.prepared.clip();
        let first = self.job.pushes.iter().map(|push| push.at_secs);
        let at_secs = first.chain(self.job.ground.iter().map(|jerk| jerk.at_secs)).fold(f64::INFINITY, f64::min);
        let frame = (at_secs.min(clip.duration_secs()) / clip.frame_time_secs()).max(0.0) as usize;
        let world = clip.world(frame.min(clip.frames().saturating_sub(1)));
        let forward = facing(&world, humanoid).unwrap_or(DVec3::Z);
        let heading_rad = libm::atan2(forward.x, forward.z);
        let in_world = |vector: DVec3, frame: PushFrame| match frame {
            PushFrame::World => vector,
            PushFrame::Facing => DVec3::Y.cross(forward) * vector.x + DVec3::Y * vector.y + forward * vector.z,
        };
        let level = |force: DVec3| DVec3 { y: 0.0, ..force }.length();
        let strongest = self.job.pushes.iter().max_by(|a, b| level(a.force_n).total_cmp(&level(b.force_n)));
        let jerk = || self.job.ground.first().map(|jerk| in_world(jerk.acceleration, jerk.frame));
        let along = strongest.map(|push| in_world(push.force_n, push.frame)).or_else(jerk);
        // From the side of the pushed limb.
        let is_left = strongest.is_some_and(|push| is_left(push.part));
        let rather_rad = heading_rad + if is_left { -USUAL_RAD } else { USUAL_RAD };
        match along {
            Some(along) => across(along, rather_rad),
            None => Camera::three_quarter().about_heading(forward),
        }
    }
}

fn is_left(part: Part) -> bool {
    part.side() == Some(Side::Left)
}
