//! The server's side of one client's connection, from handshake to close.

use super::channel::{receive_message, send_message};
use super::client_datagram::ClientDatagram;
use super::limits::*;
use super::message::{ClientMessage, Hello, ServerMessage, Welcome, short};
use super::rate_limit::RateLimit;
use super::role_assignments::RoleAssignments;
use super::server::{PendingConnection, SceneManifest};
use super::stage_queue::{ClientRequest, QueuedRequest, Sent, Shared, count};
use super::{Refusal, Role, SessionError, permit};
use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use quinn::{Connection, RecvStream, SendStream};
use sinew_control::{Command, OrderError, OrderErrorKind};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::SyncSender;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use subtle::ConstantTimeEq;
use tokio::sync::{mpsc, watch};
use tokio::time::timeout;

/// QUIC application error codes with which a connection is closed.
pub(super) const CLOSED: u32 = 0;
pub(super) const REFUSED: u32 = 1;
pub(super) const GARBAGE: u32 = 2;
pub(super) const REPLACED: u32 = 3;

/// What all connections share.
pub(super) struct ServerState {
    pub manifest: SceneManifest,
    pub roles: Mutex<RoleAssignments<Connection>>,
    pub secrets: [(Role, [u8; 32]); 2],
    pub request: SyncSender<QueuedRequest>,
    pub frames: watch::Receiver<Sent>,
    pub shared: Arc<Shared>,
    pub max_clients: usize,
}

/// A client that has joined.
struct ClientConnection {
    number: u64,
    role: Role,
    actors: Vec<String>,
    by: Arc<str>,
    state: Arc<ServerState>,
    connection: Connection,
}

/// Performs the handshake, then serves the client until its connection ends.
pub(super) async fn receive(state: Arc<ServerState>, number: u64, connection: Connection, pending: PendingConnection) {
    let greeted = timeout(HELLO_TIMEOUT, handshake(&state, number, &connection)).await;
    drop(pending);
    let (client, to, from) = match greeted {
        Ok(Ok(greeted)) => greeted,
        Ok(Err(_)) | Err(_) => {
            count(&state.shared.counts.connections_refused);
            connection.close(GARBAGE.into(), b"no valid hello message");
            return;
        }
    };
    let Some(client) = client else {
        count(&state.shared.counts.connections_refused);
        refuse_after_answer(&connection, to).await;
        return;
    };
    count(&state.shared.counts.joined);
    let ended = client.serve(to, from).await;
    state.roles().leave(number);
    state.shared.counts.present.fetch_sub(1, Ordering::Relaxed);
    match ended {
        Ok(()) => connection.close(CLOSED.into(), b"goodbye"),
        Err(SessionError::Malformed(problem)) => connection.close(GARBAGE.into(), short(&problem).as_bytes()),
        Err(error) => connection.close(CLOSED.into(), short(&error.to_string()).as_bytes()),
    }
}

/// Closes the connection once the client has read the refusal, or after two seconds.
async fn refuse_after_answer(connection: &Connection, mut to: SendStream) {
    let _ = to.finish();
    let _ = timeout(Duration::from_secs(2), to.stopped()).await;
    connection.close(REFUSED.into(), b"refused");
}

/// Reads the hello message. The client is `None` if it was refused and told why.
async fn handshake(
    state: &Arc<ServerState>,
    number: u64,
    connection: &Connection,
) -> Result<(Option<ClientConnection>, SendStream, RecvStream), SessionError> {
    let (mut to, mut from) = connection.accept_bi().await.map_err(ended)?;
    let bytes = receive_message(&mut from, MAX_HELLO).await?;
    match state.admit(number, &bytes.unwrap_or_default(), connection) {
        Ok((role, actors)) => {
            let by = if actors.is_empty() { role.name().to_owned() } else { actors.join(", ") };
            let (state, connection) = (Arc::clone(state), connection.clone());
            Ok((Some(ClientConnection { number, role, actors, by: by.into(), state, connection }), to, from))
        }
        Err(refusal) => {
            send_message(&mut to, &ServerMessage::Refused(refusal)).await?;
            Ok((None, to, from))
        }
    }
}

