//! A recording with all that its pictures show.

use super::marks::{HIT_N_S, HitMark, Marks};
use super::shapes::{add_solid, body_figure, custom};
use crate::jobs::camera::{across, change_m as change_of, follow};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Node, Pose};
use sinew_picture::{Arrow, Camera, Figure, Hit, Panel, Shade};
use sinew_stage::{RecordedCharacter, RecordedProp, Recording, Scene};
use sinew_world::PartShape;

/// A recording, the scene's camera, and what happened.
#[derive(Clone, Copy, Debug)]
pub struct Footage<'a> {
    /// The motion.
    pub recording: &'a Recording,
    /// The scene.
    pub scene: &'a Scene,
    /// What happened, where it is known.
    pub marks: &'a Marks,
}

/// Where a scene's camera stands when nothing else tells \[rad\].
const USUAL_RAD: f64 = std::f64::consts::FRAC_PI_3;

impl Footage<'_> {
    /// Where it is seen from.
    pub(super) fn camera(&self) -> Camera {
        match self.scene.camera.from_deg {
            Some(degrees) => Camera { azimuth_rad: degrees.to_radians(), elevation_rad: 0.2 },
            None => across(self.main_direction(), USUAL_RAD),
        }
    }

    /// That of the strongest push, else that in which characters go; zero where neither is.
    fn main_direction(&self) -> DVec3 {
        let pushes = self.marks.frames().iter().flat_map(|frame| &frame.pushes).map(|push| push.force_n);
        let level = |force: &DVec3| DVec3 { y: 0.0, ..*force }.length();
        if let Some(push) = pushes.filter(|force| level(force) > 0.0).max_by(|a, b| level(a).total_cmp(&level(b))) {
            return push;
        }
        let path = self.path();
        let way = path.last().zip(path.first()).map_or(DVec3::ZERO, |(end, start)| *end - *start);
        if way.length() > 0.5 { way } else { DVec3::ZERO }
    }

    /// The characters' middle in every frame; empty without characters.
    fn path(&self) -> Vec<DVec3> {
        let characters = &self.recording.characters;
        let middle = |frame: usize| {
            let hips = characters.iter().filter_map(|one| one.poses.get(frame)).map(|pose| pose.hips_position);
            DVec3 { y: 0.0, ..hips.sum::<DVec3>() / characters.len() as f64 }
        };
        if characters.is_empty() { Vec::new() } else { (0..self.recording.frames).map(middle).collect() }
    }

    /// What the camera follows in every frame; empty without characters.
    pub(super) fn followed(&self) -> Vec<DVec3> {
        follow(&self.path(), self.recording.motion_hz)
    }

    /// How far it has moved in every frame since the one before \[m\]: the mean over the joints of the character that moves most; where
    /// there is none, the prop that does.
    pub(super) fn change_m(&self) -> Vec<f64> {
        let recording = self.recording;
        let mut change_m = vec![0.0; recording.frames];
        for character in &recording.characters {
            for (change, own) in change_m.iter_mut().zip(change_of(&character.body, &character.poses)) {
                *change = f64::max(*change, own);
            }
        }
        for prop in recording.props.iter().filter(|prop| recording.characters.is_empty() && !prop.is_sensor) {
            for (change, pair) in change_m.iter_mut().skip(1).zip(prop.places.windows(2)) {
                *change = f64::max(*change, pair[0].0.distance(pair[1].0));
            }
        }
        change_m
    }

    /// Frames in which something happens, with how much each matters.
    pub(super) fn happens(&self) -> Vec<(usize, f64)> {
        let mut all = Vec::new();
        let mut pushed = false;
        for (index, frame) in self.marks.frames().iter().enumerate() {
            let hits = frame.hits.iter().map(|hit| hit.impulse_n_s).filter(|impulse| *impulse >= HIT_N_S);
            all.extend(hits.map(|impulse| (index, impulse)));
            let force = frame.pushes.iter().map(|push| push.force_n.length()).fold(0.0, f64::max);
            if !pushed && force > 0.0 {
                all.push((index, 1e3 + force));
            }
            pushed = force > 0.0;
        }
        let last = self.recording.frames.saturating_sub(1);
        let frame = |secs: f64| ((secs * self.recording.motion_hz + 1e-6).floor() as usize + 1).min(last);
        all.extend(self.marks.event_times().filter(|secs| *secs > 0.0).map(|secs| (frame(secs), HIT_N_S)));
        all
    }

    /// The picture at a place between frames, such as 2.4; marks are those of the frames after `since`, or from the start, until
    /// then.
    pub(super) fn panel(&self, at: f64, since: Option<usize>, followed: &[DVec3]) -> Panel {
        let recording = self.recording;
        let last = recording.frames.saturating_sub(1);
        let at = at.clamp(0.0, last as f64);
        let (frame, share) = (at.floor() as usize, at - at.floor());
        let next = (frame + 1).min(last);
        let mut panel = Panel { time_secs: at / recording.motion_hz, ..Panel::default() };
        for character in &recording.characters {
            let (Some(one), Some(other)) = (character.poses.get(frame), character.poses.get(next)) else { continue };
            let pose = between(one, other, share);
            body_figure(&mut panel.figure, &character.body, &pose, character.rgb);
            add_worn(&mut panel.figure, character, &pose, frame);
        }
        for prop in recording.props.iter().filter(|prop| !prop.is_sensor) {
            add_prop(&mut panel.objects, prop, frame, next, share);
        }
        panel.follow = followed.get(frame).zip(followed.get(next)).map(|(one, other)| one.lerp(*other, share));
        self.add_marks(&mut panel, frame, since);
        panel
    }

    fn add_marks(&self, panel: &mut Panel, frame: usize, since: Option<usize>) {
        let shown = |index: usize| self.marks.frame(index);
        let pushes = shown(frame).into_iter().flat_map(|marks| &marks.pushes);
        panel.arrows.extend(pushes.map(|push| Arrow { at: push.at, force_n: push.force_n, label: String::new() }));
        // Of every two that meet the strongest impact.
        let mut strongest: Vec<(usize, &HitMark)> = Vec::new();
        for index in since.map_or(0, |since| since + 1)..=frame {
            let hits = shown(index).into_iter().flat_map(|marks| &marks.hits);
            for hit in hits.filter(|hit| hit.impulse_n_s >= HIT_N_S) {
                match strongest.iter_mut().find(|(_, known)| known.is_of_the_same(hit)) {
                    Some(known) if known.1.impulse_n_s < hit.impulse_n_s => *known = (index, hit),
                    Some(_) => {}
                    None => strongest.push((index, hit)),
                }
            }
        }
        strongest.sort_by(|one, other| other.1.impulse_n_s.total_cmp(&one.1.impulse_n_s));
        let now = strongest.iter().filter(|(index, _)| index + HIT_FRAMES > frame).take(MAX_HITS);
        panel.hits.extend(now.map(|(_, hit)| Hit { at: hit.at, label: format!("{:.0} N s", hit.impulse_n_s) }));
        let mut words: Vec<String> = strongest.iter().map(|(_, hit)| hit.words()).collect();
        let secs = |index: usize| index as f64 / self.recording.motion_hz;
        let from_secs = since.map_or(-1.0, |since| secs(since) - 1e-9);
        words.extend(self.marks.events_between(from_secs, secs(frame).max(1e-8) - 1e-9).map(str::to_owned));
        panel.caption = words.join("; ");
    }
}

