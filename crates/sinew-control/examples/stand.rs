#![allow(missing_docs)]
use glam::DVec3;
use sinew_body::humanoid::*;
use sinew_world::*;
use sinew_control::{Target, tracker::*};
fn main() {
    let body = Body::standard(80.0, 1.7);
    let push: f64 = std::env::args().nth(1).map_or(0.0, |a| a.parse().unwrap());
    let mut world = World::new(WorldSettings { solver_iterations: std::env::var("IT").map_or(4, |v| v.parse().unwrap()), ..WorldSettings::default() });
    let mut pose = Pose::STANDING;
    pose.hips_position.y = hips_over_soles_m(&body, &pose);
    world.add_character(CharacterSpec { body: body.clone(), pose, velocity: DVec3::ZERO, surface: Surface::BODY }).unwrap();
    let env = |name: &str, or: f64| std::env::var(name).map_or(or, |v| v.parse().unwrap());
    let mut joints = [JointGain { frequency_hz: env("F", 3.0), damping_ratio: env("Z", 1.0), load: None }; 18];
    for n in [Node::LeftFoot, Node::RightFoot, Node::LeftLowerLeg, Node::RightLowerLeg, Node::LeftUpperLeg, Node::RightUpperLeg] { joints[n.index()].load = Some(env("L", 1.0)); }
    let pd = PdTracker::new(&body, &joints);
    let target = Target::STANDING;
    let start = std::time::Instant::now();
    for step in 0..240 * 6 {
        pd.apply(&mut world, 0, &target);
        if (240..264).contains(&step) { world.push_part(0, Node::Chest, DVec3::Z * push / 0.1, None); }
        world.step();
        if std::env::var("V").is_ok() && step < 60 && step % 4 == 0 { let f=&world.frame().characters[0]; for c in &world.frame().contacts { print!("{:?}-{:?} {:.2} ", c.a, c.b, c.impulse); } 
          println!(); for n in Node::ALL { let l=log(f.pose().local(n)); if l.length()>0.01 {print!("{n:?} {:.3} ", l);} } println!(" v {:.4} E {:.2}", f.centre_velocity, world.energy_j(0)); }
        if step % 120 == 0 {
            let f = &world.frame().characters[0];
            println!("{:.2} hips {:.3} com {:.3} {:.3} v {:.3} margin {:.3} gap {:.4} contacts {}", world.frame().time_secs, f.parts[0].position.y, f.centre_of_mass.y, f.centre_of_mass.z, f.centre_velocity.z, margin(&f.support, f.centre_of_mass), world.largest_joint_gap_m(), world.frame().contacts.len());
        }
    }
    println!("us/step {}", start.elapsed().as_micros() as f64 / 1440.0);
}
