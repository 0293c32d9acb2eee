//! Text in the embedded font.

use std::sync::OnceLock;

use ab_glyph::{Font, FontRef, GlyphId, PxScale, ScaleFont, point};

use crate::Colour;
use crate::canvas::{Canvas, Spot};
use crate::limits::MAX_TEXT_CHARS;

static REGULAR: &[u8] = include_bytes!("../assets/Inter-Regular-subset.otf");
static STRONG: &[u8] = include_bytes!("../assets/Inter-SemiBold-subset.otf");

/// Alignment of a text at its anchor.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// Style of a text.
#[derive(Clone, Copy)]
pub(crate) struct Type {
    /// Height of the em square \[px\].
    pub em_px: f32,
    pub strong: bool,
    pub colour: Colour,
}

impl Type {
    pub fn plain(em_px: f32, colour: Colour) -> Type {
        Type { em_px, strong: false, colour }
    }

    pub fn strong(em_px: f32, colour: Colour) -> Type {
        Type { em_px, strong: true, colour }
    }

    fn font(self) -> Option<&'static FontRef<'static>> {
        static FONTS: [OnceLock<Option<FontRef<'static>>>; 2] = [OnceLock::new(), OnceLock::new()];
        let bytes = if self.strong { STRONG } else { REGULAR };
        FONTS[usize::from(self.strong)].get_or_init(|| FontRef::try_from_slice(bytes).ok()).as_ref()
    }

    /// Width of a text \[px\].
    pub fn width(self, text: &str) -> f32 {
        self.glyphs(text).last().map_or(0.0, |(_, start, advance)| start + advance)
    }

    /// Glyph, start and advance \[px\] of each character.
    fn glyphs(self, text: &str) -> impl Iterator<Item = (GlyphId, f32, f32)> + '_ {
        let font = self.font();
        let mut pen = 0.0;
        text.chars().take(MAX_TEXT_CHARS).filter_map(move |letter| {
            let font = font?;
            let letter = if letter.is_control() { ' ' } else { letter };
            let mut glyph = font.glyph_id(letter);
            if glyph.0 == 0 {
                glyph = font.glyph_id('?');
            }
            let start = pen;
            let advance = font.as_scaled(self.scale(font)).h_advance(glyph);
            pen += advance;
            Some((glyph, start, advance))
        })
    }

    /// ab_glyph measures by ascent plus descent; we by the em square, as designers do.
    fn scale(self, font: &FontRef<'_>) -> PxScale {
        let em_px = if self.em_px.is_finite() { self.em_px.clamp(1.0, 400.0) } else { 1.0 };
        PxScale::from(em_px * font.height_unscaled() / font.units_per_em().unwrap_or(1_000.0))
    }

    /// The text in one line of a maximum width \[px\], or broken between words into two, the second truncated.
    pub fn in_two_lines(self, text: &str, width: f32) -> (String, String) {
        if self.width(text) <= width {
            return (text.to_owned(), String::new());
        }
        let breaks = text.char_indices().filter(|(_, letter)| letter.is_whitespace()).map(|(at, _)| at);
        match breaks.take(MAX_TEXT_CHARS).filter(|&at| self.width(&text[..at]) <= width).last() {
            Some(at) if at > 0 => (text[..at].to_owned(), self.fit(text[at..].trim_start(), width)),
            _ => (self.fit(text, width), String::new()),
        }
    }

    /// The text, truncated with an ellipsis to a maximum width \[px\].
    pub fn fit(self, text: &str, width: f32) -> String {
        let short = text.chars().count() <= MAX_TEXT_CHARS;
        if short && self.width(text) <= width {
            return text.to_owned();
        }
        let room = width - self.width("…");
        let kept = self.glyphs(text).take_while(|(_, start, advance)| start + advance <= room).count();
        if kept == 0 {
            return String::new();
        }
        let kept: String = text.chars().take(kept).collect();
        format!("{}…", kept.trim_end())
    }
}

impl Canvas {
    /// Writes a text on its base line; returns its width \[px\].
    pub fn text(&mut self, spot: Spot, anchor: Anchor, font: Type, text: &str) -> f32 {
        self.write(spot, anchor, font, text, false)
    }

    /// Writes a text that runs upwards; the spot is on its base line, at its right.
    pub fn text_upwards(&mut self, spot: Spot, anchor: Anchor, font: Type, text: &str) -> f32 {
        self.write(spot, anchor, font, text, true)
    }

