//! The live source: samples in, a wanted pose for every step out.

use super::align::{Alignment, Stand};
use super::blend::Blend;
use super::buffer::{Buffer, Entry};
use super::clock::Clock;
use super::one_euro::OneEuro;
use super::outlier_filter::{Around, OutlierFilter, Verdict};
use super::{BodyProportions, LiveSettings, PerformCounters, PerformerSample};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose, exp, log};
use sinew_snapshot::snapshot;
use sinew_world::hips_over_soles_m;

/// The state of a performer's stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Presence {
    /// No sample has arrived yet; the character stands.
    Waiting,
    /// The character follows.
    Performing,
    /// The stream is silent; the last pose is held.
    Holding,
    /// The stream has been silent for long; the character stands relaxed.
    Relaxed,
}

/// A live performer as the source of a character's wanted pose.
///
/// Time is the stage's, passed with each call; nothing else of the world is used, so the same samples at the same times
/// give the same bits. Memory is bounded, and neither call allocates.
///
/// ```
/// use glam::DVec3;
/// use sinew_body::humanoid::{Body, Pose};
/// use sinew_control::perform::{LiveSettings, LiveSource, PerformerSample, Presence};
/// let body = Body::standard(80.0, 1.7);
/// let mut source = LiveSource::new(&body, DVec3::ZERO, 0.0, &Pose::STANDING, LiveSettings::default());
/// let performer = Body::standard(60.0, 1.5);
/// for step in 0..240u32 {
///     let now = f64::from(step) / 240.0;
///     if step % 4 == 0 {
///         let mut pose = Pose::STANDING;
///         pose.hips_position.y = 0.8;
///         source.receive(&PerformerSample::of_pose(now, &pose, &performer), now);
///     }
///     source.advance(now, 1.0 / 240.0);
/// }
/// assert_eq!(source.presence(), Presence::Performing);
/// assert_eq!(source.counters().used, 60);
/// ```
#[derive(Clone, Debug)]
pub struct LiveSource {
    stand: Stand,
    settings: LiveSettings,
    outlier_filter: OutlierFilter,
    clock: Clock,
    build: Option<BodyProportions>,
    alignment: Option<Alignment>,
    /// Samples that were used with this alignment.
    aligned: u32,
    buffer: Buffer,
    /// The playhead: sender's time that is shown \[s\].
    playhead: Option<f64>,
    /// Beyond the last sample.
    is_ahead: bool,
    /// A sample came that was missing right at the playhead.
    is_mended: bool,
    presence: Presence,
    /// When the last used sample arrived \[s\].
    heard_secs: f64,
    idle: Pose,
    /// Where the body's hips are, when somebody says so \[m\].
    body_hips: Option<DVec3>,
    blend: Blend,
    filter: OneEuro,
    /// Before and after the filter.
    blended: Pose,
    shown: Pose,
    before: Pose,
    step_secs: f64,
    /// The end of the step \[s\].
    until_secs: f64,
    gain: f64,
}

snapshot!(enum Presence { 0: Waiting, 1: Performing, 2: Holding, 3: Relaxed });

snapshot!(LiveSource {
    outlier_filter, clock, build, alignment, aligned, buffer, playhead, is_ahead, is_mended, presence, heard_secs, idle, blend,
    filter, blended, shown, before, step_secs, until_secs, gain,
} fixed { stand, settings, body_hips });

/// Timeout after which a stream counts as lost \[s\]: the extrapolation beyond its last sample has come to rest by
/// then.
const SILENT_SECS: f64 = 0.25;

/// Maximum deviation of the playhead's rate while it corrects its position \[1\].
const MAX_WARP: f64 = 0.1;

/// Rate of the correction \[1/s\].
const WARP_RATE: f64 = 2.0;

/// Error above which the playhead jumps \[s\].
const JUMP_SECS: f64 = 0.4;

/// Minimum duration of the blend when a performer returns \[s\].
const RETURN_SECS: f64 = 0.4;

/// Minimum duration of the blend over a gap \[s\].
const BRIDGE_SECS: f64 = 0.1;

