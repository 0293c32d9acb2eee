//! VMC: the open protocol that VR and suit software speaks, OSC messages over UDP (<https://protocol.vmc.info>).
//!
//! [`VmcReader`] makes samples of datagrams, whatever is in them; [`VmcFrame`] writes them. Read are the address `/VMC/Ext/OK`
//! (is the performer seen), `/VMC/Ext/T` (the sender's time), `/VMC/Ext/Root/Pos` in its forms 2.0 and 2.1 (scale and offset of the
//! newer form are for mixing with camera pictures and not used) and `/VMC/Ext/Bone/Pos`. Our own sender adds `/sinew/Ext/Seq`, a
//! running number and the time in double precision.

mod axes;
mod frame;
mod osc;
mod reader;

pub use frame::VmcFrame;
pub use osc::{MAX_DATAGRAM_BYTES, Malformed};
pub use reader::VmcReader;

/// The port that receivers usually have.
pub const VMC_PORT: u16 = 39539;

const OK: &str = "/VMC/Ext/OK";
const TIME: &str = "/VMC/Ext/T";
const ROOT: &str = "/VMC/Ext/Root/Pos";
const BONE: &str = "/VMC/Ext/Bone/Pos";
const SEQ: &str = "/sinew/Ext/Seq";
