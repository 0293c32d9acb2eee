//! Performers' input and viewers' output of a running scene.

use crate::port_words::PortWords;
use anyhow::{Context, Result, bail};
use sinew::control::{Action, Command};
use sinew::live::{Mirror, Performers};
use sinew::stage::take::{Stamped, due};
use sinew::stage::{Observer, Scene, Stage, Take};
use sinew::world::CharacterId;
use std::net::{IpAddr, Ipv4Addr, SocketAddr, ToSocketAddrs};
use std::path::PathBuf;

/// Arguments about performers.
#[derive(Debug, clap::Args)]
pub(crate) struct LiveArguments {
    /// The address of this machine to listen on for performers; 0.0.0.0 accepts other machines.
    #[arg(long, value_name = "ADDRESS", default_value_t = IpAddr::V4(Ipv4Addr::LOCALHOST))]
    listen: IpAddr,
    /// Open no port for performers, and do not run in real time.
    #[arg(long)]
    no_live: bool,
    /// Send a character's simulated pose to a program that shows VMC, such as 127.0.0.1:39540 or red@127.0.0.1:39540; may be
    /// repeated. Without a name it is the first character.
    #[arg(long, value_name = "[NAME@]HOST:PORT")]
    vmc_out: Vec<String>,
    /// Record over a take: its performers and commands are replayed, and characters that were not performed in it are
    /// live.
    #[arg(long, value_name = "T.take")]
    over: Option<PathBuf>,
}

/// Ports, viewers and the take below.
pub(crate) struct Live {
    performers: Performers,
    mirrors: Vec<Mirror>,
    below: Vec<Stamped>,
    steps_per_frame: u64,
    words: PortWords,
}

impl LiveArguments {
    /// Opens what the scene and the arguments ask for.
    pub(crate) fn open(&self, scene: &Scene) -> Result<Live> {
        let below = self.below(scene)?;
        let mut performed: Vec<String> = below
            .iter()
            .filter(|stamped| matches!(stamped.command.action, Action::Perform { .. }))
            .filter_map(|stamped| stamped.command.character.clone())
            .collect();
        performed.sort();
        performed.dedup();
        let performers =
            if self.no_live { Performers::default() } else { Performers::open(scene, self.listen, &performed)? };
        for (name, address) in performers.addresses() {
            eprintln!("listening for {name} on {address}");
        }
        let mirrors = self.vmc_out.iter().map(|argument| mirror(scene, argument)).collect::<Result<_>>()?;
        let steps_per_frame = u64::from(scene.stage.steps_per_frame());
        Ok(Live { performers, mirrors, below, steps_per_frame, words: PortWords::default() })
    }

    fn below(&self, scene: &Scene) -> Result<Vec<Stamped>> {
        let Some(path) = &self.over else { return Ok(Vec::new()) };
        let take = Take::open(path)?;
        if take.physics_hz != scene.stage.physics_hz {
            bail!(
                "{}: it was recorded at {} Hz, the scene has physics_hz = {}; make them equal",
                path.display(),
                take.physics_hz,
                scene.stage.physics_hz
            );
        }
        // The time limit of scripts applies anew.
        let is_kept = |stamped: &Stamped| !matches!(stamped.command.action, Action::ScriptKilled { .. });
        Ok(take.commands.into_iter().filter(is_kept).collect())
    }
}

fn mirror(scene: &Scene, argument: &str) -> Result<Mirror> {
    let (name, address) = match argument.rsplit_once('@') {
        Some((name, address)) => (Some(name), address),
        None => (None, argument),
    };
    let known = || scene.characters.keys().cloned().collect::<Vec<_>>().join(", ");
    let character = match name {
        Some(name) => scene
            .characters
            .keys()
            .position(|known| known == name)
            .map(CharacterId::first_in)
            .with_context(|| format!("--vmc-out: no character `{name}`; there are {}", known()))?,
        None if scene.characters.is_empty() => bail!("--vmc-out: the scene has no character"),
        None => CharacterId::first_in(0),
    };
    Ok(Mirror::open(character, resolve(address)?)?)
}

/// The address behind HOST:PORT.
pub(crate) fn resolve(text: &str) -> Result<SocketAddr> {
    let mut found =
        text.to_socket_addrs().with_context(|| format!("{text}: write HOST:PORT, such as 127.0.0.1:39539"))?;
    found.next().with_context(|| format!("{text}: no such host"))
}

impl Live {
    /// Whether a performer's port is open, so that the stage must run in real time.
    pub(crate) fn keeps_time(&self) -> bool {
        !self.performers.is_empty()
    }

    /// The ports, for the report.
    pub(crate) fn performers(&self) -> &Performers {
        &self.performers
    }
}

impl Observer for Live {
    fn after_step(&mut self, stage: &Stage) {
        if stage.frame().step.is_multiple_of(self.steps_per_frame) {
            for mirror in &mut self.mirrors {
                mirror.send(stage);
            }
        }
        self.performers.shown();
        self.words.look(&self.performers);
    }

    /// Passes the samples that have arrived and the commands of the underlying take to the next step.
    fn before_step(&mut self, stage: &mut Stage) {
        let step = stage.frame().step;
        if step == 0 {
            self.after_step(stage);
        }
        for stamped in due(&self.below, step) {
            stage.command(Command::clone(&stamped.command));
        }
        self.performers.feed(stage);
    }
}
