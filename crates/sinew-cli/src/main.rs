//! The `sinew` command: arguments in, jobs of the library, text out.

mod convert;
mod files;
mod flag_names;
mod ground;
mod inspect;
mod interactive;
#[cfg(feature = "session")]
mod join;
mod live;
mod number;
mod output;
mod perform;
mod port_words;
mod progress;
mod push_argument;
mod reach;
mod reach_argument;
mod respond;
mod run;
#[cfg(feature = "session")]
mod serve;
mod stop;
mod video;
#[cfg(not(feature = "session"))]
mod without_session;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use number::within;
use sinew::jobs::ground::GroundError;
use sinew::jobs::reach::ReachError;
use sinew::jobs::respond::RespondError;
use sinew::motion::formats::ReadOptions;
use sinew::motion::{Part, UnknownPart};
use std::path::PathBuf;
use std::process::ExitCode;

/// Animated characters that respond to physics.
#[derive(Debug, Parser)]
#[command(version, propagate_version = true)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Inspect a motion file: skeleton, body parts, gait, defects.
    Inspect(inspect::Inspect),
    /// Convert a motion file into another format.
    Convert(convert::Convert),
    /// Put a clip on its floor: no sliding, floating, sinking or shaking feet.
    Ground(ground::Ground),
    /// Push a character: it yields and recovers.
    Respond(respond::Respond),
    /// Reach for a target with arms, spine, head and legs.
    Reach(reach::Reach),
    /// Run a scene: characters in a physical world.
    Run(run::Run),
    /// Play a motion file as a live performer, optionally over an emulated bad network.
    Perform(perform::Perform),
    /// Replay a take, bit for bit, or with other values.
    Replay(run::Replay),
    /// Run a scene for actors on several machines.
    #[cfg(feature = "session")]
    Serve(serve::Serve),
    /// Join a session of `sinew serve`: as an actor, as its operator, or to watch.
    #[cfg(feature = "session")]
    Join(join::Join),
    /// Run a scene for actors on several machines; not in this build.
    #[cfg(not(feature = "session"))]
    Serve(without_session::WithoutSession),
    /// Join a scene that `sinew serve` runs; not in this build.
    #[cfg(not(feature = "session"))]
    Join(without_session::WithoutSession),
}

/// The length of a unit of length \[m\], by its name or as a number.
fn unit(text: &str) -> Result<f64, String> {
    const UNITS: [(&str, f64); 6] =
        [("m", 1.0), ("dm", 0.1), ("cm", 0.01), ("mm", 0.001), ("in", 0.0254), ("ft", 0.3048)];
    let named = UNITS.into_iter().find(|(name, _)| text.eq_ignore_ascii_case(name)).map(|(_, metres)| metres);
    let usage = "write metres per unit of the file, such as 0.01, or one of m, dm, cm, mm, in, ft";
    named.or_else(|| text.parse().ok()).ok_or_else(|| usage.to_owned())
}

/// Options for reading a motion file.
#[derive(Debug, clap::Args)]
struct Reading {
    /// Length of one unit of the file in metres (0.01), or its name (m, dm, cm, mm, in, ft), instead of a guess.
    #[arg(long, value_name = "METRES", value_parser = unit)]
    units: Option<f64>,
    /// The .asf skeleton of an .amc motion, when it is not beside it.
    #[arg(long, value_name = "S.asf")]
    skeleton: Option<PathBuf>,
    /// Which animation of a .glb, .gltf or .fbx: its name, or its number from 1; otherwise the first with keys.
    #[arg(long, value_name = "NAME|N")]
    animation: Option<String>,
    /// Which of several people: the name of their root joint or armature, or a number from 1; otherwise the first.
    #[arg(long, value_name = "NAME|N")]
    person: Option<String>,
    /// Which joint is a part, such as leftHand=bone_17, before anything is guessed; may be repeated.
    #[arg(long = "part", value_name = "PART=JOINT", value_parser = part_and_joint)]
    parts: Vec<(Part, String)>,
}

impl Reading {
    fn options(&self) -> ReadOptions {
        ReadOptions {
            skeleton: self.skeleton.clone(),
            unit_m: self.units,
            animation: self.animation.clone(),
            person: self.person.clone(),
            parts: self.parts.clone(),
            ..ReadOptions::default()
        }
    }
}

fn part_and_joint(text: &str) -> Result<(Part, String), String> {
    let (part, joint) = text.split_once('=').ok_or("write PART=JOINT, such as leftHand=bone_17")?;
    let part = part.parse().map_err(|error: UnknownPart| error.to_string())?;
    Ok((part, joint.trim().to_owned()))
}

/// The person of the character.
#[derive(Debug, clap::Args)]
struct Who {
    /// Mass of the body in kilograms, 1 to 1000.
    #[arg(long, value_name = "KG", default_value_t = 80.0, value_parser = within::<100, 100_000>)]
    mass: f64,
    /// Height of the body in metres, 0.2 to 10, instead of the skeleton's own.
    #[arg(long, value_name = "M", value_parser = within::<20, 1000>)]
    height: Option<f64>,
}

impl Who {
    fn person(&self) -> sinew::body::humanoid::Person {
        sinew::body::humanoid::Person { mass_kg: self.mass, height_m: self.height }
    }
}

/// Runs the command: 0 done, 1 failed, 2 wrong usage (clap's own).
fn main() -> ExitCode {
    let arguments = Arguments::from_arg_matches(&with_negative_numbers(Arguments::command()).get_matches());
    let result = match arguments.unwrap_or_else(|error| error.exit()).command {
        Command::Inspect(command) => command.run(),
        Command::Convert(command) => command.run(),
        Command::Ground(command) => command.run(),
        Command::Respond(command) => command.run(),
        Command::Reach(command) => command.run(),
        Command::Run(command) => command.run(),
        Command::Perform(command) => command.run(),
        Command::Replay(command) => command.run(),
        #[cfg(feature = "session")]
        Command::Serve(command) => command.run(),
        #[cfg(feature = "session")]
        Command::Join(command) => command.run(),
        #[cfg(not(feature = "session"))]
        Command::Serve(command) | Command::Join(command) => command.run(),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        // A closed pipe (`sinew inspect ... | head`) is not a failure.
        Err(error) if output::is_broken_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("sinew: {}", flag_names::with_options(&format!("{error:#}")));
            ExitCode::from(if is_wrong_usage(&error) { 2 } else { 1 })
        }
    }
}

/// Lets `--compliance -1` reach the message that names the range, in all commands.
fn with_negative_numbers(command: clap::Command) -> clap::Command {
    let takes_number = |arg: clap::Arg| {
        let takes_values = arg.get_action().takes_values() && !arg.is_positional();
        if takes_values { arg.allow_negative_numbers(true) } else { arg }
    };
    command.mut_args(takes_number).mut_subcommands(with_negative_numbers)
}

/// Whether an error is about the arguments, independent of the file.
fn is_wrong_usage(error: &anyhow::Error) -> bool {
    error.downcast_ref().is_some_and(RespondError::is_of_job)
        || error.downcast_ref().is_some_and(ReachError::is_of_job)
        || error.downcast_ref().is_some_and(GroundError::is_of_job)
}
