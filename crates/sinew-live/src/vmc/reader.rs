//! Decodes VMC datagrams into samples.

use super::axes::{mirrored, mirrored_turn};
use super::osc::{self, Malformed, number};
use super::{BONE, OK, ROOT, SEQ, TIME};
use glam::{DQuat, DVec3};
use rosc::{OscMessage, OscType};
use sinew_control::perform::{BodyProportions, PerformerSample, SampleStatus};
use sinew_motion::Part;

/// Assembles samples from the messages of one sender.
///
/// A sender's frame may come as one bundle, in several datagrams or message by message. A frame is complete when its
/// time (`/VMC/Ext/T`) and all bones that the sender usually sends have arrived, or when the next one begins.
///
/// ```
/// use sinew_body::humanoid::{Body, Pose};
/// use sinew_control::perform::PerformerSample;
/// use sinew_live::vmc::{VmcFrame, VmcReader};
/// let body = Body::standard(80.0, 1.7);
/// let sent = PerformerSample::of_pose(0.25, &Pose::STANDING, &body);
/// let mut reader = VmcReader::new();
/// let mut heard = Vec::new();
/// reader.datagram(&VmcFrame::of(&sent, &body).to_bytes(), 7.0, &mut |sample| heard.push(sample))?;
/// assert_eq!(heard[0].hips_um, sent.hips_um);
/// assert_eq!(heard[0].time_secs, 0.25, "the sender's time, not that of the arrival");
/// # Ok::<(), sinew_live::vmc::Malformed>(())
/// ```
#[derive(Clone, Debug)]
pub struct VmcReader {
    /// Position and rotation of every part in its parent's frame.
    bones: [(DVec3, DQuat); Part::COUNT],
    root: (DVec3, DQuat),
    /// Bit set of the parts in the present frame.
    has: u32,
    /// Bit set of the parts in the last frame.
    usual: u32,
    time_secs: Option<f64>,
    number: Option<(u64, f64)>,
    /// The time arrived after bones: this sender ends its frames with it.
    is_closed: bool,
    frames_without_time: u32,
    is_seen: bool,
    built: Option<BodyProportions>,
    frames: u64,
}

/// Number of frames after which the body proportions are sent again.
const TELL_BUILD: u64 = 60;

/// Number of frames without a time after which the sender counts as one without times.
const TIMELESS: u32 = 3;

const HIPS: u32 = 1 << Part::Hips as u32;

impl Default for VmcReader {
    fn default() -> VmcReader {
        VmcReader::new()
    }
}

impl VmcReader {
    /// A reader before the first datagram.
    pub fn new() -> VmcReader {
        VmcReader {
            bones: [(DVec3::ZERO, DQuat::IDENTITY); Part::COUNT],
            root: (DVec3::ZERO, DQuat::IDENTITY),
            has: 0,
            usual: HIPS,
            time_secs: None,
            number: None,
            is_closed: false,
            frames_without_time: 0,
            is_seen: true,
            built: None,
            frames: 0,
        }
    }

    /// Reads a datagram that arrived at `arrival_secs` of the local clock \[s\], and passes completed samples to `out`.
    /// Samples of a sender without times get the arrival time.
    ///
    /// # Errors
    /// A datagram that is not valid OSC; none of it is used.
    pub fn datagram(
        &mut self,
        bytes: &[u8],
        arrival_secs: f64,
        out: &mut dyn FnMut(PerformerSample),
    ) -> Result<(), Malformed> {
        osc::read(bytes, &mut |message| self.message(message, arrival_secs, out))?;
        let is_whole = self.has & HIPS != 0 && self.has & self.usual == self.usual;
        let is_timeless = self.frames_without_time >= TIMELESS;
        if self.has != 0 && (self.is_closed || (is_whole && (self.time_secs.is_some() || is_timeless))) {
            self.complete(arrival_secs, out);
        }
        Ok(())
    }

