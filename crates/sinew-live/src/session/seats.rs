//! Who plays whom.

use super::Refusal;
use super::limits::QUIET;
use std::collections::BTreeMap;
use std::time::Instant;

/// Actors and the connections that play them. `C` is what is needed to end a connection.
#[derive(Debug)]
pub(super) struct Seats<C> {
    /// Every actor of the scene.
    seats: BTreeMap<String, Option<Seat<C>>>,
}

#[derive(Debug)]
struct Seat<C> {
    guest: u64,
    heard: Instant,
    connection: C,
}

impl<C: Clone> Seats<C> {
    pub(super) fn new(actors: &[String]) -> Seats<C> {
        Seats { seats: actors.iter().map(|actor| (actor.clone(), None)).collect() }
    }

    /// Gives actors to a guest: all of them, or none and a reason. Returns the connections that lost theirs because nothing was
    /// heard of them.
    pub(super) fn claim(
        &mut self,
        guest: u64,
        actors: &[String],
        connection: &C,
        now: Instant,
    ) -> Result<Vec<C>, Refusal> {
        for actor in actors {
            match self.seats.get(actor) {
                None => {
                    let known: Vec<&str> = self.seats.keys().map(String::as_str).collect();
                    let actor = super::message::short(actor);
                    return Err(Refusal::NoActor { actor, known: known.join(", ") });
                }
                Some(Some(seat)) if seat.guest != guest && now.saturating_duration_since(seat.heard) < QUIET => {
                    return Err(Refusal::Taken { actor: actor.clone() });
                }
                Some(_) => {}
            }
        }
        let mut lost = Vec::new();
        for actor in actors {
            let seat = Seat { guest, heard: now, connection: connection.clone() };
            let before = self.seats.insert(actor.clone(), Some(seat)).flatten();
            lost.extend(before.filter(|before| before.guest != guest).map(|before| before.connection));
        }
        Ok(lost)
    }

    /// A guest gave a sign of life. False when it has lost its actors to somebody else.
    pub(super) fn hear(&mut self, guest: u64, actors: &[String], now: Instant) -> bool {
        actors.iter().all(|actor| match self.seats.get_mut(actor) {
            Some(Some(seat)) if seat.guest == guest => {
                seat.heard = now;
                true
            }
            _ => false,
        })
    }

    /// A guest has left.
    pub(super) fn leave(&mut self, guest: u64) {
        for seat in self.seats.values_mut() {
            if seat.as_ref().is_some_and(|seat| seat.guest == guest) {
                *seat = None;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn a_quiet_actor_is_given_away_and_a_living_one_is_not() {
        let now = Instant::now();
        let red = ["red".to_owned()];
        let mut seats = Seats::new(&red);
        assert_eq!(seats.claim(1, &red, &"first", now), Ok(vec![]));
        let soon = now + Duration::from_millis(500);
        assert!(matches!(seats.claim(2, &red, &"second", soon), Err(Refusal::Taken { .. })));
        assert_eq!(seats.claim(2, &red, &"second", now + QUIET), Ok(vec!["first"]));
        assert!(!seats.hear(1, &red, now + QUIET), "the first has lost it");
        seats.leave(1);
        assert!(seats.hear(2, &red, now + QUIET), "the first takes nothing away when it ends");
        seats.leave(2);
        assert_eq!(seats.claim(3, &red, &"third", now + QUIET), Ok(vec![]));
    }

    #[test]
    fn somebody_gets_all_actors_or_none() {
        let now = Instant::now();
        let both = ["blue".to_owned(), "red".to_owned()];
        let mut seats = Seats::new(&both);
        assert!(seats.claim(1, &both[1..], &(), now).is_ok());
        assert!(seats.claim(2, &both, &(), now).is_err());
        assert!(seats.claim(3, &both[..1], &(), now).is_ok(), "blue was left free");
        assert!(matches!(seats.claim(4, &["green".to_owned()], &(), now), Err(Refusal::NoActor { .. })));
    }
}
