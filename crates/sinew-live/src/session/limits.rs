//! Maximum sizes, rates and times that one side accepts from the other. A peer that exceeds them is disconnected; no
//! other peer is affected.

use std::time::Duration;

/// Version of the protocol. Both sides must use the same. 2: frames say which slots are vacant or were used before.
pub const PROTOCOL: u32 = 2;

/// Default UDP port of a server.
pub const DEFAULT_PORT: u16 = 47110;

/// Maximum size of a control message from a client \[bytes\]: a command with its texts.
pub const MAX_CLIENT_MESSAGE: usize = 64 << 10;

/// Maximum size of a control message from a server \[bytes\].
pub const MAX_SERVER_MESSAGE: usize = 256 << 10;

/// Maximum size of the hello message, before the client is authenticated \[bytes\].
pub const MAX_HELLO: usize = 4 << 10;

/// Maximum size of a scene with all its files, as a take holds them \[bytes\].
pub const MAX_SCENE: usize = 64 << 20;

/// Maximum size of a frame \[bytes\]: some 8000 bodies with their contacts. [`sinew_world::frame_bytes`] limits what is in it.
pub const MAX_FRAME: usize = 2 << 20;

/// Maximum number of actors that one client may play.
pub const MAX_ACTORS_PER_CLIENT: usize = 8;

/// Maximum length of an actor's or a key's name \[bytes\].
pub const MAX_NAME: usize = 200;

/// Maximum number of requests of all clients that wait for a step; more are dropped and counted.
pub const MAX_QUEUED_REQUESTS: usize = 1 << 10;

/// Maximum number of requests of all clients that are applied before one step; the rest wait for the next.
pub const MAX_REQUESTS_PER_STEP: usize = 256;

/// Maximum number of frames in flight to one client.
pub const MAX_FRAMES_IN_FLIGHT: u32 = 128;

/// Maximum age of a frame in flight; an older one is dropped.
pub const MAX_FRAME_AGE: Duration = Duration::from_millis(1000);

/// Time within which a client must connect and authenticate.
pub const HELLO_TIMEOUT: Duration = Duration::from_secs(5);

/// Time within which a client must have received the scene.
pub const SCENE_TIMEOUT: Duration = Duration::from_secs(120);

/// A connection that receives nothing for this long has ended.
pub const IDLE_TIMEOUT: Duration = Duration::from_secs(8);

/// Time between two keep-alives of a client.
pub const KEEP_ALIVE_INTERVAL: Duration = Duration::from_millis(200);

/// A client without a keep-alive for this long loses its actor to the next client that asks for it.
pub const ACTOR_TIMEOUT: Duration = Duration::from_millis(1200);

/// Maximum rate of control messages of a client \[1/s\], with bursts of one second's worth; more wait at the client's
/// side.
pub const CONTROL_PER_SEC: f64 = 60.0;

/// Maximum rate of datagrams of a client \[1/s\], with bursts of one second's worth; more are dropped.
pub const DATAGRAMS_PER_SEC: f64 = 250.0 * MAX_ACTORS_PER_CLIENT as f64;

/// Maximum number of connections that are not yet authenticated, over all addresses.
pub const MAX_PENDING_CONNECTIONS: usize = 64;

/// Maximum number of connections from one address that are not yet authenticated.
pub const MAX_PENDING_PER_ADDRESS: usize = 16;