/// Maximum extrapolation of a pose \[s\]: a motion frame at 30 Hz.
const MAX_AHEAD_SECS: f64 = 0.034;

/// Distance from its place up to which a relaxed body comes back to it \[m\].
const KEEPS_PLACE_M: f64 = 0.1;

/// Number of samples after which an alignment is final.
const SURE: u32 = 10;

/// Maximum number of passed samples processed in one step.
const MAX_PASSED: usize = 64;

impl LiveSource {
    /// A character of this body whose performances begin at `place` (a point of the floor \[m\]) and face `facing_rad` (about +Y
    /// from +Z to +X). It has the pose `first` until then.
    pub fn new(body: &Body, place: DVec3, facing_rad: f64, first: &Pose, settings: LiveSettings) -> LiveSource {
        LiveSource {
            stand: Stand { body: body.clone(), place, facing_rad },
            outlier_filter: OutlierFilter::new(),
            clock: Clock::new(settings.most_jitter_secs),
            build: None,
            alignment: None,
            aligned: 0,
            buffer: Buffer::new(),
            playhead: None,
            is_ahead: false,
            is_mended: false,
            presence: Presence::Waiting,
            heard_secs: 0.0,
            idle: *first,
            body_hips: None,
            blend: Blend::none(),
            filter: OneEuro::new(settings.smoothing_hz),
            blended: *first,
            shown: *first,
            before: *first,
            step_secs: 1.0 / 240.0,
            until_secs: 0.0,
            gain: 1.0,
            settings,
        }
    }

    /// The performance will start at this pose; call it while the understudy plays.
    pub fn set_start_pose(&mut self, pose: &Pose) {
        if self.presence == Presence::Waiting {
            (self.idle, self.blended, self.shown, self.before) = (*pose, *pose, *pose, *pose);
        }
    }

    /// Receives a sample that arrives at a time of the stage \[s\].
    pub fn receive(&mut self, sample: &PerformerSample, now_secs: f64) {
        if !self.outlier_filter.is_sound(sample) || !sample.time_secs.is_finite() {
            return;
        }
        if sample.build.is_some() && self.build.is_none() {
            self.build = sample.build;
        }
        let mut alignment = self.alignment.unwrap_or_else(|| Alignment::of(sample, self.build, &self.stand));
        let mut pose = alignment.pose(sample);
        let around = Around {
            arrival_secs: now_secs,
            playhead_secs: self.playhead,
            buffer: &self.buffer,
            pose: &pose,
            scale: alignment.scale(),
        };
        let verdict = self.outlier_filter.judge(sample, &around);
        if verdict == Verdict::Begin {
            self.buffer.clear();
            self.clock.restart();
            self.playhead = None;
            if self.aligned < SURE {
                // The sample of the alignment was an outlier.
                alignment = Alignment::of(sample, self.build, &self.stand);
                pose = alignment.pose(sample);
                self.aligned = 0;
            }
        }
        if verdict != Verdict::Drop {
            self.clock.observe(now_secs, sample.time_secs, verdict == Verdict::Late);
        }
        if matches!(verdict, Verdict::Use | Verdict::Begin) {
            self.alignment = Some(alignment);
            self.aligned = self.aligned.saturating_add(1);
            self.heard_secs = now_secs;
            let entry = Entry { time_secs: sample.time_secs, pose };
            let gaps = self.buffer.insert(entry);
            for gap in gaps.into_iter().flatten() {
                self.clock.interval(gap);
            }
            // A sample that fills a gap at the playhead changes the interpolated pose.
            let next = self.playhead.and_then(|playhead| self.buffer.next_secs(playhead));
            self.is_mended |= gaps[1].is_some() && next == Some(sample.time_secs);
        }
    }

