//! BVH as a stream: a suit that broadcasts its header once and then a line of channel values for each frame.
//!
//! The header is a BVH's `HIERARCHY` up to a line `MOTION`; lines `Frames:` and `Frame Time:` may follow. A capture skeleton's
//! joints are turned in ways of their own, so the first second is watched before anything is shown: from it we learn which way
//! elbows and knees bend, and how long a unit is.

use sinew_body::humanoid::{Person, Reduction};
use sinew_control::perform::PerformerSample;
use sinew_motion::formats::{MotionFile, ReadOptions, bvh};
use sinew_motion::{Limits, SourceSpace};

/// Largest header \[bytes\].
const MAX_HEADER_BYTES: usize = 256 << 10;

/// Longest line \[bytes\]: a thousand channels.
const MAX_LINE_BYTES: usize = 32 << 10;

/// Frames that are watched before the performer is shown.
const WATCHED: usize = 60;

/// Time between frames when the stream does not state it \[s\].
const USUAL_SECS: f64 = 1.0 / 60.0;

/// Why a piece of the stream was thrown away.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RawError {
    /// The header is no BVH, or of no human body.
    #[error("the header: {0}")]
    Header(String),
    /// A line is no frame.
    #[error("a frame: {0}")]
    Frame(String),
    /// Too much without an end.
    #[error("{0} without an end; send a HIERARCHY, a line MOTION, then one line for each frame")]
    Endless(&'static str),
}

/// Puts the bytes of one connection together. Memory is bounded, whatever comes.
#[derive(Debug, Default)]
pub struct RawReader {
    line: Vec<u8>,
    /// The rest of the line is thrown away.
    skips: bool,
    header: String,
    state: State,
    frame_secs: Option<f64>,
    watched: String,
    frames: u64,
}

#[derive(Debug, Default)]
enum State {
    #[default]
    Header,
    Watching(usize),
    Known(Box<Known>),
    /// The header was bad; a new one may come.
    Lost,
}

#[derive(Debug)]
struct Known {
    reduction: Reduction,
    space: SourceSpace,
}

impl RawReader {
    /// Nothing heard yet.
    pub fn new() -> RawReader {
        RawReader::default()
    }

    /// Reads bytes that arrived at a time of ours \[s\]: hands out the samples that they complete, and what was wrong.
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
            out(Err(RawError::Endless("a line")));
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
            State::Lost => {}
            State::Header if line.eq_ignore_ascii_case("MOTION") => self.state = State::Watching(0),
            State::Header => {
                self.header.push_str(line);
                self.header.push('\n');
                if self.header.len() > MAX_HEADER_BYTES {
                    self.fail(RawError::Endless("a header"), out);
                }
            }
            State::Watching(_) | State::Known(_) if begins("Frame") => {
                if begins("Frame Time") {
                    let secs = line.rsplit(':').next().and_then(|text| text.trim().parse::<f64>().ok());
                    self.frame_secs = secs.filter(|secs| (1e-4..1.0).contains(secs));
                }
            }
            State::Watching(seen) => {
                let seen = *seen + 1;
                self.watched.push_str(line);
                self.watched.push('\n');
                self.frames += 1;
                self.state = State::Watching(seen);
                if seen >= WATCHED {
                    match self.understand() {
                        Ok(known) => {
                            self.state = State::Known(Box::new(known));
                            self.watched = String::new();
                        }
                        Err(problem) => self.fail(RawError::Header(problem), out),
                    }
                }
            }
            State::Known(known) => {
                let sample = self.frame(known, line, arrival_secs);
                self.frames += 1;
                out(sample.map_err(RawError::Frame));
            }
        }
    }

    fn fail(&mut self, error: RawError, out: &mut dyn FnMut(Result<PerformerSample, RawError>)) {
        self.state = State::Lost;
        self.header = String::new();
        self.watched = String::new();
        out(Err(error));
    }

    fn text(&self, rows: &str, count: usize) -> String {
        let secs = self.frame_secs.unwrap_or(USUAL_SECS);
        format!("{}MOTION\nFrames: {count}\nFrame Time: {secs}\n{rows}\n", self.header)
    }

    fn understand(&self) -> Result<Known, String> {
        let text = self.text(&self.watched, WATCHED);
        let file = MotionFile::from_bvh(text.as_bytes(), &ReadOptions::default()).map_err(|error| error.to_string())?;
        let humanoid = file.body_parts().map_err(|error| error.to_string())?;
        let reduction = Reduction::new(&file.clip, humanoid, file.stature_m, Person::default());
        Ok(Known { reduction: reduction.map_err(|error| error.to_string())?, space: file.space })
    }

    fn frame(&self, known: &Known, row: &str, arrival_secs: f64) -> Result<PerformerSample, String> {
        let text = self.text(row, 1);
        let parsed = bvh::read(text.as_bytes(), &Limits::default()).map_err(|error| error.to_string())?;
        if parsed.clip.frames() != 1 {
            return Err("the line has too few values; send one for each channel".to_owned());
        }
        let clip = known.space.clip_to_world(&parsed.clip);
        let pose = known.reduction.pose(&clip.world(0));
        let time_secs = self.frame_secs.map_or(arrival_secs, |secs| self.frames as f64 * secs);
        let sample = PerformerSample::of_pose(time_secs, &pose, known.reduction.body());
        Ok(PerformerSample { number: Some(self.frames), ..sample })
    }
}
