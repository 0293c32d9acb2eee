//! A client's connection to the server: connect, handshake, run, end.

use super::certificate::{client_side, is_wrong_certificate, server_name};
use super::channel::{read_bytes, receive_message, send_message};
use super::client_datagram::ClientDatagram;
use super::client_stats::ClientStats;
use super::limits::*;
use super::message::{ClientMessage, Hello, ServerMessage, Welcome};
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

/// What the application wants to send.
#[derive(Debug)]
pub(super) enum Outgoing {
    /// On the control stream: reliable and in order.
    Message(ClientMessage),
    /// In a datagram: unreliable, never sent again.
    Datagram(Vec<u8>),
}

/// What the tasks of a client share with the application.
pub(super) struct Received {
    pub stats: Mutex<ClientStats>,
    pub frames: SyncSender<Arc<Frame>>,
}

impl Received {
    pub(super) fn stats(&self) -> MutexGuard<'_, ClientStats> {
        self.stats.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A connection whose handshake is complete.
pub(super) struct Link {
    pub connection: Connection,
    pub welcome: Welcome,
    /// The scene, as bytes of a take.
    pub scene: Vec<u8>,
    to: SendStream,
    from: RecvStream,
    // Kept alive as long as the connection.
    _endpoint: quinn::Endpoint,
}

/// Time within which a server must answer.
const ANSWER_TIMEOUT: Duration = Duration::from_secs(10);

impl Link {
    /// Connects and performs the handshake.
    pub(super) async fn connect(token: &Token, actors: &[String]) -> Result<Link, SessionError> {
        let address = token.address();
        let unreachable = |problem: String| SessionError::Unreachable { address: address.clone(), problem };
        let looked_up = tokio::net::lookup_host((token.host.as_str(), token.port)).await;
        let addresses: Vec<SocketAddr> = looked_up.map_err(|error| unreachable(error.to_string()))?.take(8).collect();
        let mut last = unreachable("the host name has no address".to_owned());
        for address in addresses {
            match timeout(ANSWER_TIMEOUT, open(token, address)).await {
                Ok(Ok((endpoint, connection))) => {
                    let greeted = timeout(SCENE_TIMEOUT, handshake(token, actors, &connection)).await;
                    let slow = |_| Err(SessionError::Ended("the server does not send its scene".to_owned()));
                    let (welcome, scene, to, from) = greeted.unwrap_or_else(slow)?;
                    return Ok(Link { connection, welcome, scene, to, from, _endpoint: endpoint });
                }
                Ok(Err(error)) => last = error,
                Err(_) => last = unreachable("timeout".to_owned()),
            }
        }
        Err(last)
    }

