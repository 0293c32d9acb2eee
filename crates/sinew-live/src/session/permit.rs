//! Authorization: what a client may command.

use super::Role;
use sinew_control::{Action, Command, OrderError, OrderErrorKind};

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
/// // Props and joints are the operator's, even when a command names an actor's own character beside one.
/// let cut = Command::to("red", Action::Cut { joint: "rope".into() });
/// assert!(permit(Role::Actor, &["red".into()], &cut).is_err());
/// // Nobody edits the scene over the network.
/// assert!(permit(Role::Operator, &[], &Command::stage(Action::Edit { text: "format = 1".into() })).is_err());
/// ```
///
/// # Errors
/// [`OrderErrorKind::NotPermitted`]: why the command is not allowed.
pub fn permit(role: Role, actors: &[String], command: &Command) -> Result<(), OrderError> {
    refused(role, actors, command).map_or(Ok(()), |problem| Err(OrderError::new(OrderErrorKind::NotPermitted, problem)))
}

/// Why a command is refused.
fn refused(role: Role, actors: &[String], command: &Command) -> Option<String> {
    const STAGE: &str = "only the operator commands the stage and its props; join with the operator's token";
    match &command.action {
        Action::ScriptKilled { .. } => return Some("only the server stops scripts".to_owned()),
        Action::Edit { .. } => return Some("a scene is edited where it runs, not over the network".to_owned()),
        Action::Reload { text: Some(_), .. } => {
            return Some("text of a controller is not accepted from the network".to_owned());
        }
        _ => {}
    }
    match (role, &command.character) {
        (Role::Operator, _) => None,
        (Role::Actor, Some(character)) if actors.contains(character) => match &command.action {
            Action::Reload { .. } | Action::Controller { .. } => {
                Some("only the operator changes controllers; join with the operator's token".to_owned())
            }
            action if action.is_for_stage() => Some(STAGE.to_owned()),
            _ => None,
        },
        (Role::Actor, Some(character)) => Some(format!(
            "this client does not play `{}`; join as it, or with the operator's token",
            super::message::short(character)
        )),
        (Role::Actor, None) => Some(STAGE.to_owned()),
    }
}