impl ServerState {
    fn roles(&self) -> MutexGuard<'_, RoleAssignments<Connection>> {
        self.roles.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Authenticates a client and assigns its actors.
    fn admit(&self, number: u64, hello: &[u8], connection: &Connection) -> Result<(Role, Vec<String>), Refusal> {
        let hello = Hello::read(hello)?;
        let shown = URL_SAFE_NO_PAD.decode(&hello.secret).unwrap_or_default();
        // Both secrets are always compared, each in constant time.
        let mut role = None;
        for (of, secret) in &self.secrets {
            if bool::from(secret.as_slice().ct_eq(&shown)) {
                role = Some(*of);
            }
        }
        let role = role.ok_or(Refusal::Secret)?;
        let present = &self.shared.counts.present;
        if present.fetch_add(1, Ordering::Relaxed) >= self.max_clients as u64 {
            present.fetch_sub(1, Ordering::Relaxed);
            return Err(Refusal::Full);
        }
        let claimed = self.roles().claim(number, &hello.actors, connection, Instant::now());
        match claimed {
            Ok(lost) => {
                for connection in lost {
                    connection.close(REPLACED.into(), b"another client has joined as the actor");
                }
                Ok((role, hello.actors))
            }
            Err(refusal) => {
                present.fetch_sub(1, Ordering::Relaxed);
                Err(refusal)
            }
        }
    }
}

impl ClientConnection {
    /// Serves the client until it leaves, is disconnected or violates the protocol.
    async fn serve(&self, mut to: SendStream, from: RecvStream) -> Result<(), SessionError> {
        let manifest = &self.state.manifest;
        let welcome = Welcome {
            role: self.role,
            actors: self.actors.clone(),
            step: self.state.shared.step.load(Ordering::Relaxed),
            physics_hz: manifest.physics_hz,
            seed: manifest.seed,
            scene_bytes: manifest.scene.len() as u64,
        };
        let (note, notes) = mpsc::channel(16);
        let begin = async {
            send_message(&mut to, &ServerMessage::Welcome(welcome)).await?;
            to.write_all(&manifest.scene).await.map_err(ended)?;
            Ok(to)
        };
        let speak = async {
            let slow = |_| Err(SessionError::Ended("the client does not receive the scene".to_owned()));
            let to = timeout(SCENE_TIMEOUT, begin).await.unwrap_or_else(slow)?;
            send_notes(to, notes).await
        };
        tokio::select! {
            ended = speak => ended,
            ended = self.receive_control(from, &note) => ended,
            ended = self.receive_datagrams() => ended,
            ended = self.send_frames() => ended,
        }
    }

    /// Receives commands and keys. A client above its rate limit is read no faster: its own stream fills, and no other
    /// client is affected.
    async fn receive_control(&self, mut from: RecvStream, note: &mpsc::Sender<String>) -> Result<(), SessionError> {
        let mut limit = RateLimit::new(CONTROL_PER_SEC, Instant::now());
        while let Some(bytes) = receive_message(&mut from, MAX_CLIENT_MESSAGE).await? {
            while let Err(wait) = limit.take(Instant::now()) {
                tokio::time::sleep(wait).await;
            }
            self.note_alive()?;
            let queued = match ClientMessage::read(&bytes)? {
                ClientMessage::Leave => return Ok(()),
                ClientMessage::Command(command) => {
                    let checked =
                        permit(self.role, &self.actors, &command).and_then(|()| self.check_against_scene(&command));
                    checked.and_then(|()| self.forward(ClientRequest::Command(command)))
                }
                ClientMessage::Press(key) => {
                    self.may_press(&key).and_then(|()| self.forward(ClientRequest::Press(key)))
                }
            };
            if let Err(error) = queued {
                count(&self.state.shared.counts.requests_refused);
                // Notes to a client that does not read them are dropped.
                let _ = note.try_send(error.to_string());
            }
        }
        Ok(())
    }

    /// Receives keep-alives and performance samples. Those above the rate limit are dropped: the next one is newer.
    async fn receive_datagrams(&self) -> Result<(), SessionError> {
        let mut limit = RateLimit::new(DATAGRAMS_PER_SEC, Instant::now());
        loop {
            let bytes = self.connection.read_datagram().await.map_err(ended)?;
            if limit.take(Instant::now()).is_err() {
                count(&self.state.shared.counts.requests_dropped);
                continue;
            }
            self.note_alive()?;
            let datagram = ClientDatagram::read(&bytes).map_err(|error| SessionError::Malformed(error.to_string()))?;
            if let Some(command) = datagram.command(&self.actors) {
                // A refused or dropped sample is not reported: the next one is newer.
                let _ = self.check_against_scene(&command).and_then(|()| self.forward(ClientRequest::Command(command)));
            }
        }
    }

