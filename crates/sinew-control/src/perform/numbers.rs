//! Sequence numbers of a stream: which have arrived, and how many are lost.

use sinew_snapshot::snapshot;

/// A window of the last sequence numbers, and the count of all.
#[derive(Clone, Debug)]
pub(super) struct Numbers {
    /// One bit a number, by the number modulo the window.
    seen: [u64; WORDS],
    span: Option<Span>,
    /// Missing numbers of earlier runs: a restarted sender counts from a new start.
    lost_before: u64,
}

#[derive(Clone, Copy, Debug, Default)]
struct Span {
    lowest: u64,
    highest: u64,
    distinct: u64,
}

const WORDS: usize = 32;

/// Size of the window.
const WINDOW: u64 = 64 * WORDS as u64;

snapshot!(Span { lowest, highest, distinct }
    valid |span| span.lowest <= span.highest && span.distinct <= (span.highest - span.lowest).saturating_add(1));
snapshot!(Numbers { seen, span, lost_before } valid |numbers| numbers.lost_before <= u64::MAX / 2);

impl Numbers {
    pub fn new() -> Numbers {
        Numbers { seen: [0; WORDS], span: None, lost_before: 0 }
    }

    /// Registers a number. False for a duplicate, or for one older than the window.
    pub fn take(&mut self, number: u64) -> bool {
        let Some(span) = &mut self.span else {
            self.begin(number);
            return true;
        };
        if number > span.highest {
            let ahead = number - span.highest;
            if ahead >= WINDOW {
                // Not a gap, but a new count.
                self.lost_before += span.lost();
                self.begin(number);
                return true;
            }
            for between in span.highest + 1..=number {
                self.seen[word(between)] &= !bit(between);
            }
            span.highest = number;
        } else if span.highest - number >= WINDOW || self.seen[word(number)] & bit(number) != 0 {
            return false;
        }
        span.lowest = span.lowest.min(number);
        span.distinct += 1;
        self.seen[word(number)] |= bit(number);
        true
    }

    /// Resets for a restarted sender.
    pub fn restart(&mut self, number: u64) {
        self.lost_before += self.span.map_or(0, |span| span.lost());
        self.begin(number);
    }

    fn begin(&mut self, number: u64) {
        self.seen = [0; WORDS];
        self.seen[word(number)] |= bit(number);
        self.span = Some(Span { lowest: number, highest: number, distinct: 1 });
    }

    /// Whether the sender numbers its samples.
    pub fn any(&self) -> bool {
        self.span.is_some()
    }

    /// Numbers between the first and the last that have not arrived.
    pub fn lost(&self) -> u64 {
        self.lost_before + self.span.map_or(0, |span| span.lost())
    }
}

impl Span {
    fn lost(&self) -> u64 {
        (self.highest - self.lowest).saturating_add(1).saturating_sub(self.distinct)
    }
}

fn word(number: u64) -> usize {
    (number % WINDOW / 64) as usize
}

fn bit(number: u64) -> u64 {
    1 << (number % 64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_not_come_is_lost_whatever_the_order() {
        let mut numbers = Numbers::new();
        for number in [5, 7, 6, 10, 7, 9, 4] {
            numbers.take(number);
        }
        assert_eq!(numbers.lost(), 1, "8 is missing");
        assert!(!numbers.take(9) && numbers.take(8));
        assert_eq!(numbers.lost(), 0);
    }

    #[test]
    fn a_count_that_begins_elsewhere_costs_nothing() {
        let mut numbers = Numbers::new();
        for number in [1, 3, u64::MAX, u64::MAX - 1] {
            assert!(numbers.take(number));
        }
        assert!(!numbers.take(0), "too old to know");
        assert_eq!(numbers.lost(), 1);
        numbers.restart(0);
        assert!(numbers.take(1) && numbers.lost() == 1);
    }
}
