//! What pushes did to a run, measured against the same run without them.

use crate::prepared_clip::PreparedClip;
use crate::track::Track;
use sinew_body::humanoid::Node;
use sinew_motion::{Clip, Humanoid, Part, Side, contacts};

/// The angle of every joint from the run without pushes, over time.
///
/// ```
/// use glam::DVec3;
/// use sinew_body::humanoid::{Body, Node, Pose};
/// use sinew_motion::Part;
/// use sinew_response::{Deflection, Disturbances, Prepared, Push, PushFrame, Settings};
///
/// let prepared = Prepared::of_poses(Body::standard(80.0, 1.7), vec![Pose::STANDING; 300], Settings::default())?;
/// let push = Push {
///     part: Part::LeftHand,
///     point: None,
///     force_n: DVec3::new(0.0, 0.0, -100.0),
///     frame: PushFrame::Facing,
///     at_secs: 0.5,
///     for_secs: 0.1,
/// };
/// let pushed = prepared.run(Disturbances { pushes: &[push], ground: &[] });
/// let deflection = Deflection::between(&pushed, &prepared.run(Disturbances::default()));
/// assert!(deflection.peaks_rad(0.0, 5.0)[Node::LeftUpperArm.index()] > 0.1);
/// # Ok::<(), sinew_response::PrepareError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Deflection {
    rows: Vec<(f64, [f64; Node::COUNT])>,
}

impl Deflection {
    /// A joint within this of the run without pushes has recovered \[rad\]: 2 degrees.
    pub const RECOVERED_RAD: f64 = 2.0 * std::f64::consts::PI / 180.0;

    /// How far a run is from another run of the same motion.
    pub fn between(pushed: &Track, unpushed: &Track) -> Deflection {
        let poses = 0..pushed.poses().len().min(unpushed.poses().len());
        Deflection { rows: poses.map(|index| (pushed.secs(index), pushed.deflection(unpushed, index))).collect() }
    }

    /// Time from the clip's first frame \[s\] and the joints' angles by [`Node::index`] \[rad\], a row a pose.
    pub fn rows(&self) -> &[(f64, [f64; Node::COUNT])] {
        &self.rows
    }

    /// The largest angle of every joint from one time until another \[rad\], the second not included; by [`Node::index`].
    pub fn peaks_rad(&self, from_secs: f64, to_secs: f64) -> [f64; Node::COUNT] {
        let mut peaks = [0.0; Node::COUNT];
        for (_, angles) in self.rows.iter().filter(|(secs, _)| (from_secs..to_secs).contains(secs)) {
            for (peak, angle) in peaks.iter_mut().zip(angles) {
                *peak = f64::max(*peak, *angle);
            }
        }
        peaks
    }

    /// Time from `end_secs` until every joint stays within [`Deflection::RECOVERED_RAD`] up to `to_secs` \[s\]; `None` if it never
    /// does.
    pub fn recovered_secs(&self, end_secs: f64, to_secs: f64) -> Option<f64> {
        let away = |angles: &[f64; Node::COUNT]| !angles.iter().all(|&angle| angle <= Deflection::RECOVERED_RAD);
        let rows = || self.rows.iter().filter(|(secs, _)| (end_secs..to_secs).contains(secs));
        let (last, _) = rows().next_back()?;
        match rows().rfind(|(_, angles)| away(angles)) {
            None => Some(0.0),
            Some((secs, _)) if secs == last => None,
            Some((secs, _)) => rows().map(|(later, _)| *later).find(|later| later > secs).map(|back| back - end_secs),
        }
    }
}

/// How far stance ankles leave the input's over time, on the clip's own skeleton.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StanceDeviation {
    /// Time \[s\] and distance \[m\].
    rows: Vec<(f64, f64)>,
}

impl StanceDeviation {
    /// Of a clip as [`PreparedClip::applied`] gave it for this run, in the ground's frame.
    pub fn of(humanoid: &Humanoid, prepared: &PreparedClip, clip: &Clip, track: &Track) -> StanceDeviation {
        let (input, scale) = (prepared.clip(), prepared.reduction().scale());
        let standing = contacts(input, humanoid);
        let ankles = [(Side::Left, Part::LeftFoot), (Side::Right, Part::RightFoot)];
        let (mut before, mut after) = (Vec::new(), Vec::new());
        let mut rows = Vec::new();
        for frame in prepared.first_frame()..clip.frames().min(input.frames()) {
            input.world_into(frame, &mut before);
            clip.world_into(frame, &mut after);
            let secs = frame as f64 * clip.frame_time_secs();
            let ground = track.deviation_at(secs).ground_shift / scale;
            for (side, part) in ankles {
                if let (true, Some(ankle)) = (standing.side(side)[frame], humanoid.joint(part)) {
                    let gap = after[ankle].translation - before[ankle].translation - ground;
                    rows.push((secs, gap.length()));
                }
            }
        }
        StanceDeviation { rows }
    }

    /// The largest distance from one time until another \[m\], the second not included.
    pub fn largest_m(&self, from_secs: f64, to_secs: f64) -> f64 {
        let rows = self.rows.iter().filter(|(secs, _)| (from_secs..to_secs).contains(secs));
        rows.map(|(_, gap)| *gap).fold(0.0, f64::max)
    }
}
