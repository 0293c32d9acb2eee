//! A moving prop as carrier: the frame of the performer's motion moves with it.

use glam::{DQuat, DVec3};
use sinew_world::{PropId, World};

/// The displacement and rotation of a prop since the character stepped on it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Carrier {
    prop: PropId,
    start: (DVec3, DQuat),
}

/// The transform of a carrier at an instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Carried {
    start: DVec3,
    place: DVec3,
    turn: DQuat,
    centre: DVec3,
    velocity: DVec3,
    spin: DVec3,
}

sinew_snapshot::snapshot!(Carrier { prop, start });

impl Carrier {
    pub(super) fn new(world: &World, prop: PropId) -> Option<Carrier> {
        let state = world.frame().prop(prop)?;
        Some(Carrier { prop, start: (state.position, state.rotation) })
    }

    /// Its number in the world.
    pub(super) fn prop(&self) -> PropId {
        self.prop
    }

    /// The prop as it is now.
    pub(super) fn now(&self, world: &World) -> Option<Carried> {
        let state = world.frame().prop(self.prop)?;
        Some(Carried {
            start: self.start.0,
            place: state.position,
            turn: (state.rotation * self.start.1.conjugate()).normalize(),
            centre: state.centre,
            velocity: state.velocity,
            spin: state.angular_velocity,
        })
    }
}

impl Carried {
    pub(super) fn place(&self, point: DVec3) -> DVec3 {
        self.place + self.turn * (point - self.start)
    }

    pub(super) fn rotation(&self, rotation: DQuat) -> DQuat {
        (self.turn * rotation).normalize()
    }

    pub(super) fn direction(&self, direction: DVec3) -> DVec3 {
        self.turn * direction
    }

    /// World velocity of a point that moves relative to the carrier.
    pub(super) fn velocity(&self, velocity: DVec3, at: DVec3) -> DVec3 {
        self.turn * velocity + self.velocity + self.spin.cross(at - self.centre)
    }

    /// A world velocity relative to the carrier: the inverse of [`Carried::velocity`].
    pub(super) fn without(&self, velocity: DVec3, at: DVec3) -> DVec3 {
        self.turn.conjugate() * (velocity - self.velocity - self.spin.cross(at - self.centre))
    }

    pub(super) fn place_back(&self, place: DVec3) -> DVec3 {
        self.start + self.turn.conjugate() * (place - self.place)
    }

    pub(super) fn rotation_back(&self, rotation: DQuat) -> DQuat {
        (self.turn.conjugate() * rotation).normalize()
    }
}
