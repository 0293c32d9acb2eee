//! A scene is edited while it runs, sought backwards, and continued as a what-if; a snapshot of that goes through a file.
//!
//! Somebody stands with a weak hold and is hit by a ball. After half a second the text of the scene is edited: stronger springs, the
//! reflex `balance`. `cargo run -p sinew-stage --example edit_and_seek`

use sinew_control::{Action, Command};
use sinew_stage::scene::SceneDocument;
use sinew_stage::{Runner, Scene, Stage, StageSnapshot};
use std::error::Error;

const SCENE: &str = "format = 1

# Somebody who is hit.
[characters.one]
pose_gain = 0.6  # a weak hold

[props.ball]
ball_radius_m = 0.12
mass_kg = 4
position_m = [0, 1.3, 3]
velocity_m_s = [0, 2.2, -4]
";

/// A step of physics is 1/240 s.
const EDITED: u64 = 120;
const END: u64 = 480;

fn main() -> Result<(), Box<dyn Error>> {
    let mut runner = Runner::new(Stage::new(Scene::from_text(SCENE)?, None)?).with_take().with_timeline()?;
    runner.run(EDITED, &mut []);

    // The document keeps its comments; the stage follows from the next step on.
    let mut document = SceneDocument::parse(SCENE)?;
    document.set("characters.one.pose_gain", "2")?;
    document.set("characters.one.reflexes", "[\"balance\"]")?;
    for edited in runner.stage_mut().edit(&document.to_string())? {
        println!("{}: {:?}", edited.path, edited.outcome);
    }
    runner.run(END, &mut []);
    let edited = runner.stage().hash();
    tell("edited", runner.stage());

    // Back to the moment before the edit, and on without it: with gravity of the moon for the ball.
    let take = runner.what_if(EDITED)?;
    let (on, part, over_secs, for_secs) = (Some("ball".to_owned()), None, None, None);
    let moon = Command::stage(Action::Gravity { scale: 0.165, on, part, over_secs, for_secs });
    runner.stage_mut().command(moon);
    runner.run((EDITED + END) / 2, &mut []);

    // In the middle of it, the state goes into a file, and out of it into another stage.
    let snapshot = runner.stage_mut().snapshot();
    let file = std::env::temp_dir().join(format!("edit_and_seek_{}.snapshot", std::process::id()));
    std::fs::write(&file, snapshot.to_bytes(runner.stage())?)?;
    let mut other = Stage::new(Scene::from_text(SCENE)?, None)?;
    let bytes = std::fs::read(&file)?;
    other.restore(&StageSnapshot::from_bytes(&bytes, &other)?)?;
    std::fs::remove_file(&file)?;
    println!("a snapshot of {} bytes at step {}", bytes.len(), snapshot.step());

    runner.run(END, &mut []);
    tell(&format!("take {take}, not edited"), runner.stage());
    while other.frame().step < END {
        other.step();
    }
    assert_eq!(other.hash(), runner.stage().hash(), "from the file it goes on to the same bits");

    // The first take is still there, bit for bit.
    runner.go_to(0, END)?;
    assert_eq!(runner.stage().hash(), edited);
    tell("edited, again", runner.stage());
    Ok(())
}

fn tell(what: &str, stage: &Stage) {
    let head = stage.frame().characters[0].parts[3].position;
    let ball = stage.frame().props[0].position;
    println!("{what:<20} head at {:.2} m, ball at {:.2} m after {:.1} s", head.y, ball.y, stage.frame().time_secs);
}
