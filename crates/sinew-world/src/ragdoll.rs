//! A character's body as rigid bodies and joints.
//!
//! Every part is a rigid body with its origin at the joint to its parent. Knees are hinges, all other joints balls
//! whose swing and twist are limited (`joint.rs`). Neighbouring parts, and parts that overlap when the body stands, do
//! not collide with each other.

use crate::character::Character;
use crate::engine::Engine;
use crate::solid::Form;
use crate::{CharacterId, CharacterSpec, Drive, Entity, Solid, SpecError, Surface, sanitize};
use glam::{DQuat, DVec3};
use rapier3d_f64::prelude::*;
use sinew_body::humanoid::{Body, Node, Pose as BodyPose, Sole};

/// Smallest moment of inertia of a part, relative to the body's mass times its stature squared \[1\]: about 0.009 kg m²
/// for 80 kg and 1.7 m. A collar bone or a foot alone has a tenth of that, and springs that hold a whole body through
/// it converge poorly; the difference is not visible, since such parts move with their neighbours.
const MIN_INERTIA: f64 = 4e-5;

/// Friction of a limp joint, relative to its outboard inertia \[1/s\].
pub(crate) const LIMP_DAMPING: f64 = 2.0;

/// The body's own collision shape of a part.
pub fn part_solid(body: &Body, node: Node) -> Solid {
    let shape = body.link(node).shape;
    match node {
        Node::LeftFoot | Node::RightFoot => foot(body, node),
        _ => {
            let radius = (shape.from_radius_m + shape.to_radius_m) / 2.0;
            // Capsules end where the segment ends, so that neighbours overlap as little as they can.
            let line = shape.to - shape.from;
            let cut = if matches!(node, Node::LeftHand | Node::RightHand | Node::Head) {
                line.normalize_or_zero() * (radius * 0.5).min(line.length() * 0.45)
            } else {
                DVec3::ZERO
            };
            Solid::capsule_between(shape.from, shape.to - cut, radius)
        }
    }
}

/// A sole: a box under the ankle, from the heel to the tip of the toes.
fn foot(body: &Body, node: Node) -> Solid {
    let sole = Sole::of(body, node);
    let height = 0.6 * sole.ankle_m;
    let size_m = DVec3::new(sole.breadth_m, height, sole.toes_m - sole.heel_m);
    let centre = DVec3::new(sole.middle_m, -sole.ankle_m + height / 2.0, (sole.heel_m + sole.toes_m) / 2.0);
    Solid::new(Form::Box { size_m }).at(centre)
}

/// Height of the ankle above the sole \[m\].
pub fn sole_m(body: &Body, node: Node) -> f64 {
    Sole::of(body, node).ankle_m
}

/// Height of the hips of a pose above the lowest point of the soles \[m\].
pub fn hips_over_soles_m(body: &Body, pose: &BodyPose) -> f64 {
    let positions = pose.positions(body);
    let mut lowest = f64::INFINITY;
    for node in [Node::LeftFoot, Node::RightFoot] {
        let solid = foot(body, node);
        let Form::Box { size_m } = solid.form else { continue };
        for corner in 0..8 {
            let sign = |bit: usize| if corner >> bit & 1 == 0 { -0.5 } else { 0.5 };
            let point = solid.centre + DVec3::new(sign(0), sign(1), sign(2)) * size_m;
            lowest = lowest.min((positions[node.index()] + pose.world[node.index()] * point).y);
        }
    }
    pose.hips_position.y - lowest
}

/// Outboard moment of inertia about each joint, standing: the mean over three axes \[kg m²\].
pub fn outboard_inertias(body: &Body) -> [f64; Node::COUNT] {
    let positions = BodyPose::STANDING.positions(body);
    let mut inertias = [0.0; Node::COUNT];
    for node in Node::ALL {
        let link = body.link(node);
        let own = part_inertia(body, node).element_sum() / 3.0;
        let centre = positions[node.index()] + link.centre;
        let mut at = Some(node);
        while let Some(carrying) = at {
            let arm = (centre - positions[carrying.index()]).length_squared() * 2.0 / 3.0;
            inertias[carrying.index()] += own + link.mass_kg * arm;
            at = carrying.parent();
        }
    }
    inertias
}

/// Moments of inertia of a part as the world uses them \[kg m²\].
pub(crate) fn part_inertia(body: &Body, node: Node) -> DVec3 {
    let least = MIN_INERTIA * body.mass_kg() * body.stature_m() * body.stature_m();
    body.link(node).inertia.max(DVec3::splat(least))
}

