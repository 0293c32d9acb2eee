//! A session for tests: a stage on its own thread, and clients.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![allow(dead_code, reason = "not every test needs all of it")]

mod scene;

pub use scene::SCENE;
use sinew_live::session::{
    Client, Role, SceneManifest, Server, ServerCounts, ServerSettings, SessionError, SessionObserver, Token,
};
use sinew_stage::{Runner, Scene, Stage, Take};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

/// A session with its stage on a thread of its own.
pub struct ServerState {
    pub server: Server,
    ended: Arc<AtomicBool>,
    stage: Option<JoinHandle<Done>>,
}

/// What the stage has done.
pub struct Done {
    pub take: Take,
    pub hashes: BTreeMap<u64, String>,
    pub applied: Vec<sinew_live::session::AppliedCommand>,
}

impl ServerState {
    pub fn open() -> ServerState {
        let scene = Scene::from_text(SCENE).unwrap();
        let settings = ServerSettings { bind: "127.0.0.1:0".parse().unwrap(), ..ServerSettings::default() };
        let (server, queue) = Server::open(&settings, SceneManifest::of(&scene).unwrap()).unwrap();
        let ended = Arc::new(AtomicBool::new(false));
        let until = Arc::clone(&ended);
        let stage = std::thread::spawn(move || {
            let mut runner = Runner::new(Stage::new(scene, None).unwrap()).paced().with_take();
            let mut session_observer = SessionObserver::new(queue, runner.stage());
            while !until.load(Ordering::Relaxed) {
                runner.step(&mut [&mut session_observer]);
            }
            let take = runner.take().unwrap();
            Done { take, hashes: session_observer.hashes().clone(), applied: session_observer.applied().to_vec() }
        });
        ServerState { server, ended, stage: Some(stage) }
    }

    pub fn token(&self, role: Role) -> Token {
        self.server.token(role).clone()
    }

    pub fn counts(&self) -> ServerCounts {
        self.server.counts()
    }

    pub fn close(mut self) -> Done {
        self.ended.store(true, Ordering::Relaxed);
        self.stage.take().unwrap().join().unwrap()
    }
}

impl Drop for ServerState {
    fn drop(&mut self) {
        self.ended.store(true, Ordering::Relaxed);
    }
}

pub fn join(token: &Token, actors: &[&str]) -> Result<Client, SessionError> {
    let actors: Vec<String> = actors.iter().map(|&actor| actor.to_owned()).collect();
    Client::join(token, &actors)
}

/// The stage of a take, played again.
pub fn replayed(take: &Take) -> Stage {
    let take = Take::read(&take.to_bytes().unwrap()).unwrap();
    let mut stage = Stage::new(take.to_scene(None).unwrap(), None).unwrap();
    stage.prescribe(take.commands.clone());
    for _ in 0..take.steps {
        stage.step();
    }
    stage
}

/// Looks until a client has frames up to a step, or so long that it never will.
pub fn watch_until(client: &Client, step: u64) {
    for _ in 0..600 {
        if client.next_frame(Duration::from_millis(100)).is_some_and(|frame| frame.step >= step) {
            return;
        }
    }
    panic!("no frame of step {step}: {:?}, {:?}", client.stats(), client.state());
}

/// Waits for something that must come.
pub fn until(what: &str, mut is_so: impl FnMut() -> bool) {
    for _ in 0..3000 {
        if is_so() {
            return;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    panic!("{what} never came");
}

/// The hashes of one step are the same for all who have it, and there are such steps.
pub fn agree(one: &BTreeMap<u64, String>, other: &BTreeMap<u64, String>) {
    let both: Vec<u64> = one.keys().copied().filter(|step| other.contains_key(step)).collect();
    assert!(!both.is_empty(), "no step in common: {:?} and {:?}", one.keys(), other.keys());
    for step in both {
        assert_eq!(one[&step], other[&step], "step {step}");
    }
}
