//! What eyes see of a push: the clip that `respond` writes beside the clip that it read, as poses of the 18 bodies.
#![allow(clippy::unwrap_used, dead_code, reason = "a test that cannot go on fails; claims use a part each")]

use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Person, Pose, Reduction};
use sinew_body::measure::Changed;
use sinew_motion::formats::{MotionFile, ReadOptions};
use sinew_motion::{Clip, Part, floor_height_m};
use sinew_response::{Disturbances, Excerpt, PreparedClip, Push, PushFrame, Settings, Track};
use sinew_testkit::{mocap, repository, work};
use std::ops::Range;

/// The clips at which the motion was judged by eye, or their like, and the time \[s\] at which each is pushed: a walk, a run, a
/// pick-up, a walk with a box, a side step, a boxer, a punch, a swing, a box lifted, a chair, a dance, a jump, a form, a loop of
/// a game.
pub const CLIPS: [(&str, f64); 14] = [
    ("accad_bvh/Female1_B03_Walk1.bvh", 1.5),
    ("accad_bvh/Female1_C03_Run.bvh", 0.5),
    ("accad_bvh/Female1_A05_PickUpBox.bvh", 2.2),
    ("accad_bvh/Female1_B20_WalkWithBox.bvh", 1.2),
    ("accad_bvh/Female1_B22_SideStepLeft.bvh", 0.6),
    ("accad_bvh/Male2_E1_JabLeft.bvh", 0.5),
    ("cmu_bvh_60hz_trimmed/143_23_punch.bvh", 1.0),
    ("accad_bvh/Female1_A03_Swing.bvh", 1.5),
    ("accad_bvh/Female1_A06_LiftBox.bvh", 3.0),
    ("cmu_bvh_60hz_trimmed/113_15_sit.bvh", 2.0),
    ("dialects/rokoko_jesse_dance.bvh", 3.0),
    ("cmu_bvh_motionbuilder/06_15.bvh", 1.5),
    ("accad_bvh/Male2_Form_1.bvh", 5.0),
    ("gltf/CesiumMan.glb", 0.6),
];

/// Looked at after a push \[s\], by which everything has come back.
const WINDOW_SECS: f64 = 5.0;

/// Where a push acts, from where, how hard \[N\] and how long \[s\].
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    pub part: Part,
    pub force_n: DVec3,
    pub for_secs: f64,
}

/// The pushes of the review: four parts, backward; chest and hips from the side too; a tap, a blow, a car, and a long push.
pub fn kinds() -> Vec<Kind> {
    let mut kinds = Vec::new();
    for (part, aside) in [(Part::Chest, true), (Part::Head, false), (Part::RightHand, false), (Part::Hips, true)] {
        for direction in [DVec3::NEG_Z, DVec3::X].into_iter().take(1 + usize::from(aside)) {
            for (newtons, for_secs) in [(100.0, 0.1), (300.0, 0.1), (1000.0, 0.1), (100.0, 2.0)] {
                kinds.push(Kind { part, force_n: direction * newtons, for_secs });
            }
        }
    }
    kinds
}

/// A clip, ready to be pushed.
pub struct Scene {
    pub name: String,
    pub prepared: PreparedClip,
    pub body: Body,
    pub at_secs: f64,
    pub floor_m: f64,
    /// The clip's own poses.
    pub input: Vec<Pose>,
}

impl Scene {
    pub fn of_clip(name: &str, clip: &Clip, file: &MotionFile, at_secs: f64) -> Scene {
        let humanoid = file.body_parts().unwrap();
        let reduction = Reduction::new(clip, humanoid, file.stature_m, Person::default()).unwrap();
        let prepared = PreparedClip::new(clip, humanoid, reduction, Excerpt::default(), Settings::default()).unwrap();
        prepared.motion().stable_settings();
        Scene {
            name: name.to_owned(),
            body: prepared.motion().body().clone(),
            input: poses(&prepared, clip),
            floor_m: floor_height_m(clip, humanoid),
            prepared,
            at_secs,
        }
    }

    pub fn load(name: &str, at_secs: f64) -> Option<Scene> {
        let path = if name.starts_with("samples/") { repository(name) } else { mocap()?.join(name) };
        let file = MotionFile::read(&path, &ReadOptions::default()).unwrap();
        Some(Scene::of_clip(name, &file.clip, &file, at_secs))
    }

    /// The same with other settings.
    pub fn with(&self, settings: Settings) -> Scene {
        let prepared = self.prepared.with_settings(settings).unwrap();
        prepared.motion().stable_settings();
        Scene { prepared, name: self.name.clone(), body: self.body.clone(), input: self.input.clone(), ..*self }
    }

    pub fn frame_secs(&self) -> f64 {
        self.prepared.clip().frame_time_secs()
    }

    pub fn push(&self, kind: Kind) -> Seen<'_> {
        let push = Push {
            part: kind.part,
            point: None,
            force_n: kind.force_n,
            frame: PushFrame::Facing,
            at_secs: self.at_secs,
            for_secs: kind.for_secs,
        };
        let track = self.prepared.motion().run(Disturbances { pushes: &[push], ground: &[] });
        let ours = poses(&self.prepared, &self.prepared.applied(&track));
        Seen { scene: self, kind, track, ours }
    }
}

fn poses(prepared: &PreparedClip, clip: &Clip) -> Vec<Pose> {
    let mut world = Vec::new();
    (0..clip.frames())
        .map(|frame| {
            clip.world_into(frame, &mut world);
            prepared.reduction().pose(&world)
        })
        .collect()
}

/// The sample walk and [`CLIPS`], as far as they are there.
pub fn scenes() -> Vec<Scene> {
    let mut clips = vec![("samples/walk.bvh", 1.5)];
    clips.extend(CLIPS);
    work(&clips, |&(name, at_secs)| Scene::load(name, at_secs)).into_iter().flatten().collect()
}

/// What a push did to a clip.
pub struct Seen<'a> {
    pub scene: &'a Scene,
    pub kind: Kind,
    pub track: Track,
    /// The poses of the clip that was written.
    pub ours: Vec<Pose>,
}

impl Seen<'_> {
    pub fn name(&self) -> String {
        let Kind { part, force_n, for_secs } = self.kind;
        format!("{}, {part} {force_n} N for {for_secs} s", self.scene.name)
    }

    pub fn changed(&self) -> Changed<'_> {
        Changed { ours: &self.ours, input: &self.scene.input, frame_secs: self.scene.frame_secs() }
    }

    /// The frames from a time after the push's end on \[s\], as long as it is looked at.
    pub fn after(&self, secs: f64) -> Range<usize> {
        let frame = |secs: f64| (secs / self.scene.frame_secs()).ceil() as usize;
        let end_secs = self.scene.at_secs + self.kind.for_secs;
        frame(end_secs + secs)..frame(end_secs + WINDOW_SECS).min(self.ours.len())
    }

    /// At a frame, by how far a node of ours is turned in the world from the input's \[rad\].
    pub fn turned(&self, frame: usize, node: Node) -> f64 {
        let world = |poses: &[Pose]| poses[frame].world[node.index()];
        sinew_body::humanoid::log(world(&self.ours) * world(&self.scene.input).conjugate()).length()
    }
}
