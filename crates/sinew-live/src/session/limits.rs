//! What one side takes from the other at most. A peer that goes beyond is cut off; nobody else notices.

use std::time::Duration;

/// Version of the protocol. Both sides must speak the same.
pub const PROTOCOL: u32 = 1;

/// The UDP port that a server binds when none is asked for.
pub const DEFAULT_PORT: u16 = 47110;

/// Longest control message from a client \[bytes\]: a command with its texts.
pub const MAX_CLIENT_MESSAGE: usize = 64 << 10;

/// Longest control message from a server \[bytes\].
pub const MAX_SERVER_MESSAGE: usize = 256 << 10;

/// Longest message before a client is known to have the secret \[bytes\].
pub const MAX_HELLO: usize = 4 << 10;

/// Largest scene with all its files, as a take holds them \[bytes\].
pub const MAX_SCENE: usize = 64 << 20;

/// Longest encoded frame \[bytes\]: some 8000 bodies with their contacts.
pub const MAX_FRAME: usize = 2 << 20;

/// Characters in an encoded frame.
pub const MAX_CHARACTERS: usize = 1 << 10;

/// Props in an encoded frame.
pub const MAX_PROPS: usize = 1 << 14;

/// Contacts in an encoded frame; of more only the first are sent.
pub const MAX_CONTACTS: usize = 1 << 12;

/// Corners of one support polygon in an encoded frame.
pub const MAX_CORNERS: usize = 255;

/// Actors that one client may play.
pub const MAX_ACTORS_OF_ONE: usize = 8;

/// Length of an actor's or a key's name \[bytes\].
pub const MAX_NAME: usize = 200;

/// Commands of all clients that wait for a step; more are dropped and counted.
pub const MAX_ORDERS: usize = 1 << 10;

/// Commands of all clients that one step obeys; the rest waits for the next.
pub const MAX_ORDERS_OF_STEP: usize = 256;

/// Frames under way to one client.
pub const MAX_FRAMES_UNDER_WAY: u32 = 128;

/// A frame older than this is given up.
pub const STALE: Duration = Duration::from_millis(1000);

/// Time in which a connection must be up and the client must have shown its secret.
pub const HELLO_WITHIN: Duration = Duration::from_secs(5);

/// Time in which a client must have taken the scene.
pub const SCENE_WITHIN: Duration = Duration::from_secs(120);

/// A connection from which nothing comes for so long has ended.
pub const IDLE: Duration = Duration::from_secs(8);

/// Time between two signs of life of a client.
pub const SIGN_OF_LIFE: Duration = Duration::from_millis(200);

/// An actor whose client gave no sign of life for so long is given to the next who asks for it.
pub const QUIET: Duration = Duration::from_millis(1200);

/// Control messages a second that a client may send in the long run; more wait, at the client's side.
pub const CONTROL_PER_SEC: f64 = 60.0;

/// Datagrams a second that a client may send in the long run; more are dropped.
pub const DATAGRAMS_PER_SEC: f64 = 250.0 * MAX_ACTORS_OF_ONE as f64;

/// Connections that have not shown the secret yet, over all addresses.
pub const MAX_STRANGERS: usize = 64;

/// Connections that have not shown the secret yet, of one address.
pub const MAX_STRANGERS_OF_ONE: usize = 16;
