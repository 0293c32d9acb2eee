//! What a reach is for, in the world: points, surfaces of props, and what is in the way.

use crate::Stage;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::Node;
use sinew_control::source::{Aimed, HANDS};
use sinew_control::{OrderError, OrderErrorKind, ReachHand, ReachOrder};
use sinew_reach::{Flight, Obstacle};
use sinew_world::{BodyState, CharacterId, Entity, Form, PropId, Solid};

/// A prop that is slower than this does not fly \[m/s\].
const FLIES_M_S: f64 = 0.5;

/// A hand's own thickness, between its centre and what it touches \[m\].
const PALM_M: f64 = 0.035;

impl Stage {
    /// Where each hand is to come.
    pub(crate) fn aim_of(
        &self,
        index: CharacterId,
        order: &ReachOrder<PropId>,
    ) -> Result<[Option<Aimed>; 2], OrderError> {
        let character = self.character_frame(index)?;
        if order.left_m.is_some() || order.right_m.is_some() {
            let point = |place: Option<[f64; 3]>| place.map(|place| Aimed::Point(place.into()));
            return Ok([point(order.left_m), point(order.right_m)]);
        }
        let left = character.left();
        let middle = |hand: ReachHand, target: DVec3| match hand {
            ReachHand::Left => 0,
            ReachHand::Right => 1,
            _ => usize::from((target - character.parts[0].position).dot(left) < 0.06),
        };
        if let Some(point) = order.target_m {
            let point = DVec3::from(point);
            let mut aimed = [None; 2];
            let side = middle(order.hand, point);
            // What a hand holds is what is to arrive.
            let mut held = self.world.held().filter(|held| held.character == index && held.node == HANDS[side]);
            aimed[side] = Some(match held.next().map(|held| held.object) {
                Some(Entity::Prop(prop)) => Aimed::Held(prop, point),
                _ => Aimed::Point(point),
            });
            return Ok(aimed);
        }
        // The order was checked: it states a target.
        let Some(prop) = order.object else { return Ok([None; 2]) };
        let state = self.world.frame().prop(prop).ok_or_else(|| prop_gone(prop))?;
        let solid = self.solid_of(prop);
        let surface = |direction: DVec3| {
            let depth = solid.as_ref().map_or(0.0, |solid| depth(solid, state, direction));
            direction * (depth + PALM_M)
        };
        if order.hand == ReachHand::Both {
            return Ok([Some(Aimed::Prop(prop, surface(left))), Some(Aimed::Prop(prop, surface(-left)))]);
        }
        let side = middle(order.hand, state.centre);
        let shoulder = character.part([Node::LeftUpperArm, Node::RightUpperArm][side]).position;
        // From the shoulder's side, rather from the side than from above.
        let mut from = shoulder - state.centre;
        from.y *= 0.35;
        let mut aimed = [None; 2];
        aimed[side] = Some(Aimed::Prop(prop, surface(from.normalize_or(DVec3::Y))));
        Ok(aimed)
    }

    /// How the prop of a reach flies: by gravity and drag alone, as nothing holds or touches it. `None` for one that does not.
    pub(crate) fn flight_of(&self, aimed: &[Option<Aimed>; 2]) -> Option<Flight> {
        let frame = self.world.frame();
        let prop = aimed.iter().flatten().find_map(|aimed| match aimed {
            Aimed::Prop(prop, _) => Some(*prop),
            _ => None,
        })?;
        let (state, spec) = (frame.prop(prop)?, self.scene.props.get(self.cast.prop_name(prop))?);
        let is_held = self.world.held().any(|held| held.object == Entity::Prop(prop));
        let name = self.cast.prop_name(prop);
        let is_tied = self.scene.joints.values().any(|joint| joint.between.iter().any(|end| end == name));
        let flies = spec.mass_kg.is_some()
            && state.velocity.length() > FLIES_M_S
            && frame.touching(Entity::Prop(prop)).next().is_none()
            && !is_held
            && !is_tied;
        flies.then(|| Flight {
            at: state.centre,
            velocity: state.velocity,
            gravity_m_s2: self.world.settings().gravity_m_s2 * spec.gravity_scale.unwrap_or(1.0),
            drag_per_s: spec.drag_per_s,
        })
    }

    /// Props that arms keep clear of, where they are now.
    pub(crate) fn obstacles(&self, props: &[PropId]) -> Result<Vec<Obstacle>, OrderError> {
        let mut all = Vec::new();
        for &prop in props {
            let state = self.world.frame().prop(prop).ok_or_else(|| prop_gone(prop))?;
            let Some(solid) = self.solid_of(prop) else { continue };
            all.extend(obstacles_of(&solid, state));
        }
        Ok(all)
    }
}

/// The error for a prop that was removed.
fn prop_gone(prop: PropId) -> OrderError {
    OrderError::new(OrderErrorKind::NotFound, format!("prop {prop} is not there any more"))
}

/// How far a prop's surface is from its centre in a direction \[m\].
pub(crate) fn depth(solid: &Solid, state: &BodyState, direction: DVec3) -> f64 {
    let turn = state.rotation * solid.rotation;
    let local = turn.conjugate() * direction;
    match &solid.form {
        Form::Ball { radius_m } => *radius_m,
        Form::Capsule { radius_m, length_m } => radius_m + 0.5 * length_m * local.y.abs(),
        Form::Box { size_m } => {
            // Where the ray leaves the box.
            let half = *size_m * 0.5;
            let share = |axis: usize| half[axis] / local[axis].abs().max(1e-9);
            share(0).min(share(1)).min(share(2))
        }
        Form::Ring { radius_m, tube_m } => radius_m + tube_m,
        Form::Hull { points_m } => points_m.iter().map(|point| point.dot(local)).fold(0.0, f64::max),
        Form::Mesh { points_m, .. } => points_m.iter().map(|point| point.dot(local)).fold(0.0, f64::max),
    }
}

/// A prop as what must not be touched; a ring as its hull's box, meshes and hulls by the box around them.
fn obstacles_of(solid: &Solid, state: &BodyState) -> Vec<Obstacle> {
    let centre = state.position + state.rotation * solid.centre;
    let turn: DQuat = (state.rotation * solid.rotation).normalize();
    let around = |points: &[DVec3]| {
        let low = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        Obstacle::Box { centre: centre + turn * ((low + high) * 0.5), turn, half_m: (high - low) * 0.5 }
    };
    vec![match &solid.form {
        Form::Ball { radius_m } => Obstacle::Capsule { from: centre, to: centre, radius_m: *radius_m },
        Form::Capsule { radius_m, length_m } => {
            let half = turn * DVec3::Y * (0.5 * length_m);
            Obstacle::Capsule { from: centre - half, to: centre + half, radius_m: *radius_m }
        }
        Form::Box { size_m } => Obstacle::Box { centre, turn, half_m: *size_m * 0.5 },
        Form::Ring { radius_m, tube_m } => {
            let reach = radius_m + tube_m;
            Obstacle::Box { centre, turn, half_m: DVec3::new(reach, *tube_m, reach) }
        }
        Form::Hull { points_m } => around(points_m),
        Form::Mesh { points_m, .. } => around(points_m),
    }]
}
