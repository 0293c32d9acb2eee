//! The recorded motion of a run, frame by frame, for files and pictures.

use crate::scene::{CharacterSpec, PropSpec};
use crate::{Scene, Stage, StageError};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_world::{CharacterFrame, CharacterId, Frame, PartShape, PropId, Solid};

/// A run at the motion rate.
#[derive(Clone, Debug, Default)]
pub struct Recording {
    /// Frames a second.
    pub motion_hz: f64,
    /// Number of frames so far; the first is the start.
    pub frames: usize,
    /// Every character, in the order of the stage.
    pub characters: Vec<RecordedCharacter>,
    /// Every prop, in the order of the stage.
    pub props: Vec<RecordedProp>,
}

/// A character's motion.
#[derive(Clone, Debug)]
pub struct RecordedCharacter {
    /// Its id on the stage.
    pub id: CharacterId,
    /// Its name.
    pub name: String,
    /// Its body.
    pub body: Body,
    /// Its colour, where the scene states one.
    pub rgb: Option<[u8; 3]>,
    /// Its pose in every frame: before it came its first one, after it went its last.
    pub poses: Vec<Pose>,
    /// Changes of a part's shape, with the first frame that shows each.
    pub shapes: Vec<(usize, Node, PartShape)>,
}

/// A prop's motion.
#[derive(Clone, Debug)]
pub struct RecordedProp {
    /// Its id on the stage.
    pub id: PropId,
    /// Its name.
    pub name: String,
    /// Its shape.
    pub solid: Solid,
    /// Its colour, where the scene states one.
    pub rgb: Option<[u8; 3]>,
    /// A sensor is not drawn.
    pub is_sensor: bool,
    /// `world_from_prop` in every frame: before it came its first place, after it went its last.
    pub places: Vec<(DVec3, DQuat)>,
}

impl Recording {
    /// An empty recording of a stage.
    pub fn new(stage: &Stage) -> Recording {
        let motion_hz = f64::from(stage.scene().stage.motion_hz);
        let mut recording = Recording { motion_hz, ..Recording::default() };
        recording.take_in(stage);
        recording
    }

    /// An empty recording of a scene whose stage runs elsewhere; [`Recording::push_frame`] fills it.
    ///
    /// # Errors
    /// A clip of the scene cannot be read.
    pub fn of_scene(scene: &Scene) -> Result<Recording, StageError> {
        let characters = scene.characters.iter().zip(crate::build::bodies(scene)?).enumerate();
        let characters = characters.map(|(slot, ((name, spec), body))| RecordedCharacter {
            id: CharacterId::first_in(slot),
            name: name.clone(),
            body,
            rgb: spec.rgb(),
            poses: Vec::new(),
            shapes: Vec::new(),
        });
        let props = scene.props.iter().enumerate();
        let props = props.filter_map(|(slot, (name, spec))| recorded_prop(PropId::first_in(slot), name, spec));
        Ok(Recording {
            motion_hz: f64::from(scene.stage.motion_hz),
            frames: 0,
            characters: characters.collect(),
            props: props.collect(),
        })
    }

    /// Records the present frame.
    pub fn push(&mut self, stage: &Stage) {
        self.take_in(stage);
        for character in &mut self.characters {
            for node in Node::ALL {
                let shape = stage.shape_in_place_of_own(character.id, node).unwrap_or(&PartShape::Own);
                if character.shape(node, self.frames) != shape {
                    character.shapes.push((self.frames, node, shape.clone()));
                }
            }
        }
        self.push_frame(stage.world().frame());
    }

    /// Takes in who and what has come since the frame before.
    fn take_in(&mut self, stage: &Stage) {
        let (scene, world) = (stage.scene(), stage.world());
        for (id, name) in stage.cast().characters() {
            if self.characters.iter().any(|known| known.id == id) {
                continue;
            }
            let (Some(body), Some(seen)) = (world.body(id).cloned(), world.frame().character(id)) else { continue };
            let rgb = scene.characters.get(name).and_then(CharacterSpec::rgb);
            let poses = vec![seen.pose(); self.frames];
            self.characters.push(RecordedCharacter { id, name: name.to_owned(), body, rgb, poses, shapes: Vec::new() });
        }
        for (id, name) in stage.cast().props() {
            if self.props.iter().any(|known| known.id == id) {
                continue;
            }
            let recorded = scene.props.get(name).and_then(|spec| recorded_prop(id, name, spec));
            let (Some(recorded), Some(seen)) = (recorded, world.frame().prop(id)) else { continue };
            self.props.push(RecordedProp { places: vec![(seen.position, seen.rotation); self.frames], ..recorded });
        }
    }

    /// Records a frame; parts keep the shapes of the previous frame. What is no longer there, its slot vacant or used by another,
    /// keeps its last place.
    ///
    /// ```
    /// use sinew_stage::{Recording, Scene, Stage};
    /// use sinew_world::BodyState;
    /// let scene = Scene::from_text("format = 1\n[props.ball]\nball_radius_m = 0.1\nmass_kg = 1\nposition_m = [0, 1, 0]")?;
    /// let mut recording = Recording::of_scene(&scene)?;
    /// let mut frame = Stage::new(scene, None)?.frame().clone();
    /// recording.push_frame(&frame);
    /// (frame.props[0], frame.prop_ids[0]) = (BodyState::REST, None);
    /// recording.push_frame(&frame);
    /// assert_eq!(recording.props[0].places[1].0.y, 1.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn push_frame(&mut self, frame: &Frame) {
        for character in &mut self.characters {
            let seen = frame.character(character.id).map(CharacterFrame::pose);
            let pose = seen.or_else(|| character.poses.last().cloned()).unwrap_or(Pose::STANDING);
            character.poses.push(pose);
        }
        for prop in &mut self.props {
            let seen = frame.prop(prop.id).map(|seen| (seen.position, seen.rotation));
            let place = seen.or_else(|| prop.places.last().copied()).unwrap_or_default();
            prop.places.push(place);
        }
        self.frames += 1;
    }

    /// Time of a frame \[s\].
    pub fn time_secs(&self, frame: usize) -> f64 {
        frame as f64 / self.motion_hz
    }
}

fn recorded_prop(id: PropId, name: &str, spec: &PropSpec) -> Option<RecordedProp> {
    let (rgb, is_sensor) = (spec.rgb(), spec.sensor);
    Some(RecordedProp { id, name: name.to_owned(), solid: spec.solid()?, rgb, is_sensor, places: Vec::new() })
}

impl RecordedCharacter {
    /// The collision shape that a part has in a frame.
    pub fn shape(&self, node: Node, frame: usize) -> &PartShape {
        let changes = self.shapes.iter().rev();
        let mut known = changes.filter(|(from, part, _)| *part == node && *from <= frame);
        known.next().map_or(&PartShape::Own, |(.., shape)| shape)
    }
}
