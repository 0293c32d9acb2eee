//! Bodies for pictures: tapered capsules.

use glam::DVec3;

use crate::Colour;
use crate::limits::{MAX_CAPSULES, MAX_COORDINATE_M, MAX_RADIUS_M};

/// What a capsule belongs to: it sets the tint, so that a viewer can tell left from right.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Shade {
    /// Trunk, neck and head: warm grey.
    #[default]
    Midline,
    /// The body's own left arm and leg: blue.
    Left,
    /// The body's own right arm and leg: orange.
    Right,
    /// An object that is not a body: green.
    Object,
    /// A colour of the caller's choice; its opacity is ignored.
    Custom(Colour),
}

impl Shade {
    /// The tint under full light.
    pub fn colour(self) -> Colour {
        match self {
            Shade::Midline => Colour::hex(0xE4DBCF),
            Shade::Left => Colour::hex(0x4C93D6),
            Shade::Right => Colour::hex(0xF0953A),
            Shade::Object => Colour::hex(0x7DB48C),
            Shade::Custom(colour) => colour.with_alpha(255),
        }
    }
}

/// The convex hull of two balls: a limb segment. With equal ends it is a ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule {
    /// Centre of the first ball \[m\], world, Y up.
    pub from: DVec3,
    /// Centre of the second ball \[m\], world, Y up.
    pub to: DVec3,
    /// Radius of the first ball \[m\], above 0.
    pub radius_from_m: f64,
    /// Radius of the second ball \[m\], above 0.
    pub radius_to_m: f64,
    /// What it belongs to.
    pub shade: Shade,
}

impl Capsule {
    /// A capsule of one radius \[m\] between two points \[m\], world.
    pub fn new(from: DVec3, to: DVec3, radius_m: f64, shade: Shade) -> Capsule {
        Capsule::tapered(from, to, radius_m, radius_m, shade)
    }

    /// A capsule with a radius \[m\] at each end.
    pub fn tapered(from: DVec3, to: DVec3, radius_from_m: f64, radius_to_m: f64, shade: Shade) -> Capsule {
        Capsule { from, to, radius_from_m, radius_to_m, shade }
    }

    /// A ball about a point \[m\], world.
    pub fn ball(centre: DVec3, radius_m: f64, shade: Shade) -> Capsule {
        Capsule::new(centre, centre, radius_m, shade)
    }

    /// The capsule with its radii clamped, or `None` if it cannot be drawn.
    fn drawable(&self) -> Option<Capsule> {
        let radius = |radius_m: f64| (radius_m.is_finite() && radius_m > 0.0).then(|| radius_m.min(MAX_RADIUS_M));
        (is_drawable(self.from) && is_drawable(self.to)).then_some(())?;
        Some(Capsule { radius_from_m: radius(self.radius_from_m)?, radius_to_m: radius(self.radius_to_m)?, ..*self })
    }
}

/// A body, or anything else made of capsules.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figure {
    /// The capsules, in any order: nearer ones hide farther ones. Those with a coordinate or radius that is not finite
    /// or a radius of 0 or less are skipped.
    pub capsules: Vec<Capsule>,
}

impl Figure {
    /// A figure of capsules.
    pub fn new(capsules: Vec<Capsule>) -> Figure {
        Figure { capsules }
    }

    /// The capsules that can be drawn.
    pub(crate) fn drawable(&self) -> impl Iterator<Item = Capsule> + '_ {
        self.capsules.iter().take(MAX_CAPSULES).filter_map(Capsule::drawable)
    }

    /// The middle of the box around the figure \[m\], world; `None` if there is nothing to draw.
    pub fn middle(&self) -> Option<DVec3> {
        let ends = self.drawable().flat_map(|capsule| [capsule.from, capsule.to]);
        let (low, high) = ends.fold(None, |span: Option<(DVec3, DVec3)>, end| {
            let (low, high) = span.unwrap_or((end, end));
            Some((low.min(end), high.max(end)))
        })?;
        Some((low + high) / 2.0)
    }
}

/// Whether a point is finite and near enough to be drawn.
pub(crate) fn is_drawable(point: DVec3) -> bool {
    point.is_finite() && point.abs().max_element() <= MAX_COORDINATE_M
}
