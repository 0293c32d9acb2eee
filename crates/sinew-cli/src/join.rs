//! `sinew join`.

use crate::output;
use crate::run::{Out, press};
use anyhow::{Context, Result, bail};
use sinew::control::Command;
use sinew::jobs::run::Footage;
use sinew::jobs::session::{JoinReport, View};
use sinew::live::Port;
use sinew::live::session::{Client, ConnectionState, Role, Token};
use std::io::BufRead;
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, sync_channel};
use std::time::{Duration, Instant};

/// Arguments of `sinew join`.
#[derive(Debug, clap::Args)]
pub(crate) struct Join {
    /// The token that `sinew serve` printed; or the server's HOST or HOST:PORT, with --token-file.
    server: String,
    /// The actor to play; may be repeated. Without it you watch, or operate with the operator's token.
    #[arg(long = "as", value_name = "ACTOR")]
    actors: Vec<String>,
    /// Send a performer's motion: listen for VMC on this UDP port; samples go to the first actor.
    #[arg(long, value_name = "PORT", requires = "actors")]
    vmc: Option<u16>,
    /// The address of this machine to listen on for the performer; 0.0.0.0 accepts other machines.
    #[arg(long, value_name = "ADDRESS", default_value_t = IpAddr::V4(Ipv4Addr::LOCALHOST))]
    listen: IpAddr,
    /// A file with the token, such as `sinew serve --token-file` wrote: with --as the first line is taken, else the last.
    #[arg(long, value_name = "F")]
    token_file: Option<PathBuf>,
    /// Leave after this time [s]. Default: when the session ends.
    #[arg(long = "for", value_name = "SECONDS")]
    for_secs: Option<f64>,
    /// Press a key of the scene at a time after joining [s], such as b@1.5; may be repeated.
    #[arg(long, value_name = "KEY@SECONDS", value_parser = press)]
    press: Vec<(f64, String)>,
    /// Send lines of the standard input: a key of the scene, or a command as JSON such as
    /// {"character":"red","do":"pose","name":"guard"}.
    #[arg(long)]
    keys: bool,
    /// Azimuth of your own camera, about +Y from +Z to +X [degrees]. Default: the scene's.
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true)]
    camera: Option<f64>,
    #[command(flatten)]
    out: Out,
}

/// Maximum wait for a frame.
const LOOK: Duration = Duration::from_millis(5);

/// Lines that wait to be sent.
const MAX_LINES: usize = 100;

impl Join {
    pub(crate) fn run(&self) -> Result<()> {
        self.out.check(self.token_file.iter(), std::iter::empty())?;
        let token = self.token()?;
        // Opened first, so that a port in use is an error before the session is joined.
        let performer = self.vmc.map(|port| Port::vmc(SocketAddr::new(self.listen, port))).transpose()?;
        let client = Client::join(&token, &self.actors)?;
        let whom = match (self.actors.is_empty(), token.role) {
            (false, _) => self.actors.join(", "),
            (true, Role::Operator) => "its operator".to_owned(),
            (true, Role::Actor) => "a spectator".to_owned(),
        };
        output::say(&format!("joined {} as {whom} at step {}", client.scene().file_name(), client.welcome().step))?;
        let mut view = if self.out.needs_motion() { Some(View::of(&client)?) } else { None };
        self.stay(&client, performer.as_ref(), view.as_mut())?;
        let report = JoinReport::of(&client);
        let mut scene = client.scene().clone();
        drop(client);
        if let Some(view) = view.filter(|view| view.recording().frames > 0) {
            if let Some(degrees) = self.camera {
                scene.set("camera.from_deg", &degrees.to_string())?;
            }
            // Those of the scene count from its start.
            scene.set("camera.times_secs", "[]")?;
            let first = report.stats.first_step.unwrap_or_default();
            let footage = Footage { recording: view.recording(), scene: &scene, marks: view.marks() };
            self.out.write_motion(&footage, &format!("as {whom} saw it from step {first} on"))?;
        }
        self.out.files().write_report(&report)?;
        let stats = &report.stats;
        let mut lines = vec![format!(
            "{} frames to step {}, {} late, {} differ; round trip {:.1} ms",
            stats.frames,
            stats.last_step.unwrap_or_default(),
            stats.frames_late,
            stats.frames_that_differ,
            stats.round_trip_ms
        )];
        lines.extend(stats.rejected.iter().map(|problem| format!("rejected by the server: {problem}")));
        lines.extend(self.out.files().words(std::iter::empty()));
        output::say(&lines.join("\n"))?;
        if stats.frames_that_differ > 0 {
            bail!("received frames differ from the server's: their hashes differ; use the same Sinew on both sides");
        }
        match report.ended {
            Some(why) if stats.frames == 0 => bail!("{why}"),
            _ => Ok(()),
        }
    }