    fn message(&mut self, message: &OscMessage, arrival_secs: f64, out: &mut dyn FnMut(PerformerSample)) {
        let args = &message.args;
        match message.addr.as_str() {
            OK => {
                let is_zero = |at: usize| matches!(args.get(at), Some(OscType::Int(0)));
                // Loaded, calibration state, calibration mode, tracking status.
                self.is_seen = !is_zero(0) && !is_zero(3);
            }
            TIME => {
                let time = number(args.first());
                if self.has != 0 && self.time_secs.is_some_and(|before| before != time) {
                    self.complete(arrival_secs, out);
                }
                self.is_closed |= self.has != 0 && self.time_secs.is_none();
                self.time_secs = Some(time);
            }
            SEQ => {
                let count = match args.first() {
                    Some(OscType::Long(count)) => u64::try_from(*count).ok(),
                    Some(OscType::Int(count)) => u64::try_from(*count).ok(),
                    _ => None,
                };
                self.number = count.map(|count| (count, number(args.get(1))));
            }
            ROOT => self.root = placed(args.get(1..).unwrap_or_default()),
            BONE => {
                let Some(OscType::String(name)) = args.first() else { return };
                // Fingers and eyes are not among our parts.
                let Ok(part) = name.parse::<Part>() else { return };
                if self.has & 1 << part as u32 != 0 && part == Part::Hips {
                    // The hips again: a new frame begins.
                    self.complete(arrival_secs, out);
                }
                self.bones[part as usize] = placed(args.get(1..).unwrap_or_default());
                self.has |= 1 << part as u32;
            }
            _ => {}
        }
    }

    fn complete(&mut self, arrival_secs: f64, out: &mut dyn FnMut(PerformerSample)) {
        let told = self.time_secs.take();
        self.frames_without_time = if told.is_some() { 0 } else { self.frames_without_time.saturating_add(1) };
        let (number, exact) = match self.number.take() {
            Some((number, time)) => (Some(number), Some(time)),
            None => (None, None),
        };
        let time = exact.or(told).unwrap_or(arrival_secs);
        let mut turns = self.bones.map(|(_, turn)| turn);
        let (root_place, root_turn) = self.root;
        let (hips_place, hips_turn) = self.bones[0];
        turns[0] = root_turn * hips_turn;
        let mut sample = PerformerSample::new(time, root_place + root_turn * hips_place, &turns);
        sample.number = number;
        if !self.is_seen && sample.status == SampleStatus::Tracked {
            sample.status = SampleStatus::Untracked;
        }
        let build = self.build();
        if build != self.built || self.frames.is_multiple_of(TELL_BUILD) {
            sample.build = build;
            self.built = build;
        }
        self.frames += 1;
        self.usual = self.has | HIPS;
        self.has = 0;
        self.is_closed = false;
        out(sample);
    }

    /// Body proportions from the positions of the bones in their parents; `None` for senders without positions.
    fn build(&self) -> Option<BodyProportions> {
        let place = |part: Part| self.bones[part as usize].0;
        let legs = (place(Part::LeftUpperLeg) + place(Part::RightUpperLeg)) / 2.0;
        let bones = [Part::LeftLowerLeg, Part::LeftFoot, Part::RightLowerLeg, Part::RightFoot];
        let each = bones.map(|part| place(part).length());
        let is_sound = legs.is_finite() && each.iter().all(|length| (0.01..10.0).contains(length));
        is_sound.then(|| BodyProportions::new(legs, each.iter().sum::<f64>() / 2.0))
    }
}

/// Position and rotation from seven numbers in Unity's axes. A message that is too short gives NaN, which the outlier
/// filter rejects later.
fn placed(args: &[OscType]) -> (DVec3, DQuat) {
    let at = |index: usize| number(args.get(index));
    let place = DVec3::new(at(0), at(1), at(2));
    (mirrored(place), mirrored_turn(DQuat::from_xyzw(at(3), at(4), at(5), at(6))))
}
