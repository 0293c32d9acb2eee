//! Inspection of a motion file.

use serde::Serialize;
use sinew_body::humanoid::{Node, Person, Reduction};
use sinew_motion::formats::{AnimationInfo, MotionFile};
use sinew_motion::{Origin, find_cycle, find_defects, floor_height_m, moves_from};
use sinew_response::{Excerpt, PreparedClip, Settings};
use std::collections::BTreeMap;

/// The answer of `sinew inspect`; units are in the names.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Inspection {
    /// The file.
    pub file: String,
    /// `bvh`, `amc`, `gltf`, `glb`, `vrm`, `vrma` or `fbx`.
    pub format: String,
    /// How many frames.
    pub frames: usize,
    /// Frames per second.
    pub fps: f64,
    /// Duration \[s\].
    pub duration_s: f64,
    /// Length of one file unit \[m\].
    pub unit_m: f64,
    /// Standing height of the body \[m\]; null if it is not a human body.
    pub stature_m: Option<f64>,
    /// Why the skeleton is not a human body; null if it is one.
    pub no_body: Option<String>,
    /// All animations of the file, in its order; empty for formats that hold one without a name.
    pub animations: Vec<AnimationReport>,
    /// The joints in the file's order.
    pub joints: Vec<JointReport>,
    /// Mass of each part of the person \[kg\].
    pub mass_kg: BTreeMap<String, f64>,
    /// First and last frame of the gait cycle, from 0; null without a gait.
    pub cycle: Option<(usize, usize)>,
    /// Its duration \[s\].
    pub cycle_s: Option<f64>,
    /// The first frame that belongs to the motion.
    pub first_frame: usize,
    /// Where the floor is \[m\], Y up.
    pub floor_height_m: Option<f64>,
    /// The actuation spectrum of the upper body: root mean square torque along each direction \[N m\], descending.
    pub actuation_n_m: Vec<f64>,
    /// Number of near-unactuated ("quiet") coordinates of the 24: they use less than a hundredth of the largest torque.
    pub quiet_coordinates: usize,
    /// Defects of the data.
    pub defects: Vec<DefectReport>,
    /// What was guessed, repaired or lost in reading.
    pub notes: Vec<String>,
}

/// One animation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AnimationReport {
    /// Its name; empty where the file gives it none.
    pub name: String,
    /// Number of frames that its keys make; 0 where they cannot be read.
    pub frames: usize,
    /// Frames per second.
    pub fps: f64,
    /// Whether it is the one that was read and inspected.
    pub is_read: bool,
}

/// One joint.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct JointReport {
    /// The file's name.
    pub name: String,
    /// The body part; null for a joint without one.
    pub part: Option<String>,
    /// Whether the part was guessed from the skeleton's shape rather than read from the name.
    pub guessed: bool,
    /// The parent's name.
    pub parent: Option<String>,
}

/// One defect.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DefectReport {
    /// What kind, such as `Frozen`.
    pub kind: String,
    /// First and last frame; null when it concerns the whole clip.
    pub frames: Option<(usize, usize)>,
    /// The joint, where it is one.
    pub joint: Option<String>,
    /// As text.
    pub text: String,
}

/// Coordinates that use less than this of the largest torque are quiet.
const QUIET: f64 = 0.01;

/// Inspects a file.
///
/// ```
/// use sinew::body::humanoid::Person;
/// use sinew::jobs::inspect::inspect;
/// use sinew::motion::formats::{MotionFile, ReadOptions};
/// let walk = MotionFile::from_bvh(&sinew::stage::sample_walk_bvh()?, &ReadOptions::default())?;
/// let inspection = inspect(&walk, Person::default());
/// assert_eq!(inspection.joints.len(), walk.clip.skeleton().joints().len());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn inspect(file: &MotionFile, person: Person) -> Inspection {
    let clip = &file.clip;
    let joints = clip.skeleton().joints();
    let humanoid = file.humanoid.as_ref().ok();
    let mut inspection = Inspection {
        file: file.path.display().to_string(),
        format: file.format.to_string(),
        frames: clip.frames(),
        fps: clip.fps(),
        duration_s: clip.duration_secs(),
        unit_m: file.space.unit_m,
        stature_m: None,
        no_body: file.humanoid.as_ref().err().map(ToString::to_string),
        animations: file
            .animations
            .iter()
            .map(|AnimationInfo { name, frames, fps, is_read }| AnimationReport {
                name: name.clone(),
                frames: *frames,
                fps: *fps,
                is_read: *is_read,
            })
            .collect(),
        joints: joints
            .iter()
            .enumerate()
            .map(|(index, joint)| {
                let part = humanoid.and_then(|humanoid| humanoid.part(index));
                JointReport {
                    name: joint.name.clone(),
                    part: part.map(|part| part.name().to_owned()),
                    guessed: part.is_some_and(|part| humanoid.and_then(|h| h.origin(part)) == Some(Origin::Shape)),
                    parent: joint.parent.map(|parent| joints[parent].name.clone()),
                }
            })
            .collect(),
        mass_kg: BTreeMap::new(),
        cycle: None,
        cycle_s: None,
        first_frame: 0,
        floor_height_m: None,
        actuation_n_m: Vec::new(),
        quiet_coordinates: 0,
        defects: Vec::new(),
        notes: file.notes.iter().map(ToString::to_string).collect(),
    };
    let Some(humanoid) = humanoid else { return inspection };
    inspection.stature_m = Some(file.stature_m);
    inspection.first_frame = moves_from(clip, humanoid);
    inspection.cycle = find_cycle(clip, humanoid).map(|cycle| (cycle.first, cycle.last));
    inspection.cycle_s = inspection.cycle.map(|(first, last)| (last - first) as f64 * clip.frame_time_secs());
    inspection.floor_height_m = Some(floor_height_m(clip, humanoid));
    inspection.defects = find_defects(clip, humanoid)
        .into_iter()
        .map(|defect| DefectReport {
            kind: format!("{:?}", defect.kind),
            frames: defect.frames,
            joint: defect.joint.map(|joint| joints[joint].name.clone()),
            text: defect.text,
        })
        .collect();
    match Reduction::new(clip, humanoid, file.stature_m, person) {
        Ok(reduction) => {
            let mass = |node: &Node| (node.part().name().to_owned(), reduction.body().link(*node).mass_kg);
            inspection.mass_kg = Node::ALL.iter().map(mass).collect();
            let excerpt = Excerpt { cycle: inspection.cycle, repeat: 0 };
            if let Ok(prepared) = PreparedClip::new(clip, humanoid, reduction, excerpt, Settings::default()) {
                let basis = prepared.motion().basis();
                inspection.actuation_n_m = basis.eigenvalues().iter().map(|value| value.sqrt()).collect();
                let largest = inspection.actuation_n_m[0];
                inspection.quiet_coordinates =
                    inspection.actuation_n_m.iter().filter(|&&torque| torque <= QUIET * largest).count();
            }
        }
        Err(error) => inspection.notes.push(error.to_string()),
    }
    inspection
}
