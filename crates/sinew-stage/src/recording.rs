//! The recorded motion of a run, frame by frame, for files and pictures.

use crate::{Scene, Stage, StageError};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_world::{CharacterId, Frame, PartShape, Solid};

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
    /// Its name.
    pub name: String,
    /// Its body.
    pub body: Body,
    /// Its colour, where the scene states one.
    pub rgb: Option<[u8; 3]>,
    /// Its pose in every frame.
    pub poses: Vec<Pose>,
    /// Changes of a part's shape, with the first frame that shows each.
    pub shapes: Vec<(usize, Node, PartShape)>,
}

/// A prop's motion.
#[derive(Clone, Debug)]
pub struct RecordedProp {
    /// Its name.
    pub name: String,
    /// Its shape.
    pub solid: Solid,
    /// Its colour, where the scene states one.
    pub rgb: Option<[u8; 3]>,
    /// A sensor is not drawn.
    pub is_sensor: bool,
    /// `world_from_prop` in every frame.
    pub places: Vec<(DVec3, DQuat)>,
}

impl Recording {
    /// An empty recording of a stage.
    pub fn new(stage: &Stage) -> Recording {
        let world = stage.world();
        let bodies = world.frame().character_ids.iter().flatten().filter_map(|&id| world.body(id).cloned());
        Recording::of_bodies(stage.scene(), bodies)
    }

    /// An empty recording of a scene whose stage runs elsewhere; [`Recording::push_frame`] fills it.
    ///
    /// # Errors
    /// A clip of the scene cannot be read.
    pub fn of_scene(scene: &Scene) -> Result<Recording, StageError> {
        Ok(Recording::of_bodies(scene, crate::build::bodies(scene)?.into_iter()))
    }

    fn of_bodies(scene: &Scene, bodies: impl Iterator<Item = Body>) -> Recording {
        let characters = scene.characters.iter().zip(bodies).map(|((name, spec), body)| RecordedCharacter {
            name: name.clone(),
            body,
            rgb: spec.rgb(),
            poses: Vec::new(),
            shapes: Vec::new(),
        });
        let props = scene.props.iter().filter_map(|(name, spec)| {
            let solid = spec.solid()?;
            Some(RecordedProp {
                name: name.clone(),
                solid,
                rgb: spec.rgb(),
                is_sensor: spec.sensor,
                places: Vec::new(),
            })
        });
        Recording {
            motion_hz: f64::from(scene.stage.motion_hz),
            frames: 0,
            characters: characters.collect(),
            props: props.collect(),
        }
    }

    /// Records the present frame.
    pub fn push(&mut self, stage: &Stage) {
        for (slot, character) in self.characters.iter_mut().enumerate() {
            let id = CharacterId::first_in(slot);
            for node in Node::ALL {
                let shape = stage.shape_in_place_of_own(id, node).unwrap_or(&PartShape::Own);
                if character.shape(node, self.frames) != shape {
                    character.shapes.push((self.frames, node, shape.clone()));
                }
            }
        }
        self.push_frame(stage.world().frame());
    }

    /// Records a frame; parts keep the shapes of the previous frame.
    pub fn push_frame(&mut self, frame: &Frame) {
        for (character, seen) in self.characters.iter_mut().zip(&frame.characters) {
            character.poses.push(seen.pose());
        }
        for (prop, seen) in self.props.iter_mut().zip(&frame.props) {
            prop.places.push((seen.position, seen.rotation));
        }
        self.frames += 1;
    }

    /// Time of a frame \[s\].
    pub fn time_secs(&self, frame: usize) -> f64 {
        frame as f64 / self.motion_hz
    }
}

impl RecordedCharacter {
    /// The collision shape that a part has in a frame.
    pub fn shape(&self, node: Node, frame: usize) -> &PartShape {
        let changes = self.shapes.iter().rev();
        let mut known = changes.filter(|(from, part, _)| *part == node && *from <= frame);
        known.next().map_or(&PartShape::Own, |(.., shape)| shape)
    }
}
