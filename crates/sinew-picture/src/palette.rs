//! The 127 colours of a moving picture.
//!
//! Most of a frame is flat: paper, tiles, text. The palette has those colours exactly, and a pixel becomes the colour nearest to
//! its own, without dithering, whose noise flickers and fills the file. Both are why this is ours: of the libraries, `color_quant`
//! moves flat colours off their values, and `quantette` brings more crates than this crate has.

use std::collections::BTreeMap;

/// Colours of a palette; one more is left for "as in the frame before". Twice as many make a file larger by a tenth, and a
/// difference that is hard to see.
pub(crate) const COLOURS: usize = 127;
/// The index that stands for "as in the frame before".
pub(crate) const UNCHANGED: u8 = COLOURS as u8;

/// How often each colour (0xRRGGBB) is in some frames.
#[derive(Default)]
pub(crate) struct Histogram(BTreeMap<u32, u64>);

impl Histogram {
    /// Counts the pixels of a frame: red, green, blue, alpha.
    pub fn add(&mut self, rgba: &[u8]) {
        let mut pixels: Vec<u32> = rgba.chunks_exact(4).map(key).collect();
        pixels.sort_unstable();
        for run in pixels.chunk_by(|one, other| one == other) {
            *self.0.entry(run[0]).or_default() += run.len() as u64;
        }
    }
}

/// A palette, and for each colour met so far the index of the nearest in it.
pub(crate) struct Palette {
    colours: Vec<[u8; 3]>,
    /// By colour (0xRRGGBB); [`UNKNOWN`] until it is met.
    nearest: Vec<u16>,
}

const UNKNOWN: u16 = u16::MAX;

impl Palette {
    /// Median cut (Heckbert, *Color Image Quantization for Frame Buffer Display*, 1982), where a box of colours is represented by
    /// its most frequent one instead of their mean.
    pub fn of(histogram: &Histogram) -> Palette {
        let all: Vec<Weighted> = histogram.0.iter().map(|(&key, &count)| Weighted::new(key, count)).collect();
        let mut boxes = vec![Region::new(all)];
        while boxes.len() < COLOURS {
            let widest = boxes.iter().enumerate().max_by(|(_, one), (_, other)| one.spread.total_cmp(&other.spread));
            let Some((index, _)) = widest.filter(|(_, region)| region.spread > 0.0) else { break };
            let (one, other) = boxes.swap_remove(index).split();
            boxes.extend([one, other]);
        }
        let mut colours: Vec<[u8; 3]> = boxes.iter().filter_map(Region::representative).collect();
        colours.sort_unstable();
        Palette { colours, nearest: vec![UNKNOWN; 1 << 24] }
    }

    /// Its colours, red, green and blue of each; padded to 128.
    pub fn rgb(&self) -> Vec<u8> {
        let mut rgb: Vec<u8> = self.colours.iter().flatten().copied().collect();
        rgb.resize(3 * (COLOURS + 1), 0);
        rgb
    }

    /// The index of the nearest colour for every pixel of a frame.
    pub fn indexed(&mut self, rgba: &[u8]) -> Vec<u8> {
        rgba.chunks_exact(4).map(|pixel| self.index(key(pixel))).collect()
    }

    fn index(&mut self, key: u32) -> u8 {
        let known = self.nearest[key as usize];
        if known != UNKNOWN {
            return known as u8;
        }
        let [red, green, blue] = channels(key).map(i32::from);
        let off = |colour: &[u8; 3]| {
            let [r, g, b] = colour.map(i32::from);
            // Green counts most and blue least, as to the eye.
            2 * (r - red) * (r - red) + 4 * (g - green) * (g - green) + (b - blue) * (b - blue)
        };
        let nearest = self.colours.iter().enumerate().min_by_key(|(_, colour)| off(colour));
        let index = nearest.map_or(0, |(index, _)| index as u8);
        self.nearest[key as usize] = u16::from(index);
        index
    }
}

