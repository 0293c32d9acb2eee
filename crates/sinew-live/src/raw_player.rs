//! A BVH file as a motion capture suit that broadcasts raw BVH: the header, then line by line.

use crate::PlayerError;
use std::time::Duration;

/// A BVH file, ready to be sent to a port for [`raw`](crate::raw) streams.
///
/// ```
/// use sinew_live::RawPlayer;
/// let text = "HIERARCHY\nROOT Hips\n{\n}\nMOTION\nFrames: 2\nFrame Time: 0.02\n0 1 0\n0 2 0\n";
/// let player = RawPlayer::new(text).unwrap();
/// assert!(player.header().ends_with("MOTION\nFrame Time: 0.02\n"));
/// // Forwards and backwards in turn, without a jump.
/// assert_eq!([0, 1, 2].map(|number| player.line(number)), ["0 1 0", "0 2 0", "0 1 0"]);
/// ```
#[derive(Clone, Debug)]
pub struct RawPlayer {
    header: String,
    lines: Vec<String>,
    interval: Duration,
}

impl RawPlayer {
    /// Splits the text of a BVH file into header and lines; the receiver parses them.
    ///
    /// # Errors
    /// A text without hierarchy, frame time or frames.
    pub fn new(text: &str) -> Result<RawPlayer, PlayerError> {
        let mut lines = text.lines().map(str::trim);
        let hierarchy: Vec<&str> = lines.by_ref().take_while(|line| !line.eq_ignore_ascii_case("MOTION")).collect();
        if !hierarchy.first().is_some_and(|line| line.eq_ignore_ascii_case("HIERARCHY")) {
            return Err(PlayerError::NotBvh);
        }
        let (heads, rows): (Vec<&str>, Vec<&str>) =
            lines.filter(|line| !line.is_empty()).partition(|line| line.contains(':'));
        let secs =
            heads.iter().find_map(|line| line.strip_prefix("Frame Time:")).and_then(|secs| secs.trim().parse().ok());
        let secs: f64 = secs.filter(|secs| (1e-4..1.0).contains(secs)).ok_or(PlayerError::NoFrameTime)?;
        if rows.is_empty() {
            return Err(PlayerError::NoFrames);
        }
        Ok(RawPlayer {
            header: format!("{}\nMOTION\nFrame Time: {secs}\n", hierarchy.join("\n")),
            lines: rows.into_iter().map(str::to_owned).collect(),
            interval: Duration::from_secs_f64(secs),
        })
    }

    /// The header, which is sent first.
    pub fn header(&self) -> &str {
        &self.header
    }

    /// The line of the frame of this number, without its line end. The clip plays forwards and backwards in turn.
    pub fn line(&self, number: u64) -> &str {
        &self.lines[crate::player::ping_pong(number, self.lines.len())]
    }

    /// Time from frame to frame.
    pub fn interval(&self) -> Duration {
        self.interval
    }
}
