//! Writes the sample walk: `cargo run -p sinew-body --example make_samples [FOLDER]`, by default into `samples/` at the root of
//! the repository, and checks that both files read back as the same motion.

use sinew_body::humanoid::Shape;
use sinew_body::walk::Walk;
use sinew_motion::Limits;
use sinew_motion::formats::{BodyShape, Format, WriteJob, bvh, gltf};
use std::error::Error;
use std::path::{Path, PathBuf};

/// A name and what the file holds.
pub type File = (&'static str, Vec<u8>);

/// Both files: the same in every run and on every machine.
pub fn files() -> Result<[File; 2], Box<dyn Error>> {
    let walk = Walk::default();
    let clip = walk.clip()?;
    let job = WriteJob { clip: &clip, source: None };
    let mut text = Vec::new();
    bvh::write(&mut text, &job)?;
    let mut binary = Vec::new();
    let shape = |(joint, shape): (usize, Shape)| BodyShape {
        joint,
        from: shape.from,
        to: shape.to,
        radius_m: shape.from_radius_m,
    };
    let shapes: Vec<BodyShape> = walk.shapes().into_iter().map(shape).collect();
    gltf::write(&mut binary, &job, Format::Glb, &shapes)?;
    Ok([("walk.bvh", text), ("walk.glb", binary)])
}

#[allow(dead_code, reason = "the test of the shipped files uses the rest of this file")]
fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args_os()
        .nth(1)
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../samples"), PathBuf::from);
    std::fs::create_dir_all(&folder)?;
    let frames = Walk::default().clip()?.frames();
    for (name, bytes) in files()? {
        let read = match name {
            "walk.bvh" => bvh::read(&bytes, &Limits::default())?,
            _ => gltf::read_slice(&bytes, None, &Limits::default())?,
        };
        assert_eq!(read.clip.frames(), frames, "{name} should hold every frame");
        std::fs::write(folder.join(name), &bytes)?;
        println!("{name}: {} bytes, {frames} frames", bytes.len());
    }
    Ok(())
}
