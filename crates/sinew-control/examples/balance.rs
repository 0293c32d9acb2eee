//! Pushes a standing character from eight directions:
//! `cargo run --release -p sinew-control --example balance -- table` prints the impulse up to which it stands,
//! `... -- scan` what each of many impulses comes to, `... -- push AZIMUTH_DEG IMPULSE_N_S OUT.png` draws one push. Azimuths count
//! from straight ahead towards the left.
//!
//! Set in the environment: `KG` and `M` (the body), `POSE` (`knees`, `stride`, `guard`), `CHEST=1` (push there instead of on the
//! hips), `VIEW` (`side`, `front`), `SECS` (how long a push is shown).

#[path = "../tests/all/pushed/mod.rs"]
mod pushed;

use glam::DVec3;
use pushed::{GUARD, KNEES_BENT, Outcome, Place, Push, STRIDE, Standing, Turns, outcome, stood_n_s};
use sinew_body::humanoid::{Body, Node, log, support_margin_m};
use sinew_control::reflex::BalanceSettings;
use sinew_picture::{Arrow, Camera, Capsule, Figure, Filmstrip, Panel, Shade, Style};
use sinew_world::CharacterId;

fn env(name: &str, or: f64) -> f64 {
    std::env::var(name).ok().and_then(|value| value.parse().ok()).unwrap_or(or)
}

fn make() -> Standing {
    let turns: Turns = match std::env::var("POSE").as_deref() {
        Ok("knees") => KNEES_BENT,
        Ok("guard") => GUARD,
        Ok("stride") => STRIDE,
        _ => &[],
    };
    Standing::new(Body::standard(env("KG", 80.0), env("M", 1.7)), turns, BalanceSettings::default())
}

fn place() -> Place {
    if std::env::var("CHEST").is_ok() { Place::Chest } else { Place::Centre }
}

fn table() {
    let halvings = env("HALVINGS", 7.0) as usize;
    let mut standing = make();
    standing.run(pushed::PUSH_AT_SECS, None);
    let mut worst = f64::INFINITY;
    for azimuth_deg in [0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0] {
        let push = Push { azimuth_deg, impulse_n_s: 0.0, for_secs: 0.1, place: place() };
        let bound = standing.bound_n_s(push.direction());
        let (stood, end) = stood_n_s(&make, push, bound, halvings);
        worst = worst.min(stood / bound);
        println!(
            "{azimuth_deg:4} reach {:.3} m bound {bound:6.1} N s stood {stood:6.1} N s {:4.0} % then {end:?}",
            standing.reach_m(push.direction()),
            100.0 * stood / bound
        );
    }
    println!("worst {:.0} %", 100.0 * worst);
}

/// What each of twenty impulses up to the bound comes to: a letter each, `.` for standing.
fn scan() {
    let mut standing = make();
    standing.run(pushed::PUSH_AT_SECS, None);
    for azimuth_deg in [0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0] {
        let mut push = Push { azimuth_deg, impulse_n_s: 0.0, for_secs: 0.1, place: place() };
        let bound = standing.bound_n_s(push.direction());
        let row: String = (1..=24)
            .map(|part| {
                push.impulse_n_s = bound * f64::from(part) / 20.0;
                match outcome(&make, &push) {
                    Outcome::Stands => '.',
                    Outcome::Fell => 'F',
                    Outcome::Stepped => 's',
                    Outcome::Unquiet => 'u',
                }
            })
            .collect();
        println!("{azimuth_deg:4} {row}");
    }
}

