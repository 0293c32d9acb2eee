//! Who plays whom.

use super::Refusal;
use super::limits::QUIET;
use std::collections::BTreeMap;
use std::time::Instant;

/// Actors and the connections that play them. `C` is what is needed to end a connection.
#[derive(Debug)]
pub(super) struct RoleAssignments<C> {
    /// Every actor of the scene.
    roles: BTreeMap<String, Option<Seat<C>>>,
}

#[derive(Debug)]
struct Seat<C> {
    client: u64,
    heard: Instant,
    connection: C,
}

impl<C: Clone> RoleAssignments<C> {
    pub(super) fn new(actors: &[String]) -> RoleAssignments<C> {
        RoleAssignments { roles: actors.iter().map(|actor| (actor.clone(), None)).collect() }
    }

    /// Gives actors to a client: all of them, or none and a reason. Returns the connections that lost theirs because nothing was
    /// heard of them.
    pub(super) fn claim(
        &mut self,
        client: u64,
        actors: &[String],
        connection: &C,
        now: Instant,
    ) -> Result<Vec<C>, Refusal> {
        for actor in actors {
            match self.roles.get(actor) {
                None => {
                    let known: Vec<&str> = self.roles.keys().map(String::as_str).collect();
                    let actor = super::message::short(actor);
                    return Err(Refusal::NoActor { actor, known: known.join(", ") });
                }
                Some(Some(seat)) if seat.client != client && now.saturating_duration_since(seat.heard) < QUIET => {
                    return Err(Refusal::Taken { actor: actor.clone() });
                }
                Some(_) => {}
            }
        }
        let mut lost = Vec::new();
        for actor in actors {
            let seat = Seat { client, heard: now, connection: connection.clone() };
            let before = self.roles.insert(actor.clone(), Some(seat)).flatten();
            lost.extend(before.filter(|before| before.client != client).map(|before| before.connection));
        }
        Ok(lost)
    }

    /// A client gave a sign of life. False when it has lost its actors to somebody else.
    pub(super) fn hear(&mut self, client: u64, actors: &[String], now: Instant) -> bool {
        actors.iter().all(|actor| match self.roles.get_mut(actor) {
            Some(Some(seat)) if seat.client == client => {
                seat.heard = now;
                true
            }
            _ => false,
        })
    }

    /// A client has left.
    pub(super) fn leave(&mut self, client: u64) {
        for seat in self.roles.values_mut() {
            if seat.as_ref().is_some_and(|seat| seat.client == client) {
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
        let mut roles = RoleAssignments::new(&red);
        assert_eq!(roles.claim(1, &red, &"first", now), Ok(vec![]));
        let soon = now + Duration::from_millis(500);
        assert!(matches!(roles.claim(2, &red, &"second", soon), Err(Refusal::Taken { .. })));
        assert_eq!(roles.claim(2, &red, &"second", now + QUIET), Ok(vec!["first"]));
        assert!(!roles.hear(1, &red, now + QUIET), "the first has lost it");
        roles.leave(1);
        assert!(roles.hear(2, &red, now + QUIET), "the first takes nothing away when it ends");
        roles.leave(2);
        assert_eq!(roles.claim(3, &red, &"third", now + QUIET), Ok(vec![]));
    }

    #[test]
    fn somebody_gets_all_actors_or_none() {
        let now = Instant::now();
        let both = ["blue".to_owned(), "red".to_owned()];
        let mut roles = RoleAssignments::new(&both);
        assert!(roles.claim(1, &both[1..], &(), now).is_ok());
        assert!(roles.claim(2, &both, &(), now).is_err());
        assert!(roles.claim(3, &both[..1], &(), now).is_ok(), "blue was left free");
        assert!(matches!(roles.claim(4, &["green".to_owned()], &(), now), Err(Refusal::NoActor { .. })));
    }
}
