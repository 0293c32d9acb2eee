//! What a performer's port has to say while it runs: once, on the standard error.

use sinew::live::Performers;
use std::time::{Duration, Instant};

/// Interval at which the counters are looked at.
const LOOK: Duration = Duration::from_secs(1);

/// Datagrams of another performer from which on it is said: fewer come when a program is started again.
const MANY_FOREIGN: u64 = 30;

/// Malformed datagrams from which on it is said: a bad network makes some.
const MANY_MALFORMED: u64 = 30;

/// Says once for each performer and cause why its datagrams are dropped; the summary and the report have the numbers.
#[derive(Default)]
pub(crate) struct PortWords {
    looked: Option<Instant>,
    told: Vec<(String, &'static str)>,
}

impl PortWords {
    /// Looks at the counters once a second.
    pub fn look(&mut self, performers: &Performers) {
        if self.looked.is_some_and(|looked| looked.elapsed() < LOOK) {
            return;
        }
        self.looked = Some(Instant::now());
        for (name, address) in performers.addresses() {
            let Some((counters, _)) = performers.of(name) else { continue };
            let causes = [
                (
                    counters.foreign >= MANY_FOREIGN,
                    "a second program or machine sends bones to this port, and its datagrams are dropped; stop it, or give it \
                     a port of its own",
                ),
                (
                    counters.malformed >= MANY_MALFORMED,
                    "many datagrams are malformed and dropped; check that the sender uses VMC",
                ),
                (
                    counters.goes_by_arrival,
                    "the sender's clock stands still or is out of range; its samples are timed by their arrival",
                ),
            ];
            for (_, words) in causes.into_iter().filter(|(holds, _)| *holds) {
                let is_told = self.told.iter().any(|(whom, told)| whom == name && *told == words);
                if !is_told {
                    eprintln!("{name} at {address}: {words}");
                    self.told.push((name.to_owned(), words));
                }
            }
        }
    }
}
