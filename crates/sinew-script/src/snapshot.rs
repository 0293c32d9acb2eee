//! The input of a script in one step. Names are indices in [`Names`](crate::Names), so that the message is short.

use serde::{Deserialize, Serialize};

/// The world before a step, in world axes.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct Snapshot {
    /// Physics steps done.
    pub step: u64,
    /// Time since the start \[s\].
    pub time_secs: f64,
    /// Time between two calls of `step()` \[s\].
    pub step_secs: f64,
    /// Characters, in the order of [`Names::characters`](crate::Names::characters).
    pub characters: Vec<CharacterState>,
    /// Props, in the order of [`Names::objects`](crate::Names::objects).
    pub objects: Vec<ObjectState>,
    /// Joints of props, in the order of [`Names::joints`](crate::Names::joints).
    pub joints: Vec<JointState>,
    /// Contacts.
    pub contacts: Vec<Contact>,
}

/// A character.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct CharacterState {
    /// In the order of [`Names::parts`](crate::Names::parts).
    pub parts: Vec<PartState>,
    /// Centre of mass of the whole body \[m\].
    pub centre_of_mass: [f64; 3],
    /// Its velocity \[m/s\].
    pub centre_velocity: [f64; 3],
    /// Facing of the character: a horizontal unit vector.
    pub facing: [f64; 3],
    /// Corners of the support polygon \[m\]; empty in the air.
    pub support: Vec<[f64; 3]>,
    /// Attachments: which object to which part.
    pub attached: Vec<(usize, Thing)>,
}

/// A part of a character.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct PartState {
    /// Its joint to the parent \[m\].
    pub position: [f64; 3],
    /// `world_from_part`, x, y, z, w.
    pub rotation: [f64; 4],
    /// Velocity of its centre of mass \[m/s\].
    pub velocity: [f64; 3],
}

/// A prop.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct ObjectState {
    /// Its centre \[m\].
    pub position: [f64; 3],
    /// The centre's velocity \[m/s\].
    pub velocity: [f64; 3],
    /// `world_from_prop`, x, y, z, w.
    pub rotation: [f64; 4],
    /// Angular velocity \[rad/s\].
    pub spin: [f64; 3],
}

/// A joint of props.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct JointState {
    /// A hinge's angle \[degrees\], a slider's shift \[m\], else the distance of the ends \[m\].
    pub place: f64,
    /// Its rate of change \[rad/s, m/s\].
    pub speed: f64,
    /// Neither cut nor broken.
    pub is_whole: bool,
}

/// A body that can have contacts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Thing {
    /// The ground.
    Ground,
    /// A prop, by its place.
    Object(usize),
    /// A part of a character, by their places.
    Part(usize, usize),
}

/// A contact of two bodies.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Contact {
    /// One.
    pub a: Thing,
    /// The other.
    pub b: Thing,
    /// Where \[m\].
    pub point: [f64; 3],
    /// Impulse on `b` in the last step \[N s\]; `a` gets the opposite.
    pub impulse: [f64; 3],
}

impl Snapshot {
    /// Whether it is consistent with the names: a state for each, and no other index.
    pub(crate) fn fits(&self, names: &crate::Names) -> bool {
        let (parts, characters, objects) = (names.parts.len(), names.characters.len(), names.objects.len());
        let known = |thing: Thing| match thing {
            Thing::Ground => true,
            Thing::Object(object) => object < objects,
            Thing::Part(character, part) => character < characters && part < parts,
        };
        self.characters.len() == characters
            && self.objects.len() == objects
            && self.joints.len() == names.joints.len()
            && self.contacts.iter().all(|contact| known(contact.a) && known(contact.b))
            && self.characters.iter().all(|character| {
                character.parts.len() == parts
                    && character.attached.iter().all(|&(part, thing)| part < parts && known(thing))
            })
    }
}
