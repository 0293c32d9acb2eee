//! Orders to reach: what they name is found on the stage, and what hands take hold of is held.

use crate::Stage;
use crate::actor::Actor;
use crate::event::{Cause, CharacterEffect, Effect, ReachTarget};
use crate::stage::gone;
use sinew_body::humanoid::{Node, Pose, exp};
use sinew_control::source::{ReachArrival, ReachSource};
use sinew_control::tracker::TrackerKind;
use sinew_control::{OrderError, OrderErrorKind, ReachOrder};
use sinew_reach::{Goal, Reacher, Start, Style};
use sinew_world::{BodyState, CharacterFrame, CharacterId, Entity, PropId};

/// A reach under way, to look at.
#[derive(Clone, Copy, Debug)]
pub struct ReachNow<'a> {
    /// Counts the character's reaches, from 1.
    pub number: u64,
    /// Who plans it. Its poses are what is wanted, not where the body is.
    pub reacher: &'a Reacher,
    /// When it was ordered, in the reacher's time \[s\].
    pub since_secs: f64,
    /// Now, in the reacher's time \[s\].
    pub now_secs: f64,
    /// Where the hands are to be now, world \[m\].
    pub goal: Goal,
}

impl Stage {
    /// Begins to reach, from whatever pose the character is in. None when it does so already.
    pub(crate) fn begin_reach(
        &mut self,
        index: CharacterId,
        order: &ReachOrder<PropId>,
    ) -> Result<Option<CharacterEffect>, OrderError> {
        let style = Style {
            flexibility: order.flexibility,
            speed_m_s: order.speed_m_s.filter(|_| order.time_secs.is_none()),
            time_secs: order.time_secs,
            seed: self.scene.stage.seed.wrapping_add(index.slot() as u64),
            // The first character of a scene that states no seed does it plainly.
            manner_seed: Some(self.scene.stage.seed.wrapping_add(index.slot() as u64).wrapping_sub(1)),
            ..Style::default()
        };
        if self.actor(index)?.sources.reach().is_some_and(|reach| reach.is_about(order)) {
            return Ok(None);
        }
        let aimed = self.aim_of(index, order)?;
        let obstacles = self.obstacles(&order.avoid)?;
        let frame = self.world.frame();
        let now_secs = frame.time_secs;
        let start = self.start_of(self.actor(index)?, self.character_frame(index)?, now_secs);
        let flight = self.flight_of(&aimed);
        let actor = self.actors.get_mut(&index).ok_or_else(|| gone(index))?;
        let mut reach = match actor.sources.take_reach() {
            // On from the reach before: nothing jumps.
            Some(mut before) => before.restyle(&style, now_secs).map(|()| before),
            None => {
                let step_secs = self.world.settings().step_secs();
                ReachSource::new(actor.body(), index, &style, &start, now_secs, step_secs)
            }
        }
        .map_err(|error| OrderError::new(OrderErrorKind::OutOfRange, error.to_string()))?;
        actor.reaches += 1;
        reach.order(order, aimed, &obstacles, frame, flight.as_ref(), actor.reaches);
        let (goal, outcome) = (reach.goal(frame), reach.reacher().outcome());
        let point = || ReachTarget::Point(goal.left.or(goal.right).unwrap_or_default());
        let effect = CharacterEffect::Reaches {
            target: order.object.map_or_else(point, |prop| ReachTarget::Object(self.cast.prop_name(prop).to_owned())),
            in_secs: outcome.arrives_secs - reach.own_secs(now_secs),
            steps: outcome.steps.len(),
            fails: outcome.reason,
            late: outcome.is_late,
        };
        actor.sources.set_reach(reach);
        self.pass_through(index, &aimed);
        Ok(Some(effect))
    }

    /// Stands up from a reach and goes back to what was before. False when there is none.
    pub(crate) fn end_reach(&mut self, index: CharacterId) -> bool {
        let now_secs = self.world.frame().time_secs;
        let reach = self.actors.get_mut(&index).and_then(|actor| actor.sources.reach_mut());
        reach.is_some_and(|reach| reach.leave_at(now_secs))
    }

    /// The reach that a character is about, if it reaches now.
    pub fn reach_of(&self, character: CharacterId) -> Option<ReachNow<'_>> {
        let frame = self.world.frame();
        let reach = self.actors.get(&character)?.sources.reach().filter(|reach| reach.is_reaching())?;
        Some(ReachNow {
            number: reach.number(),
            reacher: reach.reacher(),
            since_secs: reach.since_secs(),
            now_secs: reach.own_secs(frame.time_secs),
            goal: reach.goal(frame),
        })
    }

    /// The wanted pose and how it moves; of a body that springs or nothing drives, its own.
    fn start_of(&self, actor: &Actor, character: &CharacterFrame, now_secs: f64) -> Start {
        let ago = 1.0 / f64::from(self.scene.stage.motion_hz);
        if matches!(actor.tracker().kind(), TrackerKind::Kinematic | TrackerKind::Response)
            && actor.sources.own().motion().is_some()
        {
            let before = actor.sources.pose_at(now_secs - ago);
            return Start { pose: actor.sources.pose_at(now_secs), before: Some((before, ago)) };
        }
        let pose = character.pose();
        let speed = character.centre_velocity.length();
        let before = (speed > STILL_M_S).then(|| (earlier(&character.parts, &pose, ago), ago));
        Start { pose, before }
    }

    /// The hands of a reach should be there.
    pub(crate) fn reach_arrives(&mut self, index: CharacterId, arrival: &ReachArrival) {
        let who = self.cast.character_name(index).to_owned();
        let mut notes = Vec::new();
        for hand in &arrival.hands {
            notes.push(CharacterEffect::HandArrives { node: hand.node, gap_m: hand.gap_m });
        }
        for held in arrival.hands.iter().filter_map(|hand| hand.holds) {
            self.world.attach(held);
            if let Entity::Prop(prop) = held.object {
                notes.push(CharacterEffect::Holds { node: held.node, object: self.cast.prop_name(prop).to_owned() });
            }
        }
        for note in notes {
            self.note(Cause::ReachArrives, Effect::of(&who, note));
        }
    }
}

/// A body slower than this begins at rest \[m/s\].
const STILL_M_S: f64 = 0.15;

/// The pose a moment before, by the parts' velocities.
fn earlier(parts: &[BodyState; Node::COUNT], pose: &Pose, ago: f64) -> Pose {
    let mut before = *pose;
    for node in Node::ALL {
        let spin = parts[node.index()].angular_velocity;
        before.world[node.index()] = (exp(spin * -ago) * pose.world[node.index()]).normalize();
    }
    let hips = &parts[0];
    let arm = hips.position - hips.centre;
    let velocity = hips.velocity + hips.angular_velocity.cross(arm);
    before.hips_position -= velocity * ago;
    before
}
