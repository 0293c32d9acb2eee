//! One client, seen from the server: from its first word to its last.

use super::channel::{hear, say};
use super::limits::*;
use super::message::{ClientSays, Hello, ServerSays, Welcome, short};
use super::pace::Pace;
use super::role_assignments::RoleAssignments;
use super::server::{PendingConnection, SceneManifest};
use super::stage_queue::{Order, Placed, Sent, Shared, count};
use super::upward::Upward;
use super::{Refusal, Role, SessionError, permit};
use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use quinn::{Connection, RecvStream, SendStream};
use sinew_control::Command;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::SyncSender;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use subtle::ConstantTimeEq;
use tokio::sync::{mpsc, watch};
use tokio::time::timeout;

/// Why a connection is closed, for the other side's words.
pub(super) const CLOSED: u32 = 0;
pub(super) const REFUSED: u32 = 1;
pub(super) const GARBAGE: u32 = 2;
pub(super) const REPLACED: u32 = 3;

/// What all guests share.
pub(super) struct ServerState {
    pub manifest: SceneManifest,
    pub roles: Mutex<RoleAssignments<Connection>>,
    pub secrets: [(Role, [u8; 32]); 2],
    pub order: SyncSender<Placed>,
    pub frames: watch::Receiver<Sent>,
    pub shared: Arc<Shared>,
    pub most_clients: usize,
}

/// A client that is in.
struct ClientConnection {
    number: u64,
    role: Role,
    actors: Vec<String>,
    by: Arc<str>,
    state: Arc<ServerState>,
    connection: Connection,
}

/// Hears who it is, and keeps it as long as it stays.
pub(super) async fn receive(state: Arc<ServerState>, number: u64, connection: Connection, stranger: PendingConnection) {
    let greeted = timeout(HELLO_WITHIN, greet(&state, number, &connection)).await;
    drop(stranger);
    let (client, to, from) = match greeted {
        Ok(Ok(greeted)) => greeted,
        Ok(Err(_)) | Err(_) => {
            count(&state.shared.counts.strangers_refused);
            connection.close(GARBAGE.into(), b"no greeting");
            return;
        }
    };
    let Some(client) = client else {
        count(&state.shared.counts.strangers_refused);
        refuse_politely(&connection, to).await;
        return;
    };
    count(&state.shared.counts.joined);
    let ended = client.stay(to, from).await;
    state.roles().leave(number);
    state.shared.counts.present.fetch_sub(1, Ordering::Relaxed);
    match ended {
        Ok(()) => connection.close(CLOSED.into(), b"goodbye"),
        Err(SessionError::Malformed(problem)) => connection.close(GARBAGE.into(), short(&problem).as_bytes()),
        Err(error) => connection.close(CLOSED.into(), short(&error.to_string()).as_bytes()),
    }
}

/// Waits a moment until the refusal has been read.
async fn refuse_politely(connection: &Connection, mut to: SendStream) {
    let _ = to.finish();
    let _ = timeout(Duration::from_secs(2), to.stopped()).await;
    connection.close(REFUSED.into(), b"refused");
}

/// Reads the greeting. `None` when the client has been told why it is refused.
async fn greet(
    state: &Arc<ServerState>,
    number: u64,
    connection: &Connection,
) -> Result<(Option<ClientConnection>, SendStream, RecvStream), SessionError> {
    let (mut to, mut from) = connection.accept_bi().await.map_err(ended)?;
    let bytes = hear(&mut from, MAX_HELLO).await?;
    match state.admit(number, &bytes.unwrap_or_default(), connection) {
        Ok((role, actors)) => {
            let by = if actors.is_empty() { role.name().to_owned() } else { actors.join(", ") };
            let (state, connection) = (Arc::clone(state), connection.clone());
            Ok((Some(ClientConnection { number, role, actors, by: by.into(), state, connection }), to, from))
        }
        Err(refusal) => {
            say(&mut to, &ServerSays::Refused(refusal)).await?;
            Ok((None, to, from))
        }
    }
}

