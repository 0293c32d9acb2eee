//! Draws a pushed walker and a plot of its lean, and the walker as a GIF beside it:
//! `cargo run -p sinew-picture --example strip [OUT.png]`.
//!
//! What it does not do: the walker is made of sines, not of physics.

#[path = "../tests/all/common/mod.rs"]
mod common;

use sinew_picture::{Camera, Filmstrip, Limit, Mark, Movie, Plot, Series, Sheet};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let strip = Filmstrip {
        panels: (0..16).map(|step| common::panel(0.5 + 0.1 * f64::from(step))).collect(),
        camera: Camera::three_quarter(),
        ..Filmstrip::default()
    };
    let parts = [
        ("leftUpperArm", 52.0, 1.0),
        ("spine", 31.0, 0.8),
        ("head", 24.0, 1.9),
        ("rightUpperArm", 20.0, 1.2),
        ("hips", 6.0, 0.7),
        ("leftFoot", 1.4, 2.0),
    ];
    let line = |peak: f64, haste: f64| {
        let value = |time: f64| {
            peak * common::yielding(0.8 + (time - 0.8) * haste) * libm::cos((time - 0.8).max(0.0) * 1.7 * haste).abs()
        };
        (30..=180).map(|frame| f64::from(frame) / 60.0).map(|time| (time, value(time))).collect()
    };
    let plot = Plot {
        title: "Deflection from the input motion".to_owned(),
        x_label: "time (s)".to_owned(),
        y_label: "deflection (°)".to_owned(),
        series: parts.iter().map(|&(name, peak, haste)| Series::new(name, line(peak, haste))).collect(),
        marks: vec![Mark { from_secs: 0.8, to_secs: 0.95, label: "push 192 N".to_owned() }],
        limits: vec![Limit { value: 2.0, label: "recovered below 2°".to_owned() }],
        ..Plot::default()
    };
    let sheet = Sheet {
        title: "Pushed while walking".to_owned(),
        subtitle: "192 N on the chest for 0.15 s, from the front left".to_owned(),
        pieces: vec![strip.into(), plot.into()],
        footer: "A walker made of sines, drawn by the strip example of sinew-picture".to_owned(),
        width_px: 1800,
    };
    let picture = sheet.draw()?;
    let png = picture.to_png()?;
    let path = std::env::args().nth(1).map_or_else(|| std::env::temp_dir().join("strip.png"), Into::into);
    std::fs::write(&path, &png)?;
    let movie = Movie {
        title: "Pushed while walking".to_owned(),
        panels: (0..60).map(|frame| common::panel(0.5 + f64::from(frame) / 25.0)).collect(),
        camera: Camera::side(),
        ..Movie::default()
    };
    std::fs::write(path.with_extension("gif"), movie.to_gif()?)?;
    println!("{}: {} × {} px, {} kB", path.display(), picture.width(), picture.height(), png.len() / 1000);
    let left = sinew_picture::Shade::Left.colour();
    let blue = picture.rgba().chunks_exact(4).filter(|pixel| pixel[2] > pixel[0].saturating_add(60)).count();
    assert!(blue > 10_000, "the left limbs ({left:?}) should show");
    Ok(())
}