pub(crate) fn build(engine: &mut Engine, spec: &CharacterSpec, id: CharacterId) -> Result<Character, SpecError> {
    let body = &spec.body;
    if let Some(node) = sanitize::faulty_part(body) {
        return Err(SpecError::NoMass(node.part().name()));
    }
    let Some(velocity) = sanitize::velocity(spec.velocity).filter(|_| sanitize::is_place(spec.pose.hips_position))
    else {
        return Err(SpecError::NotFinite);
    };
    let mut spec = spec.clone();
    spec.surface = sanitize::surface(spec.surface);
    for rotation in &mut spec.pose.world {
        *rotation = sanitize::unit(*rotation).ok_or(SpecError::NotFinite)?;
    }
    let body = &spec.body;
    let positions = spec.pose.positions(body);
    let mut bodies = [RigidBodyHandle::invalid(); Node::COUNT];
    let mut colliders = [ColliderHandle::invalid(); Node::COUNT];
    for node in Node::ALL {
        let link = body.link(node);
        let mass = MassProperties::new(link.centre, link.mass_kg, part_inertia(body, node));
        let rigid = RigidBodyBuilder::dynamic()
            .pose(Pose::from_parts(positions[node.index()], spec.pose.world[node.index()]))
            .linvel(velocity)
            .additional_mass_properties(mass);
        let handle = engine.bodies.insert(rigid);
        let solid = part_solid(body, node);
        let collider = part_collider(&solid, spec.surface, id, node).ok_or(SpecError::NoShape)?;
        bodies[node.index()] = handle;
        colliders[node.index()] = engine.colliders.insert_with_parent(collider, handle, &mut engine.bodies);
    }
    let mut joints = [ImpulseJointHandle::invalid(); Node::COUNT];
    for node in Node::ALL {
        let Some(parent) = node.parent() else { continue };
        let locked = JointAxesMask::LIN_AXES | if is_hinge(node) { HINGE_LOCKS } else { JointAxesMask::empty() };
        let joint = GenericJointBuilder::new(locked)
            .local_anchor1(body.link(node).offset)
            .local_anchor2(DVec3::ZERO)
            .contacts_enabled(false)
            .build();
        joints[node.index()] = engine.joints.insert(bodies[parent.index()], bodies[node.index()], joint, true);
    }
    for (one, other) in never_collide(body) {
        let pass = GenericJointBuilder::new(JointAxesMask::empty()).contacts_enabled(false).build();
        engine.joints.insert(bodies[one.index()], bodies[other.index()], pass, true);
    }
    let outboard = outboard_inertias(body);
    let drives = std::array::from_fn(|at| Drive::limp(LIMP_DAMPING * outboard[at]));
    Ok(Character::new(spec, bodies, colliders, joints, drives, outboard))
}

/// A hinge's other two axes.
const HINGE_LOCKS: JointAxesMask = JointAxesMask::ANG_Y.union(JointAxesMask::ANG_Z);

/// Knees turn about their X alone.
pub(crate) fn is_hinge(node: Node) -> bool {
    matches!(node, Node::LeftLowerLeg | Node::RightLowerLeg)
}

pub(crate) fn part_collider(solid: &Solid, surface: Surface, character: CharacterId, node: Node) -> Option<Collider> {
    Some(
        ColliderBuilder::new(solid.shape()?)
            .position(solid.placement())
            .density(0.0)
            .friction(surface.friction)
            .friction_combine_rule(CoefficientCombineRule::GeometricMean)
            .restitution(surface.bounce)
            .restitution_combine_rule(CoefficientCombineRule::Max)
            .user_data(crate::engine::tag(Entity::Part(character, node)))
            .build(),
    )
}

/// Pairs that are not neighbours, but overlap when the body stands.
pub fn never_collide(body: &Body) -> Vec<(Node, Node)> {
    let pose = BodyPose::STANDING;
    let positions = pose.positions(body);
    let place = |node: Node| {
        let solid = part_solid(body, node);
        solid
            .shape()
            .map(|shape| (shape, Pose::from_parts(positions[node.index()], DQuat::IDENTITY) * solid.placement()))
    };
    let mut pairs = Vec::new();
    for one in Node::ALL {
        for other in Node::ALL {
            let neighbours = one.parent() == Some(other) || other.parent() == Some(one);
            if one >= other || neighbours {
                continue;
            }
            let overlap = match (place(one), place(other)) {
                (Some((a, a_at)), Some((b, b_at))) => {
                    rapier3d_f64::parry::query::distance(&a_at, &*a, &b_at, &*b).is_ok_and(|gap| gap.distance <= 0.0)
                }
                _ => true,
            };
            if overlap {
                pairs.push((one, other));
            }
        }
    }
    pairs
}