impl ServerState {
    fn roles(&self) -> MutexGuard<'_, RoleAssignments<Connection>> {
        self.roles.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Decides whether somebody may come in, and as whom.
    fn admit(&self, number: u64, hello: &[u8], connection: &Connection) -> Result<(Role, Vec<String>), Refusal> {
        let hello = Hello::read(hello)?;
        let shown = URL_SAFE_NO_PAD.decode(&hello.secret).unwrap_or_default();
        // Both are compared, each in the same time whatever it is.
        let mut role = None;
        for (of, secret) in &self.secrets {
            if bool::from(secret.as_slice().ct_eq(&shown)) {
                role = Some(*of);
            }
        }
        let role = role.ok_or(Refusal::Secret)?;
        let present = &self.shared.counts.present;
        if present.fetch_add(1, Ordering::Relaxed) >= self.most_clients as u64 {
            present.fetch_sub(1, Ordering::Relaxed);
            return Err(Refusal::Full);
        }
        let claimed = self.roles().claim(number, &hello.actors, connection, Instant::now());
        match claimed {
            Ok(lost) => {
                for connection in lost {
                    connection.close(REPLACED.into(), b"the actor has joined anew");
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
    /// Until it leaves, is cut off or breaks a rule.
    async fn stay(&self, mut to: SendStream, from: RecvStream) -> Result<(), SessionError> {
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
            say(&mut to, &ServerSays::Welcome(welcome)).await?;
            to.write_all(&manifest.scene).await.map_err(ended)?;
            Ok(to)
        };
        let speak = async {
            let slow = |_| Err(SessionError::Ended("it does not take the scene".to_owned()));
            let to = timeout(SCENE_WITHIN, begin).await.unwrap_or_else(slow)?;
            tell(to, notes).await
        };
        tokio::select! {
            ended = speak => ended,
            ended = self.hear_control(from, &note) => ended,
            ended = self.hear_datagrams() => ended,
            ended = self.show() => ended,
        }
    }

    /// Commands and keys. One that sends more than it may is read no faster: its own stream fills, and nobody else's.
    async fn hear_control(&self, mut from: RecvStream, note: &mpsc::Sender<String>) -> Result<(), SessionError> {
        let mut pace = Pace::new(CONTROL_PER_SEC, Instant::now());
        while let Some(bytes) = hear(&mut from, MAX_CLIENT_MESSAGE).await? {
            while let Err(wait) = pace.take(Instant::now()) {
                tokio::time::sleep(wait).await;
            }
            self.is_heard()?;
            let passed = match ClientSays::read(&bytes).map_err(SessionError::Malformed)? {
                ClientSays::Leave => return Ok(()),
                ClientSays::Command(command) => {
                    let suits = permit(self.role, &self.actors, &command).and_then(|()| self.suits(&command));
                    suits.and_then(|()| self.pass(Order::Command(command)))
                }
                ClientSays::Press(key) => self.may_press(&key).and_then(|()| self.pass(Order::Press(key))),
            };
            if let Err(problem) = passed {
                count(&self.state.shared.counts.orders_refused);
                // One that does not read what it is told is not told more.
                let _ = note.try_send(problem);
            }
        }
        Ok(())
    }

    /// Signs of life and what actors perform. What is too much is dropped: the next one is newer.
    async fn hear_datagrams(&self) -> Result<(), SessionError> {
        let mut pace = Pace::new(DATAGRAMS_PER_SEC, Instant::now());
        loop {
            let bytes = self.connection.read_datagram().await.map_err(ended)?;
            if pace.take(Instant::now()).is_err() {
                count(&self.state.shared.counts.orders_dropped);
                continue;
            }
            self.is_heard()?;
            let upward = Upward::read(&bytes).map_err(|error| SessionError::Malformed(error.to_string()))?;
            if let Some(command) = upward.command(&self.actors) {
                // One that is refused, or too many: the next one is newer.
                let _ = self.suits(&command).and_then(|()| self.pass(Order::Command(command)));
            }
        }
    }

    fn is_heard(&self) -> Result<(), SessionError> {
        if self.state.roles().hear(self.number, &self.actors, Instant::now()) {
            Ok(())
        } else {
            Err(SessionError::Ended("the actor has joined anew".to_owned()))
        }
    }

    /// Whether a command names what the scene has, with numbers that are sound.
    fn suits(&self, command: &Command) -> Result<(), String> {
        self.state.manifest.rules.as_ref().map_or(Ok(()), |scene| scene.check_command(command))
    }

    fn may_press(&self, key: &str) -> Result<(), String> {
        let bound = self.state.manifest.keys.get(key).ok_or_else(|| {
            let known: Vec<&str> = self.state.manifest.keys.keys().map(String::as_str).collect();
            format!("the scene has no key `{}`; there are {}", short(key), known.join(", "))
        })?;
        bound.iter().try_for_each(|command| permit(self.role, &self.actors, command))
    }

    /// Hands an order to the stage, which takes it before its next step.
    fn pass(&self, order: Order) -> Result<(), String> {
        let shared = &self.state.shared;
        let arrived_step = shared.step.load(Ordering::Relaxed);
        match self.state.order.try_send(Placed { order, by: Arc::clone(&self.by), arrived_step }) {
            Ok(()) => {
                count(&shared.counts.orders);
                Ok(())
            }
            Err(_) => {
                count(&shared.counts.orders_dropped);
                Err("the stage has too much to do; send it again".to_owned())
            }
        }
    }

    /// Frames. Each has a stream of its own, so that a lost packet holds up one frame and no other. As many are under way as the
    /// connection can carry at a time; a frame for which there is no room is left out, and the next one is newer.
    async fn show(&self) -> Result<(), SessionError> {
        let shared = &self.state.shared;
        let mut frames = self.state.frames.clone();
        frames.mark_changed();
        let under_way = Arc::new(AtomicU64::new(0));
        loop {
            let over = |_| SessionError::Ended("the session is over".to_owned());
            frames.changed().await.map_err(over)?;
            let frame = Arc::clone(&frames.borrow_and_update());
            if frame.is_empty() {
                continue;
            }
            let (bytes, room) = (frame.len() as u64, self.connection.stats().path.cwnd);
            // One frame more than there is room for: a sender that never fills the window is not given a larger one.
            if under_way.load(Ordering::Relaxed) > room {
                count(&shared.counts.frames_dropped);
                continue;
            }
            // A client that takes nothing is waited for here, and holds up nobody else.
            let Ok(opened) = timeout(STALE, self.connection.open_uni()).await else {
                count(&shared.counts.frames_dropped);
                continue;
            };
            let mut stream = opened.map_err(ended)?;
            match timeout(STALE, stream.write_all(&frame)).await {
                Ok(written) => written.map_err(ended)?,
                Err(_) => {
                    // Dropped as it is it would pass for a whole one.
                    let _ = stream.reset(0u32.into());
                    count(&shared.counts.frames_dropped);
                    continue;
                }
            }
            let _ = stream.finish();
            under_way.fetch_add(bytes, Ordering::Relaxed);
            let (under_way, shared) = (Arc::clone(&under_way), Arc::clone(shared));
            tokio::spawn(async move {
                if timeout(STALE, stream.stopped()).await.is_ok() {
                    count(&shared.counts.frames_sent);
                } else {
                    let _ = stream.reset(0u32.into());
                    count(&shared.counts.frames_dropped);
                }
                under_way.fetch_sub(bytes, Ordering::Relaxed);
            });
        }
    }
}

fn ended(error: impl std::fmt::Display) -> SessionError {
    SessionError::Ended(error.to_string())
}

/// Passes words on to the client.
async fn tell(mut to: SendStream, mut notes: mpsc::Receiver<String>) -> Result<(), SessionError> {
    while let Some(problem) = notes.recv().await {
        say(&mut to, &ServerSays::NotPassed(problem)).await?;
    }
    // The other tasks end the stay.
    std::future::pending().await
}
