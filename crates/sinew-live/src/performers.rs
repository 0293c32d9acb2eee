//! All performers of a stage: their ports, and how long their samples take to show.

use crate::port::{Port, PortCounters, PortError};
use sinew_control::{Action, Command};
use sinew_stage::{Scene, Stage};
use std::collections::BTreeMap;
use std::net::{IpAddr, SocketAddr};
use std::time::{Duration, Instant};

/// Samples of one performer that a step takes: a sender of more than 1900 Hz at 240 steps a second loses some.
const MAX_A_STEP: usize = 8;

/// Ports of a scene's performers.
///
/// Around every step: [`feed`](Performers::feed), [`Stage::step`], what sends the frame, [`shown`](Performers::shown).
#[derive(Debug, Default)]
pub struct Performers {
    heard: BTreeMap<String, Performer>,
}

#[derive(Debug)]
struct Performer {
    port: Port,
    latency: Latency,
    /// Arrivals of the samples of this step.
    waiting: Vec<Instant>,
}

impl Performers {
    /// Opens the port of every character whose source states one, on one address of this machine. Characters in `without` are
    /// left out: somebody else performs them.
    ///
    /// # Errors
    /// The first port that cannot be opened.
    pub fn open(scene: &Scene, address: IpAddr, without: &[String]) -> Result<Performers, PortError> {
        let mut heard = BTreeMap::new();
        for (name, character) in scene.characters.iter().filter(|(name, _)| !without.contains(name)) {
            let Some(live) = character.source.as_ref().and_then(|source| source.live.as_ref()) else { continue };
            let port = match (live.port, live.raw_port) {
                (Some(port), _) => Port::vmc(SocketAddr::new(address, port))?,
                (None, Some(port)) => Port::raw(SocketAddr::new(address, port))?,
                (None, None) => continue,
            };
            let waiting = Vec::with_capacity(MAX_A_STEP);
            heard.insert(name.clone(), Performer { port, latency: Latency::default(), waiting });
        }
        Ok(Performers { heard })
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.heard.is_empty()
    }

    /// Who is listened for, and where.
    pub fn addresses(&self) -> impl Iterator<Item = (&str, SocketAddr)> {
        self.heard.iter().map(|(name, performer)| (name.as_str(), performer.port.address()))
    }

    /// Gives the stage the samples that have arrived, as commands for its next step.
    pub fn feed(&mut self, stage: &mut Stage) {
        for (name, performer) in &mut self.heard {
            for _ in 0..MAX_A_STEP {
                let Some((arrival, sample)) = performer.port.next() else { break };
                stage.command(Command::to(name.as_str(), Action::Perform { sample: Box::new(sample) }));
                performer.waiting.push(arrival);
            }
        }
    }

    /// The frame that has those samples in it is out.
    pub fn shown(&mut self) {
        let now = Instant::now();
        for performer in self.heard.values_mut() {
            for arrival in performer.waiting.drain(..) {
                performer.latency.add(now.duration_since(arrival));
            }
        }
    }

    /// What a performer's port has heard, and how long samples took from there to a frame; `None` for who has no port.
    pub fn of(&self, name: &str) -> Option<(PortCounters, &Latency)> {
        self.heard.get(name).map(|performer| (performer.port.counters(), &performer.latency))
    }
}

/// How long something takes: a histogram of constant size.
#[derive(Clone, Debug)]
pub struct Latency {
    buckets: Vec<u64>,
    count: u64,
}

/// Width of a bucket.
const BUCKET: Duration = Duration::from_micros(20);

/// Buckets: up to 200 ms; all that takes longer is in the last one.
const BUCKETS: usize = 10_000;

impl Default for Latency {
    fn default() -> Latency {
        Latency { buckets: vec![0; BUCKETS], count: 0 }
    }
}

impl Latency {
    /// Adds one.
    pub fn add(&mut self, taken: Duration) {
        let bucket = (taken.as_nanos() / BUCKET.as_nanos()) as usize;
        self.buckets[bucket.min(BUCKETS - 1)] += 1;
        self.count += 1;
    }

    /// Adds all of another one.
    pub fn join(&mut self, other: &Latency) {
        for (bucket, more) in self.buckets.iter_mut().zip(&other.buckets) {
            *bucket += more;
        }
        self.count += other.count;
    }

    /// The time that a share of all stays below \[ms\]; `None` when there are none.
    pub fn quantile_ms(&self, share: f64) -> Option<f64> {
        let wanted = ((self.count as f64 * share).ceil() as u64).max(1);
        let mut seen = 0;
        let bucket = self.buckets.iter().position(|count| {
            seen += count;
            seen >= wanted
        })?;
        Some((bucket as f64 + 1.0) * BUCKET.as_secs_f64() * 1e3)
    }
}