    /// Advances by a step that begins at a time of the stage \[s\]; [`LiveSource::pose`] is then the wanted pose at its
    /// end. Returns the new presence if it changes.
    pub fn advance(&mut self, now_secs: f64, step_secs: f64) -> Option<Presence> {
        self.step_secs = step_secs;
        self.until_secs = now_secs + step_secs;
        let was = self.presence;
        self.presence = self.presence_at(now_secs);
        if was != self.presence && self.presence == Presence::Relaxed {
            self.move_to_body();
            self.idle = self.at_ease();
            self.blend = Blend::begin(&self.blended, &self.idle, self.settings.relax_secs);
        }
        if self.presence == Presence::Relaxed {
            self.yield_place();
        }
        let wanted = match self.presence {
            Presence::Waiting | Presence::Relaxed => self.idle,
            Presence::Performing | Presence::Holding => {
                let is_back = matches!(was, Presence::Waiting | Presence::Relaxed);
                self.play(now_secs, step_secs, is_back);
                self.playhead.and_then(|playhead| self.buffer.at(playhead)).unwrap_or(self.blended)
            }
        };
        self.blend.advance(step_secs);
        self.blended = self.blend.over(&wanted);
        self.before = self.shown;
        self.shown = self.filter.next(&self.shown, &self.blended, step_secs);
        let gain = if self.presence == Presence::Relaxed { self.settings.relaxed_gain } else { 1.0 };
        let rate = (1.0 - self.settings.relaxed_gain) * step_secs / self.settings.relax_secs.max(step_secs);
        self.gain += (gain - self.gain).clamp(-rate, rate);
        (was != self.presence).then_some(self.presence)
    }

    fn presence_at(&self, now_secs: f64) -> Presence {
        if self.buffer.is_empty() {
            return Presence::Waiting;
        }
        let silent = now_secs - self.heard_secs;
        match self.presence {
            _ if silent <= SILENT_SECS => Presence::Performing,
            Presence::Waiting => Presence::Waiting,
            _ if silent > SILENT_SECS + self.settings.hold_secs => Presence::Relaxed,
            Presence::Relaxed => Presence::Relaxed,
            _ => Presence::Holding,
        }
    }

    /// Moves the playhead to its time at the end of the step.
    fn play(&mut self, now_secs: f64, step_secs: f64, is_back: bool) {
        let Some(newest) = self.buffer.newest().map(|newest| newest.time_secs) else { return };
        // One step more: samples arrive between steps and are seen at the next.
        let due = now_secs - self.clock.offset_secs() - self.clock.delay_secs();
        let Some(playhead) = self.playhead else {
            self.show_from(due, step_secs, RETURN_SECS);
            return;
        };
        let next = playhead + step_secs;
        let off = due - next;
        if is_back {
            self.show_from(due, step_secs, RETURN_SECS);
        } else if off.abs() > JUMP_SECS {
            self.show_from(due, step_secs, BRIDGE_SECS);
        } else if (self.is_ahead || self.is_mended) && next <= newest {
            // The extrapolated part is known now.
            self.show_from(next, step_secs, BRIDGE_SECS);
        } else if next > newest {
            // Nothing is shown, so the playhead may wait at its position.
            self.is_ahead = true;
            self.playhead = Some(if due < next { due.max(newest).max(playhead.min(next)) } else { next });
        } else {
            let warp = (off * WARP_RATE).clamp(-MAX_WARP, MAX_WARP);
            self.playhead = Some(next + warp * step_secs);
        }
        let Some(playhead) = self.playhead else { return };
        for _ in 0..MAX_PASSED {
            let Some(gap) = self.buffer.pass(playhead) else { break };
            if !self.outlier_filter.counters().lost_is_estimate {
                continue;
            }
            self.outlier_filter.estimate_lost(gap, self.clock.interval_secs());
        }
    }

    /// Shows the stream from a time on, with an inertial blend from the present pose.
    fn show_from(&mut self, time_secs: f64, step_secs: f64, least_secs: f64) {
        if let Some(wanted) = self.buffer.at(time_secs - step_secs) {
            self.blend = Blend::begin(&self.blended, &wanted, least_secs);
        }
        self.playhead = Some(time_secs);
        self.is_mended = false;
        self.is_ahead = self.buffer.newest().is_none_or(|newest| newest.time_secs < time_secs);
    }

