//! A client: joins, performs and commands, and sees what happens.

use super::client_stats::{ClientStats, Standing};
use super::limits::{MAX_ACTORS_OF_ONE, MAX_NAME, QUIET};
use super::link::{Link, Seen, Up, is_lost};
use super::message::{ClientSays, Welcome};
use super::upward::Upward;
use super::{Refusal, SessionError, Token};
use sinew_control::Command;
use sinew_control::perform::PerformerSample;
use sinew_stage::{Scene, Take};
use sinew_world::Frame;
use std::sync::mpsc::{Receiver, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use tokio::sync::mpsc;

/// A place in a session. It leaves when it is dropped.
pub struct Client {
    scene: Scene,
    welcome: Welcome,
    up: mpsc::Sender<Up>,
    frames: Receiver<Arc<Frame>>,
    seen: Arc<Seen>,
    standing: Arc<Mutex<Standing>>,
    runtime: Option<tokio::runtime::Runtime>,
}

/// Actors of one client, as a byte counts them.
const MAX_ACTORS: u8 = MAX_ACTORS_OF_ONE as u8;

/// Orders that wait to be sent.
const MAX_UP: usize = 256;

/// Frames that wait to be looked at.
const MAX_FRAMES: usize = 256;

/// Tries to come back, and the time between two.
const REJOIN_TRIES: u32 = 40;
const REJOIN_EVERY: Duration = Duration::from_millis(250);

impl Client {
    /// Joins a session as some actors, or as none to watch or operate. An actor that a lost client of the same name still seems
    /// to play is waited for a moment.
    ///
    /// # Errors
    /// When nobody answers, the server is not the token's, or it refuses.
    pub fn join(token: &Token, actors: &[String]) -> Result<Client, SessionError> {
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(1)
            .thread_name("sinew-client")
            .enable_all()
            .build()
            .map_err(|error| SessionError::Machine(error.to_string()))?;
        let link = runtime.block_on(make(token, actors))?;
        let scene = scene_of(&link.scene)?;
        let welcome = link.welcome.clone();
        let (up, wanted) = mpsc::channel(MAX_UP);
        let (frame, frames) = sync_channel(MAX_FRAMES);
        let seen = Arc::new(Seen { stats: Mutex::default(), frames: frame });
        let standing = Arc::new(Mutex::new(Standing::Connected));
        let stay = stay(token.clone(), actors.to_vec(), link, Arc::clone(&seen), wanted, Arc::clone(&standing));
        runtime.spawn(stay);
        Ok(Client { scene, welcome, up, frames, seen, standing, runtime: Some(runtime) })
    }

    /// The scene that is played.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// What the server said first.
    pub fn welcome(&self) -> &Welcome {
        &self.welcome
    }

    /// The next frame, newer than those before; waits for it so long. Of frames that nobody fetched in time some are left out.
    pub fn next_frame(&self, within: Duration) -> Option<Arc<Frame>> {
        self.frames.recv_timeout(within).ok()
    }

    /// Sends a command, to be applied in the next step. False when too many wait already.
    pub fn command(&self, command: Command) -> bool {
        let what = serde_json::to_value(&command.action).ok();
        let what = what.and_then(|action| Some(action.get("do")?.as_str()?.to_owned()));
        let sent = self.up.try_send(Up::Say(ClientSays::Command(command))).is_ok();
        if sent {
            self.seen.stats().note_sent(what.unwrap_or_default());
        }
        sent
    }

    /// Presses a key of the scene. False when too many orders wait already.
    pub fn press(&self, key: &str) -> bool {
        let key: String = key.chars().take(MAX_NAME / 4).collect();
        let sent = self.up.try_send(Up::Say(ClientSays::Press(key.clone()))).is_ok();
        if sent {
            self.seen.stats().note_sent(key);
        }
        sent
    }

    /// Sends what one of its actors performs, the first being 0: at once or not at all. A sample of an actor that it does not play
    /// is not sent.
    pub fn perform(&self, actor: usize, sample: PerformerSample) {
        let Ok(actor @ 0..MAX_ACTORS) = u8::try_from(actor) else { return };
        let upward = Upward::Performed { actor, sample: Box::new(sample) };
        let is_its = usize::from(actor) < self.welcome.actors.len();
        if is_its && self.up.try_send(Up::Throw(upward.to_bytes())).is_err() {
            self.seen.stats().samples_not_sent += 1;
        }
    }

    /// What it has received.
    pub fn stats(&self) -> ClientStats {
        self.seen.stats().clone()
    }

    /// How it stands.
    pub fn standing(&self) -> Standing {
        self.standing.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        let Some(runtime) = self.runtime.take() else { return };
        let _ = self.up.try_send(Up::Say(ClientSays::Leave));
        let standing = Arc::clone(&self.standing);
        let left = async move {
            while !matches!(*standing.lock().unwrap_or_else(PoisonError::into_inner), Standing::Ended(_)) {
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

/// Joins; an actor that somebody still seems to play is asked for again until its silence would have been noticed.
async fn make(token: &Token, actors: &[String]) -> Result<Link, SessionError> {
    let mut waited = Duration::ZERO;
    loop {
        match Link::make(token, actors).await {
            Err(SessionError::Refused(Refusal::Taken { .. })) if waited < 2 * QUIET => {
                tokio::time::sleep(REJOIN_EVERY).await;
                waited += REJOIN_EVERY;
            }
            made => return made,
        }
    }
}

/// Keeps the link, and makes it anew when it is lost.
async fn stay(
    token: Token,
    actors: Vec<String>,
    mut link: Link,
    seen: Arc<Seen>,
    mut wanted: mpsc::Receiver<Up>,
    standing: Arc<Mutex<Standing>>,
) {
    let set = |now: Standing| *standing.lock().unwrap_or_else(PoisonError::into_inner) = now;
    loop {
        let mut ended = link.keep(&seen, &mut wanted).await;
        let mut tries = 0;
        link = loop {
            if !is_lost(&ended) || tries >= REJOIN_TRIES || wanted.is_closed() {
                return set(Standing::Ended(ended));
            }
            set(Standing::Rejoining);
            match make(&token, &actors).await {
                Ok(link) => break link,
                Err(error) => ended = error,
            }
            tries += 1;
            tokio::time::sleep(REJOIN_EVERY).await;
        };
        // What was wanted meanwhile is over.
        while wanted.try_recv().is_ok() {}
        seen.stats().rejoined += 1;
        set(Standing::Connected);
    }
}