    fn note_alive(&self) -> Result<(), SessionError> {
        if self.state.roles().keep_alive(self.number, &self.actors, Instant::now()) {
            Ok(())
        } else {
            Err(SessionError::Ended("another client has joined as the actor".to_owned()))
        }
    }

    /// Checks that a command names things of the scene and that its numbers are in range.
    fn check_against_scene(&self, command: &Command) -> Result<(), OrderError> {
        self.state.manifest.rules.as_ref().map_or(Ok(()), |scene| scene.check_command(command))
    }

    fn may_press(&self, key: &str) -> Result<(), OrderError> {
        let bound = self.state.manifest.keys.get(key).ok_or_else(|| {
            let known: Vec<&str> = self.state.manifest.keys.keys().map(String::as_str).collect();
            let problem = format!("the scene has no key `{}`; its keys are {}", short(key), known.join(", "));
            OrderError::new(OrderErrorKind::NotFound, problem)
        })?;
        bound.iter().try_for_each(|command| permit(self.role, &self.actors, command))
    }

    /// Queues a request for the stage, which takes it before its next step.
    fn forward(&self, request: ClientRequest) -> Result<(), OrderError> {
        let shared = &self.state.shared;
        let arrived_step = shared.step.load(Ordering::Relaxed);
        match self.state.request.try_send(QueuedRequest { request, by: Arc::clone(&self.by), arrived_step }) {
            Ok(()) => {
                count(&shared.counts.requests);
                Ok(())
            }
            Err(_) => {
                count(&shared.counts.requests_dropped);
                let problem = "the queue of requests to the stage is full; send it again";
                Err(OrderError::new(OrderErrorKind::TooLarge, problem))
            }
        }
    }

    /// Sends frames. Each has a stream of its own, so that a lost packet delays one frame and no other. Frames in
    /// flight are limited by the congestion window; a frame that does not fit is dropped, and the next one is newer.
    async fn send_frames(&self) -> Result<(), SessionError> {
        let shared = &self.state.shared;
        let mut frames = self.state.frames.clone();
        frames.mark_changed();
        let in_flight = Arc::new(AtomicU64::new(0));
        loop {
            let over = |_| SessionError::Ended("the session is over".to_owned());
            frames.changed().await.map_err(over)?;
            let frame = Arc::clone(&frames.borrow_and_update());
            if frame.is_empty() {
                continue;
            }
            let (bytes, room) = (frame.len() as u64, self.connection.stats().path.cwnd);
            // One frame more than fits: congestion control does not grow a window that is never filled.
            if in_flight.load(Ordering::Relaxed) > room {
                count(&shared.counts.frames_dropped);
                continue;
            }
            // Only this client's task waits here when the client does not receive.
            let Ok(opened) = timeout(MAX_FRAME_AGE, self.connection.open_uni()).await else {
                count(&shared.counts.frames_dropped);
                continue;
            };
            let mut stream = opened.map_err(ended)?;
            match timeout(MAX_FRAME_AGE, stream.write_all(&frame)).await {
                Ok(written) => written.map_err(ended)?,
                Err(_) => {
                    // Without a reset the truncated frame would look complete.
                    let _ = stream.reset(0u32.into());
                    count(&shared.counts.frames_dropped);
                    continue;
                }
            }
            let _ = stream.finish();
            in_flight.fetch_add(bytes, Ordering::Relaxed);
            let (in_flight, shared) = (Arc::clone(&in_flight), Arc::clone(shared));
            tokio::spawn(async move {
                if timeout(MAX_FRAME_AGE, stream.stopped()).await.is_ok() {
                    count(&shared.counts.frames_sent);
                } else {
                    let _ = stream.reset(0u32.into());
                    count(&shared.counts.frames_dropped);
                }
                in_flight.fetch_sub(bytes, Ordering::Relaxed);
            });
        }
    }
}

fn ended(error: impl std::fmt::Display) -> SessionError {
    SessionError::Ended(error.to_string())
}

/// Sends the reasons of rejected requests to the client.
async fn send_notes(mut to: SendStream, mut notes: mpsc::Receiver<String>) -> Result<(), SessionError> {
    while let Some(problem) = notes.recv().await {
        send_message(&mut to, &ServerMessage::Rejected(problem)).await?;
    }
    // The other tasks end the connection.
    std::future::pending().await
}
