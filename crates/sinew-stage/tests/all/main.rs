//! Everything that `sinew-stage` is held to, as one program.

mod blend;
mod catch;
mod edit;
mod edit_running;
mod honours;
mod hostile;
mod live;
mod orders;
mod performance;
mod runner;
mod sample_walk;
mod scene_errors;
mod scene_sets;
mod scenes_page;
mod schema;
mod snapshot;
mod snapshot_bytes;
mod stage;
mod takes;
mod timeline;
mod undisturbed;

/// Scenes here have no controllers.
fn host() -> Option<sinew_script::ScriptHost> {
    None
}
