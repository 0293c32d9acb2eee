//! The join token that a server prints: its address, the fingerprint of its certificate, and a secret.

use super::SessionError;
use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

/// What its holder may do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// Commands the actors that it joined as, and no others. Without an actor it only watches.
    Actor,
    /// Commands everything.
    Operator,
}

/// A join token. It is a password: its holder can join as long as the server runs.
///
/// Written as `sinew1/actor/HOST:PORT/FINGERPRINT/SECRET`, the last two in URL-safe base64 without padding.
///
/// ```
/// use sinew_live::session::{Role, Token};
/// let token = Token { role: Role::Actor, host: "::1".into(), port: 47110, fingerprint: [7; 32], secret: [9; 32] };
/// let text = token.to_string();
/// assert!(text.starts_with("sinew1/actor/[::1]:47110/"));
/// assert_eq!(text.parse::<Token>(), Ok(token));
/// ```
#[derive(Clone, PartialEq, Eq)]
pub struct Token {
    /// What its holder may do.
    pub role: Role,
    /// Host name or IP address.
    pub host: String,
    /// UDP port.
    pub port: u16,
    /// SHA-256 of the server's certificate (DER).
    pub fingerprint: [u8; 32],
    /// The password; sent to the server only after its certificate has been checked.
    pub secret: [u8; 32],
}

/// Maximum length of a token \[bytes\].
const MAX_BYTES: usize = 512;

/// The prefix: marks a token and its version.
const MARK: &str = "sinew1";

impl Role {
    /// `actor` or `operator`.
    pub fn name(self) -> &'static str {
        match self {
            Role::Actor => "actor",
            Role::Operator => "operator",
        }
    }
}

impl Token {
    /// Host and port as text, an IPv6 address in brackets.
    pub fn address(&self) -> String {
        if self.host.contains(':') {
            format!("[{}]:{}", self.host, self.port)
        } else {
            format!("{}:{}", self.host, self.port)
        }
    }

    /// The same token with another address of the server, `HOST` or `HOST:PORT`.
    ///
    /// # Errors
    /// An invalid host or port.
    pub fn with_address(mut self, address: &str) -> Result<Token, SessionError> {
        let (host, port) = split_address(address)?;
        self.host = host;
        self.port = port.unwrap_or(self.port);
        Ok(self)
    }
}

impl Display for Token {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let code = |bytes: &[u8; 32]| URL_SAFE_NO_PAD.encode(bytes);
        let (fingerprint, secret) = (code(&self.fingerprint), code(&self.secret));
        write!(f, "{MARK}/{}/{}/{fingerprint}/{secret}", self.role.name(), self.address())
    }
}

/// Leaves out the secret, so that it does not appear in logs.
impl fmt::Debug for Token {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{MARK}/{}/{}/...", self.role.name(), self.address())
    }
}

impl FromStr for Token {
    type Err = SessionError;

    fn from_str(text: &str) -> Result<Token, SessionError> {
        let wrong = |problem: &str| SessionError::Token(problem.to_owned());
        let text = text.trim();
        if text.len() > MAX_BYTES {
            return Err(wrong("it is too long"));
        }
        let pieces: Vec<&str> = text.split('/').collect();
        let [mark, role, address, fingerprint, secret] = pieces[..] else {
            return Err(wrong("it does not have five pieces between `/`"));
        };
        if mark != MARK {
            return Err(wrong("it does not begin with `sinew1/`"));
        }
        let role = match role {
            "actor" => Role::Actor,
            "operator" => Role::Operator,
            _ => return Err(wrong("its second piece is neither `actor` nor `operator`")),
        };
        let (host, port) = split_address(address)?;
        let port = port.ok_or_else(|| wrong("it has no port"))?;
        let bytes = |text: &str, what: &str| {
            let bytes = URL_SAFE_NO_PAD.decode(text).ok().and_then(|bytes| <[u8; 32]>::try_from(bytes).ok());
            bytes.ok_or_else(|| SessionError::Token(format!("its {what} is truncated or changed")))
        };
        Ok(Token {
            role,
            host,
            port,
            fingerprint: bytes(fingerprint, "fingerprint")?,
            secret: bytes(secret, "secret")?,
        })
    }
}

/// `HOST`, `HOST:PORT`, `[V6]`, `[V6]:PORT` or a bare IPv6 address.
fn split_address(text: &str) -> Result<(String, Option<u16>), SessionError> {
    let wrong = |problem: &str| SessionError::Token(problem.to_owned());
    let port = |text: &str| match text.parse::<u16>() {
        Ok(port) if port != 0 => Ok(port),
        _ => Err(wrong("its port is not a number from 1 to 65535")),
    };
    let (host, port) = if let Some(rest) = text.strip_prefix('[') {
        let (host, rest) = rest.split_once(']').ok_or_else(|| wrong("a `[` has no `]`"))?;
        match rest.strip_prefix(':') {
            Some(text) => (host, Some(port(text)?)),
            None if rest.is_empty() => (host, None),
            None => return Err(wrong("after `]`, `:` and the port are expected")),
        }
    } else if text.matches(':').count() == 1 {
        let (host, text) = text.split_once(':').unwrap_or((text, ""));
        (host, Some(port(text)?))
    } else {
        (text, None)
    };
    let is_sound = |c: char| c.is_ascii_alphanumeric() || ".-_:%".contains(c);
    if host.is_empty() || !host.chars().all(is_sound) {
        return Err(wrong("its host is empty or invalid"));
    }
    Ok((host.to_owned(), port))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn what_was_cut_off_or_changed_is_no_token() {
        let token =
            Token { role: Role::Operator, host: "stage.lan".into(), port: 9, fingerprint: [1; 32], secret: [2; 32] };
        let text = token.to_string();
        for end in 0..text.len() {
            assert!(text[..end].parse::<Token>().is_err(), "{}", &text[..end]);
        }
        assert!(text.replace("sinew1", "sinew2").parse::<Token>().is_err());
        assert!(text.replace(":9/", ":0/").parse::<Token>().is_err());
    }

    #[test]
    fn the_secret_is_not_in_what_is_logged() {
        let token = Token { role: Role::Actor, host: "a".into(), port: 9, fingerprint: [1; 32], secret: [2; 32] };
        assert!(!format!("{token:?}").contains(&URL_SAFE_NO_PAD.encode([2; 32])));
    }

    proptest! {
        #[test]
        fn no_text_brings_the_reader_down(text in any::<String>()) {
            let _ = text.parse::<Token>();
            let _ = split_address(&text);
        }
    }
}
