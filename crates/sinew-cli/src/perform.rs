//! `sinew perform`.

use crate::live::resolve;
use crate::{Reading, output};
use anyhow::{Context, Result, bail};
use sinew::live::{ClipPlayer, Impairment, RawPlayer};
use sinew::motion::Limits;
use sinew::motion::formats::{MotionFile, bytes_of};
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::io::Write;
use std::net::{SocketAddr, TcpStream, UdpSocket};
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Arguments of `sinew perform`.
#[derive(Debug, clap::Args)]
pub(crate) struct Perform {
    /// The motion file to play, forwards and backwards in turn; default: a generated walk.
    clip: Option<PathBuf>,
    /// The receiver: udp://127.0.0.1:39539 sends VMC; tcp://127.0.0.1:39541 sends a BVH raw, as some motion capture
    /// suits do, at its own rate.
    #[arg(long, value_name = "udp://HOST:PORT")]
    to: String,
    /// Frames a second. Default: 60.
    #[arg(long, value_name = "N")]
    fps: Option<f64>,
    /// Duration [s]. Default: until stopped.
    #[arg(long = "for", value_name = "SECONDS")]
    for_secs: Option<f64>,
    /// Delay of every datagram [ms].
    #[arg(long, value_name = "MS", default_value_t = 0.0, value_parser = millis)]
    delay: f64,
    /// Maximum additional delay (jitter) [ms].
    #[arg(long, value_name = "MS", default_value_t = 0.0, value_parser = millis)]
    jitter: f64,
    /// Share that is lost, 0 to 1.
    #[arg(long, value_name = "P", default_value_t = 0.0, value_parser = share)]
    loss: f64,
    /// Share that arrives twice, 0 to 1.
    #[arg(long, value_name = "P", default_value_t = 0.0, value_parser = share)]
    duplicate: f64,
    /// Share that is reordered: delayed by one to three frames, 0 to 1.
    #[arg(long, value_name = "P", default_value_t = 0.0, value_parser = share)]
    reorder: f64,
    /// Share that is corrupted: NaN, invalid quaternions, jumps, old time stamps, truncation; 0 to 1.
    #[arg(long, value_name = "P", default_value_t = 0.0, value_parser = share)]
    corrupt: f64,
    /// Seed of the random generator.
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    reading: Reading,
}

fn share(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "a number from 0 to 1 is expected")?;
    if (0.0..=1.0).contains(&value) { Ok(value) } else { Err("a number from 0 to 1 is expected".to_owned()) }
}

fn millis(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "milliseconds are expected")?;
    if (0.0..=60_000.0).contains(&value) { Ok(value) } else { Err("give 0 to 60000 milliseconds".to_owned()) }
}

impl Perform {
    pub(crate) fn run(&self) -> Result<()> {
        if self.for_secs.is_some_and(|secs| !(0.0..=1e9).contains(&secs)) {
            bail!("--for is out of range; give seconds");
        }
        match self.to.split_once("://") {
            Some(("udp", address)) => self.send_vmc(resolve(address)?),
            Some(("tcp", address)) => self.send_raw(resolve(address)?),
            _ => bail!("--to {}: write udp://HOST:PORT, such as udp://127.0.0.1:39539, or tcp://HOST:PORT", self.to),
        }
    }

    fn send_vmc(&self, to: SocketAddr) -> Result<()> {
        let file = match &self.clip {
            Some(path) => MotionFile::read(path, &self.reading.options())?,
            None => MotionFile::from_bvh(&sinew::stage::sample_walk_bvh()?, &self.reading.options())?,
        };
        let player = ClipPlayer::new(&file, self.fps.unwrap_or(60.0))?;
        let impairment = Impairment {
            delay_secs: self.delay / 1e3,
            jitter_secs: self.jitter / 1e3,
            loss: self.loss,
            duplicate: self.duplicate,
            reorder: self.reorder,
            corrupt: self.corrupt,
            seed: self.seed,
        };
        let socket = UdpSocket::bind(if to.is_ipv4() { "0.0.0.0:0" } else { "[::]:0" })?;
        let (frames, datagrams) = play(&player, &impairment, self.for_secs, |bytes| {
            // No receiver yet, or a full buffer: the next one is newer.
            let _ = socket.send_to(bytes, to);
        });
        output::say(&format!("performed {frames} frames in {datagrams} datagrams to {to}"))
    }

    fn send_raw(&self, to: SocketAddr) -> Result<()> {
        let shares = [self.delay, self.jitter, self.loss, self.duplicate, self.reorder, self.corrupt];
        if self.fps.is_some() || shares != [0.0; 6] {
            bail!(
                "--to tcp: a raw stream comes whole, in order and at the clip's rate; give no --fps, --delay, --jitter, \
                   --loss, --duplicate, --reorder and --corrupt, or send VMC by udp://"
            );
        }
        let bytes = match &self.clip {
            Some(path) => bytes_of(path, &Limits::default())?,
            None => sinew::stage::sample_walk_bvh()?,
        };
        let player = RawPlayer::new(&String::from_utf8_lossy(&bytes))
            .with_context(|| self.clip.as_ref().map_or("the walk".to_owned(), |path| path.display().to_string()))?;
        let stream = TcpStream::connect(to);
        let mut stream =
            stream.with_context(|| format!("nobody listens at {to}; run a scene with raw_port = {}", to.port()))?;
        stream.set_nodelay(true)?;
        stream.write_all(player.header().as_bytes())?;
        let began = Instant::now();
        let last = self.for_secs.map_or(u64::MAX, |secs| (secs / player.interval().as_secs_f64()).ceil() as u64);
        let mut frames = 0;
        while frames < last {
            std::thread::sleep(player.interval().mul_f64(frames as f64).saturating_sub(began.elapsed()));
            if stream.write_all(format!("{}\n", player.line(frames)).as_bytes()).is_err() {
                break;
            }
            frames += 1;
        }
        output::say(&format!("performed {frames} frames to {to}"))
    }
}

/// Sends every datagram when it is due; returns how many frames and datagrams there were.
fn play(
    player: &ClipPlayer,
    impairment: &Impairment,
    for_secs: Option<f64>,
    mut send: impl FnMut(&[u8]),
) -> (u64, u64) {
    let began = Instant::now();
    let last = for_secs.map_or(u64::MAX, |secs| (secs / player.interval_secs()).ceil() as u64);
    let mut under_way = BinaryHeap::new();
    let (mut frames, mut datagrams) = (0u64, 0u64);
    loop {
        let sent_secs = frames as f64 * player.interval_secs();
        let due = under_way.peek().map(|Reverse((arrival, _))| *arrival);
        let next = Duration::from_secs_f64(sent_secs);
        match due {
            Some(arrival) if frames >= last || arrival <= next => {
                std::thread::sleep(Duration::saturating_sub(arrival, began.elapsed()));
                if let Some(Reverse((_, bytes))) = under_way.pop() {
                    let bytes: Vec<u8> = bytes;
                    send(&bytes);
                    datagrams += 1;
                }
            }
            None if frames >= last => return (frames, datagrams),
            _ => {
                std::thread::sleep(next.saturating_sub(began.elapsed()));
                for (arrival_secs, bytes) in player.datagrams(frames, impairment) {
                    under_way.push(Reverse((Duration::from_secs_f64(arrival_secs), bytes)));
                }
                frames += 1;
            }
        }
    }
}
