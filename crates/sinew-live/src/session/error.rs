//! What goes wrong between machines.

/// A session that does not begin, or ends.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SessionError {
    /// A token that is none.
    #[error("this is no token: {0}; copy the whole line that `sinew serve` printed")]
    Token(String),
    /// Nobody answers.
    #[error(
        "{place}: nobody answers ({problem}); check that `sinew serve` runs there, that --bind lets others in, and the firewall's UDP port"
    )]
    Unreachable {
        /// Host and port.
        place: String,
        /// What the network said.
        problem: String,
    },
    /// The certificate is not the one of the token.
    #[error("{place}: this is not the server that the token is for; ask for its new token")]
    Impostor {
        /// Host and port.
        place: String,
    },
    /// The server said no.
    #[error("the server refuses: {0}")]
    Refused(Refusal),
    /// What arrived cannot be understood.
    #[error("{0}")]
    Malformed(String),
    /// The connection ended.
    #[error("the connection ended: {0}")]
    Ended(String),
    /// A socket, a certificate, a thread.
    #[error("{0}")]
    Machine(String),
}

/// Why a server says no.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, serde::Serialize, serde::Deserialize)]
#[serde(tag = "why", rename_all = "snake_case")]
pub enum Refusal {
    /// Another protocol.
    #[error(
        "it speaks version {server} of the protocol, this program version {client}; use the same Sinew on both sides"
    )]
    Version {
        /// The server's.
        server: u32,
        /// The client's.
        client: u32,
    },
    /// A wrong secret.
    #[error("the token is not valid here; ask for the server's present one")]
    Secret,
    /// No such actor.
    #[error("it has no actor `{actor}`; there are {known}")]
    NoActor {
        /// What was asked for.
        actor: String,
        /// Those of the scene.
        known: String,
    },
    /// Somebody else plays it.
    #[error("`{actor}` is played by somebody else; choose another, or wait until they leave")]
    Taken {
        /// The actor.
        actor: String,
    },
    /// No place left.
    #[error("it is full; ask its operator for a place")]
    Full,
    /// The first message was none.
    #[error("the greeting was not understood: {problem}")]
    Greeting {
        /// What is wrong with it.
        problem: String,
    },
}