    /// Says where the hips of the body are \[m\], before each [`advance`](LiveSource::advance): a relaxed body stands where it is, not
    /// where its performer left, which may be inside an obstacle.
    pub fn body_is_at(&mut self, hips: DVec3) {
        self.body_hips = hips.is_finite().then_some(hips);
    }

    /// The body may not have come to where its performer went: from now on the pose is where the body is.
    fn move_to_body(&mut self) {
        let Some(hips) = self.body_hips else { return };
        let off = (hips - self.blended.hips_position).with_y(0.0);
        if off.length() > KEEPS_PLACE_M {
            for pose in [&mut self.blended, &mut self.shown, &mut self.before] {
                pose.hips_position += off;
            }
        }
    }

    /// A relaxed body that something keeps from its place stands beside it.
    fn yield_place(&mut self) {
        let Some(hips) = self.body_hips else { return };
        let off = (hips - self.idle.hips_position).with_y(0.0);
        self.idle.hips_position += off - off.clamp_length_max(KEEPS_PLACE_M);
    }

    /// Standing upright at the position and heading of the shown pose.
    fn at_ease(&self) -> Pose {
        let forward = self.blended.world[0] * DVec3::Z;
        let turn = exp(DVec3::Y * libm::atan2(forward.x, forward.z));
        let height = hips_over_soles_m(&self.stand.body, &Pose::STANDING);
        let hips = self.blended.hips_position;
        Pose {
            hips_position: DVec3::new(hips.x, self.stand.place.y + height, hips.z),
            world: Pose::STANDING.world.map(|rotation| turn * rotation),
        }
    }

    /// The wanted pose at the end of the step.
    pub fn pose(&self) -> &Pose {
        &self.shown
    }

    /// The predicted wanted pose at a time of the stage soon after the end of the step \[s\], for trackers that need
    /// the end of a motion frame.
    pub fn pose_at(&self, time_secs: f64) -> Pose {
        let ahead = (time_secs - self.until_secs).clamp(0.0, MAX_AHEAD_SECS);
        let Some(playhead) = self.playhead.filter(|_| self.presence == Presence::Performing && ahead > 0.0) else {
            return self.shown;
        };
        let (Some(now), Some(then)) = (self.buffer.at(playhead), self.buffer.at(playhead + ahead)) else {
            return self.shown;
        };
        let locals = Node::ALL.map(|node| {
            let turned = now.local(node).conjugate() * then.local(node);
            (self.shown.local(node) * turned).normalize()
        });
        Pose::from_locals(self.shown.hips_position + then.hips_position - now.hips_position, &locals)
    }

    /// The state of the performer's stream.
    pub fn presence(&self) -> Presence {
        self.presence
    }

    /// Statistics of the samples so far.
    pub fn counters(&self) -> PerformCounters {
        self.outlier_filter.counters()
    }

    /// Delay of the jitter buffer beyond the minimum latency \[s\].
    pub fn delay_secs(&self) -> f64 {
        self.clock.delay_secs()
    }

    /// Lag of the playhead behind a sample that would arrive now with minimum latency \[s\]; `None` before the first.
    pub fn lag_secs(&self, now_secs: f64) -> Option<f64> {
        Some(now_secs - self.clock.offset_secs() - self.playhead?)
    }

    /// Number of buffered samples.
    pub fn waiting(&self) -> usize {
        self.buffer.len()
    }

    /// Factor on the gains: 1, less when relaxed.
    pub fn gain(&self) -> f64 {
        self.gain
    }

    /// Velocity of the hips \[m/s\] and their angular velocity in their own frame \[rad/s\].
    pub fn root_velocity(&self) -> (DVec3, DVec3) {
        let linear = (self.shown.hips_position - self.before.hips_position) / self.step_secs;
        (linear, self.turning(Node::Hips))
    }

    /// Angular velocity of a joint in its own frame \[rad/s\].
    pub(crate) fn turning(&self, node: Node) -> DVec3 {
        let apart: DQuat = self.before.local(node).conjugate() * self.shown.local(node);
        log(apart.normalize()) / self.step_secs
    }
}