fn key(pixel: &[u8]) -> u32 {
    u32::from(pixel[0]) << 16 | u32::from(pixel[1]) << 8 | u32::from(pixel[2])
}

fn channels(key: u32) -> [u8; 3] {
    [(key >> 16) as u8, (key >> 8) as u8, key as u8]
}

#[derive(Clone, Copy)]
struct Weighted {
    rgb: [u8; 3],
    count: u64,
    /// The root of the count: rare colours, as of an arrow, count for more than their share.
    weight: f64,
}

impl Weighted {
    fn new(key: u32, count: u64) -> Weighted {
        Weighted { rgb: channels(key), count, weight: (count as f64).sqrt() }
    }
}

/// A box of colours.
struct Region {
    colours: Vec<Weighted>,
    /// The channel along which they differ most, and their weighted squared distance from the mean along it.
    axis: usize,
    spread: f64,
}

impl Region {
    fn new(colours: Vec<Weighted>) -> Region {
        let weight: f64 = colours.iter().map(|colour| colour.weight).sum();
        let along = |axis: usize| {
            let of = |colour: &Weighted| f64::from(colour.rgb[axis]);
            let mean = colours.iter().map(|colour| of(colour) * colour.weight).sum::<f64>() / weight.max(1e-9);
            colours.iter().map(|colour| (of(colour) - mean) * (of(colour) - mean) * colour.weight).sum::<f64>()
        };
        let spreads = [along(0), along(1), along(2)];
        let axis = (0..3).max_by(|&a, &b| spreads[a].total_cmp(&spreads[b])).unwrap_or(0);
        Region { spread: spreads[axis], axis, colours }
    }

    /// Two boxes, cut at the mean along its axis.
    fn split(mut self) -> (Region, Region) {
        let axis = self.axis;
        self.colours.sort_by_key(|colour| colour.rgb[axis]);
        let weight: f64 = self.colours.iter().map(|colour| colour.weight).sum();
        let mean = self.colours.iter().map(|colour| f64::from(colour.rgb[axis]) * colour.weight).sum::<f64>() / weight;
        let at = self.colours.partition_point(|colour| f64::from(colour.rgb[axis]) <= mean);
        let other = self.colours.split_off(at.clamp(1, self.colours.len().max(2) - 1));
        (Region::new(self.colours), Region::new(other))
    }

    fn representative(&self) -> Option<[u8; 3]> {
        self.colours.iter().max_by_key(|colour| colour.count).map(|colour| colour.rgb)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flat_colours_are_kept_exactly_and_others_come_near() {
        // Two flat colours, and a ramp of a thousand rare ones.
        let mut rgba: Vec<u8> =
            [[250, 249, 251, 255], [12, 200, 90, 255]].iter().flat_map(|flat| flat.repeat(5_000)).collect();
        for step in 0..1_000_u32 {
            rgba.extend([(step / 4) as u8, (step / 8) as u8, 255 - (step / 5) as u8, 255]);
        }
        let mut histogram = Histogram::default();
        histogram.add(&rgba);
        let mut palette = Palette::of(&histogram);
        let (indices, rgb) = (palette.indexed(&rgba), palette.rgb());
        assert_eq!(rgb.len(), 3 * (COLOURS + 1));
        let shown = |at: usize| &rgb[3 * usize::from(indices[at])..3 * usize::from(indices[at]) + 3];
        assert_eq!(shown(0), [250, 249, 251]);
        assert_eq!(shown(5_000), [12, 200, 90]);
        for at in (10_000..11_000).step_by(7) {
            // The ramp has 1,000 steps for some 125 colours, four levels a step in the channel that changes most.
            let off = shown(at).iter().zip(&rgba[4 * at..4 * at + 3]).map(|(a, b)| a.abs_diff(*b)).max();
            assert!(off < Some(10), "{at} is off by {off:?}");
        }
    }
}
