//! BVH as a stream: a motion capture suit that broadcasts its header once and then a line of channel values for each
//! frame.
//!
//! The header is a BVH's `HIERARCHY` up to a line `MOTION`; lines `Frames:` and `Frame Time:` may follow. The joint
//! axes of a capture skeleton are arbitrary, so the first second is used for calibration and yields no samples: it
//! shows about which axes elbows and knees bend, and the length unit.

use sinew_body::humanoid::{Person, Reduction};
use sinew_control::perform::PerformerSample;
use sinew_motion::formats::{MotionFile, ReadOptions, bvh};
use sinew_motion::{Limits, SourceSpace};

/// Maximum size of the header \[bytes\].
const MAX_HEADER_BYTES: usize = 256 << 10;

/// Maximum length of a line \[bytes\]: a thousand channels.
const MAX_LINE_BYTES: usize = 32 << 10;

/// Number of frames for calibration, before the first sample.
const CALIBRATION_FRAMES: usize = 60;

/// Time between frames if the stream does not state it \[s\].
const DEFAULT_FRAME_SECS: f64 = 1.0 / 60.0;

/// Why a part of the stream was discarded.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RawError {
    /// The header is not BVH, or does not describe a human body.
    #[error("the header: {0}")]
    Header(String),
    /// A line is not a valid frame.
    #[error("a frame: {0}")]
    Frame(String),
    /// A header or line exceeds its maximum size.
    #[error("{0} is too long; send a HIERARCHY, a line MOTION, then one line for each frame")]
    TooLong(&'static str),
}

/// Decodes the bytes of one connection. Memory is bounded for any input.
#[derive(Debug, Default)]
pub struct RawReader {
    line: Vec<u8>,
    /// The rest of the line is discarded.
    skips: bool,
    header: String,
    state: State,
    frame_secs: Option<f64>,
    calibration: String,
    frames: u64,
}

#[derive(Debug, Default)]
enum State {
    #[default]
    Header,
    Calibrating(usize),
    Ready(Box<Rig>),
    /// The header was invalid; waits for a new one.
    Invalid,
}

#[derive(Debug)]
struct Rig {
    reduction: Reduction,
    space: SourceSpace,
}

impl RawReader {
    /// A reader before the first byte.
    pub fn new() -> RawReader {
        RawReader::default()
    }

    /// Reads bytes that arrived at `arrival_secs` of the local clock \[s\]; passes completed samples and errors to
    /// `out`.
    pub fn bytes(
        &mut self,
        mut bytes: &[u8],
        arrival_secs: f64,
        out: &mut dyn FnMut(Result<PerformerSample, RawError>),
    ) {
        while let Some(end) = bytes.iter().position(|&byte| byte == b'\n') {
            let (piece, rest) = bytes.split_at(end);
            bytes = &rest[1..];
            self.keep(piece, out);
            let line = std::mem::take(&mut self.line);
            if !std::mem::take(&mut self.skips) {
                let text = String::from_utf8_lossy(&line);
                self.whole_line(text.trim(), arrival_secs, out);
            }
            self.line = line;
            self.line.clear();
        }
        self.keep(bytes, out);
    }

    fn keep(&mut self, piece: &[u8], out: &mut dyn FnMut(Result<PerformerSample, RawError>)) {
        if self.skips {
            return;
        }
        if self.line.len() + piece.len() > MAX_LINE_BYTES {
            self.line.clear();
            self.skips = true;
            out(Err(RawError::TooLong("a line")));
            return;
        }
        self.line.extend_from_slice(piece);
    }

    fn whole_line(&mut self, line: &str, arrival_secs: f64, out: &mut dyn FnMut(Result<PerformerSample, RawError>)) {
        let begins = |word: &str| line.get(..word.len()).is_some_and(|start| start.eq_ignore_ascii_case(word));
        if begins("HIERARCHY") {
            *self = RawReader { line: std::mem::take(&mut self.line), ..RawReader::default() };
        }
        if line.is_empty() {
            return;
        }
        match &self.state {
            State::Invalid => {}
            State::Header if line.eq_ignore_ascii_case("MOTION") => self.state = State::Calibrating(0),
            State::Header => {
                self.header.push_str(line);
                self.header.push('\n');
                if self.header.len() > MAX_HEADER_BYTES {
                    self.fail(RawError::TooLong("a header"), out);
                }
            }
            State::Calibrating(_) | State::Ready(_) if begins("Frame") => {
                if begins("Frame Time") {
                    let secs = line.rsplit(':').next().and_then(|text| text.trim().parse::<f64>().ok());
                    self.frame_secs = secs.filter(|secs| (1e-4..1.0).contains(secs));
                }
            }
            State::Calibrating(seen) => {
                let seen = *seen + 1;
                self.calibration.push_str(line);
                self.calibration.push('\n');
                self.frames += 1;
                self.state = State::Calibrating(seen);
                if seen >= CALIBRATION_FRAMES {
                    match self.calibrate() {
                        Ok(rig) => {
                            self.state = State::Ready(Box::new(rig));
                            self.calibration = String::new();
                        }
                        Err(problem) => self.fail(RawError::Header(problem), out),
                    }
                }
            }
            State::Ready(rig) => {
                let sample = self.frame(rig, line, arrival_secs);
                self.frames += 1;
                out(sample.map_err(RawError::Frame));
            }
        }
    }

    fn fail(&mut self, error: RawError, out: &mut dyn FnMut(Result<PerformerSample, RawError>)) {
        self.state = State::Invalid;
        self.header = String::new();
        self.calibration = String::new();
        out(Err(error));
    }

    fn text(&self, rows: &str, count: usize) -> String {
        let secs = self.frame_secs.unwrap_or(DEFAULT_FRAME_SECS);
        format!("{}MOTION\nFrames: {count}\nFrame Time: {secs}\n{rows}\n", self.header)
    }

    fn calibrate(&self) -> Result<Rig, String> {
        let text = self.text(&self.calibration, CALIBRATION_FRAMES);
        let file = MotionFile::from_bvh(text.as_bytes(), &ReadOptions::default()).map_err(|error| error.to_string())?;
        let humanoid = file.body_parts().map_err(|error| error.to_string())?;
        let reduction = Reduction::new(&file.clip, humanoid, file.stature_m, Person::default());
        Ok(Rig { reduction: reduction.map_err(|error| error.to_string())?, space: file.space })
    }

    fn frame(&self, rig: &Rig, row: &str, arrival_secs: f64) -> Result<PerformerSample, String> {
        let text = self.text(row, 1);
        let parsed = bvh::read(text.as_bytes(), &Limits::default()).map_err(|error| error.to_string())?;
        if parsed.clip.frames() != 1 {
            return Err("the line has too few values; send one for each channel".to_owned());
        }
        let clip = rig.space.clip_to_world(&parsed.clip);
        let pose = rig.reduction.pose(&clip.world(0));
        let time_secs = self.frame_secs.map_or(arrival_secs, |secs| self.frames as f64 * secs);
        let sample = PerformerSample::of_pose(time_secs, &pose, rig.reduction.body());
        Ok(PerformerSample { number: Some(self.frames), ..sample })
    }
}
