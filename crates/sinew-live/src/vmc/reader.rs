//! Decodes VMC datagrams into samples.

use super::axes::{mirrored, mirrored_turn};
use super::osc::{self, Malformed, number};
use super::sender_clock::SenderClock;
use super::{BONE, OK, ROOT, SEQ, TIME};
use glam::{DQuat, DVec3};
use rosc::{OscMessage, OscType};
use sinew_control::perform::{BodyProportions, PerformerSample, SampleStatus};
use sinew_motion::Part;

/// Assembles samples from the messages of one sender.
///
/// A sender's frame may come as one bundle, in several datagrams or message by message, with its time (`/VMC/Ext/T`)
/// before or after its bones, or without any. The bones between two times are one frame; without times a frame begins
/// with the hips, or with a bone that comes again. A frame is complete when all bones that the sender usually sends
/// have arrived. What is usual shows in the first frame that came from its beginning to its end; until then only a
/// datagram with a whole body gives a sample. So no sample has the bones of two frames, or hips alone.
///
/// A sender whose time stands still, or is too large to tell frames apart (seconds since 1970 in single precision), is
/// followed by the time of arrival from then on; see [`VmcReader::goes_by_arrival`].
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
    /// Bit set of the parts in the present datagram.
    has_now: u32,
    /// Bit set of the parts that a frame usually has; 0 until one was seen whole.
    usual: u32,
    /// The present frame was seen from its beginning.
    is_clean: bool,
    /// Frames in a row without all usual parts.
    incomplete: u32,
    time_secs: Option<f64>,
    number: Option<(u64, f64)>,
    /// The time arrived after the bones and ends the frame.
    is_closed: bool,
    /// This sender's times are datagrams of their own after the bones.
    trails: bool,
    /// A time has arrived.
    tells_time: bool,
    /// Two frames went by without a time.
    is_timeless: bool,
    clock: SenderClock,
    is_seen: bool,
    built: Option<BodyProportions>,
    frames: u64,
}

/// Number of frames after which the body proportions are sent again.
const TELL_BUILD: u64 = 60;

/// Frames in a row without a usual part after which it no longer belongs to a frame: more than a bad network loses.
const MAX_INCOMPLETE: u32 = 10;

/// The parts that VRM requires of a humanoid: a datagram that has them all is a whole body.
const REQUIRED: u32 = bits(&[
    Part::Hips,
    Part::Spine,
    Part::Head,
    Part::LeftUpperArm,
    Part::LeftLowerArm,
    Part::LeftHand,
    Part::RightUpperArm,
    Part::RightLowerArm,
    Part::RightHand,
    Part::LeftUpperLeg,
    Part::LeftLowerLeg,
    Part::LeftFoot,
    Part::RightUpperLeg,
    Part::RightLowerLeg,
    Part::RightFoot,
]);

