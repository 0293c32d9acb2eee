//! Descriptions of characters and props for a world.

use crate::{CharacterId, PropId, PropJointId, Solid, Surface};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Pose};

/// Description of a character, from which a ragdoll is made.
#[derive(Clone, Debug)]
pub struct CharacterSpec {
    /// Masses, lengths, limits.
    pub body: Body,
    /// Its initial pose.
    pub pose: Pose,
    /// Velocity of the whole body \[m/s\].
    pub velocity: DVec3,
    /// Of its skin and soles.
    pub surface: Surface,
}

/// How a prop moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// Dynamic: moved by forces and contacts, with this mass \[kg\].
    Dynamic {
        /// Mass.
        mass_kg: f64,
    },
    /// Never moves.
    Fixed,
    /// Kinematic: moves as commanded, and nothing stops it: a platform.
    Moving,
}

/// A prop.
#[derive(Clone, Debug, PartialEq)]
pub struct PropSpec {
    /// Its shape about its origin.
    pub solid: Solid,
    /// The kind of its motion.
    pub motion: Motion,
    /// Its friction and restitution.
    pub surface: Surface,
    /// Position of its origin \[m\].
    pub position: DVec3,
    /// `world_from_prop`.
    pub rotation: DQuat,
    /// Velocity \[m/s\].
    pub velocity: DVec3,
    /// Angular velocity \[rad/s\].
    pub spin: DVec3,
    /// A sensor: detects contacts without collision response.
    pub is_sensor: bool,
    /// Factor on gravity.
    pub gravity_scale: f64,
    /// Linear and angular damping \[1/s\].
    pub drag_per_s: f64,
}

impl PropSpec {
    /// A prop at rest.
    pub fn new(solid: Solid, motion: Motion, position: DVec3) -> PropSpec {
        PropSpec {
            solid,
            motion,
            surface: Surface { friction: 0.6, bounce: 0.2 },
            position,
            rotation: DQuat::IDENTITY,
            velocity: DVec3::ZERO,
            spin: DVec3::ZERO,
            is_sensor: false,
            gravity_scale: 1.0,
            drag_per_s: 0.0,
        }
    }
}

/// Why something cannot be added to a world.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SpecError {
    /// Numbers that are not finite, or beyond the world's bounds.
    #[error("a place, rotation or velocity is not a finite number, or farther than 10 km from the origin")]
    NotFinite,
    /// A mesh without triangles, or hull points in a plane.
    #[error(
        "the shape has no volume or no triangles, or a size that is not between 0.1 mm and 10 km; \
         give a hull four points that do not lie in a plane"
    )]
    NoShape,
    /// Too many shapes were added to a character.
    #[error("the character has as many added shapes as it can have; remove one first")]
    TooManyShapes,
    /// A dynamic triangle mesh.
    #[error("a mesh of triangles has no inside and cannot be dynamic; make it fixed, or use its hull")]
    HollowMesh,
    /// A joint that cannot be made.
    #[error(
        "the joint cannot be made: it needs two different things, points within the world, an axis, lengths, gains and forces above \
         0, a range around 0, and a motor only on a hinge or a slider"
    )]
    NoJoint,
    /// There is no such character, any more or at all.
    #[error("there is no character {0}: it was removed, or the id is another world's; ask for it again")]
    StaleCharacter(CharacterId),
    /// There is no such prop, any more or at all.
    #[error("there is no prop {0}: it was removed, or the id is another world's; ask for it again")]
    StaleProp(PropId),
    /// There is no such joint of props, any more or at all.
    #[error("there is no joint {0}: it was removed, or the id is another world's; ask for it again")]
    StalePropJoint(PropJointId),
    /// A mass, size or inertia that is not above 0, or out of range.
    #[error("{0} has no mass or no size, or one that is not a sound number")]
    NoMass(&'static str),
}
