//! The stage's side of a session. It is used on the stage's own thread and never blocks.

use super::limits::MAX_REQUESTS_PER_STEP;
use sinew_control::Command;
use sinew_world::Frame;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::Receiver;
use tokio::sync::watch;

/// A request of a client to the stage.
#[derive(Clone, Debug, PartialEq)]
pub enum ClientRequest {
    /// A command.
    Command(Command),
    /// A key of the scene; the client is allowed the commands that it is bound to.
    Press(String),
}

/// A request and its origin.
#[derive(Clone, Debug, PartialEq)]
pub struct QueuedRequest {
    /// The request.
    pub request: ClientRequest,
    /// The client: names of its actors, or `operator`.
    pub by: Arc<str>,
    /// Physics steps that were done when it arrived.
    pub arrived_step: u64,
}

/// State that network and stage share without locks.
#[derive(Debug, Default)]
pub(super) struct Shared {
    /// Physics steps done.
    pub step: AtomicU64,
    /// The session was asked to end.
    pub stop: AtomicBool,
    pub counts: Counts,
}

/// Atomic counters behind [`ServerCounts`].
#[derive(Debug, Default)]
pub(super) struct Counts {
    pub joined: AtomicU64,
    pub present: AtomicU64,
    pub connections_refused: AtomicU64,
    pub requests: AtomicU64,
    pub requests_refused: AtomicU64,
    pub requests_dropped: AtomicU64,
    pub frames_sent: AtomicU64,
    pub frames_dropped: AtomicU64,
}

/// Statistics of a server, for its report.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct ServerCounts {
    /// Clients that have joined.
    pub joined: u64,
    /// Clients that are connected now.
    pub present: u64,
    /// Connections refused because they did not authenticate, or exceeded the maximum number.
    #[serde(rename = "strangers_refused")]
    pub connections_refused: u64,
    /// Requests that were queued for the stage.
    #[serde(rename = "orders")]
    pub requests: u64,
    /// Requests that were not allowed, or invalid.
    #[serde(rename = "orders_refused")]
    pub requests_refused: u64,
    /// Requests dropped because the queue was full or the rate limit was exceeded.
    #[serde(rename = "orders_dropped")]
    pub requests_dropped: u64,
    /// Frames sent, over all clients.
    pub frames_sent: u64,
    /// Frames dropped for newer ones, over all clients.
    pub frames_dropped: u64,
}

impl Counts {
    pub(super) fn now(&self) -> ServerCounts {
        let of = |count: &AtomicU64| count.load(Ordering::Relaxed);
        ServerCounts {
            joined: of(&self.joined),
            present: of(&self.present),
            connections_refused: of(&self.connections_refused),
            requests: of(&self.requests),
            requests_refused: of(&self.requests_refused),
            requests_dropped: of(&self.requests_dropped),
            frames_sent: of(&self.frames_sent),
            frames_dropped: of(&self.frames_dropped),
        }
    }
}

/// Adds one to a count.
pub(super) fn count(one: &AtomicU64) {
    one.fetch_add(1, Ordering::Relaxed);
}

/// An encoded frame, shared by all connections.
pub(super) type Sent = Arc<Vec<u8>>;

/// The queue from which the stage takes requests, and to which it publishes frames.
pub struct StageQueue {
    pub(super) requests: Receiver<QueuedRequest>,
    pub(super) frames: watch::Sender<Sent>,
    pub(super) shared: Arc<Shared>,
    /// Buffers of frames; one without readers is reused.
    pub(super) buffers: Vec<Sent>,
}

/// Maximum number of kept buffers.
const MAX_BUFFERS: usize = 256;

impl StageQueue {
    /// The next request, if one is queued. A step should take no more than [`MAX_REQUESTS_PER_STEP`].
    pub fn next_request(&mut self) -> Option<QueuedRequest> {
        self.requests.try_recv().ok()
    }

    /// Requests for the next step, in the order of arrival, at most [`MAX_REQUESTS_PER_STEP`].
    pub fn requests_for_step(&mut self) -> impl Iterator<Item = QueuedRequest> {
        self.requests.try_iter().take(MAX_REQUESTS_PER_STEP)
    }

    /// Publishes a frame to all clients.
    pub fn publish(&mut self, frame: &Frame) {
        let mut buffer = self.free_buffer();
        if let Some(bytes) = Arc::get_mut(&mut buffer) {
            frame.write(bytes);
        }
        if self.buffers.len() < MAX_BUFFERS {
            self.buffers.push(Arc::clone(&buffer));
        }
        self.frames.send_replace(buffer);
    }

    /// Sets the number of physics steps done.
    pub fn done(&self, step: u64) {
        self.shared.step.store(step, Ordering::Relaxed);
    }

    /// Whether the session was asked to end.
    pub fn should_stop(&self) -> bool {
        self.shared.stop.load(Ordering::Relaxed)
    }

    fn free_buffer(&mut self) -> Sent {
        let free = self.buffers.iter().position(|buffer| Arc::strong_count(buffer) == 1);
        free.map_or_else(Sent::default, |at| self.buffers.swap_remove(at))
    }
}
