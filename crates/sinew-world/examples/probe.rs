use glam::DVec3;
use sinew_body::humanoid::*;
use sinew_world::*;
fn main() {
    let body = Body::standard(80.0, 1.7);
    println!("outboard {:?}", outboard_inertias(&body));
    println!("never {:?}", never_collide(&body));
    let iterations: usize = std::env::args().nth(1).map_or(4, |a| a.parse().unwrap());
    let mut world = World::new(WorldSettings { solver_iterations: iterations, ..Default::default() });
    let mut pose = Pose::STANDING;
    pose.hips_position.y = hips_over_soles_m(&body, &pose);
    world.add_character(CharacterSpec { body: body.clone(), pose, velocity: DVec3::new(0.0, 0.0, 0.4), surface: Surface::BODY }).unwrap();
    let e0 = world.energy_j(0);
    let mut worst: f64 = 0.0; let mut emax = e0; let mut rise: f64 = 0.0; let mut prev = e0; let mut peak: f64 = 0.0;
    let start = std::time::Instant::now();
    for step in 0..240 * 10 {
        world.step();
        worst = worst.max(world.largest_joint_gap_m());
        let e = world.energy_j(0);
        rise = rise.max(e - prev); prev = e; emax = emax.max(e);
        peak = peak.max(world.frame().contacts.iter().map(|c| c.impulse.length()).fold(0.0, f64::max));
        if step % 120 == 0 {
            let f = &world.frame().characters[0];
            let total: f64 = world.frame().contacts.iter().filter(|c| c.a == Entity::Floor).map(|c| c.impulse.y).sum();
            let (mut wl, mut wn) = (0.0, Node::Hips);
            for n in Node::ALL { let ex = body.link(n).limit.excess(f.pose().local(n)); if ex > wl { wl = ex; wn = n; } }
            println!("{:.2} hips {:.3} com {:.3} head {:.3} E {:.1} gap {:.4} contacts {} impulse/mgdt {:.2} asleep {} limit excess {:.2} {:?} support {}", world.frame().time_secs, f.parts[0].position.y, f.centre_of_mass.y, f.part(Node::Head).position.y, e, world.largest_joint_gap_m(), world.frame().contacts.len(), total / (80.0 * 9.81 / 240.0), world.is_asleep(0), wl.to_degrees(), wn, f.support.len());
        }
    }
    println!("worst gap {worst} rise {rise} emax/e0 {} peak contact Ns {peak} us/step {}", emax / e0, start.elapsed().as_micros() as f64 / 2400.0);
}