/// Frames for which an impact stays marked.
const HIT_FRAMES: usize = 6;

/// Marked impacts of a picture; of a heap of bodies nothing else would be seen.
const MAX_HITS: usize = 5;

/// The pose a share of the way from one to another.
fn between(one: &Pose, other: &Pose, share: f64) -> Pose {
    if share == 0.0 {
        return *one;
    }
    let mut pose = *one;
    pose.hips_position = one.hips_position.lerp(other.hips_position, share);
    for (rotation, to) in pose.world.iter_mut().zip(other.world) {
        *rotation = rotation.slerp(to, share);
    }
    pose
}

fn add_prop(objects: &mut Figure, prop: &RecordedProp, frame: usize, next: usize, share: f64) {
    let (Some(one), Some(other)) = (prop.places.get(frame), prop.places.get(next)) else { return };
    let place: (DVec3, DQuat) = (one.0.lerp(other.0, share), one.1.slerp(other.1, share));
    add_solid(objects, &prop.solid, place, prop.rgb.map_or(Shade::Object, custom));
}

/// Shapes that parts have in place of their own, such as skis.
fn add_worn(figure: &mut Figure, character: &RecordedCharacter, pose: &Pose, frame: usize) {
    let positions = pose.positions(&character.body);
    for node in Node::ALL {
        if let PartShape::Other(solid) = character.shape(node, frame) {
            add_solid(figure, solid, (positions[node.index()], pose.world[node.index()]), Shade::Object);
        }
    }
}
