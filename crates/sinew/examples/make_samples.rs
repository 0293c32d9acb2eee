//! Writes the sample walk: `cargo run -p sinew --example make_samples [FOLDER]`, by default into `samples/` at the root of the repository.

use sinew::sample::Walk;
use sinew_motion::formats::{Format, WriteJob, bvh, gltf};
use std::error::Error;
use std::path::{Path, PathBuf};

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args_os()
        .nth(1)
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../samples"), PathBuf::from);
    let walk = Walk::default();
    let clip = walk.clip()?;
    let job = WriteJob { clip: &clip, source: None };
    let mut text = Vec::new();
    bvh::write(&mut text, &job)?;
    let mut binary = Vec::new();
    gltf::write(&mut binary, &job, Format::Glb, &walk.body_shapes())?;
    std::fs::create_dir_all(&folder)?;
    for (name, bytes) in [("walk.bvh", text), ("walk.glb", binary)] {
        std::fs::write(folder.join(name), &bytes)?;
        println!("{name}: {} bytes, {} frames", bytes.len(), clip.frames());
    }
    Ok(())
}
