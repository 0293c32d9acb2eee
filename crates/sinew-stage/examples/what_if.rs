//! A scene runs, is sought backwards, and runs on from there in other ways; every way is kept.
//!
//! Somebody who stands is pushed after a second, once with its own strength, then with a half and a fifth of it from the moment of the
//! push on. `cargo run -p sinew-stage --example what_if`

use sinew_control::{Action, Command};
use sinew_stage::{Runner, Scene, Stage};
use std::error::Error;

const SCENE: &str = r#"
format = 1
[characters.one]
reflexes = ["balance"]
[[at]]
time_secs = 1
character = "one"
do = "push"
on = "chest"
force_n = [0, 0, 260]
for_secs = 0.1
"#;

/// A step of physics is 1/240 s.
const PUSHED: u64 = 240;
const END: u64 = 4 * 240;

fn main() -> Result<(), Box<dyn Error>> {
    let stage = Stage::new(Scene::from_text(SCENE)?, None)?;
    let mut runner = Runner::new(stage).with_take().with_timeline()?;
    runner.run(END, &mut []);
    let hash = runner.stage().hash();
    tell("as it is", &runner);

    for factor in [0.5, 0.2] {
        // Back to the moment before the push, and on from there with other gains.
        runner.go_to(0, PUSHED)?;
        let take = runner.what_if(PUSHED)?;
        runner.stage_mut().command(Command::to("one", Action::Gain { factor, part: None }));
        runner.run(END, &mut []);
        tell(&format!("take {take}: gain {factor}"), &runner);
    }

    // The first take is still there, bit for bit.
    runner.go_to(0, END)?;
    assert_eq!(runner.stage().hash(), hash);
    tell("take 0 again", &runner);
    Ok(())
}

fn tell(what: &str, runner: &Runner) {
    let head = runner.stage().frame().characters[0].parts[3].position;
    println!("{what:<18} head at {:.2} m after {:.1} s", head.y, runner.stage().frame().time_secs);
}
