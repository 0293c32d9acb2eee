//! One connection of a client: made, greeted, kept, lost.

use super::certificate::{client_side, is_impostor, server_name};
use super::channel::{hear, read_bytes, say};
use super::client_stats::ClientStats;
use super::frame_code::decode_frame;
use super::limits::*;
use super::message::{ClientSays, Hello, ServerSays, Welcome};
use super::upward::Upward;
use super::{PROTOCOL, SessionError, Token};
use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use quinn::{Connection, ConnectionError, RecvStream, SendStream};
use sinew_world::Frame;
use std::net::{Ipv4Addr, Ipv6Addr, SocketAddr};
use std::sync::mpsc::SyncSender;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use tokio::sync::mpsc;
use tokio::time::timeout;

/// What the application wants sent.
#[derive(Debug)]
pub(super) enum Up {
    /// On the control stream, in order.
    Say(ClientSays),
    /// In a datagram: arrives at once or not at all.
    Throw(Vec<u8>),
}

/// What the tasks of a client share with the application.
pub(super) struct Seen {
    pub stats: Mutex<ClientStats>,
    pub frames: SyncSender<Arc<Frame>>,
}

impl Seen {
    pub(super) fn stats(&self) -> MutexGuard<'_, ClientStats> {
        self.stats.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A connection that has been let in.
pub(super) struct Link {
    pub connection: Connection,
    pub welcome: Welcome,
    /// The scene, as bytes of a take.
    pub scene: Vec<u8>,
    to: SendStream,
    from: RecvStream,
    // It lives as long as the connection.
    _endpoint: quinn::Endpoint,
}

/// Time in which a server must answer.
const ANSWER_WITHIN: Duration = Duration::from_secs(10);

impl Link {
    /// Connects and is let in.
    pub(super) async fn make(token: &Token, actors: &[String]) -> Result<Link, SessionError> {
        let place = token.place();
        let unreachable = |problem: String| SessionError::Unreachable { place: place.clone(), problem };
        let looked_up = tokio::net::lookup_host((token.host.as_str(), token.port)).await;
        let addresses: Vec<SocketAddr> = looked_up.map_err(|error| unreachable(error.to_string()))?.take(8).collect();
        let mut last = unreachable("the name has no address".to_owned());
        for address in addresses {
            match timeout(ANSWER_WITHIN, connect(token, address)).await {
                Ok(Ok((endpoint, connection))) => {
                    let greeted = timeout(SCENE_WITHIN, greet(token, actors, &connection)).await;
                    let slow = |_| Err(SessionError::Ended("the server does not send its scene".to_owned()));
                    let (welcome, scene, to, from) = greeted.unwrap_or_else(slow)?;
                    return Ok(Link { connection, welcome, scene, to, from, _endpoint: endpoint });
                }
                Ok(Err(error)) => last = error,
                Err(_) => last = unreachable("it gives no answer".to_owned()),
            }
        }
        Err(last)
    }

