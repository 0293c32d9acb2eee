//! Which client plays which actor.

use super::Refusal;
use super::limits::ACTOR_TIMEOUT;
use std::collections::BTreeMap;
use std::time::Instant;

/// Actors and the clients that play them. `C` is a handle with which a connection can be closed.
#[derive(Debug)]
pub(super) struct RoleAssignments<C> {
    /// Every actor of the scene.
    roles: BTreeMap<String, Option<Assignment<C>>>,
}

#[derive(Debug)]
struct Assignment<C> {
    client: u64,
    last_alive: Instant,
    connection: C,
}

impl<C: Clone> RoleAssignments<C> {
    pub(super) fn new(actors: &[String]) -> RoleAssignments<C> {
        RoleAssignments { roles: actors.iter().map(|actor| (actor.clone(), None)).collect() }
    }

    /// Assigns actors to a client: all of them, or none and a reason. Returns the connections that lost an actor
    /// because they sent no keep-alive within [`ACTOR_TIMEOUT`].
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
                Some(Some(assignment))
                    if assignment.client != client
                        && now.saturating_duration_since(assignment.last_alive) < ACTOR_TIMEOUT =>
                {
                    return Err(Refusal::Taken { actor: actor.clone() });
                }
                Some(_) => {}
            }
        }
        let mut lost = Vec::new();
        for actor in actors {
            let assignment = Assignment { client, last_alive: now, connection: connection.clone() };
            let before = self.roles.insert(actor.clone(), Some(assignment)).flatten();
            lost.extend(before.filter(|before| before.client != client).map(|before| before.connection));
        }
        Ok(lost)
    }

    /// Notes a keep-alive of a client. False when it has lost its actors to another client.
    pub(super) fn keep_alive(&mut self, client: u64, actors: &[String], now: Instant) -> bool {
        actors.iter().all(|actor| match self.roles.get_mut(actor) {
            Some(Some(assignment)) if assignment.client == client => {
                assignment.last_alive = now;
                true
            }
            _ => false,
        })
    }

    /// Frees the actors of a client that has left.
    pub(super) fn leave(&mut self, client: u64) {
        for assignment in self.roles.values_mut() {
            if assignment.as_ref().is_some_and(|assignment| assignment.client == client) {
                *assignment = None;
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
        assert_eq!(roles.claim(2, &red, &"second", now + ACTOR_TIMEOUT), Ok(vec!["first"]));
        assert!(!roles.keep_alive(1, &red, now + ACTOR_TIMEOUT), "the first has lost it");
        roles.leave(1);
        assert!(roles.keep_alive(2, &red, now + ACTOR_TIMEOUT), "the first takes nothing away when it ends");
        roles.leave(2);
        assert_eq!(roles.claim(3, &red, &"third", now + ACTOR_TIMEOUT), Ok(vec![]));
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
