//! `sinew perform` and `sinew run` as their user has them: two programs and a socket.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use crate::command::{json, sinew};
use serde_json::Value;
use std::net::{TcpListener, UdpSocket};
use std::path::Path;
use std::process::{Child, Command, Stdio};

const SCENE: &str = "format = 1\n[characters.blue]\ntracker = \"kinematic\"\nposition_m = [2, 0, 0]\n\
                     source = { live = { port = 1 } }\n[characters.red]\ntracker = \"kinematic\"\n\
                     source = { live = { port = 2 } }\n";

/// A port that nobody has.
fn free_port() -> u16 {
    UdpSocket::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port()
}

fn scene(folder: &Path) -> [u16; 2] {
    let ports = [free_port(), free_port()];
    let text = SCENE.replace("port = 1", &format!("port = {}", ports[0]));
    std::fs::write(folder.join("two.toml"), text.replace("port = 2", &format!("port = {}", ports[1]))).unwrap();
    ports
}

/// The sample walk, performed to a port until it is killed.
fn perform(port: u16, arguments: &[&str]) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_sinew"));
    command.args(["perform", "--to", &format!("udp://127.0.0.1:{port}")]).args(arguments);
    command.stdout(Stdio::null()).spawn().unwrap()
}

fn run(folder: &Path, port: u16, arguments: &[&str]) -> Value {
    let mut performer = perform(port, &["--loss", "0.05", "--jitter", "10", "--corrupt", "0.05"]);
    let ran = sinew(folder, ["run", "two.toml", "--for", "3"].iter().chain(arguments));
    performer.kill().unwrap();
    performer.wait().unwrap();
    ran.done();
    json(&folder.join("r.json"))
}

fn count(report: &Value, actor: &str, key: &str) -> u64 {
    report["actors"][actor][key].as_u64().unwrap()
}

#[test]
fn a_performance_over_a_socket_is_reported_replayed_re_run_on_another_body_and_performed_over() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let ports = scene(folder);
    let first = run(folder, ports[1], &["--take", "first.take", "--report", "r.json"]);
    // 60 a second for three seconds of the scene less what is lost; a machine with much to do starts the performer late, or takes
    // longer than three seconds.
    assert!((40..2000).contains(&count(&first, "red", "received")), "{}", first["actors"]);
    assert!(count(&first, "red", "lost") > 0 && count(&first, "red", "rejected") > 0, "{}", first["actors"]);
    assert_eq!(first["actors"]["red"]["lost_is_estimate"], false);
    assert!(first["actors"]["red"]["latency_ms"]["p99"].as_f64().unwrap() > 0.0);
    assert_eq!(count(&first, "blue", "received"), 0);
    // The same bits, and the same book.
    sinew(folder, ["replay", "first.take", "--report", "again.json"]).done();
    let again = json(&folder.join("again.json"));
    assert_eq!(again["hash"], first["hash"]);
    assert_eq!(again["actors"]["red"]["counters"], first["actors"]["red"]["counters"]);
    assert!(again["actors"]["red"]["latency_ms"].is_null());
    // The same performance on a taller body.
    let set = ["replay", "first.take", "--set", "characters.red.height_m=2.2", "--report", "tall.json"];
    sinew(folder, set).done();
    let tall = json(&folder.join("tall.json"));
    let hips = |report: &Value| report["characters"]["red"]["hips_height_end_m"].as_f64().unwrap();
    // 2.2 m instead of 1.7.
    assert!((hips(&tall) / hips(&first) - 2.2 / 1.7).abs() < 0.1, "{} {}", hips(&tall), hips(&first));
    // Somebody else performs over it.
    let second = run(folder, ports[0], &["--over", "first.take", "--take", "second.take", "--report", "r.json"]);
    assert_eq!(second["actors"]["red"]["counters"], first["actors"]["red"]["counters"], "as it was");
    assert!(count(&second, "blue", "received") > 40);
    sinew(folder, ["replay", "second.take"]).done();
}

#[test]
fn a_shipped_scene_is_taken_over_from_its_understudy_by_whoever_performs() {
    let folder = tempfile::tempdir().unwrap();
    let port = free_port();
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/tetherball.toml");
    let port_there = format!("characters.player.source.live.port={port}");
    let arguments = ["run", scene.to_str().unwrap(), "--set", &port_there, "--for", "2.5", "--report", "r.json"];
    let mut performer = perform(port, &[]);
    let ran = sinew(folder.path(), arguments);
    performer.kill().unwrap();
    performer.wait().unwrap();
    assert!(ran.done().out.contains("player is performed in place of its understudy"));
    assert!(count(&json(&folder.path().join("r.json")), "player", "received") > 40);
}

#[test]
fn a_suit_that_broadcasts_raw_is_followed() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
    let text = "format = 1\n[characters.red]\nsource = { live = { raw_port = PORT } }\ntracker = \"kinematic\"\n";
    std::fs::write(folder.join("raw.toml"), text.replace("PORT", &port.to_string())).unwrap();
    let stage = std::thread::spawn({
        let folder = folder.to_owned();
        move || sinew(&folder, ["run", "raw.toml", "--for", "4", "--report", "r.json"])
    });
    let to = format!("tcp://127.0.0.1:{port}");
    // The stage may not listen yet.
    let performed = (0..40).any(|_| {
        std::thread::sleep(std::time::Duration::from_millis(50));
        sinew(folder, ["perform", "--to", &to, "--for", "3"]).code == 0
    });
    stage.join().unwrap().done();
    assert!(performed);
    let report = json(&folder.join("r.json"));
    // Of three seconds at the sample's 60 Hz the first is watched only.
    assert!(count(&report, "red", "received") > 40, "{}", report["actors"]);
    assert_eq!(count(&report, "red", "rejected"), 0, "{}", report["actors"]);
    sinew(folder, ["perform", "--to", &to, "--loss", "0.1"]).failed(&["a raw stream comes whole"]);
}

#[test]
fn a_scene_with_performers_runs_without_any_when_it_is_told_to() {
    let folder = tempfile::tempdir().unwrap();
    scene(folder.path());
    let taken: Vec<String> = ["run", "two.toml", "--no-live", "--for", "0.5"].map(str::to_owned).to_vec();
    assert!(sinew(folder.path(), taken).done().out.contains("120 steps"));
}

#[test]
fn what_cannot_be_performed_or_heard_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    sinew(folder, ["perform", "--to", "127.0.0.1:39539"]).failed(&["write udp://HOST:PORT"]);
    sinew(folder, ["perform", "none.bvh", "--to", "udp://127.0.0.1:39539"]).failed(&["none.bvh"]);
    std::fs::write(folder.join("walk.txt"), "no BVH").unwrap();
    sinew(folder, ["perform", "walk.txt", "--to", "tcp://127.0.0.1:9"]).failed(&["walk.txt", "begins with HIERARCHY"]);
    // What has no end is not read.
    sinew(folder, ["perform", "/dev/zero", "--to", "tcp://127.0.0.1:9"]).failed(&["it is not a file"]);
    sinew(folder, ["perform", "--to", "udp://127.0.0.1:39539", "--loss", "5"]).refused(&["from 0 to 1"]);
    let port = scene(folder)[0];
    let _taken = UdpSocket::bind(("127.0.0.1", port)).unwrap();
    sinew(folder, ["run", "two.toml"]).failed(&["is it in use?"]);
    sinew(folder, ["run", "two.toml", "--no-live", "--vmc-out", "green@127.0.0.1:9"]).failed(&["no character `green`"]);
}
