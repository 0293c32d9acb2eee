//! Draws a pushed walker: `cargo run -p sinew-picture --example strip [OUT.png]`.
//!
//! What it does not do: the walker is made of sines, not of physics; see the `sinew respond` command for the real thing.

#[path = "../tests/common/mod.rs"]
mod common;

use sinew_picture::{Camera, Filmstrip};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let strip = Filmstrip {
        title: "Pushed while walking".to_owned(),
        subtitle: "192 N on the chest for 0.15 s, from the front left".to_owned(),
        panels: (0..16).map(|step| common::panel(0.5 + 0.1 * f64::from(step))).collect(),
        camera: Camera::three_quarter(),
        ..Filmstrip::default()
    };
    let start = std::time::Instant::now();
    let pixmap = strip.draw()?;
    println!("drawn in {:.0} ms", start.elapsed().as_secs_f64() * 1e3);
    let png = strip.to_png()?;
    println!(
        "with encoding twice {:.0} ms, {}x{}, {} kB",
        start.elapsed().as_secs_f64() * 1e3,
        pixmap.width(),
        pixmap.height(),
        png.len() / 1000
    );
    let path = std::env::args().nth(1).map_or_else(|| std::env::temp_dir().join("strip.png"), Into::into);
    std::fs::write(&path, png)?;
    Ok(())
}