    /// Receives and sends until the connection ends.
    pub(super) async fn run(self, received: &Arc<Received>, outgoing: &mut mpsc::Receiver<Outgoing>) -> SessionError {
        let Link { connection, to, from, .. } = self;
        let ended = tokio::select! {
            error = receive_frames(&connection, received) => error,
            error = receive_words(from, received) => error,
            error = send(&connection, to, received, outgoing) => error,
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

async fn open(token: &Token, to: SocketAddr) -> Result<(quinn::Endpoint, Connection), SessionError> {
    let unreachable = |problem: String| SessionError::Unreachable { address: token.address(), problem };
    let from: SocketAddr = match to {
        SocketAddr::V4(to) if to.ip().is_loopback() => (Ipv4Addr::LOCALHOST, 0).into(),
        SocketAddr::V4(_) => (Ipv4Addr::UNSPECIFIED, 0).into(),
        SocketAddr::V6(to) if to.ip().is_loopback() => (Ipv6Addr::LOCALHOST, 0).into(),
        SocketAddr::V6(_) => (Ipv6Addr::UNSPECIFIED, 0).into(),
    };
    let endpoint = quinn::Endpoint::client(from).map_err(|error| SessionError::Local(error.to_string()))?;
    let connecting = endpoint.connect_with(client_side(token.fingerprint)?, to, server_name());
    let connection = connecting.map_err(|error| unreachable(error.to_string()))?.await;
    match connection {
        Ok(connection) => Ok((endpoint, connection)),
        Err(error) if is_wrong_certificate(&error) => Err(SessionError::WrongCertificate { address: token.address() }),
        Err(error) => Err(unreachable(error.to_string())),
    }
}

/// Sends the hello message and receives the server's answer.
async fn handshake(
    token: &Token,
    actors: &[String],
    connection: &Connection,
) -> Result<(Welcome, Vec<u8>, SendStream, RecvStream), SessionError> {
    let ended = |error: ConnectionError| wording(&error);
    let (mut to, mut from) = connection.open_bi().await.map_err(ended)?;
    let secret = URL_SAFE_NO_PAD.encode(token.secret);
    send_message(&mut to, &Hello { protocol: PROTOCOL, secret, actors: actors.to_vec() }).await?;
    let answer = receive_message(&mut from, MAX_SERVER_MESSAGE).await?;
    match ServerMessage::read(&answer.unwrap_or_default())? {
        ServerMessage::Refused(refusal) => Err(SessionError::Refused(refusal)),
        ServerMessage::Welcome(welcome) => {
            let length = usize::try_from(welcome.scene_bytes).unwrap_or(usize::MAX);
            if length > MAX_SCENE {
                let problem = format!("the server's scene has {length} bytes; the maximum is {MAX_SCENE}");
                return Err(SessionError::Malformed(problem));
            }
            let scene = read_bytes(&mut from, length).await?;
            Ok((welcome, scene, to, from))
        }
        ServerMessage::Rejected(_) => {
            Err(SessionError::Malformed("the server sends a message before its welcome".to_owned()))
        }
    }
}

/// Why a connection has ended; [`is_lost`] tells a lost connection from one that the server closed.
fn wording(reason: &ConnectionError) -> SessionError {
    match reason {
        ConnectionError::ApplicationClosed(close) => {
            SessionError::Ended(super::message::short(&String::from_utf8_lossy(&close.reason)))
        }
        ConnectionError::TimedOut => SessionError::Ended(LOST.to_owned()),
        other => SessionError::Ended(format!("{LOST}: {other}")),
    }
}

/// Begin of the error text of a lost connection.
const LOST: &str = "the connection was lost";

/// Whether a connection was lost, and not closed by one side.
pub(super) fn is_lost(error: &SessionError) -> bool {
    matches!(error, SessionError::Ended(text) if text.starts_with(LOST))
        || matches!(error, SessionError::Unreachable { .. })
}

/// Receives frames, each from its own stream.
async fn receive_frames(connection: &Connection, received: &Arc<Received>) -> SessionError {
    loop {
        let mut stream = match connection.accept_uni().await {
            Ok(stream) => stream,
            Err(error) => return wording(&error),
        };
        let received = Arc::clone(received);
        // The transport limits the number of open streams, and so of these tasks.
        tokio::spawn(async move {
            // A frame that the server drops on the way is reset, and skipped here.
            let Ok(Ok(bytes)) = timeout(2 * MAX_FRAME_AGE, stream.read_to_end(MAX_FRAME)).await else { return };
            match Frame::from_bytes(&bytes) {
                Ok((frame, said)) => {
                    if received.stats().note(&frame, said, bytes.len()) {
                        // Dropped when the application does not fetch frames in time.
                        let _ = received.frames.try_send(Arc::new(frame));
                    }
                }
                Err(_) => received.stats().frames_malformed += 1,
            }
        });
    }
}

async fn receive_words(mut from: RecvStream, received: &Arc<Received>) -> SessionError {
    loop {
        let bytes = match receive_message(&mut from, MAX_SERVER_MESSAGE).await {
            Ok(Some(bytes)) => bytes,
            Ok(None) => return SessionError::Ended("the server closed the connection".to_owned()),
            Err(error) => return error,
        };
        match ServerMessage::read(&bytes) {
            Ok(ServerMessage::Rejected(problem)) => received.stats().note_rejected(super::message::short(&problem)),
            Ok(_) => {}
            Err(error) => return error,
        }
    }
}

/// Sends what the application wants to send, and keep-alives.
async fn send(
    connection: &Connection,
    mut to: SendStream,
    received: &Arc<Received>,
    outgoing: &mut mpsc::Receiver<Outgoing>,
) -> SessionError {
    let mut alive = tokio::time::interval(KEEP_ALIVE_INTERVAL);
    alive.set_missed_tick_behavior(tokio::time::MissedTickBehavior::Skip);
    loop {
        tokio::select! {
            _ = alive.tick() => {
                let seen_step = {
                    let mut stats = received.stats();
                    stats.round_trip_ms = connection.rtt().as_secs_f64() * 1e3;
                    stats.last_step.unwrap_or(0)
                };
                let _ = connection.send_datagram(ClientDatagram::Alive { seen_step }.to_bytes().into());
            }
            next = outgoing.recv() => match next {
                Some(Outgoing::Datagram(bytes)) => {
                    if connection.send_datagram(bytes.into()).is_err() {
                        received.stats().samples_not_sent += 1;
                    }
                }
                Some(Outgoing::Message(words)) => {
                    if let Err(error) = send_message(&mut to, &words).await {
                        return error;
                    }
                    if words == ClientMessage::Leave {
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