    /// Until the time is over or the session ends.
    fn stay(&self, client: &Client, performer: Option<&Port>, mut view: Option<&mut View>) -> Result<()> {
        let lines = self.keys.then(lines);
        let mut presses = self.press.clone();
        presses.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        let mut presses = presses.into_iter().peekable();
        let began = Instant::now();
        let mut stood = ConnectionState::Connected;
        loop {
            let passed = began.elapsed().as_secs_f64();
            if self.for_secs.is_some_and(|secs| passed >= secs) {
                return Ok(());
            }
            while let Some((_, key)) = presses.next_if(|(secs, _)| *secs <= passed) {
                client.press(&key);
            }
            for line in lines.iter().flat_map(Receiver::try_iter) {
                send(client, line.trim());
            }
            while let Some((_, sample)) = performer.and_then(Port::next) {
                client.perform(0, sample);
            }
            // With a performer the wait is short, so that its samples are sent without delay.
            let within = if performer.is_some() { LOOK / 5 } else { LOOK };
            if let Some(frame) = client.next_frame(within)
                && let Some(view) = &mut view
            {
                view.push(&frame);
            }
            let stands = client.state();
            if stands != stood {
                match &stands {
                    ConnectionState::Connected => eprintln!("connected again"),
                    ConnectionState::Rejoining => eprintln!("the connection is lost; trying again"),
                    ConnectionState::Ended(why) => {
                        eprintln!("{why}");
                        return Ok(());
                    }
                }
                stood = stands;
            }
        }
    }

    fn token(&self) -> Result<Token> {
        let Some(path) = &self.token_file else {
            let token: Token = self.server.parse().with_context(|| {
                format!(
                    "`{}` is not a valid token, and a host needs --token-file",
                    self.server.chars().take(80).collect::<String>()
                )
            })?;
            return Ok(token);
        };
        let token: Token = self.line(&read_small(path)?).parse()?;
        Ok(token.with_address(&self.server)?)
    }

    fn line<'a>(&self, text: &'a str) -> &'a str {
        let mut lines = text.lines().filter(|line| !line.trim().is_empty());
        let line = if self.actors.is_empty() { lines.next_back() } else { lines.next() };
        line.unwrap_or_default()
    }
}

fn read_small(path: &Path) -> Result<String> {
    use std::io::Read;
    let place = || format!("{}: the token cannot be read; check the file", path.display());
    let mut text = String::new();
    std::fs::File::open(path).and_then(|file| file.take(4096).read_to_string(&mut text)).with_context(place)?;
    Ok(text)
}

/// Lines of the standard input, read by a thread that ends with the program or the input.
fn lines() -> Receiver<String> {
    let (sender, lines) = sync_channel(MAX_LINES);
    std::thread::spawn(move || {
        for line in std::io::stdin().lock().lines().map_while(Result::ok) {
            if sender.send(line).is_err() {
                break;
            }
        }
    });
    lines
}

fn send(client: &Client, line: &str) {
    let is_sent = if line.is_empty() {
        true
    } else if line.starts_with('{') {
        match serde_json::from_str::<Command>(line) {
            Ok(command) => client.command(command),
            Err(error) => {
                eprintln!("not a valid command: {error}");
                true
            }
        }
    } else {
        client.press(line)
    };
    if !is_sent {
        eprintln!("the send queue is full; this line is dropped");
    }
}
