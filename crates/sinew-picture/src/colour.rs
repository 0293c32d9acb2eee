//! Colours, and the palette of the plots.

/// A colour, sRGB, 8 bits a channel, not premultiplied.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Colour {
    /// Red, 0 to 255.
    pub red: u8,
    /// Green, 0 to 255.
    pub green: u8,
    /// Blue, 0 to 255.
    pub blue: u8,
    /// Opacity, 0 (clear) to 255 (solid).
    pub alpha: u8,
}

impl Colour {
    /// A solid colour from 0xRRGGBB.
    ///
    /// ```
    /// use sinew_picture::Colour;
    /// assert_eq!(Colour::hex(0x0072B2).green, 0x72);
    /// ```
    pub const fn hex(rgb: u32) -> Colour {
        Colour { red: (rgb >> 16) as u8, green: (rgb >> 8) as u8, blue: rgb as u8, alpha: 255 }
    }

    /// The same colour, with another opacity, 0 (clear) to 255 (solid).
    #[must_use]
    pub const fn with_alpha(mut self, alpha: u8) -> Colour {
        self.alpha = alpha;
        self
    }

    pub(crate) fn paint(self) -> tiny_skia::Paint<'static> {
        let mut paint = tiny_skia::Paint { anti_alias: true, ..Default::default() };
        paint.set_color_rgba8(self.red, self.green, self.blue, self.alpha);
        paint
    }

    /// Red, green and blue, 0 to 1.
    pub(crate) fn channels(self) -> [f32; 3] {
        [self.red, self.green, self.blue].map(|channel| f32::from(channel) / 255.0)
    }
}

/// Line colours that the common kinds of colour blindness tell apart: Okabe and Ito, *Color Universal Design* (2008),
/// without the yellow, which is too pale for a line on white.
pub const PALETTE: [Colour; 7] = [
    Colour::hex(0x0072B2),
    Colour::hex(0xD55E00),
    Colour::hex(0x009E73),
    Colour::hex(0xCC79A7),
    Colour::hex(0xE69F00),
    Colour::hex(0x56B4E9),
    Colour::hex(0x333333),
];

pub(crate) const PAPER: Colour = Colour::hex(0xFFFFFF);
pub(crate) const INK: Colour = Colour::hex(0x1B2330);
pub(crate) const INK_SOFT: Colour = Colour::hex(0x5B6675);
pub(crate) const HAIRLINE: Colour = Colour::hex(0xDDE2E8);
pub(crate) const ARROW: Colour = Colour::hex(0xC2185B);
