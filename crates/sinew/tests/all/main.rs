//! Everything that the façade's jobs are held to, as one program. Scenes with controllers are tests of `sinew-script-host`.
#![allow(
    clippy::unwrap_used,
    clippy::disallowed_methods,
    reason = "tests fail, and may use the platform's mathematics"
)]

mod claims_input;
mod fell;
mod golden;
mod pictures;
mod ran;
mod scene_balance;
mod scene_reach;
mod scene_respond;
mod scene_skills;
mod scene_walk2d;
mod scenes;
#[cfg(feature = "session")]
mod session;

/// Scenes here have no controllers.
fn host() -> Option<sinew::script::ScriptHost> {
    None
}
