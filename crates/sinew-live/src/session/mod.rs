//! Sessions: one stage, actors on several machines.
//!
//! One authority: the server runs the stage, on a thread of its own and at the pace of the clock. Clients send commands and
//! performance, and are sent frames:
//!
//! ```text
//!  client ──commands (control stream, in order)──▶ ┌────────┐  orders, bounded   ┌───────┐
//!  client ──performance (datagrams)─────────────▶ │ Server │ ─────────────────▶ │ stage │──▶ take
//!  client ◀──frames (a stream each, newest first)── └────────┘ ◀───newest frame── └───────┘
//!                                                    tokio                 StageQueue    own thread
//! ```
//!
//! A command is applied, and recorded in the take, in the step that begins after it arrived. A frame holds the bits of every
//! body's place and velocity, so that every client computes [`Frame::hash`](sinew_world::Frame::hash) itself; hashes of one step
//! are equal everywhere. Late joiners get the scene with all its files, and with the next frame all there is to see.
//!
//! The stage never waits for the network: orders wait in a bounded queue, and of frames only the newest is offered. What one
//! client may take, send or hold open is bounded in [`limits`], so that a slow or hostile one harms itself only.

mod certificate;
mod channel;
mod client;
mod client_connection;
mod client_stats;
mod error;
mod frame_code;
pub mod limits;
mod link;
mod message;
mod pace;
mod permit;
mod relay;
mod role_assignments;
mod sample_code;
mod server;
mod session_observer;
mod stage_queue;
mod token;
mod upward;
mod wire;

pub use client::Client;
pub use client_stats::{ClientStats, SentOrder, Standing, note_hash};
pub use error::{Refusal, SessionError};
pub use frame_code::{decode_frame, encode_frame};
pub use limits::PROTOCOL;
pub use message::{ClientSays, Hello, ServerSays, Welcome};
pub use permit::permit;
pub use relay::{LinkConditions, Relay};
pub use server::{SceneManifest, Server, ServerSettings};
pub use session_observer::{AppliedCommand, SessionObserver};
pub use stage_queue::{Order, Placed, ServerCounts, StageQueue};
pub use token::{Role, Token};
pub use upward::Upward;
pub use wire::Malformed;
