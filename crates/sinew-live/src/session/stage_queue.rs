//! The stage's side of a session. It runs on the stage's own thread and never waits for anybody.

use super::frame_code::encode_frame;
use super::limits::MAX_ORDERS_OF_STEP;
use sinew_control::Command;
use sinew_world::Frame;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::Receiver;
use tokio::sync::watch;

/// Something that a client wants done.
#[derive(Clone, Debug, PartialEq)]
pub enum Order {
    /// A command.
    Command(Command),
    /// A key of the scene; the client may give the commands that it is bound to.
    Press(String),
}

/// An order and where it came from.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// What is to be done.
    pub order: Order,
    /// Whose client it was: names of its actors, or `operator`.
    pub by: Arc<str>,
    /// Physics steps that were done when it arrived.
    pub arrived_step: u64,
}

/// What network and stage share without locks.
#[derive(Debug, Default)]
pub(super) struct Shared {
    /// Physics steps done.
    pub step: AtomicU64,
    /// Somebody asked for the end.
    pub stop: AtomicBool,
    pub counts: Counts,
}

/// What came of all that arrived.
#[derive(Debug, Default)]
pub(super) struct Counts {
    pub joined: AtomicU64,
    pub present: AtomicU64,
    pub strangers_refused: AtomicU64,
    pub orders: AtomicU64,
    pub orders_refused: AtomicU64,
    pub orders_dropped: AtomicU64,
    pub frames_sent: AtomicU64,
    pub frames_dropped: AtomicU64,
}

/// What came of all that arrived at a server, for its report.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct ServerCounts {
    /// Clients that were let in.
    pub joined: u64,
    /// Clients that are in now.
    pub present: u64,
    /// Connections that did not show a valid secret, or were too many.
    pub strangers_refused: u64,
    /// Orders that were passed to the stage.
    pub orders: u64,
    /// Orders that the client may not give, or that were not understood.
    pub orders_refused: u64,
    /// Orders that were too many.
    pub orders_dropped: u64,
    /// Frames sent, over all clients.
    pub frames_sent: u64,
    /// Frames that were given up for newer ones, over all clients.
    pub frames_dropped: u64,
}

impl Counts {
    pub(super) fn now(&self) -> ServerCounts {
        let of = |count: &AtomicU64| count.load(Ordering::Relaxed);
        ServerCounts {
            joined: of(&self.joined),
            present: of(&self.present),
            strangers_refused: of(&self.strangers_refused),
            orders: of(&self.orders),
            orders_refused: of(&self.orders_refused),
            orders_dropped: of(&self.orders_dropped),
            frames_sent: of(&self.frames_sent),
            frames_dropped: of(&self.frames_dropped),
        }
    }
}

/// Adds one to a count.
pub(super) fn count(one: &AtomicU64) {
    one.fetch_add(1, Ordering::Relaxed);
}

/// An encoded frame on its way to everybody.
pub(super) type Sent = Arc<Vec<u8>>;

/// Where the stage takes orders and hands out frames.
pub struct StageQueue {
    pub(super) orders: Receiver<Placed>,
    pub(super) frames: watch::Sender<Sent>,
    pub(super) shared: Arc<Shared>,
    /// Buffers of frames; one that nobody reads any more is used again.
    pub(super) buffers: Vec<Sent>,
}

/// Buffers that are kept.
const MAX_BUFFERS: usize = 256;

impl StageQueue {
    /// The next order, if one waits. A step should take no more than [`MAX_ORDERS_OF_STEP`].
    pub fn next_order(&mut self) -> Option<Placed> {
        self.orders.try_recv().ok()
    }

    /// Orders for the next step, in the order of their arrival.
    pub fn orders_of_step(&mut self) -> impl Iterator<Item = Placed> {
        self.orders.try_iter().take(MAX_ORDERS_OF_STEP)
    }

    /// Says how far the stage is; with a frame to send, everybody gets it.
    pub fn publish(&mut self, frame: &Frame) {
        let mut buffer = self.free_buffer();
        if let Some(bytes) = Arc::get_mut(&mut buffer) {
            bytes.clear();
            encode_frame(frame, bytes);
        }
        if self.buffers.len() < MAX_BUFFERS {
            self.buffers.push(Arc::clone(&buffer));
        }
        self.frames.send_replace(buffer);
    }

    /// Says how far the stage is.
    pub fn done(&self, step: u64) {
        self.shared.step.store(step, Ordering::Relaxed);
    }

    /// Whether somebody asked for the end.
    pub fn should_stop(&self) -> bool {
        self.shared.stop.load(Ordering::Relaxed)
    }

    fn free_buffer(&mut self) -> Sent {
        let free = self.buffers.iter().position(|buffer| Arc::strong_count(buffer) == 1);
        free.map_or_else(Sent::default, |at| self.buffers.swap_remove(at))
    }
}