    /// Writes a text with a pale rim, so that it is legible on any background.
    pub fn text_with_rim(&mut self, spot: Spot, anchor: Anchor, font: Type, rim: Colour, text: &str) -> f32 {
        let rim = Type { colour: rim, ..font };
        let reach = (font.em_px / 10.0).max(1.0);
        for (right, down) in
            [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0), (0.7, 0.7), (-0.7, 0.7), (0.7, -0.7), (-0.7, -0.7)]
        {
            self.write((spot.0 + right * reach, spot.1 + down * reach), anchor, rim, text, false);
        }
        self.write(spot, anchor, font, text, false)
    }

    /// Writes a text with a rim about a spot, within the canvas; upwards (`above`) or downwards of it where another label is in
    /// the way. `taken` holds the boxes of those (left, top, right, bottom), and gets this one's.
    #[allow(clippy::too_many_arguments, reason = "place and style of one text")]
    pub fn label(
        &mut self,
        spot: Spot,
        above: bool,
        font: Type,
        rim: Colour,
        text: &str,
        unit: f32,
        taken: &mut Vec<[f32; 4]>,
    ) {
        let edge = 7.0 * unit;
        let text = font.fit(text, self.width() - 2.0 * edge);
        if text.is_empty() {
            return;
        }
        let half = font.width(&text) / 2.0;
        let x = spot.0.max(half + edge).min(self.width() - half - edge);
        let line = font.em_px * 1.15;
        let mut y = spot.1;
        for _ in 0..12 {
            let own = [x - half, y - line * 0.75, x + half, y + line * 0.25];
            let clear =
                |other: &[f32; 4]| own[0] > other[2] || own[2] < other[0] || own[1] > other[3] || own[3] < other[1];
            if taken.iter().all(clear) {
                break;
            }
            y += if above { -line } else { line };
        }
        y = y.max(line).min(self.height() - 4.0 * unit);
        taken.push([x - half, y - line * 0.75, x + half, y + line * 0.25]);
        self.text_with_rim((x, y), Anchor::Middle, font, rim, &text);
    }

    fn write(&mut self, spot: Spot, anchor: Anchor, font: Type, text: &str, upwards: bool) -> f32 {
        let width = font.width(text);
        let Some(face) = font.font() else { return 0.0 };
        if !(spot.0.is_finite() && spot.1.is_finite()) {
            return width;
        }
        let back = match anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => width / 2.0,
            Anchor::End => width,
        };
        let scale = font.scale(face);
        let colour = font.colour.channels();
        let alpha = f32::from(font.colour.alpha) / 255.0;
        for (glyph, start, _) in font.glyphs(text) {
            // A whole-pixel base line keeps horizontal stems crisp.
            let (along, across) =
                if upwards { (start - back - spot.1, spot.0.round()) } else { (spot.0 - back + start, spot.1.round()) };
            let glyph = glyph.with_scale_and_position(scale, point(along, across));
            let Some(outline) = face.outline_glyph(glyph) else { continue };
            let corner = outline.px_bounds().min;
            outline.draw(|right, down, cover| {
                let (along, across) = (corner.x as i32 + right as i32, corner.y as i32 + down as i32);
                let (x, y) = if upwards { (across, -along - 1) } else { (along, across) };
                self.blend(x, y, colour, cover * alpha);
            });
        }
        width
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::colour::{INK, PAPER};

    #[test]
    fn both_embedded_fonts_hold_every_sign_that_pictures_use() {
        for strong in [false, true] {
            let font = Type { em_px: 16.0, strong, colour: INK }.font().unwrap();
            for letter in (' '..='~').chain("°±²³µ·×–—…’←↑→↓−≤≥Δ".chars()) {
                assert_ne!(font.glyph_id(letter).0, 0, "{letter} is missing");
            }
        }
    }

    #[test]
    fn a_text_leaves_ink_and_an_upward_one_is_as_long() {
        let ink = |upwards: bool| {
            let mut canvas = Canvas::new(120, 120, PAPER).unwrap();
            canvas.write((60.0, 60.0), Anchor::Middle, Type::plain(16.0, INK), "deflection (°)", upwards);
            canvas.pixmap.pixels().iter().filter(|pixel| pixel.red() < 128).count()
        };
        assert!(ink(false) > 100);
        // Sub-pixel positions differ between the two directions, so the counts only nearly agree.
        assert!(ink(false).abs_diff(ink(true)) * 5 < ink(false));
    }

    #[test]
    fn a_long_text_is_cut_with_an_ellipsis_to_its_room() {
        let font = Type::plain(16.0, INK);
        let cut = font.fit("a caption that is far too long for its panel", 100.0);
        assert!(cut.ends_with('…') && font.width(&cut) <= 100.0);
        assert_eq!(font.fit("short", 100.0), "short");
        assert_eq!(font.fit("no room", 2.0), "");
        assert!(font.fit(&"x".repeat(1_000_000), 1e9).len() < 1_000);
    }
}