const fn bits(parts: &[Part]) -> u32 {
    let mut set = 0;
    let mut at = 0;
    while at < parts.len() {
        set |= 1 << parts[at] as u32;
        at += 1;
    }
    set
}

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
            has_now: 0,
            usual: 0,
            is_clean: false,
            incomplete: 0,
            time_secs: None,
            number: None,
            is_closed: false,
            trails: false,
            tells_time: false,
            is_timeless: false,
            clock: SenderClock::default(),
            is_seen: true,
            built: None,
            frames: 0,
        }
    }

    /// Whether samples have the time of their arrival, because the sender's own cannot be used.
    pub fn goes_by_arrival(&self) -> bool {
        self.clock.goes_by_arrival()
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
        self.has_now = 0;
        osc::read(bytes, &mut |message| self.message(message, arrival_secs, out))?;
        let is_usual = self.usual != 0 && self.has & self.usual == self.usual;
        let is_whole_body = self.has & REQUIRED == REQUIRED;
        let is_complete = if self.is_closed {
            is_usual || is_whole_body
        } else {
            let is_at_once = is_whole_body && self.has == self.has_now;
            (is_usual && (self.time_secs.is_some() || self.is_timeless)) || (is_at_once && self.time_secs.is_some())
        };
        if self.has != 0 && (is_complete || self.is_closed) {
            self.end(is_complete || self.usual != 0, arrival_secs, out);
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
            TIME => self.time(number(args.first()), arrival_secs, out),
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
                let Some(part) = part_of(args) else { return };
                let bit = 1 << part as u32;
                let begins = part == Part::Hips && self.is_timeless && self.has & !self.has_now != 0;
                if self.has & bit != 0 || begins {
                    // Without a time between them, the same bone again is the next frame's.
                    self.is_timeless |= !self.tells_time;
                    let is_known = self.time_secs.is_some() || self.is_timeless;
                    self.end(is_known && (self.usual != 0 || self.is_clean), arrival_secs, out);
                    self.is_clean = true;
                }
                if self.has == 0 {
                    self.is_clean |= self.time_secs.is_some() || part == Part::Hips;
                }
                self.bones[part as usize] = placed(args.get(1..).unwrap_or_default());
                self.has |= bit;
                self.has_now |= bit;
            }
            _ => {}
        }
    }

    /// A time ends the frame before it, unless that one has none yet and shows that its time comes last.
    fn time(&mut self, secs: f64, arrival_secs: f64, out: &mut dyn FnMut(PerformerSample)) {
        self.tells_time = true;
        self.is_timeless = false;
        if self.has != 0 && self.time_secs.is_none() {
            let is_first_whole = self.usual == 0 && self.is_clean && self.has & REQUIRED == REQUIRED;
            self.trails |= self.has_now == 0 && is_first_whole;
            if self.has_now != 0 || self.trails {
                self.time_secs = Some(secs);
                self.is_closed = true;
                return;
            }
            // Its own time was lost, or came before the first datagram.
            self.end(false, arrival_secs, out);
        } else if self.has != 0 {
            self.end(self.usual != 0 || self.is_clean, arrival_secs, out);
        }
        self.time_secs = Some(secs);
    }

    /// Ends the present frame, as a sample or without one.
    fn end(&mut self, is_sample: bool, arrival_secs: f64, out: &mut dyn FnMut(PerformerSample)) {
        let has_usual = self.has & self.usual == self.usual;
        self.incomplete = if has_usual { 0 } else { self.incomplete + 1 };
        self.usual = if self.incomplete > MAX_INCOMPLETE { self.has } else { self.usual | self.has };
        self.has = 0;
        self.has_now = 0;
        self.is_clean = false;
        self.is_closed = false;
        let (told, number) = (self.time_secs.take(), self.number.take());
        if is_sample {
            let time_secs = match (number, told) {
                (Some((_, exact)), _) => exact,
                (None, Some(told)) => self.clock.time_secs(told, arrival_secs),
                (None, None) => arrival_secs,
            };
            out(self.sample(time_secs, number.map(|(number, _)| number)));
        }
    }

    fn sample(&mut self, time_secs: f64, number: Option<u64>) -> PerformerSample {
        let mut turns = self.bones.map(|(_, turn)| turn);
        let (root_place, root_turn) = self.root;
        let (hips_place, hips_turn) = self.bones[0];
        turns[0] = root_turn * hips_turn;
        let mut sample = PerformerSample::new(time_secs, root_place + root_turn * hips_place, &turns);
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
        sample
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

/// The part that a bone message is about; `None` for fingers and eyes, which are not among our parts.
fn part_of(args: &[OscType]) -> Option<Part> {
    match args.first() {
        Some(OscType::String(name)) => Part::named(name),
        _ => None,
    }
}

/// Whether a datagram has a bone of the body: what makes its sender a performer.
pub(crate) fn has_body(bytes: &[u8]) -> Result<bool, Malformed> {
    let mut has_body = false;
    osc::read(bytes, &mut |message| has_body |= message.addr == BONE && part_of(&message.args).is_some())?;
    Ok(has_body)
}
