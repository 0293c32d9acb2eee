//! From what actors want to what their bodies do.

use crate::Stage;
use crate::actor::Actor;
use crate::basis::prepared;
use crate::cast::Cast;
use crate::event::{Cause, CharacterEffect, Effect};
use crate::scene::{CharacterSpec, Scene};
use sinew_control::graph::Cause as GraphCause;
use sinew_control::source::{SourceEvent, StreamChange};
use sinew_control::tracker::{KdTracker, KinematicTracker, Limp, PdTracker, ResponseTracker, Tracker, TrackerKind};
use sinew_control::{OrderError, OrderErrorKind};
use sinew_response::Settings;
use sinew_world::{CharacterId, PropId, World};

impl Stage {
    /// Every actor decides, and its tracker tells the world.
    pub(crate) fn step_actors(&mut self) {
        let frame_secs = frame_secs(&self.scene);
        let mut events = Vec::new();
        let ids: Vec<CharacterId> = self.actors.keys().copied().collect();
        for index in ids {
            self.end_passing(index);
            let Some(actor) = self.actors.get_mut(&index) else { continue };
            actor.advance(&self.world, &mut events);
            for event in events.drain(..) {
                self.tell(index, event);
            }
            if let Some(actor) = self.actors.get_mut(&index) {
                actor.follow(&mut self.world, frame_secs);
            }
        }
    }

    /// Notes what a source of an actor has to tell, and does what follows from it.
    fn tell(&mut self, index: CharacterId, event: SourceEvent) {
        let (cause, effect) = match event {
            SourceEvent::Stream(StreamChange { presence, replaces_understudy }) => {
                (Cause::Stream, CharacterEffect::Performer { presence, replaces_understudy })
            }
            SourceEvent::Graph { cause, graph, from, to } => {
                let cause = match cause {
                    GraphCause::Touch(touch) => Cause::GraphTouch {
                        touched: [touch.a, touch.b].map(|thing| self.cast.name_of(thing)),
                        impulse_n_s: touch.impulse.length(),
                    },
                    GraphCause::Timer => Cause::GraphTimer,
                    GraphCause::Signal => Cause::GraphSignal,
                    GraphCause::Sensor(value) => Cause::GraphSensor { value },
                };
                (cause, CharacterEffect::Transition { graph, from, to })
            }
            SourceEvent::Reach(arrival) => return self.reach_arrives(index, &arrival),
        };
        let name = self.cast.character_name(index).to_owned();
        self.note(cause, Effect::of(name, effect));
    }

    /// Follows by another tracker from the next step on, from where the body is now.
    ///
    /// # Errors
    /// When the response finds no coordinates in the motion; all stays as it was.
    pub(crate) fn set_tracker(&mut self, index: CharacterId, kind: TrackerKind) -> Result<(), OrderError> {
        let spec = self.spec(index)?;
        let tracker = make_tracker(&self.scene, &self.cast, &self.world, self.actor(index)?, spec, kind)?;
        let floor_m = spec.position_m[1];
        if let Some(actor) = self.actors.get_mut(&index) {
            actor.set_tracker(tracker, floor_m, &mut self.world);
        }
        Ok(())
    }
}

/// A tracker for a character as the scene has it, at rest where the body is now.
pub(crate) fn make_tracker(
    scene: &Scene,
    cast: &Cast,
    world: &World,
    actor: &Actor,
    spec: &CharacterSpec,
    kind: TrackerKind,
) -> Result<Box<dyn Tracker>, OrderError> {
    let frame_secs = frame_secs(scene);
    let not_found = |problem: String| OrderError::new(OrderErrorKind::NotFound, problem);
    let here =
        world.frame().character(actor.id).ok_or_else(|| not_found("the character is not in the world".to_owned()))?;
    let now = here.pose();
    let prop = |name: &String| cast.prop(name).ok_or_else(|| not_found(format!("no prop `{name}`")));
    Ok(match kind {
        TrackerKind::Kinematic => Box::new(KinematicTracker::new(frame_secs, &now)),
        TrackerKind::Pd => Box::new(PdTracker::with(actor.springs().clone())),
        TrackerKind::None => Box::new(Limp),
        TrackerKind::Kd => {
            let settings = spec.kd.settings(|part| spec.node(part));
            let mut tracker = KdTracker::new(actor.body(), settings, frame_secs, &now);
            tracker.stand_on(world, spec.kd.stands_on.as_ref().map(prop).transpose()?);
            Box::new(tracker)
        }
        TrackerKind::Response => {
            let motion = actor.sources().own().motion();
            let gravity_m_s2 = world.settings().gravity_m_s2;
            let settings = Settings { time_step_secs: frame_secs, gravity_m_s2, ..Settings::default() };
            let prepared = prepared(spec, actor.body(), motion, settings)
                .map_err(|problem| OrderError::new(OrderErrorKind::WrongState, problem))?;
            let (basis, settings) = (prepared.basis().clone(), prepared.stable_settings());
            let mut tracker = ResponseTracker::new(actor.body().clone(), basis, settings, &now);
            tracker.stand_on(world, spec.response.stands_on.as_ref().map(prop).transpose()?);
            if let Some(part) = &spec.response.keep_upright {
                let node = spec.node(part).ok_or_else(|| not_found(format!("no part or alias `{part}`")))?;
                tracker.keep_upright(Some(node));
            }
            tracker.avoid(&spec.response.avoid.iter().map(prop).collect::<Result<Vec<PropId>, OrderError>>()?);
            Box::new(tracker)
        }
    })
}

/// Length of a motion frame \[s\].
fn frame_secs(scene: &Scene) -> f64 {
    1.0 / f64::from(scene.stage.motion_hz)
}
