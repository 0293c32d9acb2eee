//! Errors of a session.

/// Why a session did not begin, or ended.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SessionError {
    /// An invalid token.
    #[error("the token is invalid: {0}; copy the whole line that `sinew serve` printed")]
    Token(String),
    /// The server does not answer.
    #[error(
        "{address}: the server does not answer ({problem}); check that the server runs there, that ServerSettings::bind lets others in, and the firewall's UDP port"
    )]
    Unreachable {
        /// Host and port of the server.
        address: String,
        /// The network's error.
        problem: String,
    },
    /// The server's certificate is not the one that the token pins.
    #[error("{address}: the certificate is not the one of the token; ask for the server's present token")]
    WrongCertificate {
        /// Host and port of the server.
        address: String,
    },
    /// The server refused the connection.
    #[error("the server refuses: {0}")]
    Refused(Refusal),
    /// A message that cannot be decoded.
    #[error("{0}")]
    Malformed(String),
    /// The connection ended.
    #[error("the connection ended: {0}")]
    Ended(String),
    /// A local failure: a socket, a certificate, a thread.
    #[error("{0}")]
    Local(String),
}

/// Why a server refuses a connection.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, serde::Serialize, serde::Deserialize)]
#[serde(tag = "why", rename_all = "snake_case")]
pub enum Refusal {
    /// Another version of the protocol.
    #[error(
        "it uses version {server} of the protocol, this program version {client}; use the same Sinew on both sides"
    )]
    Version {
        /// The server's version.
        server: u32,
        /// The client's version.
        client: u32,
    },
    /// An invalid secret.
    #[error("the token is not valid here; ask for the server's present one")]
    Secret,
    /// An actor that the scene does not have.
    #[error("it has no actor `{actor}`; its actors are {known}")]
    NoActor {
        /// The requested actor.
        actor: String,
        /// The actors of the scene.
        known: String,
    },
    /// Another client plays the actor.
    #[error("`{actor}` is played by another client; choose another actor, or wait until that client leaves")]
    Taken {
        /// The actor.
        actor: String,
    },
    /// The maximum number of clients is connected.
    #[error("it has its maximum number of clients; try again later, or ask its operator to raise it")]
    Full,
    /// The hello message is invalid.
    #[error("the hello message is invalid: {problem}")]
    Greeting {
        /// What is wrong with it.
        problem: String,
    },
}
