//! A tug of war on real network hosts: namespaces of this machine, joined by virtual cables, with a relay between that adds
//! the delay of a long way.
//!
//! ```text
//! red: sinew perform ─▶ sinew join ──┐     40 ms each way     ┌── stage
//!                                    ├─▶ way: relay ─────────▶│ sinew serve
//! blue: sinew perform ─▶ sinew join ─┘                        └──
//! ```

use crate::{command, repository};
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Two who pull on one rope.
const SCENE: &str = "scenes/tug-of-war.toml";

/// The key with which red is pulled.
const KEY: &str = "2";

/// Port of a performer on its own host.
const VMC: &str = "39539";

/// Delay of the relay each way \[ms\].
const DELAY_MS: u32 = 40;

/// Runs two performed actors and a stage on three hosts, kills one actor and lets it come back, and checks hashes and times. Says
/// that it is skipped where namespaces are not permitted.
///
/// # Errors
/// When a claim does not hold.
pub fn run() -> Result<(), String> {
    let root = repository::root();
    let hosts = match Hosts::make() {
        Ok(hosts) => hosts,
        Err(problem) => {
            println!("SKIPPED: network namespaces are not permitted here ({})", problem.trim());
            return Ok(());
        }
    };
    let programs = ["--bin", "sinew", "--example", "session_check", "--example", "relay"];
    let packages = ["--package", "sinew-cli", "--package", "sinew", "--package", "sinew-live"];
    let features = ["--no-default-features", "--features", "sinew-cli/session,sinew/session"];
    command::run(command::cargo(&root, &["build"]).args(packages).args(features).args(programs))?;
    let target = repository::target().join("debug");
    let folder = std::env::temp_dir().join(format!("sinew-hosts-{}", std::process::id()));
    fs::create_dir(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let done = Session { hosts: &hosts, target: &target, folder: &folder, scene: &root.join(SCENE) }.run();
    let _ = fs::remove_dir_all(&folder);
    done
}

/// The hosts, gone when this is dropped.
struct Hosts {
    mark: u32,
}

/// Host, its address, and the way's address on the same cable.
const CABLES: [(&str, &str, &str); 3] =
    [("stage", "10.77.1.2", "10.77.1.1"), ("red", "10.77.2.2", "10.77.2.1"), ("blue", "10.77.3.2", "10.77.3.1")];

impl Hosts {
    fn make() -> Result<Hosts, String> {
        let hosts = Hosts { mark: std::process::id() % 100_000 };
        for host in ["way", "stage", "red", "blue"] {
            ip(&["netns", "add", &hosts.name(host)])?;
            ip(&["-n", &hosts.name(host), "link", "set", "lo", "up"])?;
        }
        for (host, here, there) in CABLES {
            let end = format!("to-{host}");
            let (name, way) = (hosts.name(host), hosts.name("way"));
            ip(&["-n", &way, "link", "add", &end, "type", "veth", "peer", "name", "cable", "netns", &name])?;
            ip(&["-n", &name, "address", "add", &format!("{here}/24"), "dev", "cable"])?;
            ip(&["-n", &way, "address", "add", &format!("{there}/24"), "dev", &end])?;
            ip(&["-n", &name, "link", "set", "cable", "up"])?;
            ip(&["-n", &way, "link", "set", &end, "up"])?;
        }
        Ok(hosts)
    }

    fn name(&self, host: &str) -> String {
        format!("sinew-{}-{host}", self.mark)
    }

    /// A program on a host.
    fn start(&self, host: &str, program: &Path, arguments: &[&str]) -> Result<Running, String> {
        println!("{host:>5}$ {} {}", program.file_name().unwrap_or_default().display(), arguments.join(" "));
        let mut command = Command::new("ip");
        command.args(["netns", "exec", &self.name(host)]).arg(program).args(arguments).stdin(Stdio::null());
        command.spawn().map(Running).map_err(|error| error.to_string())
    }
}

impl Drop for Hosts {
    fn drop(&mut self) {
        for host in ["red", "blue", "stage", "way"] {
            let _ = ip(&["netns", "delete", &self.name(host)]);
        }
    }
}

fn ip(arguments: &[&str]) -> Result<(), String> {
    command::output(Command::new("ip").args(arguments)).map(|_| ())
}

/// A program that is ended when this is dropped.
struct Running(Child);

impl Running {
    fn kill(mut self) -> Result<(), String> {
        self.0.kill().and_then(|()| self.0.wait()).map(|_| ()).map_err(|error| error.to_string())
    }

    fn wait(mut self) -> Result<(), String> {
        let status = self.0.wait().map_err(|error| error.to_string())?;
        if status.success() { Ok(()) } else { Err(format!("a program on a host has failed: {status}")) }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

struct Session<'a> {
    hosts: &'a Hosts,
    target: &'a Path,
    folder: &'a Path,
    scene: &'a Path,
}

impl Session<'_> {
    fn run(&self) -> Result<(), String> {
        let sinew = self.target.join("sinew");
        let relay = self.target.join("examples/relay");
        let (token, take) = (self.path("token"), self.path("session.take"));
        let (server, red, blue) = (self.path("server.json"), self.path("red.json"), self.path("blue.json"));
        let scene = self.scene.to_str().ok_or("the scene's path is not Unicode")?;
        let delay = DELAY_MS.to_string();
        let mut performers = Vec::new();
        for host in ["red", "blue"] {
            // What the understudy does, once more as a performer: it stays where the rope is.
            let clip = self.path(&format!("{host}.bvh"));
            command::output(Command::new(&sinew).args(["run", scene, "--no-live", "--character", host, "-o", &clip]))?;
            performers.push(self.hosts.start(
                host,
                &sinew,
                &["perform", &clip, "--to", &format!("udp://127.0.0.1:{VMC}")],
            )?);
        }
        let _relay = self.hosts.start("way", &relay, &["0.0.0.0:47111", "10.77.1.2:47110", &delay])?;
        let serve = ["serve", scene, "--bind", "10.77.1.2:47110", "--token-file", &token, "--for", "24"];
        let stage =
            self.hosts.start("stage", &sinew, &[&serve[..], &["--take", &take, "--report", &server]].concat())?;
        self.appears(&token)?;
        let join = |host: &str, way: &str, report: &str, more: &[&str]| {
            let begin = ["join", way, "--token-file", &token, "--as", host, "--vmc", VMC, "--report", report];
            self.hosts.start(host, &sinew, &[&begin[..], more].concat())
        };
        let presses: Vec<String> = ["2", "4", "6", "16"].iter().map(|secs| format!("{KEY}@{secs}")).collect();
        let presses: Vec<&str> = presses.iter().flat_map(|press| ["--press", press]).collect();
        let pulls = join("red", "10.77.2.1:47111", &red, &[&["--for", "20"], &presses[..]].concat())?;
        let first = join("blue", "10.77.3.1:47111", &blue, &[])?;
        sleep(Duration::from_secs(8));
        println!(" blue is killed");
        first.kill()?;
        sleep(Duration::from_secs(3));
        let again = join("blue", "10.77.3.1:47111", &blue, &["--for", "8"])?;
        again.wait()?;
        pulls.wait()?;
        stage.wait()?;
        let round_trip = (2 * DELAY_MS).to_string();
        let mut check = Command::new(self.target.join("examples/session_check"));
        command::run(check.args([&take, &server, &round_trip, &red, &blue]))
    }

    fn path(&self, name: &str) -> String {
        self.folder.join(name).display().to_string()
    }

    /// Waits until the server has written its tokens.
    fn appears(&self, path: &str) -> Result<(), String> {
        let began = Instant::now();
        while fs::metadata(path).map_or(0, |file| file.len()) == 0 {
            if began.elapsed() > Duration::from_secs(20) {
                return Err("the server did not begin".to_owned());
            }
            sleep(Duration::from_millis(50));
        }
        Ok(())
    }
}
