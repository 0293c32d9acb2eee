//! Descriptions of characters and props for a world.

use crate::{CharacterId, PropId, PropJointId, Solid, Surface};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Pose};

/// Description of a character, from which a ragdoll is made. It takes effect with
/// [`World::add_character`](crate::World::add_character), which refuses what is out of range.
#[derive(Clone, Debug)]
pub struct CharacterSpec {
    /// Masses, lengths, limits: every part 1e-6 to 1e6 kg and 0.1 mm to 10 km.
    pub body: Body,
    /// Its initial pose, world; within 10 km of the origin.
    pub pose: Pose,
    /// Velocity of the whole body at the start \[m/s\], world, shortened to 400 m/s.
    pub velocity: DVec3,
    /// Of its skin and soles. [`Surface::BODY`] is usual.
    pub surface: Surface,
}

/// How a prop moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// Dynamic: moved by forces and contacts.
    Dynamic {
        /// Mass \[kg\], 1e-6 to 1e9.
        mass_kg: f64,
    },
    /// Never moves.
    Fixed,
    /// Kinematic: moves as commanded, and nothing stops it: a platform.
    Moving,
}

/// A prop. It takes effect with [`World::add_prop`](crate::World::add_prop), which refuses what is out of range;
/// [`PropSpec::new`] states the defaults.
#[derive(Clone, Debug, PartialEq)]
pub struct PropSpec {
    /// Its shape about its origin; sizes 0.1 mm to 10 km.
    pub solid: Solid,
    /// The kind of its motion.
    pub motion: Motion,
    /// Its friction and restitution. Default friction 0.6, bounce 0.2.
    pub surface: Surface,
    /// Initial position of its origin \[m\], world; within 10 km of the world's origin.
    pub position: DVec3,
    /// `world_from_prop` at the start. Default no turn.
    pub rotation: DQuat,
    /// Velocity at the start \[m/s\], world, shortened to 400 m/s. Default zero.
    pub velocity: DVec3,
    /// Angular velocity at the start \[rad/s\], world, shortened to 500 rad/s. Default zero.
    pub spin: DVec3,
    /// A sensor: detects contacts without collision response. Default false.
    pub is_sensor: bool,
    /// Factor on gravity \[1\], clamped to −100 to 100. Default 1; see [`World::set_prop_gravity`](crate::World::set_prop_gravity).
    pub gravity_scale: f64,
    /// Linear and angular damping \[1/s\], clamped to 0 to 1000. Default 0.
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
