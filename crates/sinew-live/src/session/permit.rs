//! Authorization: what a client may command.

use super::Role;
use sinew_control::{Action, Command};

/// Checks whether a client with this role and these actors may send a command.
///
/// An actor commands the characters that it plays and nothing else. No client sends program text or reports what
/// happened to a script: only the server does.
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
/// Why the command is not allowed.
pub fn permit(role: Role, actors: &[String], command: &Command) -> Result<(), String> {
    match &command.action {
        Action::ScriptKilled { .. } => return Err("only the server stops scripts".to_owned()),
        Action::Reload { text: Some(_), .. } => {
            return Err("text of a controller is not accepted from the network".to_owned());
        }
        _ => {}
    }
    match (role, &command.character) {
        (Role::Operator, _) => Ok(()),
        (Role::Actor, Some(character)) if actors.contains(character) => match command.action {
            Action::Reload { .. } | Action::Controller { .. } => {
                Err("only the operator changes controllers; join with the operator's token".to_owned())
            }
            _ => Ok(()),
        },
        (Role::Actor, Some(character)) => Err(format!(
            "this client does not play `{}`; join as it, or with the operator's token",
            super::message::short(character)
        )),
        (Role::Actor, None) => {
            Err("only the operator commands the stage and its props; join with the operator's token".to_owned())
        }
    }
}
