//! Filmstrips of the sample walk in a world: `cargo run -p sinew-control --example responding_walk -- ball ball.png`, and so on for
//! `platform`, `cup` and `post`.

#[path = "../tests/all/walker/mod.rs"]
mod walker;

use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_picture::{Arrow, Camera, Capsule, Figure, Filmstrip, Panel, Shade};
use sinew_response::PointForce;
use sinew_world::{Form, Motion, PropId, PropSpec, Solid, WorldSettings};
use walker::{Scene, Walk, ball};

const RADIUS_M: f64 = 0.1;

fn figure(body: &Body, pose: &Pose) -> Figure {
    let joints = pose.positions(body);
    let capsules = Node::ALL.into_iter().map(|node| {
        let shape = body.link(node).shape;
        let place = |point: DVec3| joints[node.index()] + pose.world[node.index()] * point;
        let shade = match node.part().side() {
            Some(sinew_motion::Side::Left) => Shade::Left,
            Some(sinew_motion::Side::Right) => Shade::Right,
            None => Shade::Midline,
        };
        Capsule::tapered(place(shape.from), place(shape.to), shape.from_radius_m, shape.to_radius_m, shade)
    });
    Figure::new(capsules.collect())
}

/// What is drawn of a scene besides the body.
type Things = fn(&Scene) -> Vec<Capsule>;

fn panel(scene: &Scene, things: Things, ghost: &Pose, forces: &[PointForce]) -> Panel {
    let mut shown = figure(&scene.walk.body, &scene.pose());
    shown.capsules.extend(things(scene));
    let parts = &scene.world.frame().characters[0].parts;
    Panel {
        time_secs: scene.world.frame().time_secs,
        figure: shown,
        ghost: Some(figure(&scene.walk.body, ghost)),
        arrows: forces
            .iter()
            .map(|force| Arrow { at: parts[force.node.index()].centre, force_n: force.force_n, label: String::new() })
            .collect(),
        follow: Some(ghost.hips_position),
        caption: String::new(),
        ..Panel::default()
    }
}

fn first_prop(scene: &Scene) -> Vec<Capsule> {
    scene.world.frame().props.iter().map(|prop| Capsule::ball(prop.position, RADIUS_M, Shade::Object)).collect()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [kind, out] = &arguments[..] else { return Err("give ball, platform, cup or post, and a PNG file".into()) };
    let walk = Walk::new(8, kind == "platform" || kind == "post");
    let floor = WorldSettings::default().floor.filter(|_| kind != "platform");
    let mut scene = Scene::in_world(&walk, WorldSettings { floor, ..WorldSettings::default() });
    let (mut every, mut camera, mut things): (usize, Camera, Things) = (3, Camera::three_quarter(), first_prop);
    match kind.as_str() {
        "ball" => {
            scene.frames_until(60);
            let (velocity, hit) = (DVec3::new(2.0, 0.0, -6.0), 90);
            let target = walk.centres(walk.pose(hit))[Node::RightLowerArm.index()] + DVec3::Z * RADIUS_M;
            scene.world.add_prop(ball(2.0, RADIUS_M, 0.5, target - velocity * 0.5, velocity))?;
            scene.frames_until(84);
        }
        "platform" => {
            let solid = Solid::new(Form::Box { size_m: DVec3::new(3.0, 0.2, 4.0) }).at(DVec3::Y * -0.1);
            let platform = scene.world.add_prop(PropSpec::new(solid, Motion::Moving, DVec3::ZERO))?;
            scene.tracker.stand_on(&scene.world, Some(platform));
            scene.frames_until(60);
            scene.world.accelerate_prop(platform, DVec3::Z * -4.0);
            camera = Camera::side();
            things = |_| Vec::new();
        }
        "cup" => {
            scene.frames_until(30);
            scene.tracker.keep_upright(Some(Node::RightHand));
            scene.frames_until(60);
            every = 4;
            // A cup with its axis along what was up in the hand when it was taken.
            things = |scene| {
                let hand = scene.world.frame().characters[0].part(Node::RightHand);
                let axis = scene.tracker.upright().map_or(DVec3::Y, |(_, axis)| hand.rotation * axis);
                let shade = Shade::Object;
                vec![Capsule::tapered(hand.centre - axis * 0.02, hand.centre + axis * 0.13, 0.03, 0.05, shade)]
            };
        }
        "post" => {
            let hand = Node::RightHand.index();
            let out = walk.poses[60..60 + 2 * walk.stride].iter().map(|pose| walk.centres(pose)[hand]);
            let at = out.min_by(|a, b| a.x.total_cmp(&b.x)).ok_or("no poses")?;
            let solid = Solid::capsule_between(DVec3::Y * -0.5, DVec3::Y * 0.3, 0.05);
            let post = scene.world.add_prop(PropSpec::new(solid, Motion::Fixed, at - DVec3::X * 0.05))?;
            scene.tracker.avoid(&[post]);
            scene.frames_until(60);
            every = 4;
            camera = Camera::front();
            things = |scene| {
                let at = scene.world.frame().props[0].position;
                vec![Capsule::new(at - DVec3::Y * 0.5, at + DVec3::Y * 0.3, 0.05, Shade::Object)]
            };
        }
        _ => return Err(format!("no scene `{kind}`; there are ball, platform, cup and post").into()),
    }
    let begins = scene.frame;
    let mut panels = Vec::new();
    let mut forces: Vec<PointForce> = Vec::new();
    for _ in 0..16 {
        let mut ghost = *scene.wanted();
        if kind == "platform" {
            ghost.hips_position += scene.world.frame().props[0].position;
        }
        panels.push(panel(&scene, things, &ghost, &forces));
        forces.clear();
        for _ in 0..every {
            scene.frame();
            forces.extend(scene.tracker.forces().iter().filter(|force| force.force_n.length() > 5.0));
            if kind == "platform" && scene.frame == begins + 12 {
                scene.world.accelerate_prop(PropId::first_in(0), DVec3::ZERO);
            }
        }
    }
    let strip = Filmstrip { title: format!("A responding walk: {kind}"), panels, camera, ..Filmstrip::default() };
    std::fs::write(out, strip.to_png()?)?;
    Ok(())
}
