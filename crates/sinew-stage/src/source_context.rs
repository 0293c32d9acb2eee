//! What sources of a scene are made from: clips on a character's body, its key poses, its names.

use crate::Stage;
use crate::motion_source::{self, Play};
use crate::scene::{CharacterSpec, Scene};
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_control::source::{ClipPlay, ClipSource, KeyPoses, PoseBook, Source as _, SourceContext, SourceSpec};
use sinew_control::tracker::TrackerKind;
use sinew_control::{OrderError, OrderErrorKind};
use sinew_world::CharacterId;
use std::sync::Arc;

/// A character's body, and the clips that its source plays.
pub(crate) struct Cut {
    pub body: Body,
    pub clips: Vec<(ClipPlay, ClipSource)>,
}

/// The body of a character, from a clip's skeleton if it has one, with limits as wide as its clips move.
pub(crate) fn cut(scene: &Scene, spec: &CharacterSpec) -> Result<Cut, String> {
    let plays = spec.source.as_ref().map_or_else(Vec::new, SourceSpec::clips);
    let Some(skeleton) = spec.clip.as_ref().or(plays.first().map(|play| &play.file)) else {
        return Ok(Cut { body: Body::standard(spec.mass_kg, spec.height_m.unwrap_or(1.7)), clips: Vec::new() });
    };
    let file = motion_source::read(scene, skeleton)?;
    let reduction = motion_source::reduction(&file, spec)?;
    let mut body = reduction.body().clone();
    let mut clips: Vec<(ClipPlay, ClipSource)> = Vec::new();
    for play in &plays {
        let how = how(scene, spec.tracker, play);
        let clip = if play.file == *skeleton {
            motion_source::clip_source(&file, &reduction, spec, &how)?
        } else {
            read_clip(scene, spec, &how, play)?
        };
        widen(&mut body, clip.poses().iter().chain(clip.motion().unwrap_or_default()), spec.tracker);
        clips.push((play.clone(), clip));
    }
    Ok(Cut { body, clips })
}

/// Widens the limits of a body to the poses of its clip. One that the response moves goes through all of them, and between two frames a
/// little beyond: its limits get some room where the clip comes to them, and its knees their turn about X in any case.
fn widen<'a>(body: &mut Body, poses: impl Iterator<Item = &'a Pose>, tracker: TrackerKind) {
    let before = Node::ALL.map(|node| body.link(node).limit);
    let has_room = tracker == TrackerKind::Response;
    for pose in poses {
        body.widen_limits(pose);
        for knee in [Node::LeftLowerLeg, Node::RightLowerLeg].into_iter().filter(|_| has_room) {
            let limit = &mut body.link_mut(knee).limit;
            let bent = limit.centre.conjugate() * pose.local(knee);
            // Within half a turn.
            let angle = 2.0 * libm::atan(bent.x / if bent.w == 0.0 { f64::MIN_POSITIVE } else { bent.w });
            limit.swing.x_positive = limit.swing.x_positive.max(angle);
            limit.swing.x_negative = limit.swing.x_negative.max(-angle);
        }
    }
    for node in Node::ALL.into_iter().filter(|_| has_room) {
        let (limit, before) = (&mut body.link_mut(node).limit, &before[node.index()]);
        let room = |now: f64, before: f64| if now > before { now + ROOM_RAD } else { now };
        limit.swing.x_positive = room(limit.swing.x_positive, before.swing.x_positive);
        limit.swing.x_negative = room(limit.swing.x_negative, before.swing.x_negative);
        limit.swing.z_positive = room(limit.swing.z_positive, before.swing.z_positive);
        limit.swing.z_negative = room(limit.swing.z_negative, before.swing.z_negative);
        limit.twist = (-room(-limit.twist.0, -before.twist.0), room(limit.twist.1, before.twist.1));
    }
}

/// How far a limit lies beyond what the clip does \[rad\]: a cubic between two frames of a quick turn strays by a degree or two.
const ROOM_RAD: f64 = 0.05;

pub(crate) fn how(scene: &Scene, tracker: TrackerKind, play: &ClipPlay) -> Play {
    Play {
        hz: f64::from(scene.stage.motion_hz),
        start_secs: play.start_secs,
        repeats: play.repeats,
        until_secs: scene.stage.duration_secs,
        is_filtered: tracker == TrackerKind::Response,
        stands_on_floor: tracker == TrackerKind::Kd,
    }
}

fn read_clip(scene: &Scene, spec: &CharacterSpec, how: &Play, play: &ClipPlay) -> Result<ClipSource, String> {
    let file = motion_source::read(scene, &play.file)?;
    let reduction = motion_source::reduction(&file, spec)?;
    motion_source::clip_source(&file, &reduction, spec, how)
}

/// A character of a scene, at the start or in the middle of a run.
pub(crate) struct Context<'a> {
    pub scene: &'a Scene,
    pub spec: &'a CharacterSpec,
    pub tracker: TrackerKind,
    pub book: &'a Arc<PoseBook>,
    /// The key pose that it begins in.
    pub first: &'a str,
    pub step_secs: f64,
    /// Clips that are read already.
    pub clips: &'a [(ClipPlay, ClipSource)],
    /// In the middle of a run: the stage's time \[s\], the body, and the pose in which a clip is to begin.
    pub running: Option<(f64, &'a Body, Pose)>,
}

impl SourceContext for Context<'_> {
    fn key_poses(&self) -> KeyPoses {
        KeyPoses::new(Arc::clone(self.book), self.first, self.step_secs)
    }

    fn clip(&self, play: &ClipPlay) -> Result<ClipSource, OrderError> {
        let known = self.clips.iter().find(|(known, _)| known == play);
        let mut clip = match known {
            Some((_, clip)) => clip.clone(),
            None => read_clip(self.scene, self.spec, &how(self.scene, self.tracker, play), play)
                .map_err(|problem| OrderError::new(OrderErrorKind::NotFound, problem))?,
        };
        if let Some((now_secs, body, at)) = &self.running {
            clip.begin_in(body, *now_secs, at);
        }
        Ok(clip)
    }

    fn node(&self, name: &str) -> Option<Node> {
        self.spec.node(name)
    }

    fn now_secs(&self) -> f64 {
        self.running.as_ref().map_or(0.0, |(now_secs, ..)| *now_secs)
    }
}

impl Stage {
    /// Follows another source from now on, from where the body is.
    pub(crate) fn follow_source(&mut self, id: CharacterId, source: &SourceSpec) -> Result<(), OrderError> {
        let spec = self.spec(id)?;
        let frame = self.world.frame();
        let actor = self.actor(id)?;
        let context = Context {
            scene: &self.scene,
            spec,
            tracker: actor.tracker().kind(),
            book: actor.sources.book(),
            first: actor.sources.first(),
            step_secs: self.world.settings().step_secs(),
            clips: &[],
            running: Some((frame.time_secs, actor.body(), self.character_frame(id)?.pose())),
        };
        let nothing = || OrderError::new(OrderErrorKind::Contradiction, "it states no source of its own");
        let own = source.build(&context)?.ok_or_else(nothing)?;
        let now_secs = frame.time_secs;
        self.actor_mut(id)?.sources.follow_from(own, source, now_secs);
        Ok(())
    }
}
