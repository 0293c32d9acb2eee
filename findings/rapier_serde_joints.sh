#!/usr/bin/env bash
# Rapier's serde leaves out joints that were added or removed since the last step.
#
# The surprise: a world is serialised, deserialised and stepped on, and its joints behave otherwise than in the world that was not
# serialised. A rope that was added before the next step no longer holds as soon as one of its bodies falls asleep: the ball flies on
# for ever. And a body whose rope was removed stays joined to the ball as far as sleep is concerned, and never falls asleep.
#
# Why it matters: a saved game, a rollback or a replay that saves right after a change of joints goes on to another motion, seconds
# later, although all bodies, joints and contacts were restored bit for bit.
#
# Version: rapier3d-f64 0.36.1 (features serde-serialize, enhanced-determinism).
# Source: src/dynamics/joint/impulse_joint/impulse_joint_set.rs, `#[serde(skip)]` on `island_events` and `modified_joints` of
# `ImpulseJointSet`: what is in them links and unlinks bodies in the islands at the beginning of the next step.
#
# What helps: step once between a change of joints and saving; or, after loading, `joints.iter_mut()`, which marks all joints as
# changed and so links them again (for added ones), and removing joints only right before a step (for removed ones).
#
# Prints what is seen. Ends with 0 as long as it is so, with 1 when it has changed. Needs cargo and the registry; no Sinew.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/src"
cat > "$folder/Cargo.toml" <<'TOML'
[package]
name = "rapier-serde-joints"
version = "0.0.0"
edition = "2024"

[dependencies]
postcard = { version = "=1.2.0", default-features = false, features = ["use-std"] }
rapier3d-f64 = { version = "=0.36.1", features = ["enhanced-determinism", "serde-serialize"] }
serde = { version = "=1.0.229", features = ["derive"] }

[workspace]
TOML
cat > "$folder/src/main.rs" <<'RUST'
use rapier3d_f64::prelude::*;
use serde::{Deserialize, Serialize};

/// The library's sets.
#[derive(Serialize, Deserialize)]
struct World {
    islands: IslandManager,
    broad_phase: DefaultBroadPhase,
    narrow_phase: NarrowPhase,
    bodies: RigidBodySet,
    colliders: ColliderSet,
    joints: ImpulseJointSet,
    multibody_joints: MultibodyJointSet,
    soft_bodies: SoftBodySet,
    ccd: CCDSolver,
}

impl World {
    fn step(&mut self, pipeline: &mut PhysicsPipeline) {
        pipeline.step(
            Vector::new(0.0, -9.81, 0.0),
            &IntegrationParameters::default(),
            &mut self.islands,
            &mut self.broad_phase,
            &mut self.narrow_phase,
            &mut self.bodies,
            &mut self.colliders,
            &mut self.joints,
            &mut self.multibody_joints,
            &mut self.soft_bodies,
            &mut self.ccd,
            &(),
            &(),
        );
    }
}

/// A heavy post that rests on the ground, and a weightless ball that drifts away from it at 1 m/s.
fn post_and_ball() -> (World, RigidBodyHandle, RigidBodyHandle) {
    let mut world = World {
        islands: IslandManager::new(),
        broad_phase: DefaultBroadPhase::new(),
        narrow_phase: NarrowPhase::new(),
        bodies: RigidBodySet::new(),
        colliders: ColliderSet::new(),
        joints: ImpulseJointSet::new(),
        multibody_joints: MultibodyJointSet::new(),
        soft_bodies: SoftBodySet::new(),
        ccd: CCDSolver::new(),
    };
    world.colliders.insert(ColliderBuilder::new(SharedShape::halfspace(Vector::Y)));
    let post = world.bodies.insert(RigidBodyBuilder::dynamic().translation(Vector::new(0.0, 1.0, 0.0)));
    world.colliders.insert_with_parent(ColliderBuilder::cuboid(0.5, 1.0, 0.5).density(2000.0), post, &mut world.bodies);
    let away = RigidBodyBuilder::dynamic().translation(Vector::new(2.0, 3.0, 0.0)).linvel(Vector::new(1.0, 0.0, 0.0));
    let ball = world.bodies.insert(away.gravity_scale(0.0));
    world.colliders.insert_with_parent(ColliderBuilder::ball(0.05), ball, &mut world.bodies);
    (world, post, ball)
}

/// What goes on, and what goes on after it was serialised: where the ball is after 15 s, and whether the post sleeps.
fn both(mut world: World, post: RigidBodyHandle, ball: RigidBodyHandle) -> [(f64, bool); 2] {
    let bytes = postcard::to_stdvec(&world).unwrap();
    let mut restored: World = postcard::from_bytes(&bytes).unwrap();
    [&mut world, &mut restored].map(|world| {
        let mut pipeline = PhysicsPipeline::new();
        (0..900).for_each(|_| world.step(&mut pipeline));
        (world.bodies[ball].translation().x, world.bodies[post].is_sleeping())
    })
}

fn main() {
    let rope = || RopeJointBuilder::new(8.0);

    let (mut world, post, ball) = post_and_ball();
    world.step(&mut PhysicsPipeline::new());
    world.joints.insert(post, ball, rope(), true);
    let added = both(world, post, ball);

    let (mut world, post, ball) = post_and_ball();
    let cord = world.joints.insert(post, ball, rope(), true);
    world.step(&mut PhysicsPipeline::new());
    world.joints.remove(cord, true);
    let removed = both(world, post, ball);

    let say = |(x, sleeps): (f64, bool)| format!("ball at {x:.2} m, post {}", if sleeps { "asleep" } else { "awake" });
    for (what, [on, restored]) in [("a rope of 8 m was added", added), ("the rope was removed", removed)] {
        println!("serialised after {what}: without it {}; with it {}", say(on), say(restored));
    }
    let is_known = added[0].0 < 11.0 && added[1].0 > 16.0 && removed[0].1 && !removed[1].1;
    std::process::exit(if is_known { 0 } else { 1 });
}
RUST
echo "rapier3d-f64 0.36.1"
cargo run --quiet --manifest-path "$folder/Cargo.toml"
