//! Where the shared motion files are, and how clips are compared.
#![allow(dead_code, reason = "each test file uses a part of it")]

use sinew_motion::Clip;

/// The largest distance [m] and angle [rad] between the joints of two clips, in the world, over all frames.
pub fn world_gap(a: &Clip, b: &Clip) -> (f64, f64) {
    assert_eq!(a.frames(), b.frames(), "as many frames");
    assert_eq!(a.skeleton().len(), b.skeleton().len(), "as many joints");
    let (mut distance, mut angle) = (0.0_f64, 0.0_f64);
    for frame in 0..a.frames() {
        for (a, b) in a.world(frame).iter().zip(b.world(frame)) {
            distance = distance.max((a.translation - b.translation).length());
            // By the sine: acos near 1 would lose half of the digits.
            let turn = a.rotation.conjugate() * b.rotation;
            angle = angle.max(2.0 * libm::asin(turn.xyz().length().min(1.0)));
        }
    }
    (distance, angle)
}

/// A GLB of this JSON and binary chunk.
pub fn glb(json: &str, bin: &[u8]) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut bin = bin.to_vec();
    bin.resize(bin.len().next_multiple_of(4), 0);
    let mut glb = b"glTF\x02\0\0\0".to_vec();
    glb.extend(((12 + 8 + json.len() + 8 + bin.len()) as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", &json), (b"BIN\0", &bin)] {
        glb.extend((chunk.len() as u32).to_le_bytes());
        glb.extend(kind);
        glb.extend(chunk);
    }
    glb
}

/// Floats as bytes.
pub fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}
