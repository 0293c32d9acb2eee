//! All performers of a stage: their ports, and the latency from a sample's arrival to the frame that shows it.

use crate::port::{Port, PortCounters, PortError};
use sinew_control::{Action, Command};
use sinew_stage::{Scene, Stage};
use std::collections::BTreeMap;
use std::net::{IpAddr, SocketAddr};
use std::time::{Duration, Instant};

/// Maximum number of samples of one performer that a step takes: a sender of more than 1900 Hz at 240 steps a second
/// loses some.
const MAX_A_STEP: usize = 8;

/// Ports of a scene's performers.
///
/// Around every step call [`feed`](Performers::feed), [`Stage::step`], the code that sends the frame, and
/// [`shown`](Performers::shown).
#[derive(Debug, Default)]
pub struct Performers {
    performers: BTreeMap<String, Performer>,
}

#[derive(Debug)]
struct Performer {
    port: Port,
    latency: Latency,
    /// Arrivals of the samples of this step.
    waiting: Vec<Instant>,
}

impl Performers {
    /// Opens the port of every character whose source states one, on one address of this machine. Characters in
    /// `without` get no port: another input performs them.
    ///
    /// # Errors
    /// The first port that cannot be opened.
    pub fn open(scene: &Scene, address: IpAddr, without: &[String]) -> Result<Performers, PortError> {
        let mut performers = BTreeMap::new();
        for (name, character) in scene.characters.iter().filter(|(name, _)| !without.contains(name)) {
            let Some(live) = character.source.as_ref().and_then(|source| source.live.as_ref()) else { continue };
            let port = match (live.port, live.raw_port) {
                (Some(port), _) => Port::vmc(SocketAddr::new(address, port))?,
                (None, Some(port)) => Port::raw(SocketAddr::new(address, port))?,
                (None, None) => continue,
            };
            let waiting = Vec::with_capacity(MAX_A_STEP);
            performers.insert(name.clone(), Performer { port, latency: Latency::default(), waiting });
        }
        Ok(Performers { performers })
    }

    /// Whether no port is open.
    pub fn is_empty(&self) -> bool {
        self.performers.is_empty()
    }

    /// The characters with a port, and the addresses of the ports.
    pub fn addresses(&self) -> impl Iterator<Item = (&str, SocketAddr)> {
        self.performers.iter().map(|(name, performer)| (name.as_str(), performer.port.address()))
    }

    /// Passes the samples that have arrived to the stage, as commands for its next step.
    pub fn feed(&mut self, stage: &mut Stage) {
        for (name, performer) in &mut self.performers {
            for _ in 0..MAX_A_STEP {
                let Some((arrival, sample)) = performer.port.next() else { break };
                stage.command(Command::to(name.as_str(), Action::Perform { sample: Box::new(sample) }));
                performer.waiting.push(arrival);
            }
        }
    }

    /// Call when the frame with those samples has been sent: measures their latency.
    pub fn shown(&mut self) {
        let now = Instant::now();
        for performer in self.performers.values_mut() {
            for arrival in performer.waiting.drain(..) {
                performer.latency.add(now.duration_since(arrival));
            }
        }
    }

    /// A performer's port counters, and the latency from arrival to frame; `None` for a character without a port.
    pub fn of(&self, name: &str) -> Option<(PortCounters, &Latency)> {
        self.performers.get(name).map(|performer| (performer.port.counters(), &performer.latency))
    }
}

/// A latency histogram of constant size.
#[derive(Clone, Debug)]
pub struct Latency {
    buckets: Vec<u64>,
    count: u64,
}

/// Width of a bucket.
const BUCKET: Duration = Duration::from_micros(20);

/// Number of buckets: up to 200 ms; anything longer counts in the last one.
const BUCKETS: usize = 10_000;

impl Default for Latency {
    fn default() -> Latency {
        Latency { buckets: vec![0; BUCKETS], count: 0 }
    }
}

impl Latency {
    /// Adds one latency.
    pub fn add(&mut self, taken: Duration) {
        let bucket = (taken.as_nanos() / BUCKET.as_nanos()) as usize;
        self.buckets[bucket.min(BUCKETS - 1)] += 1;
        self.count += 1;
    }

    /// Adds all counts of another histogram.
    pub fn merge(&mut self, other: &Latency) {
        for (bucket, more) in self.buckets.iter_mut().zip(&other.buckets) {
            *bucket += more;
        }
        self.count += other.count;
    }

    /// A quantile, `share` from 0 to 1 \[ms\]; `None` for an empty histogram.
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
