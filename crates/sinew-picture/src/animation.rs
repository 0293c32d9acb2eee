//! Frames as an animated GIF or PNG: one palette for all, and of each frame only what changed.

use crate::movie::Movie;
use crate::palette::{COLOURS, Histogram, Palette, UNCHANGED};
use crate::{Error, Image};

/// Frames that are drawn one by one, so that a long film needs no more memory than its file.
pub(crate) trait Frames: Sync {
    fn size_px(&self) -> (u32, u32);
    /// At least one.
    fn count(&self) -> usize;
    fn frame(&self, index: usize) -> Result<Image, Error>;
}

/// Frames whose colours make the palette.
const SAMPLED: usize = 24;

/// What differs from the frame before: the rectangle that holds all of it.
struct Change {
    left: u32,
    top: u32,
    width: u32,
    height: u32,
    /// Its colours.
    indices: Vec<u8>,
    /// The same with [`UNCHANGED`] wherever a whole stretch of a row is as before.
    sparse: Vec<u8>,
}

/// An animated GIF.
pub(crate) fn gif(frames: &impl Frames) -> Result<Vec<u8>, Error> {
    let failed = |error: gif::EncodingError| Error::EncodeMovie(error.to_string());
    let mut palette = palette(frames)?;
    let (width, height) = frames.size_px();
    let size = |pixels: u32| u16::try_from(pixels).map_err(|error| Error::EncodeMovie(error.to_string()));
    let mut bytes = Vec::new();
    let mut encoder = gif::Encoder::new(&mut bytes, size(width)?, size(height)?, &palette.rgb()).map_err(failed)?;
    encoder.set_repeat(gif::Repeat::Infinite).map_err(failed)?;
    changes(frames, &mut palette, |change| {
        let (left, top) = (size(change.left)?, size(change.top)?);
        let (width, height) = (size(change.width)?, size(change.height)?);
        let packed = |indices: Vec<u8>| {
            let mut frame = gif::Frame {
                delay: (100 / Movie::FRAMES_PER_SEC) as u16,
                dispose: gif::DisposalMethod::Keep,
                transparent: Some(UNCHANGED),
                left,
                top,
                width,
                height,
                buffer: indices.into(),
                ..gif::Frame::default()
            };
            frame.make_lzw_pre_encoded();
            frame
        };
        // Leaving out what is as before saves bytes where it leaves out much, and costs some where it breaks up a pattern.
        let (whole, sparse) = (packed(change.indices), packed(change.sparse));
        let shorter = if sparse.buffer.len() <= whole.buffer.len() { sparse } else { whole };
        encoder.write_lzw_pre_encoded_frame(&shorter).map_err(failed)
    })?;
    drop(encoder);
    Ok(bytes)
}

/// An animated PNG.
pub(crate) fn apng(frames: &impl Frames) -> Result<Vec<u8>, Error> {
    let failed = |error: png::EncodingError| Error::EncodeMovie(error.to_string());
    let mut palette = palette(frames)?;
    let (width, height) = frames.size_px();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(palette.rgb());
    let mut opacity = vec![255; COLOURS];
    opacity.push(0);
    encoder.set_trns(opacity);
    encoder.set_compression(png::Compression::High);
    encoder.set_filter(png::Filter::NoFilter);
    encoder.set_animated(frames.count() as u32, 0).map_err(failed)?;
    encoder.set_frame_delay(1, Movie::FRAMES_PER_SEC as u16).map_err(failed)?;
    encoder.set_dispose_op(png::DisposeOp::None).map_err(failed)?;
    encoder.set_blend_op(png::BlendOp::Over).map_err(failed)?;
    let mut writer = encoder.write_header().map_err(failed)?;
    let mut is_first = true;
    changes(frames, &mut palette, |change| {
        if !is_first {
            writer.reset_frame_position().map_err(failed)?;
            writer.set_frame_dimension(change.width, change.height).map_err(failed)?;
            writer.set_frame_position(change.left, change.top).map_err(failed)?;
        }
        is_first = false;
        writer.write_image_data(&change.sparse).map_err(failed)
    })?;
    writer.finish().map_err(failed)?;
    Ok(bytes)
}

