//! A scene is edited while it runs, and the edit is taken back: `cargo run -p sinew-stage --example edit_scene`.

use sinew_stage::scene::SceneDocument;
use sinew_stage::{EditOutcome, Scene, Stage};

const TEXT: &str = "format = 1

# A boxer who learns to stand.
[characters.boxer]
pose_gain = 1.0  # as people are
position_m = [0, 0, 0]

[props.ball]
ball_radius_m = 0.12
mass_kg = 4
position_m = [0, 1.3, 3]
";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut stage = Stage::new(Scene::from_text(TEXT)?, None)?;
    run(&mut stage, 120);

    let mut document = SceneDocument::parse(TEXT)?;
    document.set("characters.boxer.pose_gain", "2.5")?;
    document.set("characters.boxer.reflexes", "[\"balance\"]")?;
    document.set("characters.boxer.mass_kg", "65")?;
    document.set("props.ball.position_m", "[0, 2, 1]")?;
    document.set("characters.partner", "{ position_m = [1, 0, 0] }")?;
    println!("{document}");
    for edited in stage.edit(&document.to_string())? {
        match edited.outcome {
            EditOutcome::NeedsRestart(reason) => println!("{}: not while it runs: {reason}", edited.path),
            outcome => println!("{}: {outcome:?}", edited.path),
        }
    }
    run(&mut stage, 120);

    // The newest command goes first: the ball back to where it was.
    stage.undo();
    run(&mut stage, 1);
    for event in stage.events().list() {
        println!("{:6.3} s  {}  ({})", event.time_secs, event.effect, event.cause);
    }
    Ok(())
}

fn run(stage: &mut Stage, steps: usize) {
    for _ in 0..steps {
        stage.step();
    }
}
