//! The child process and the protocol with it. Every wait has a timeout.

use crate::protocol::{self, MAX_REPLY};
use crate::script::BUILD_IT;
use std::path::Path;
use std::time::Duration;

/// A running child. Dropped, it is killed and its end awaited.
#[derive(Debug)]
pub(crate) struct Process {
    child: std::process::Child,
    #[cfg(unix)]
    wire: std::os::unix::net::UnixStream,
}

/// Elsewhere the memory limit cannot be enforced.
#[cfg(not(unix))]
impl Process {
    pub fn start(_program: &Path, _arguments: &[String]) -> Result<Process, String> {
        Err("Python controllers need Linux, which enforces their memory limit".to_owned())
    }

    pub fn ask(&mut self, _request: &[u8], _limit: Duration) -> Result<Vec<u8>, String> {
        Err("Python controllers need Linux".to_owned())
    }
}

#[cfg(unix)]
impl Process {
    /// Starts a program whose standard input and output are the wire.
    pub fn start(program: &Path, arguments: &[String]) -> Result<Process, String> {
        use std::os::fd::OwnedFd;
        use std::os::unix::net::UnixStream;
        use std::process::{Command, Stdio};
        let start = || {
            let (wire, theirs) = UnixStream::pair()?;
            let input = OwnedFd::from(theirs.try_clone()?);
            let child = Command::new(program)
                .args(arguments)
                .env_clear()
                .env(protocol::VERSION_VARIABLE, protocol::VERSION.to_string())
                .stdin(Stdio::from(input))
                .stdout(Stdio::from(OwnedFd::from(theirs)))
                .stderr(Stdio::null())
                .spawn()?;
            Ok(Process { child, wire })
        };
        start().map_err(|error: std::io::Error| format!("{} cannot be started: {error}", program.display()))
    }

    /// Sends a message and awaits the answer. After an error the child is to be dropped.
    pub fn ask(&mut self, request: &[u8], limit: Duration) -> Result<Vec<u8>, String> {
        use std::io::ErrorKind;
        self.exchange(request, std::time::Instant::now() + limit).map_err(|error| match error.kind() {
            ErrorKind::WouldBlock | ErrorKind::TimedOut => {
                format!("it did not return within {} s", limit.as_secs_f64())
            }
            ErrorKind::UnexpectedEof | ErrorKind::BrokenPipe | ErrorKind::ConnectionReset => self.cause_of_end(),
            _ => format!("its process sent an invalid message: {error}"),
        })
    }

    fn exchange(&mut self, request: &[u8], deadline: std::time::Instant) -> std::io::Result<Vec<u8>> {
        use std::io::{ErrorKind, Read, Write};
        let remaining = || {
            let left = deadline.saturating_duration_since(std::time::Instant::now());
            if left.is_zero() { Err(std::io::Error::from(ErrorKind::TimedOut)) } else { Ok(left) }
        };
        let mut unsent = request;
        while !unsent.is_empty() {
            self.wire.set_write_timeout(Some(remaining()?))?;
            match self.wire.write(unsent) {
                Ok(count) => unsent = &unsent[count..],
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
        // Memory grows only as bytes arrive, whatever length the child announces.
        let (mut bytes, mut chunk) = (Vec::new(), [0; 16 << 10]);
        loop {
            if let Some(head) = bytes.first_chunk::<4>() {
                let length = protocol::length(*head, MAX_REPLY)?;
                if bytes.len() > 4 + length {
                    return Err(std::io::Error::other("an answer without a request"));
                }
                if bytes.len() == 4 + length {
                    return Ok(bytes.split_off(4));
                }
            }
            self.wire.set_read_timeout(Some(remaining()?))?;
            match self.wire.read(&mut chunk) {
                Ok(0) => return Err(ErrorKind::UnexpectedEof.into()),
                Ok(count) => bytes.extend_from_slice(&chunk[..count]),
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
    }

    /// Why the child closed the connection.
    fn cause_of_end(&mut self) -> String {
        use std::os::unix::process::ExitStatusExt;
        for _ in 0..100 {
            match self.child.try_wait() {
                Ok(Some(status)) => {
                    return match (status.signal(), status.code()) {
                        // What Rust does when memory is refused.
                        (Some(6), _) => "its process gave up, most likely for want of memory".to_owned(),
                        (Some(11), _) => "its process crashed, most likely by deep nesting".to_owned(),
                        (Some(signal), _) => format!("its process was ended by signal {signal}"),
                        (None, Some(code)) if code == i32::from(protocol::WRONG_VERSION) => {
                            format!("it is of another version than this program; {BUILD_IT}")
                        }
                        (None, Some(code)) => format!("its process ended by itself with code {code}"),
                        (None, None) => "its process ended by itself".to_owned(),
                    };
                }
                Ok(None) => std::thread::sleep(Duration::from_millis(1)),
                Err(_) => break,
            }
        }
        "its process closed the connection".to_owned()
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        // Either fails only when the child has ended and been awaited already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
