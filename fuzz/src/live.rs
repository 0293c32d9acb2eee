//! What the fuzz targets of capture streams do with bytes. The tests of `sinew-live` call the same functions, so that they run
//! without a nightly compiler.

use glam::DVec3;
use sinew_body::humanoid::{Body, Pose};
use sinew_control::perform::{LiveSettings, LiveSource, PerformerSample};
use sinew_live::raw::RawReader;
use sinew_live::vmc::VmcReader;

/// Reads a datagram twice, then its pieces between bytes 255 as datagrams, and performs what they say:
/// the reader learns over several datagrams what belongs to a frame.
///
/// # Panics
/// If a shown pose has NaN or infinite values.
pub fn vmc(data: &[u8]) {
    let mut reader = VmcReader::new();
    let mut samples = Vec::new();
    for arrival in [0.0, 0.1] {
        // An error is an answer.
        let _ = reader.datagram(data, arrival, &mut |sample| samples.push(sample));
    }
    // Each piece between two marks is a datagram of its own, so that bytes can be a stream of single messages.
    for (number, piece) in data.split(|&byte| byte == 0xff).take(200).enumerate() {
        let _ = reader.datagram(piece, 0.2 + number as f64 * 0.01, &mut |sample| samples.push(sample));
    }
    perform(&samples);
}

/// Reads a connection's bytes, and performs what they say.
///
/// # Panics
/// As [`vmc`].
pub fn raw(data: &[u8]) {
    let mut samples = Vec::new();
    RawReader::new().bytes(data, 0.0, &mut |result| samples.extend(result.ok()));
    perform(&samples);
}

fn perform(samples: &[PerformerSample]) {
    if samples.is_empty() {
        return;
    }
    let body = Body::standard(80.0, 1.7);
    let mut source = LiveSource::new(&body, DVec3::ZERO, 0.0, &Pose::STANDING, LiveSettings::default());
    for (step, sample) in samples.iter().take(100).enumerate() {
        let now = step as f64 / 240.0;
        source.receive(sample, now);
        source.advance(now, 1.0 / 240.0);
        assert!(source.pose().is_finite(), "what is shown is finite");
    }
}
