//! When a command shows on a character.

use crate::jobs::run::RunError;
use sinew_script::ScriptHost;
use sinew_stage::{Stage, Take};

/// Physics steps after which a command shows on a character: the first step whose frame shows the character in another state
/// than the same take shows without the command. `None` when it never does, within a second.
///
/// `command` is the command's place in [`Take::commands`].
///
/// ```
/// use sinew::control::{Action, Command};
/// use sinew::jobs::session::first_effect;
/// use sinew::stage::{Scene, Take};
/// let scene = Scene::from_text("format = 1\n[characters.red]\n[characters.blue]\nposition_m = [3, 0, 0]\n")?;
/// let push = Action::Push { on: "chest".into(), force_n: [0.0, 0.0, 50.0], for_secs: 0.1, facing: false, at_m: None };
/// let mut take = Take::of(&scene);
/// take.push(10, Command::to("red", push));
/// take.steps = 100;
/// assert_eq!(first_effect(&take, 0, "red", None)?, Some(11));
/// assert_eq!(first_effect(&take, 0, "blue", None)?, None);
/// # Ok::<(), sinew::jobs::run::RunError>(())
/// ```
///
/// # Errors
/// When the take's scene no longer reads or cannot be built.
pub fn first_effect(
    take: &Take,
    command: usize,
    character: &str,
    host: Option<ScriptHost>,
) -> Result<Option<u64>, RunError> {
    let Some(stamped) = take.commands.get(command) else { return Ok(None) };
    let mut others = take.commands.clone();
    others.remove(command);
    let mut with = Stage::new(take.to_scene(None)?, host.clone())?;
    let mut without = Stage::new(take.to_scene(None)?, host)?;
    with.prescribe(take.commands.clone());
    without.prescribe(others);
    let Some(id) = with.cast().character(character) else { return Ok(None) };
    let last = take.steps.min(stamped.step + u64::from(take.physics_hz));
    for step in 1..=last {
        with.step();
        without.step();
        if step > stamped.step && with.frame().character(id) != without.frame().character(id) {
            return Ok(Some(step));
        }
    }
    Ok(None)
}
