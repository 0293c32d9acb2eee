//! Bodies and things for pictures: tapered capsules and boxes.

use glam::{DQuat, DVec3};

use crate::Colour;
use crate::limits::{MAX_COORDINATE_M, MAX_RADIUS_M, MAX_SHAPES};

/// What a shape belongs to: it sets the tint, so that a viewer can tell left from right.
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

/// A box with sharp edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid {
    /// Its middle \[m\], world, Y up.
    pub centre: DVec3,
    /// `world_from_box`.
    pub rotation: DQuat,
    /// Lengths of its edges along its own axes \[m\], each above 0.
    pub size_m: DVec3,
    /// What it belongs to.
    pub shade: Shade,
}

impl Cuboid {
    /// The box with its edges clamped, or `None` if it cannot be drawn.
    fn drawable(&self) -> Option<Cuboid> {
        let rotation = self.rotation.is_finite().then(|| self.rotation.normalize()).filter(|turn| turn.is_finite())?;
        let sized = self.size_m.is_finite() && self.size_m.min_element() > 0.0;
        (is_drawable(self.centre) && sized).then_some(())?;
        Some(Cuboid { rotation, size_m: self.size_m.min(DVec3::splat(2.0 * MAX_RADIUS_M)), ..*self })
    }

    /// Its eight corners \[m\], world.
    pub(crate) fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|corner| {
            let side = |bit: usize| if corner >> bit & 1 == 0 { -0.5 } else { 0.5 };
            self.centre + self.rotation * (self.size_m * DVec3::new(side(0), side(1), side(2)))
        })
    }
}

/// A body, or anything else made of capsules and boxes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figure {
    /// The capsules, in any order: nearer ones hide farther ones. Those with a coordinate or radius that is not finite
    /// or a radius of 0 or less are skipped.
    pub capsules: Vec<Capsule>,
    /// The boxes, likewise.
    pub boxes: Vec<Cuboid>,
}

impl Figure {
    /// A figure of capsules.
    pub fn new(capsules: Vec<Capsule>) -> Figure {
        Figure { capsules, boxes: Vec::new() }
    }

    /// The capsules that can be drawn.
    pub(crate) fn drawable(&self) -> impl Iterator<Item = Capsule> + '_ {
        self.capsules.iter().take(MAX_SHAPES).filter_map(Capsule::drawable)
    }

    /// The boxes that can be drawn.
    pub(crate) fn drawable_boxes(&self) -> impl Iterator<Item = Cuboid> + '_ {
        self.boxes.iter().take(MAX_SHAPES).filter_map(Cuboid::drawable)
    }

    /// How many shapes are left out because there are more than [`MAX_SHAPES`].
    pub(crate) fn left_out(&self) -> usize {
        self.capsules.len().saturating_sub(MAX_SHAPES) + self.boxes.len().saturating_sub(MAX_SHAPES)
    }

    /// Points that span it, each with the distance \[m\] to which it reaches around them.
    pub(crate) fn points(&self) -> impl Iterator<Item = (DVec3, f64)> + '_ {
        let ends = |capsule: Capsule| [(capsule.from, capsule.radius_from_m), (capsule.to, capsule.radius_to_m)];
        let corners = self.drawable_boxes().flat_map(|cuboid| cuboid.corners().map(|corner| (corner, 0.0)));
        self.drawable().flat_map(ends).chain(corners)
    }

    /// The middle of the box around the figure \[m\], world; `None` if there is nothing to draw.
    pub fn middle(&self) -> Option<DVec3> {
        let (low, high) = self.points().fold(None, |span: Option<(DVec3, DVec3)>, (point, _)| {
            let (low, high) = span.unwrap_or((point, point));
            Some((low.min(point), high.max(point)))
        })?;
        Some((low + high) / 2.0)
    }
}

/// Whether a point is finite and near enough to be drawn.
pub(crate) fn is_drawable(point: DVec3) -> bool {
    point.is_finite() && point.abs().max_element() <= MAX_COORDINATE_M
}
