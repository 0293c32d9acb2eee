//! What a client may command.

use super::Role;
use sinew_control::{Action, Command};

/// Whether somebody with this role, who plays these actors, may give a command.
///
/// An actor commands the characters that it plays and nothing else. Nobody sends program text, or tells what happened to a
/// script: those are the server's own.
///
/// ```
/// use sinew_live::session::{Role, permit};
/// use sinew_control::{Action, Command};
/// let wave = Command::to("red", Action::Pose { name: "wave".into() });
/// assert!(permit(Role::Actor, &["red".into()], &wave).is_ok());
/// assert!(permit(Role::Actor, &["blue".into()], &wave).is_err());
/// assert!(permit(Role::Operator, &[], &wave).is_ok());
/// ```
///
/// # Errors
/// Why not.
pub fn permit(role: Role, actors: &[String], command: &Command) -> Result<(), String> {
    match &command.action {
        Action::ScriptKilled { .. } => return Err("only the server stops scripts".to_owned()),
        Action::Reload { text: Some(_), .. } => {
            return Err("no text of a controller is taken from the network".to_owned());
        }
        _ => {}
    }
    match (role, &command.character) {
        (Role::Operator, _) => Ok(()),
        (Role::Actor, Some(character)) if actors.contains(character) => match command.action {
            Action::Reload { .. } | Action::Controller { .. } => {
                Err("controllers are the operator's; join with the operator's token".to_owned())
            }
            _ => Ok(()),
        },
        (Role::Actor, Some(character)) => Err(format!(
            "`{}` is not yours; join as it, or with the operator's token",
            super::message::short(character)
        )),
        (Role::Actor, None) => Err("this is for the stage and its props; join with the operator's token".to_owned()),
    }
}
