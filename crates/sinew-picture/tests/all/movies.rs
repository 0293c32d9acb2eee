//! Moving pictures, read again by the decoders of the formats.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::common;
use glam::DVec3;
use sinew_picture::{Camera, Capsule, Error, Figure, Movie, MovieStyle, Panel, Shade, limits};

fn walk(frames: usize) -> Movie {
    Movie {
        title: "A walker".to_owned(),
        panels: (0..frames).map(|frame| common::panel(0.6 + frame as f64 / 25.0)).collect(),
        camera: Camera::side(),
        style: MovieStyle { width_px: 240, height_px: 180, ..MovieStyle::default() },
    }
}

/// Every frame of a GIF, composed, as red, green and blue.
fn gif_frames(bytes: &[u8]) -> (Vec<Vec<u8>>, Vec<u16>) {
    let mut decoder = gif::DecodeOptions::new().read_info(bytes).unwrap();
    let palette = decoder.global_palette().unwrap().to_vec();
    let (width, height) = (usize::from(decoder.width()), usize::from(decoder.height()));
    let mut canvas = vec![0; 3 * width * height];
    let (mut frames, mut delays) = (Vec::new(), Vec::new());
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        for (at, &index) in frame.buffer.iter().enumerate().filter(|(_, index)| Some(**index) != frame.transparent) {
            let (row, column) = (at / usize::from(frame.width), at % usize::from(frame.width));
            let to = 3 * ((row + usize::from(frame.top)) * width + column + usize::from(frame.left));
            canvas[to..to + 3].copy_from_slice(&palette[3 * usize::from(index)..3 * usize::from(index) + 3]);
        }
        frames.push(canvas.clone());
        delays.push(frame.delay);
    }
    (frames, delays)
}

/// The largest and the mean difference of a channel from the frame as it is drawn.
fn off(movie: &Movie, index: usize, rgb: &[u8]) -> (u8, f64) {
    let drawn = movie.frame(index).unwrap();
    let wanted = drawn.rgba().chunks_exact(4).flat_map(|pixel| &pixel[..3]);
    let differences: Vec<u8> = wanted.zip(rgb).map(|(one, other)| one.abs_diff(*other)).collect();
    let sum: u64 = differences.iter().map(|&off| u64::from(off)).sum();
    (differences.iter().copied().max().unwrap(), sum as f64 / differences.len() as f64)
}

#[test]
fn a_gif_shows_every_frame_at_its_true_pace_and_nearly_its_true_colours() {
    let movie = walk(20);
    let (frames, delays) = gif_frames(&movie.to_gif().unwrap());
    assert_eq!(frames.len(), 20);
    assert!(delays.iter().all(|&delay| delay == 4), "hundredths of a second: {delays:?}");
    for index in [0, 7, 19] {
        // 127 colours for some ten tints in six steps of light, and their blends at edges, of which the rare ones are off most.
        let (largest, mean) = off(&movie, index, &frames[index]);
        assert!(largest <= 60 && mean < 1.0, "frame {index}: {largest} {mean}");
    }
}

#[test]
fn an_animated_png_shows_the_same_frames_as_the_gif() {
    let movie = walk(6);
    let bytes = movie.to_apng().unwrap();
    let mut decoder = png::Decoder::new(std::io::Cursor::new(&bytes));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().unwrap();
    assert_eq!(reader.info().animation_control().unwrap().num_frames, 6);
    let mut first = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut first).unwrap();
    let control = reader.info().frame_control().unwrap();
    assert_eq!((control.delay_num, control.delay_den), (1, 25));
    let rgb: Vec<u8> = first.chunks_exact(4).flat_map(|pixel| pixel[..3].to_vec()).collect();
    assert!(rgb == gif_frames(&movie.to_gif().unwrap()).0[0]);
}

#[test]
fn same_motion_gives_the_same_bytes() {
    assert!(walk(5).to_gif().unwrap() == walk(5).to_gif().unwrap());
    assert!(walk(5).to_apng().unwrap() == walk(5).to_apng().unwrap());
}

#[test]
fn a_body_that_stands_still_costs_next_to_nothing() {
    let still = |frames: usize| Movie { panels: vec![common::panel(0.9); frames], ..walk(1) }.to_gif().unwrap().len();
    // A frame without a change is one pixel.
    assert!(still(101) - still(1) < 100 * 60, "{} {}", still(101), still(1));
}

#[test]
fn odd_films_are_films_or_errors() {
    let empty = Movie::default();
    assert!(empty.to_gif().is_ok() && empty.to_apng().is_ok());
    assert_eq!(gif_frames(&empty.to_gif().unwrap()).0.len(), 1);
    for odd in [f64::NAN, f64::INFINITY, -1e300] {
        let ball = Capsule::ball(DVec3::splat(odd), odd, Shade::Left);
        let panel = Panel { time_secs: odd, figure: Figure::new(vec![ball]), ..Panel::default() };
        let style = MovieStyle { width_px: 1, height_px: 65, floor_m: odd };
        let movie = Movie { panels: vec![panel], style, ..Movie::default() };
        assert_eq!(movie.size_px(), (64, 64));
        assert!(movie.to_gif().is_ok(), "{odd}");
    }
    let long = Movie { panels: vec![Panel::default(); limits::MAX_MOVIE_FRAMES + 1], ..Movie::default() };
    assert!(matches!(long.to_gif(), Err(Error::TooLong { frames }) if frames == limits::MAX_MOVIE_FRAMES + 1));
    assert_eq!([Movie::frames_in(2.0), Movie::frames_in(0.0), Movie::frames_in(f64::NAN)], [50, 1, 1]);
}
