//! A client: joins a session, sends performance and commands, and receives frames.

use super::client_datagram::ClientDatagram;
use super::client_stats::{ClientStats, ConnectionState};
use super::limits::{ACTOR_TIMEOUT, MAX_ACTORS_PER_CLIENT, MAX_NAME};
use super::link::{Link, Outgoing, Received, is_lost};
use super::message::{ClientMessage, Welcome};
use super::{Refusal, SessionError, Token};
use sinew_control::Command;
use sinew_control::perform::PerformerSample;
use sinew_stage::{Scene, Take};
use sinew_world::Frame;
use std::sync::mpsc::{Receiver, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use tokio::sync::mpsc;

/// A connection to a session. Dropping it leaves the session.
pub struct Client {
    scene: Scene,
    welcome: Welcome,
    outbox: mpsc::Sender<Outgoing>,
    frames: Receiver<Arc<Frame>>,
    received: Arc<Received>,
    state: Arc<Mutex<ConnectionState>>,
    runtime: Option<tokio::runtime::Runtime>,
}

/// Maximum number of actors of one client; an actor's index is one byte.
const MAX_ACTORS: u8 = MAX_ACTORS_PER_CLIENT as u8;

/// Maximum number of requests that wait to be sent.
const MAX_OUTGOING: usize = 256;

/// Maximum number of received frames that wait for [`Client::next_frame`].
const MAX_FRAMES: usize = 256;

/// Maximum number of attempts to reconnect, and the time between two.
const REJOIN_TRIES: u32 = 40;
const REJOIN_EVERY: Duration = Duration::from_millis(250);

impl Client {
    /// Joins a session as some actors, or without an actor to watch or operate. If a lost client still holds an actor,
    /// it retries until the server's timeout for that client has passed.
    ///
    /// # Errors
    /// The server does not answer, has another certificate than the token's, or refuses.
    pub fn join(token: &Token, actors: &[String]) -> Result<Client, SessionError> {
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(1)
            .thread_name("sinew-client")
            .enable_all()
            .build()
            .map_err(|error| SessionError::Local(error.to_string()))?;
        let link = runtime.block_on(connect_with_retry(token, actors))?;
        let scene = scene_of(&link.scene)?;
        let welcome = link.welcome.clone();
        let (outbox, outgoing) = mpsc::channel(MAX_OUTGOING);
        let (frame, frames) = sync_channel(MAX_FRAMES);
        let received = Arc::new(Received { stats: Mutex::default(), frames: frame });
        let state = Arc::new(Mutex::new(ConnectionState::Connected));
        let run = run(token.clone(), actors.to_vec(), link, Arc::clone(&received), outgoing, Arc::clone(&state));
        runtime.spawn(run);
        Ok(Client { scene, welcome, outbox, frames, received, state, runtime: Some(runtime) })
    }

    /// The session's scene.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The server's first message.
    pub fn welcome(&self) -> &Welcome {
        &self.welcome
    }

    /// The next frame, newer than all before it; waits up to `within`. When the queue of received frames is full, newer
    /// frames are dropped.
    pub fn next_frame(&self, within: Duration) -> Option<Arc<Frame>> {
        self.frames.recv_timeout(within).ok()
    }

    /// Sends a command; the server applies it in the next step after it arrives. False when the send queue is full.
    pub fn command(&self, command: Command) -> bool {
        let what = serde_json::to_value(&command.action).ok();
        let what = what.and_then(|action| Some(action.get("do")?.as_str()?.to_owned()));
        let sent = self.outbox.try_send(Outgoing::Message(ClientMessage::Command(command))).is_ok();
        if sent {
            self.received.stats().note_sent(what.unwrap_or_default());
        }
        sent
    }

    /// Presses a key of the scene. False when the send queue is full.
    pub fn press(&self, key: &str) -> bool {
        let key: String = key.chars().take(MAX_NAME / 4).collect();
        let sent = self.outbox.try_send(Outgoing::Message(ClientMessage::Press(key.clone()))).is_ok();
        if sent {
            self.received.stats().note_sent(key);
        }
        sent
    }

    /// Sends a performance sample of one of its actors, counted from 0, unreliably: a lost sample is not sent again. A
    /// sample for an actor that this client does not play is dropped.
    pub fn perform(&self, actor: usize, sample: PerformerSample) {
        let Ok(actor @ 0..MAX_ACTORS) = u8::try_from(actor) else { return };
        let datagram = ClientDatagram::Performed { actor, sample: Box::new(sample) };
        let is_its = usize::from(actor) < self.welcome.actors.len();
        if is_its && self.outbox.try_send(Outgoing::Datagram(datagram.to_bytes())).is_err() {
            self.received.stats().samples_not_sent += 1;
        }
    }

    /// Statistics of what it has received.
    pub fn stats(&self) -> ClientStats {
        self.received.stats().clone()
    }

    /// The state of its connection.
    pub fn state(&self) -> ConnectionState {
        self.state.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        let Some(runtime) = self.runtime.take() else { return };
        let _ = self.outbox.try_send(Outgoing::Message(ClientMessage::Leave));
        let state = Arc::clone(&self.state);
        let left = async move {
            while !matches!(*state.lock().unwrap_or_else(PoisonError::into_inner), ConnectionState::Ended(_)) {
                tokio::time::sleep(Duration::from_millis(2)).await;
            }
        };
        let _ = runtime.block_on(async { tokio::time::timeout(Duration::from_secs(1), left).await });
        runtime.shutdown_background();
    }
}

/// A take without commands is a scene.
fn scene_of(bytes: &[u8]) -> Result<Scene, SessionError> {
    let unread = |problem: String| SessionError::Malformed(format!("the server's scene: {problem}"));
    let take = Take::read(bytes).map_err(|error| unread(error.to_string()))?;
    take.to_scene(None).map_err(|error| unread(error.to_string()))
}

/// Connects. If an actor is taken, retries for twice [`ACTOR_TIMEOUT`], in which the server notices a lost client.
async fn connect_with_retry(token: &Token, actors: &[String]) -> Result<Link, SessionError> {
    let mut waited = Duration::ZERO;
    loop {
        match Link::connect(token, actors).await {
            Err(SessionError::Refused(Refusal::Taken { .. })) if waited < 2 * ACTOR_TIMEOUT => {
                tokio::time::sleep(REJOIN_EVERY).await;
                waited += REJOIN_EVERY;
            }
            made => return made,
        }
    }
}

/// Runs the connection, and reconnects when it is lost.
async fn run(
    token: Token,
    actors: Vec<String>,
    mut link: Link,
    received: Arc<Received>,
    mut outgoing: mpsc::Receiver<Outgoing>,
    state: Arc<Mutex<ConnectionState>>,
) {
    let set = |now: ConnectionState| *state.lock().unwrap_or_else(PoisonError::into_inner) = now;
    loop {
        let mut ended = link.run(&received, &mut outgoing).await;
        let mut tries = 0;
        link = loop {
            if !is_lost(&ended) || tries >= REJOIN_TRIES || outgoing.is_closed() {
                return set(ConnectionState::Ended(ended));
            }
            set(ConnectionState::Rejoining);
            match connect_with_retry(&token, &actors).await {
                Ok(link) => break link,
                Err(error) => ended = error,
            }
            tries += 1;
            tokio::time::sleep(REJOIN_EVERY).await;
        };
        // Requests that were queued while disconnected are out of date.
        while outgoing.try_recv().is_ok() {}
        received.stats().rejoined += 1;
        set(ConnectionState::Connected);
    }
}