fn palette(frames: &impl Frames) -> Result<Palette, Error> {
    let count = frames.count();
    let sampled = count.min(SAMPLED);
    let indices: Vec<usize> = (0..sampled).map(|at| at * (count - 1) / sampled.max(2).saturating_sub(1)).collect();
    let mut histogram = Histogram::default();
    for image in drawn(frames, &indices)? {
        histogram.add(image.rgba());
    }
    Ok(Palette::of(&histogram))
}

/// Frames drawn on as many cores as there are.
fn drawn(frames: &impl Frames, indices: &[usize]) -> Result<Vec<Image>, Error> {
    let cores = std::thread::available_parallelism().map_or(1, |cores| cores.get());
    let share = indices.len().div_ceil(cores).max(1);
    std::thread::scope(|scope| {
        let workers: Vec<_> = indices
            .chunks(share)
            .map(|indices| {
                scope.spawn(move || indices.iter().map(|&at| frames.frame(at)).collect::<Result<Vec<_>, _>>())
            })
            .collect();
        let mut all = Vec::with_capacity(indices.len());
        for worker in workers {
            let failed = |_| Error::EncodeMovie("a frame could not be drawn".to_owned());
            all.extend(worker.join().map_err(failed)??);
        }
        Ok(all)
    })
}

/// Frames that are in memory at a time.
const AT_A_TIME: usize = 32;

fn changes(
    frames: &impl Frames,
    palette: &mut Palette,
    mut each: impl FnMut(Change) -> Result<(), Error>,
) -> Result<(), Error> {
    let (width, height) = frames.size_px();
    let mut before: Option<Vec<u8>> = None;
    let all: Vec<usize> = (0..frames.count()).collect();
    for indices in all.chunks(AT_A_TIME) {
        for image in drawn(frames, indices)? {
            let now = palette.indexed(image.rgba());
            each(match &before {
                None => Change { left: 0, top: 0, width, height, indices: now.clone(), sparse: now.clone() },
                Some(before) => change(before, &now, width as usize),
            })?;
            before = Some(now);
        }
    }
    Ok(())
}

/// Pixels of a row that must be as before to be left out.
const STRETCH: usize = 12;

/// What changed from one frame to the next: at least one pixel, since a frame needs one.
fn change(before: &[u8], now: &[u8], width: usize) -> Change {
    let differs = |row: usize, columns: std::ops::Range<usize>| {
        let at = row * width;
        before[at + columns.start..at + columns.end] != now[at + columns.start..at + columns.end]
    };
    let rows = now.len() / width.max(1);
    let top = (0..rows).find(|&row| differs(row, 0..width)).unwrap_or(0);
    let bottom = (top..rows).rev().find(|&row| differs(row, 0..width)).unwrap_or(top);
    let column = |column: usize| (top..=bottom).any(|row| before[row * width + column] != now[row * width + column]);
    let left = (0..width).find(|&at| column(at)).unwrap_or(0);
    let right = (left..width).rev().find(|&at| column(at)).unwrap_or(left);
    let (mut indices, mut sparse) = (Vec::new(), Vec::new());
    for row in top..=bottom {
        let line = row * width + left..=row * width + right;
        let (before, now) = (&before[line.clone()], &now[line]);
        indices.extend_from_slice(now);
        let pairs: Vec<(u8, u8)> = before.iter().copied().zip(now.iter().copied()).collect();
        for stretch in pairs.chunk_by(|one, other| (one.0 == one.1) == (other.0 == other.1)) {
            let same = stretch[0].0 == stretch[0].1 && stretch.len() >= STRETCH;
            sparse.extend(stretch.iter().map(|&(_, now)| if same { UNCHANGED } else { now }));
        }
    }
    Change {
        left: left as u32,
        top: top as u32,
        width: (right - left + 1) as u32,
        height: (bottom - top + 1) as u32,
        indices,
        sparse,
    }
}
