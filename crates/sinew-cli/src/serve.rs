//! `sinew serve`.

use crate::interactive::Interactive;
use crate::output;
use crate::run::{Out, assignment};
use anyhow::{Context, Result};
use sinew::jobs::run::Footage;
use sinew::jobs::session::{ServeJob, serve};
use sinew::live::session::{Role, SceneManifest, Server, ServerSettings, limits};
use sinew::script::ScriptHost;
use sinew::stage::Scene;
use std::net::{IpAddr, SocketAddr};
use std::path::{Path, PathBuf};

/// Arguments of `sinew serve`.
#[derive(Debug, clap::Args)]
pub(crate) struct Serve {
    /// The scene file.
    scene: PathBuf,
    /// The address to bind, with or without a port; 0.0.0.0 accepts every machine of the network. Default: loopback,
    /// which accepts only this machine.
    #[arg(long, value_name = "ADDRESS[:PORT]", default_value = "127.0.0.1", value_parser = bind)]
    bind: SocketAddr,
    /// Host name of this machine as others know it, for the token. Default: the bound address.
    #[arg(long, value_name = "HOST")]
    name: Option<String>,
    /// Also write the tokens to this file: the actors' in the first line, the operator's in the second. Only you can
    /// read it.
    #[arg(long, value_name = "F")]
    token_file: Option<PathBuf>,
    /// Maximum number of connected clients.
    #[arg(long, alias = "most-clients", value_name = "N", default_value_t = 32)]
    max_clients: usize,
    /// Duration [s]. Default: until interrupted.
    #[arg(long = "for", value_name = "SECONDS")]
    for_secs: Option<f64>,
    /// Change a value of the scene first, such as characters.left.pose_gain=2; may be repeated.
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    set: Vec<(String, String)>,
    /// Where to record the take, for `sinew replay`.
    #[arg(long, value_name = "T.take")]
    take: Option<PathBuf>,
    #[command(flatten)]
    out: Out,
}

fn bind(text: &str) -> Result<SocketAddr, String> {
    if let Ok(address) = text.parse() {
        return Ok(address);
    }
    let ip: IpAddr =
        text.parse().map_err(|_| "write an address of this machine, such as 192.168.1.5 or 0.0.0.0:47110")?;
    Ok(SocketAddr::new(ip, limits::DEFAULT_PORT))
}

impl Serve {
    pub(crate) fn run(&self) -> Result<()> {
        self.out.check([&self.scene].into_iter(), self.take.iter().chain(&self.token_file))?;
        let mut scene = Scene::read(&self.scene)?;
        for (path, value) in &self.set {
            scene.set(path, value)?;
        }
        let settings = ServerSettings { bind: self.bind, name: self.name.clone(), max_clients: self.max_clients };
        let (server, queue) = Server::open(&settings, SceneManifest::of(&scene)?)?;
        self.tell(&server, &scene)?;
        server.stop_on_interrupt();
        let job = ServeJob {
            for_secs: self.for_secs,
            host: ScriptHost::find(),
            keeps_take: self.take.is_some(),
            keeps_motion: self.out.needs_motion(),
        };
        let for_picture = scene.clone();
        let mut keyboard = Interactive::begin(&scene);
        let served = serve(scene, &job, &server, queue, &mut [&mut keyboard])?;
        drop(server);
        if let (Some(path), Some(take)) = (&self.take, &served.take) {
            output::make_folder(path)?;
            take.write(path)?;
        }
        let run = &served.report.run;
        if let Some(recording) = &served.recording {
            let subtitle = format!("{:.2} s, {} physics steps, served", run.duration_s, run.steps);
            let footage = Footage { recording, scene: &for_picture, marks: &served.marks };
            self.out.write_motion(&footage, &subtitle)?;
        }
        self.out.files().write_report(&served.report)?;
        let clients = &served.report.clients;
        let mut lines = vec![
            format!("{}: {:.2} s, {} steps, hash {}", self.scene.display(), run.duration_s, run.steps, run.hash),
            format!(
                "{} clients joined, {} connections refused; {} requests queued, {} refused, {} dropped",
                clients.joined,
                clients.connections_refused,
                clients.requests,
                clients.requests_refused,
                clients.requests_dropped
            ),
        ];
        lines.extend(self.out.files().words(self.take.iter()));
        output::say(&lines.join("\n"))
    }

    /// Prints once how to join.
    fn tell(&self, server: &Server, scene: &Scene) -> Result<()> {
        let (actor, operator) = (server.token(Role::Actor), server.token(Role::Operator));
        if let Some(path) = &self.token_file {
            write_secretly(path, &format!("{actor}\n{operator}\n"))?;
        }
        let whom: Vec<&str> = scene.characters.keys().map(String::as_str).collect();
        let reach = if server.address().ip().is_loopback() {
            "for this machine only; --bind accepts others"
        } else {
            "every holder of a token can join"
        };
        output::say(&format!(
            "{} is served at {}, {reach}\nactors ({}):  sinew join {actor} --as NAME\nthe operator:  sinew join {operator}",
            self.scene.display(),
            server.address(),
            whom.join(", "),
        ))
    }
}

/// Writes a file that only its owner can read.
fn write_secretly(path: &Path, text: &str) -> Result<()> {
    use std::io::Write;
    output::make_folder(path)?;
    // An existing file may be open to others.
    let _ = std::fs::remove_file(path);
    let mut options = std::fs::OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    let place = || format!("{}: the tokens cannot be written; choose another place", path.display());
    let mut file = options.open(path).with_context(place)?;
    file.write_all(text.as_bytes()).with_context(place)
}
