//! Draws limp bodies after a fall, one by one and in a pile: `cargo run --release -p sinew-world --example pile -- OUT.png`.
//!
//! Look for limbs that pass through each other, knees and elbows bent backward, parts that hang in the air.

#[path = "../tests/all/common/mod.rs"]
mod common;

use common::{adult, lifted, odd_pose, spec, standing, supine};
use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_picture::{Camera, Capsule, Figure, Filmstrip, Panel, Shade, Style};
use sinew_world::{CharacterSpec, Form, World, WorldSettings, part_solid};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "pile.png".into());
    let body = adult();
    let mut panels = Vec::new();
    let starts: [(&str, Pose, DVec3); 7] = [
        ("slumps", standing(&body), DVec3::ZERO),
        ("stumbles", standing(&body), DVec3::Z * 1.4),
        ("thrown back", standing(&body), DVec3::Z * -3.0),
        ("thrown aside", standing(&body), DVec3::X * 2.0),
        ("dropped on its back", lifted(&body, supine(), 1.0), DVec3::ZERO),
        ("odd pose", lifted(&body, odd_pose(&body, 3, 0.9), 0.5), DVec3::ZERO),
        ("odd pose", lifted(&body, odd_pose(&body, 8, 0.9), 0.5), DVec3::ZERO),
    ];
    for (name, pose, velocity) in starts {
        let mut world = World::new(WorldSettings::default());
        world.add_character(CharacterSpec { velocity, ..spec(&body, pose) })?;
        for moment in [0.5, 3.5] {
            common::steps(&mut world, moment);
            panels.push(panel(&world, &body, name));
        }
    }
    let mut world = World::new(WorldSettings::default());
    for one in 0..8u32 {
        let mut pose = lifted(&body, odd_pose(&body, 100 + u64::from(one), 0.7), 0.3);
        pose.hips_position +=
            DVec3::new(f64::from(one % 2) * 0.3, f64::from(one / 2) * 0.9, f64::from(one / 2 % 2) * 0.3);
        world.add_character(spec(&body, pose))?;
    }
    for moment in [1.0, 4.0] {
        common::steps(&mut world, moment);
        panels.push(panel(&world, &body, "eight"));
    }
    let strip = Filmstrip {
        title: "Limp bodies".into(),
        panels,
        camera: Camera { elevation_rad: 0.7, ..Camera::three_quarter() },
        style: Style { columns: 4, ..Style::default() },
        ..Filmstrip::default()
    };
    std::fs::write(&path, strip.to_png()?)?;
    println!("{path}");
    Ok(())
}

fn panel(world: &World, body: &Body, caption: &str) -> Panel {
    let mut capsules = Vec::new();
    for one in &world.frame().characters {
        for node in Node::ALL {
            let part = one.part(node);
            let shade = match node.part().side() {
                Some(sinew_motion::Side::Left) => Shade::Left,
                Some(sinew_motion::Side::Right) => Shade::Right,
                None => Shade::Midline,
            };
            let solid = part_solid(body, node);
            let place = |point: DVec3| part.position + part.rotation * (solid.centre + solid.rotation * point);
            match solid.form {
                Form::Capsule { radius_m, length_m } => {
                    let half = DVec3::Y * length_m / 2.0;
                    capsules.push(Capsule::new(place(-half), place(half), radius_m, shade));
                }
                Form::Box { size_m } => {
                    // A sole: three rods side by side.
                    let radius = size_m.y / 2.0;
                    for x in [-1.0, 0.0, 1.0] {
                        let end = DVec3::new(x * (size_m.x / 2.0 - radius), 0.0, size_m.z / 2.0 - radius);
                        let start = DVec3::new(end.x, 0.0, -end.z);
                        capsules.push(Capsule::new(place(start), place(end), radius, shade));
                    }
                }
                _ => {}
            }
        }
    }
    let hips = world.frame().characters[0].centre_of_mass;
    Panel {
        time_secs: world.frame().time_secs,
        figure: Figure::new(capsules),
        follow: Some(hips),
        caption: caption.into(),
        ..Panel::default()
    }
}
