//! Everything that Python controllers are held to, in real child processes, as one program.
#![allow(
    clippy::unwrap_used,
    clippy::disallowed_methods,
    reason = "tests fail, and may use the platform's mathematics"
)]

mod api;
mod devices;
mod dunk;
mod edited;
mod glider;
#[path = "../../../sinew/tests/all/golden.rs"]
mod golden;
mod grasps;
mod hostile;
mod modules;
#[path = "../../../sinew/tests/all/ran.rs"]
mod ran;
mod reach_grasp;
mod reload;
mod scene;
mod scene_dunk;
mod scenes;
mod script_ranges;
#[path = "../../../sinew-stage/tests/all/performance/stage.rs"]
mod stage;
mod stapler;
mod state;
mod version;

/// The child of whole scenes. Many tests share the machine: a script that is only slow must not be taken for one that never
/// returns.
fn host() -> Option<sinew_script::ScriptHost> {
    let limits = sinew_script::Limits { step_secs: 20.0, startup_secs: 60.0, ..sinew_script::Limits::default() };
    let program = env!("CARGO_BIN_EXE_sinew-script-host").into();
    Some(sinew_script::ScriptHost { program, args: Vec::new(), limits })
}