fn report(standing: &Standing) {
    let me = &standing.world.frame().characters[0];
    let soles = |node: Node| me.part(node).rotation * DVec3::Y;
    let load = |node: Node| -> f64 {
        standing
            .world
            .frame()
            .touching(sinew_world::Entity::Part(CharacterId::first_in(0), node))
            .map(|contact| contact.impulse.y * 240.0)
            .sum()
    };
    let bend = |node: Node| log(me.pose().local(node)) * 57.3;
    println!(
        "{:.2} com {:.3} {:.3} {:.3} v {:.3} {:.3} {:.3} hips {:.1} chest {:.1} hip {:.1} knee {:.0} {:.0} ankle {:.1} load {:.0} {:.0} tilt {:.3} {:.3} margin {:.3} neck {:.1} head {:.1} feet {:.1} {:.1} at {:.3} {:.3}",
        standing.world.frame().time_secs,
        me.centre_of_mass.x,
        me.centre_of_mass.y,
        me.centre_of_mass.z,
        me.centre_velocity.x,
        me.centre_velocity.y,
        me.centre_velocity.z,
        log(me.part(Node::Hips).rotation) * 57.3,
        bend(Node::Chest),
        bend(Node::LeftUpperLeg),
        bend(Node::LeftLowerLeg).x,
        bend(Node::RightLowerLeg).x,
        bend(Node::LeftFoot),
        load(Node::LeftFoot),
        load(Node::RightFoot),
        1.0 - soles(Node::LeftFoot).y,
        1.0 - soles(Node::RightFoot).y,
        support_margin_m(&me.support, me.centre_of_mass),
        bend(Node::Neck),
        bend(Node::Head),
        log(me.part(Node::LeftFoot).rotation).y * 57.3,
        log(me.part(Node::RightFoot).rotation).y * 57.3,
        me.part(Node::LeftFoot).position,
        me.part(Node::RightFoot).position,
    );
}

fn figure(standing: &Standing) -> Figure {
    let me = &standing.world.frame().characters[0];
    let capsules = Node::ALL.into_iter().map(|node| {
        let (part, shape) = (me.part(node), standing.body.link(node).shape);
        let place = |point: DVec3| part.position + part.rotation * point;
        let shade = match node.part().side() {
            Some(sinew_motion::Side::Left) => Shade::Left,
            Some(sinew_motion::Side::Right) => Shade::Right,
            None => Shade::Midline,
        };
        Capsule::tapered(place(shape.from), place(shape.to), shape.from_radius_m, shape.to_radius_m, shade)
    });
    Figure::new(capsules.collect())
}

fn push(azimuth_deg: f64, impulse_n_s: f64, path: Option<&str>) {
    let mut standing = make();
    let push = Push { azimuth_deg, impulse_n_s, for_secs: 0.1, place: place() };
    let mut panels = Vec::new();
    let seconds = env("SECS", 7.0);
    for step in 0..(240.0 * seconds) as usize {
        standing.step(Some(&push));
        let time = standing.world.frame().time_secs;
        let every = if (2.0..3.0).contains(&time) { 12 } else { 120 };
        if step % every == 0 {
            report(&standing);
        }
        if (1.95..4.5).contains(&time) && step % 24 == 0 {
            let me = &standing.world.frame().characters[0];
            let pushing = (2.0..2.12).contains(&time) && impulse_n_s > 0.0;
            let arrows = if pushing {
                vec![Arrow {
                    at: me.part(Node::Hips).centre.with_y(me.centre_of_mass.y),
                    force_n: push.direction() * (impulse_n_s / 0.1),
                    label: String::new(),
                }]
            } else {
                Vec::new()
            };
            panels.push(Panel {
                time_secs: time,
                figure: figure(&standing),
                follow: Some(DVec3::ZERO),
                arrows,
                ..Panel::default()
            });
        }
    }
    if let Some(path) = path {
        let camera = match std::env::var("VIEW").as_deref() {
            Ok("side") => Camera::side(),
            Ok("front") => Camera::front(),
            _ => Camera::three_quarter(),
        };
        let strip = Filmstrip {
            title: format!("Pushed by {impulse_n_s:.0} N s at {azimuth_deg:.0}°"),
            panels,
            camera,
            style: Style { columns: 9, ..Style::default() },
            ..Filmstrip::default()
        };
        std::fs::write(path, strip.to_png().expect("a picture")).expect("a file");
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |at: usize| arguments.get(at).and_then(|text| text.parse().ok()).unwrap_or(0.0);
    match arguments.first().map(String::as_str) {
        Some("push") => push(number(1), number(2), arguments.get(3).map(String::as_str)),
        Some("scan") => scan(),
        _ => table(),
    }
}
