#!/bin/sh
# Sliding friction of Rapier does not point against the sliding.
#
# The surprise: with FrictionModel::Coulomb a cube that slides along its edges is braked by 0.94 of mu g, one that slides along its
# diagonal by mu g, and in between its way bends. A long box that is sent off at 45 degrees goes at 59.5 and is braked by 0.82 of mu g.
# With the default, FrictionModel::Simplified, a cube is right, but the long box goes at 54.2 degrees.
# The cause: a contact's impulse is its last one minus K^-1 v, cut to mu N, with K the inverse mass of the contact point, a 2 x 2
# matrix. While the box slides, the iteration ends where the impulse is parallel to K^-1 v. K is no multiple of the identity at the
# corners of a box (a push at a corner turns the box too), so the impulses point askew, and those of opposite corners cancel in part.
# Why it matters: who tunes a game sees boxes overshoot and veer; who compares engines reads another coefficient than was set; wheels,
# skis and curling stones curve.
# Version: rapier3d-f64 0.36.1, crates.io. Source: ContactConstraintTangentPart::solve in
# src/dynamics/solver/contact_constraint/contact_constraint_element.rs ("Exact coupled 2x2 central-friction solve", then
# simd_cap_magnitude).
# What helps: a hook modify_solver_contacts that adds the tangent velocity (K / k - 1) v to contacts that slide.
#
# Prints what is seen; exits with 1 when it is no longer so. Needs cargo and access to crates.io. Sinew is not used.
set -eu
where=$(mktemp -d)
trap 'rm -rf "$where"' EXIT
mkdir "$where/src"
cat > "$where/Cargo.toml" <<'TOML'
[package]
name = "friction-direction"
version = "0.0.0"
edition = "2021"

[dependencies]
rapier3d-f64 = "=0.36.1"

[workspace]
TOML
cat > "$where/src/main.rs" <<'RUST'
use rapier3d_f64::prelude::*;

const MU: f64 = 0.7;
const G: f64 = 9.81;

/// A box of this size sent off at 4 m/s, `deg` from its x axis: how much of mu g brakes it, and its heading half a second later [deg].
fn slide(model: FrictionModel, size: [f64; 3], deg: f64) -> (f64, f64) {
    let parameters = IntegrationParameters { dt: 1.0 / 240.0, friction_model: model, ..Default::default() };
    let mut bodies = RigidBodySet::new();
    let mut colliders = ColliderSet::new();
    let ground = bodies.insert(RigidBodyBuilder::fixed());
    let floor = ColliderBuilder::new(SharedShape::halfspace(Vector::Y)).friction(MU);
    colliders.insert_with_parent(floor, ground, &mut bodies);
    let body = bodies.insert(RigidBodyBuilder::dynamic().translation(Vector::new(0.0, size[1] / 2.0, 0.0)));
    let cuboid = ColliderBuilder::cuboid(size[0] / 2.0, size[1] / 2.0, size[2] / 2.0).friction(MU).density(100.0);
    colliders.insert_with_parent(cuboid, body, &mut bodies);
    let (mut pipeline, mut islands, mut broad) = (PhysicsPipeline::new(), IslandManager::new(), DefaultBroadPhase::new());
    let (mut narrow, mut joints, mut multi) = (NarrowPhase::new(), ImpulseJointSet::new(), MultibodyJointSet::new());
    let (mut soft, mut ccd) = (SoftBodySet::new(), CCDSolver::new());
    let mut run = |bodies: &mut RigidBodySet, steps: usize| {
        for _ in 0..steps {
            pipeline.step(
                Vector::new(0.0, -G, 0.0), &parameters, &mut islands, &mut broad, &mut narrow, bodies, &mut colliders,
                &mut joints, &mut multi, &mut soft, &mut ccd, &(), &(),
            );
        }
    };
    run(&mut bodies, 60);
    let direction = Vector::new(deg.to_radians().cos(), 0.0, deg.to_radians().sin());
    bodies[body].set_linvel(direction * 4.0, true);
    let start = bodies[body].translation();
    let from = bodies[body].linvel().length();
    run(&mut bodies, 60);
    let braking = (from - bodies[body].linvel().length()) / 0.25;
    run(&mut bodies, 60);
    let way = bodies[body].translation() - start;
    (braking / (MU * G), way.z.atan2(way.x).to_degrees())
}

fn main() {
    let cube = [0.5, 0.5, 0.5];
    let long = [1.2, 0.3, 0.3];
    let mut seen = Vec::new();
    for (name, size) in [("cube", cube), ("long box", long)] {
        for (model_name, model) in [("Coulomb", FrictionModel::Coulomb), ("Simplified", FrictionModel::Simplified)] {
            for deg in [0.0, 22.5, 45.0] {
                let (share, heading) = slide(model, size, deg);
                println!("{name:8}, {model_name:10}, sent off at {deg:4}: braked by {share:.3} mu g, goes at {heading:5.1} deg");
                seen.push((share, heading));
            }
        }
    }
    // The cube under Coulomb along its edge, and the long box askew under both.
    let is_as_before =
        (seen[0].0 - 0.936).abs() < 0.01 && (seen[8].1 - 59.5).abs() < 0.5 && (seen[11].1 - 54.2).abs() < 0.5;
    println!("{}", if is_as_before { "as before" } else { "CHANGED: Rapier behaves otherwise now" });
    std::process::exit(i32::from(!is_as_before));
}
RUST
cd "$where"
cargo run --quiet --release
