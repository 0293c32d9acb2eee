//! How long a performer's packet takes to a frame, over real sockets and at the pace of the clock; and an hour of eight performers
//! with clocks that drift, on a virtual one.
//!
//! `cargo bench -p sinew-live` runs all; `-- latency` or `-- drift` one. It is no criterion benchmark: what counts is the tail of
//! one long run. For latency, SECONDS says how long, TRACKER how the bodies follow, and THREADS, with `--features sinew-stage/threads`, on how
//! many threads the world is stepped.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a benchmark")]

use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose, exp};
use sinew_control::perform::{LiveSettings, LiveSource};
use sinew_live::vmc::VmcReader;
use sinew_live::{ClipPlayer, Impairment, Latency, Mirror, Performers};
use sinew_stage::{Scene, Stage};
use sinew_world::CharacterId;
use std::fmt::Write;
use std::net::{IpAddr, Ipv4Addr, SocketAddr, UdpSocket};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

const PHYSICS_HZ: f64 = 240.0;

fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    let is_wanted = |name: &str| wanted.is_empty() || wanted.iter().any(|one| name.contains(one.as_str()));
    if is_wanted("latency") {
        let secs = std::env::var("SECONDS").ok().and_then(|text| text.parse().ok()).unwrap_or(20.0);
        println!("packet received to frame sent, mark: p99 below {:.2} ms", 1e3 / PHYSICS_HZ + 1.0);
        for actors in [1, 8] {
            for hz in [60.0, 120.0] {
                let Ran { latency, late_steps, step_us } = latency(actors, hz, secs);
                let quantile = |share| latency.quantile_ms(share).unwrap_or(f64::NAN);
                println!(
                    "{actors} actors, {hz:3.0} Hz: median {:.2} ms, p99 {:.2} ms; {step_us:.0} us from waking to sent; {late_steps:.2} % of \
                     the steps began late",
                    quantile(0.5),
                    quantile(0.99)
                );
            }
        }
    }
    if is_wanted("drift") {
        drift(3600.0);
    }
}

/// Somebody who sways and waves.
fn player(hz: f64, phase: f64) -> ClipPlayer {
    let body = Body::standard(70.0, 1.7);
    let poses = (0..240).map(|frame| {
        let time = f64::from(frame) / hz + phase;
        let mut locals = [DQuat::IDENTITY; Node::COUNT];
        locals[Node::Chest.index()] = exp(DVec3::new(0.2, 0.1, 0.0) * libm::sin(2.0 * time));
        locals[Node::LeftUpperArm.index()] = exp(DVec3::Z * (0.6 + 0.5 * libm::sin(5.0 * time)));
        locals[Node::RightUpperArm.index()] = exp(DVec3::X * (-0.6 + 0.5 * libm::sin(4.0 * time)));
        Pose::from_locals(DVec3::new(0.0, 0.93, 0.0), &locals)
    });
    ClipPlayer::of_poses(body, poses.collect(), hz).unwrap()
}

struct Ran {
    latency: Latency,
    /// Steps that began over 1 ms late \[%\].
    late_steps: f64,
    /// Mean time from the beginning of a step until its frames are sent \[µs\].
    step_us: f64,
}

