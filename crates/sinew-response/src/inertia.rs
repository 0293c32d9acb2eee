//! Rigid-body inertia about a common origin.

use glam::{DMat3, DQuat, DVec3};

/// Mass, first and second moment of one or several bodies about a common origin, world axes: inertias of bodies simply
/// add.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Inertia {
    pub mass: f64,
    /// Mass times centre \[kg m\].
    pub first: DVec3,
    /// Inertia about the origin \[kg m²\].
    pub second: DMat3,
}

impl Inertia {
    pub(crate) const NOTHING: Inertia = Inertia { mass: 0.0, first: DVec3::ZERO, second: DMat3::ZERO };

    /// A body with moments `own` along its axes about its centre.
    pub(crate) fn of(mass: f64, centre: DVec3, world_from_body: DQuat, own: DVec3) -> Inertia {
        let second = turned(own, world_from_body);
        let outer = DMat3::from_cols(centre * centre.x, centre * centre.y, centre * centre.z);
        let shift = DMat3::from_diagonal(DVec3::splat(centre.length_squared())) - outer;
        Inertia { mass, first: centre * mass, second: second + shift * mass }
    }

    pub(crate) fn add(&mut self, other: &Inertia) {
        self.mass += other.mass;
        self.first += other.first;
        self.second += other.second;
    }
}

/// Principal moments in world axes.
pub(crate) fn turned(own: DVec3, world_from_body: DQuat) -> DMat3 {
    let rotation = DMat3::from_quat(world_from_body);
    rotation * DMat3::from_diagonal(own) * rotation.transpose()
}