    /// Receives and sends until the connection ends.
    pub(super) async fn keep(self, seen: &Arc<Seen>, up: &mut mpsc::Receiver<Up>) -> SessionError {
        let Link { connection, to, from, .. } = self;
        let ended = tokio::select! {
            error = receive_frames(&connection, seen) => error,
            error = receive_words(from, seen) => error,
            error = send(&connection, to, seen, up) => error,
        };
        match connection.close_reason() {
            Some(reason) => wording(&reason),
            None => {
                connection.close(0u32.into(), b"goodbye");
                ended
            }
        }
    }
}

async fn connect(token: &Token, to: SocketAddr) -> Result<(quinn::Endpoint, Connection), SessionError> {
    let unreachable = |problem: String| SessionError::Unreachable { place: token.place(), problem };
    let from: SocketAddr = match to {
        SocketAddr::V4(to) if to.ip().is_loopback() => (Ipv4Addr::LOCALHOST, 0).into(),
        SocketAddr::V4(_) => (Ipv4Addr::UNSPECIFIED, 0).into(),
        SocketAddr::V6(to) if to.ip().is_loopback() => (Ipv6Addr::LOCALHOST, 0).into(),
        SocketAddr::V6(_) => (Ipv6Addr::UNSPECIFIED, 0).into(),
    };
    let endpoint = quinn::Endpoint::client(from).map_err(|error| SessionError::Machine(error.to_string()))?;
    let connecting = endpoint.connect_with(client_side(token.fingerprint)?, to, server_name());
    let connection = connecting.map_err(|error| unreachable(error.to_string()))?.await;
    match connection {
        Ok(connection) => Ok((endpoint, connection)),
        Err(error) if is_impostor(&error) => Err(SessionError::Impostor { place: token.place() }),
        Err(error) => Err(unreachable(error.to_string())),
    }
}

/// Shows the secret and takes what the server answers.
async fn greet(
    token: &Token,
    actors: &[String],
    connection: &Connection,
) -> Result<(Welcome, Vec<u8>, SendStream, RecvStream), SessionError> {
    let ended = |error: ConnectionError| wording(&error);
    let (mut to, mut from) = connection.open_bi().await.map_err(ended)?;
    let secret = URL_SAFE_NO_PAD.encode(token.secret);
    say(&mut to, &Hello { protocol: PROTOCOL, secret, actors: actors.to_vec() }).await?;
    let answer = hear(&mut from, MAX_SERVER_MESSAGE).await?;
    match ServerSays::read(&answer.unwrap_or_default()).map_err(SessionError::Malformed)? {
        ServerSays::Refused(refusal) => Err(SessionError::Refused(refusal)),
        ServerSays::Welcome(welcome) => {
            let length = usize::try_from(welcome.scene_bytes).unwrap_or(usize::MAX);
            if length > MAX_SCENE {
                let problem = format!("the server's scene has {length} bytes, of {MAX_SCENE} allowed");
                return Err(SessionError::Malformed(problem));
            }
            let scene = read_bytes(&mut from, length).await?;
            Ok((welcome, scene, to, from))
        }
        ServerSays::NotPassed(_) => {
            Err(SessionError::Malformed("the server says something before it greets".to_owned()))
        }
    }
}

/// Why a connection has ended, in words; a server's own end is told apart from a lost one by [`is_lost`].
fn wording(reason: &ConnectionError) -> SessionError {
    match reason {
        ConnectionError::ApplicationClosed(close) => {
            SessionError::Ended(super::message::short(&String::from_utf8_lossy(&close.reason)))
        }
        ConnectionError::TimedOut => SessionError::Ended(LOST.to_owned()),
        other => SessionError::Ended(format!("{LOST}: {other}")),
    }
}

/// How the end of a connection begins that nobody wanted.
const LOST: &str = "nothing came any more";

/// Whether a connection ended without anybody wanting it to.
pub(super) fn is_lost(error: &SessionError) -> bool {
    matches!(error, SessionError::Ended(text) if text.starts_with(LOST))
        || matches!(error, SessionError::Unreachable { .. })
}

/// Frames, each from its own stream.
async fn receive_frames(connection: &Connection, seen: &Arc<Seen>) -> SessionError {
    loop {
        let mut stream = match connection.accept_uni().await {
            Ok(stream) => stream,
            Err(error) => return wording(&error),
        };
        let seen = Arc::clone(seen);
        // No more at a time than streams are allowed.
        tokio::spawn(async move {
            // One that is given up on the way is none.
            let Ok(Ok(bytes)) = timeout(2 * STALE, stream.read_to_end(MAX_FRAME)).await else { return };
            match decode_frame(&bytes) {
                Ok((frame, said)) => {
                    if seen.stats().note(&frame, said, bytes.len()) {
                        // An application that does not look misses some.
                        let _ = seen.frames.try_send(Arc::new(frame));
                    }
                }
                Err(_) => seen.stats().frames_malformed += 1,
            }
        });
    }
}

async fn receive_words(mut from: RecvStream, seen: &Arc<Seen>) -> SessionError {
    loop {
        let bytes = match hear(&mut from, MAX_SERVER_MESSAGE).await {
            Ok(Some(bytes)) => bytes,
            Ok(None) => return SessionError::Ended("the server has said goodbye".to_owned()),
            Err(error) => return error,
        };
        match ServerSays::read(&bytes) {
            Ok(ServerSays::NotPassed(problem)) => seen.stats().note_not_passed(super::message::short(&problem)),
            Ok(_) => {}
            Err(problem) => return SessionError::Malformed(problem),
        }
    }
}

/// What the application wants sent, and signs of life.
async fn send(
    connection: &Connection,
    mut to: SendStream,
    seen: &Arc<Seen>,
    up: &mut mpsc::Receiver<Up>,
) -> SessionError {
    let mut alive = tokio::time::interval(SIGN_OF_LIFE);
    alive.set_missed_tick_behavior(tokio::time::MissedTickBehavior::Skip);
    loop {
        tokio::select! {
            _ = alive.tick() => {
                let seen_step = {
                    let mut stats = seen.stats();
                    stats.round_trip_ms = connection.rtt().as_secs_f64() * 1e3;
                    stats.last_step.unwrap_or(0)
                };
                let _ = connection.send_datagram(Upward::Alive { seen_step }.to_bytes().into());
            }
            next = up.recv() => match next {
                Some(Up::Throw(bytes)) => {
                    if connection.send_datagram(bytes.into()).is_err() {
                        seen.stats().samples_not_sent += 1;
                    }
                }
                Some(Up::Say(words)) => {
                    if let Err(error) = say(&mut to, &words).await {
                        return error;
                    }
                    if words == ClientSays::Leave {
                        let _ = to.finish();
                        let _ = timeout(Duration::from_secs(1), to.stopped()).await;
                        return SessionError::Ended("left".to_owned());
                    }
                }
                None => return SessionError::Ended("left".to_owned()),
            }
        }
    }
}
