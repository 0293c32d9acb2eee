//! Sessions: one stage, actors on several machines.
//!
//! One authority: the server runs the stage in real time on its own thread. Clients send commands and performance
//! samples and receive frames:
//!
//! ```text
//!  client ──commands (control stream, in order)──▶ ┌────────┐  requests, bounded ┌───────┐
//!  client ──performance (datagrams)─────────────▶ │ Server │ ─────────────────▶ │ stage │──▶ take
//!  client ◀──frames (a stream each, newest first)── └────────┘ ◀───newest frame── └───────┘
//!                                                    tokio                 StageQueue    own thread
//! ```
//!
//! A command is applied, and recorded in the take, in the step that begins after it arrived. A frame holds all bits of
//! the pose and velocity of every body, so that every client computes [`Frame::hash`](sinew_world::Frame::hash) itself;
//! the hashes of one step are equal everywhere. [`frame_bytes`](sinew_world::frame_bytes) documents the layout. A client
//! that joins late receives the scene with all its files, and with the next frame the whole state.
//!
//! The stage never waits for the network: requests wait in a bounded queue, and only the newest frame is offered.
//! [`limits`] bounds what one client may send, receive or hold open, so that a slow or hostile client harms only
//! itself.

mod certificate;
mod channel;
mod client;
mod client_connection;
mod client_datagram;
mod client_stats;
mod error;
pub mod limits;
mod link;
mod message;
mod permit;
mod rate_limit;
mod relay;
mod role_assignments;
mod sample_code;
mod server;
mod session_observer;
mod stage_queue;
mod token;
mod wire;

pub use client::Client;
pub use client_datagram::ClientDatagram;
pub use client_stats::{ClientStats, ConnectionState, SentRequest, note_hash};
pub use error::{Refusal, SessionError};
pub use limits::PROTOCOL;
pub use message::{ClientMessage, Hello, ServerMessage, Welcome};
pub use permit::permit;
pub use relay::{LinkConditions, Relay};
pub use server::{SceneManifest, Server, ServerSettings};
pub use session_observer::{AppliedCommand, SessionObserver};
pub use stage_queue::{ClientRequest, QueuedRequest, ServerCounts, StageQueue};
pub use token::{Role, Token};
pub use wire::Malformed;
