//! Sends the simulated pose to any program that displays VMC.

use crate::vmc::VmcFrame;
use sinew_control::perform::PerformerSample;
use sinew_stage::Stage;
use sinew_world::CharacterId;
use std::net::{SocketAddr, UdpSocket};

/// Sends one character's pose.
#[derive(Debug)]
pub struct Mirror {
    socket: UdpSocket,
    to: SocketAddr,
    character: CharacterId,
    number: u64,
}

impl Mirror {
    /// For a character, to an address.
    ///
    /// # Errors
    /// The socket cannot be opened.
    pub fn open(character: CharacterId, to: SocketAddr) -> std::io::Result<Mirror> {
        let any = if to.is_ipv4() { "0.0.0.0:0" } else { "[::]:0" };
        let socket = UdpSocket::bind(any)?;
        // A slow viewer must not block the stage.
        socket.set_nonblocking(true)?;
        Ok(Mirror { socket, to, character, number: 0 })
    }

    /// Sends the present pose. A datagram that cannot be sent now is dropped: the next one is newer.
    pub fn send(&mut self, stage: &Stage) {
        let (Some(seen), Some(body)) = (stage.frame().character(self.character), stage.world().body(self.character))
        else {
            return;
        };
        let sample = PerformerSample::of_pose(stage.frame().time_secs, &seen.pose(), body);
        let sample = PerformerSample { number: Some(self.number), ..sample };
        self.number += 1;
        let _ = self.socket.send_to(&VmcFrame::of(&sample, body).to_bytes(), self.to);
    }
}