fn latency(actors: u16, hz: f64, secs: f64) -> Ran {
    // Ports that are free now.
    let ports: Vec<u16> = (0..actors)
        .map(|_| UdpSocket::bind("127.0.0.1:0").unwrap())
        .collect::<Vec<_>>()
        .iter()
        .map(|socket| socket.local_addr().unwrap().port())
        .collect();
    let mut text = "format = 1\n".to_owned();
    let tracker = std::env::var("TRACKER").unwrap_or_else(|_| "pd".to_owned());
    for (index, port) in ports.iter().enumerate() {
        let _ = write!(
            text,
            "[characters.a{index}]\ntracker = \"{tracker}\"\nposition_m = [{}, 0, 0]\nsource = {{ live = {{ port = {port} }} }}\n",
            index as f64 * 1.5
        );
    }
    let scene = Scene::from_text(&text).unwrap();
    let mut performers = Performers::open(&scene, IpAddr::V4(Ipv4Addr::LOCALHOST), &[]).unwrap();
    let mut stage = Stage::new(scene, None).unwrap();
    stage.set_threads(std::env::var("THREADS").ok().and_then(|text| text.parse().ok()).unwrap_or(1));
    let ends = Arc::new(AtomicBool::new(false));
    let senders: Vec<_> = ports
        .iter()
        .map(|&port| {
            let ends = Arc::clone(&ends);
            std::thread::spawn(move || send(&player(hz, f64::from(port)), port, &ends))
        })
        .collect();
    let viewer = UdpSocket::bind("127.0.0.1:0").unwrap();
    let to: SocketAddr = viewer.local_addr().unwrap();
    let mut mirrors: Vec<Mirror> =
        (0..usize::from(actors)).map(|actor| Mirror::open(CharacterId::first_in(actor), to).unwrap()).collect();
    let began = Instant::now();
    let steps = (secs * PHYSICS_HZ) as u64;
    let mut late = 0u64;
    let mut spent = Duration::ZERO;
    for step in 0..steps {
        let due = Duration::from_secs_f64(step as f64 / PHYSICS_HZ);
        late += u64::from(began.elapsed() > due + Duration::from_millis(1));
        std::thread::sleep(due.saturating_sub(began.elapsed()));
        let woken = Instant::now();
        performers.feed(&mut stage);
        stage.step();
        for mirror in &mut mirrors {
            mirror.send(&stage);
        }
        performers.shown();
        spent += woken.elapsed();
    }
    ends.store(true, Ordering::Relaxed);
    for sender in senders {
        sender.join().unwrap();
    }
    let mut all = Latency::default();
    for index in 0..actors {
        all.merge(performers.of(&format!("a{index}")).unwrap().1);
    }
    Ran {
        latency: all,
        late_steps: 100.0 * late as f64 / steps as f64,
        step_us: spent.as_secs_f64() / steps as f64 * 1e6,
    }
}

fn send(player: &ClipPlayer, port: u16, ends: &AtomicBool) {
    let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
    let began = Instant::now();
    let mut number = 0;
    while !ends.load(Ordering::Relaxed) {
        let due = Duration::from_secs_f64(number as f64 * player.interval_secs());
        std::thread::sleep(due.saturating_sub(began.elapsed()));
        for (_, bytes) in player.datagrams(number, &Impairment::default()) {
            let _ = socket.send_to(&bytes, ("127.0.0.1", port));
        }
        number += 1;
    }
}

fn drift(secs: f64) {
    println!("{secs} s of performers at 60 Hz with 10 ms of jitter and 2 % loss, on a virtual clock");
    for ppm in [100.0, -100.0, 50.0, -50.0, 20.0, -20.0, 5.0, 0.0] {
        let player = player(60.0, 0.0);
        let impairment = Impairment { jitter_secs: 0.01, loss: 0.02, seed: 7, ..Impairment::default() };
        let body = player.body().clone();
        let mut source = LiveSource::new(&body, DVec3::ZERO, 0.0, &Pose::STANDING, LiveSettings::default());
        let mut reader = VmcReader::new();
        let mut under_way: Vec<(f64, Vec<u8>)> = Vec::new();
        let (mut number, mut most_waiting) = (0u64, 0);
        let mut lags = [0.0; 2];
        let clock = 1.0 + ppm * 1e-6;
        let minute = 60.0 * PHYSICS_HZ;
        let steps = (secs * PHYSICS_HZ) as u64;
        for step in 0..steps {
            let now = step as f64 / PHYSICS_HZ;
            while number as f64 * player.interval_secs() / clock <= now {
                let sent = number as f64 * player.interval_secs();
                let datagrams = player.datagrams(number, &impairment);
                under_way.extend(datagrams.map(|(arrival, bytes)| (sent / clock + arrival - sent, bytes)));
                number += 1;
            }
            under_way.sort_by(|(one, _), (other, _)| one.total_cmp(other));
            let due = under_way.partition_point(|(arrival, _)| *arrival <= now);
            for (arrival, bytes) in under_way.drain(..due) {
                let _ = reader.datagram(&bytes, arrival, &mut |sample| source.receive(&sample, now));
            }
            source.advance(now, 1.0 / PHYSICS_HZ);
            most_waiting = most_waiting.max(source.waiting());
            let lag = source.lag_secs(now).unwrap_or(0.0) / minute;
            match step {
                step if (1..2).contains(&(step / minute as u64)) => lags[0] += lag,
                step if step + minute as u64 >= steps => lags[1] += lag,
                _ => {}
            }
        }
        println!(
            "{ppm:5} ppm: delay {:.1} ms in the second minute, {:.1} ms in the last; at most {most_waiting} samples wait",
            lags[0] * 1e3,
            lags[1] * 1e3
        );
    }
}
