//! VMC, the open protocol of VR and motion capture software: OSC messages over UDP (<https://protocol.vmc.info>).
//!
//! [`VmcReader`] decodes datagrams into samples, for any bytes; [`VmcFrame`] encodes them. The reader uses the
//! addresses `/VMC/Ext/OK` (whether the performer is tracked), `/VMC/Ext/T` (the sender's time), `/VMC/Ext/Root/Pos` in
//! its forms 2.0 and 2.1 (scale and offset of the newer form are for mixing with camera pictures and not used) and
//! `/VMC/Ext/Bone/Pos`. Our own sender adds `/sinew/Ext/Seq`, a sequence number and the time in double precision.

mod axes;
mod frame;
mod osc;
mod reader;
mod sender_clock;

pub use frame::VmcFrame;
pub use osc::{MAX_DATAGRAM_BYTES, Malformed};
pub use reader::VmcReader;
pub(crate) use reader::has_body;

/// The default port of VMC receivers.
pub const VMC_PORT: u16 = 39539;

const OK: &str = "/VMC/Ext/OK";
const TIME: &str = "/VMC/Ext/T";
const ROOT: &str = "/VMC/Ext/Root/Pos";
const BONE: &str = "/VMC/Ext/Bone/Pos";
const SEQ: &str = "/sinew/Ext/Seq";
