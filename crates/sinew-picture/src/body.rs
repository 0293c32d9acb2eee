//! Solid bodies: every sample of a panel finds the capsule nearest to the viewer.
//!
//! Painter's sorting of whole capsules fails where limbs cross (a forearm lies partly before, partly behind the trunk),
//! so depth is kept per sample. A ray along the view axis meets a tapered capsule where it meets its cone or one of its
//! two balls; all three are quadratics in depth. Edges come from jumps in depth, and lie on the farther side, so the
//! nearer limb keeps its full width and reads as being in front.

use glam::Vec3;

use crate::canvas::Canvas;
use crate::{Colour, Shade};

/// Samples per pixel along each axis; the edges are as smooth as this squared.
const SAMPLES: usize = 3;

/// A capsule in panel axes: x right, y *up* from the panel's top edge (so negative), z toward the viewer \[px\].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Solid {
    pub from: Vec3,
    pub to: Vec3,
    pub radius_from: f32,
    pub radius_to: f32,
    pub shade: Shade,
}

/// How a body is painted.
#[derive(Clone, Copy)]
pub(crate) struct Look {
    /// One colour for all of it, instead of the tints.
    pub single: Option<Colour>,
    /// Opacity of the surfaces, 0 to 1.
    pub opacity: f32,
    /// Colour of the edges.
    pub edge: Colour,
    /// Opacity of the edges, 0 to 1.
    pub edge_opacity: f32,
    /// Width of the edges \[px\].
    pub edge_px: f32,
    /// A jump in depth that makes an edge \[px\].
    pub edge_jump_px: f32,
    /// What far limbs fade to.
    pub haze: Colour,
    /// Below this the body is under the floor and shows faintly: a point's `y + slope · z` against `level` \[px\].
    pub floor: Option<Floor>,
}

/// The floor's plane in panel axes.
#[derive(Clone, Copy)]
pub(crate) struct Floor {
    /// World height per px of panel height, and per px of depth.
    pub rise: (f32, f32),
    /// Height of the floor on that scale, less what counts as touching.
    pub level: f32,
}

/// Nothing was hit here.
const EMPTY: f32 = f32::NEG_INFINITY;

/// Buffers for bodies, kept from panel to panel.
#[derive(Default)]
pub(crate) struct Painter {
    depth: Vec<f32>,
    /// Index of the capsule and light, where `depth` is set.
    surface: Vec<(u16, f32)>,
    width: usize,
    height: usize,
}

impl Painter {
    /// Paints a body on the canvas.
    pub fn paint(&mut self, canvas: &mut Canvas, solids: &[Solid], look: &Look) {
        let (width, height) = (canvas.pixmap.width() as usize, canvas.pixmap.height() as usize);
        (self.width, self.height) = (width * SAMPLES, height * SAMPLES);
        self.depth.clear();
        self.depth.resize(self.width * self.height, EMPTY);
        self.surface.resize(self.width * self.height, (0, 0.0));
        let margin = look.edge_px.ceil() as usize + 1;
        let mut span: Option<Span> = None;
        for (index, solid) in solids.iter().enumerate().take(usize::from(u16::MAX)) {
            if let Some(drawn) = self.add(index as u16, solid) {
                span = Some(span.map_or(drawn, |span| span.with(drawn)));
            }
        }
        let Some(span) = span else { return };
        let tints: Vec<[f32; 3]> =
            solids.iter().map(|solid| look.single.unwrap_or(solid.shade.colour()).channels()).collect();
        let columns = (span.left / SAMPLES).saturating_sub(margin)..(span.right / SAMPLES + 1 + margin).min(width);
        let rows = (span.top / SAMPLES).saturating_sub(margin)..(span.bottom / SAMPLES + 1 + margin).min(height);
        let depths = solids.iter().flat_map(|solid| [solid.from.z, solid.to.z]);
        let (far, near) = depths.fold((f32::MAX, f32::MIN), |(far, near), depth| (far.min(depth), near.max(depth)));
        let scene = Scene { look, tints, far, near };
        for row in rows {
            for column in columns.clone() {
                self.resolve(canvas, column, row, &scene);
            }
        }
    }

    /// Enters a capsule into the depth buffer; the part of the buffer it may have touched.
    fn add(&mut self, index: u16, solid: &Solid) -> Option<Span> {
        let scale = SAMPLES as f32;
        let cone = Cone::new(solid.from * scale, solid.to * scale, solid.radius_from * scale, solid.radius_to * scale)?;
        let span = cone.span(self.width, self.height)?;
        for row in span.top..=span.bottom {
            let y = -(row as f32 + 0.5);
            for column in span.left..=span.right {
                let Some((depth, normal)) = cone.hit(column as f32 + 0.5, y) else { continue };
                let at = row * self.width + column;
                if depth > self.depth[at] {
                    self.depth[at] = depth;
                    self.surface[at] = (index, light(normal));
                }
            }
        }
        Some(span)
    }

    /// Averages the samples of one pixel onto the canvas.
    fn resolve(&self, canvas: &mut Canvas, column: usize, row: usize, scene: &Scene) {
        let look = scene.look;
        let (mut colour, mut cover) = ([0.0f32; 3], 0.0f32);
        for down in 0..SAMPLES {
            for right in 0..SAMPLES {
                let (x, y) = (column * SAMPLES + right, row * SAMPLES + down);
                let at = y * self.width + x;
                let own = self.depth[at];
                let (mut tint, mut opacity) = ([0.0; 3], 0.0);
                if own > EMPTY {
                    let (index, light) = self.surface[at];
                    tint = scene.colour(index, light, own / SAMPLES as f32);
                    opacity = look.opacity * look.floor.map_or(1.0, |floor| floor.shows(y, own));
                }
                if self.is_edge(x, y, own, look) {
                    let edge = look.edge.channels();
                    let share = look.edge_opacity + opacity * (1.0 - look.edge_opacity);
                    for channel in 0..3 {
                        let under = tint[channel] * opacity * (1.0 - look.edge_opacity);
                        tint[channel] = (edge[channel] * look.edge_opacity + under) / share.max(1e-6);
                    }
                    opacity = share;
                }
                for channel in 0..3 {
                    colour[channel] += tint[channel] * opacity;
                }
                cover += opacity;
            }
        }
        if cover > 0.0 {
            let average = colour.map(|channel| channel / cover);
            canvas.blend(column as i32, row as i32, average, cover / (SAMPLES * SAMPLES) as f32);
        }
    }

    /// Whether something clearly nearer lies within the width of an edge.
    fn is_edge(&self, x: usize, y: usize, own: f32, look: &Look) -> bool {
        let reach = ((look.edge_px * SAMPLES as f32) as usize).max(1);
        let slant = (reach * 7 / 10).max(1);
        let jump = look.edge_jump_px * SAMPLES as f32;
        let nearer = |right: isize, down: isize| {
            let (x, y) = (x as isize + right, y as isize + down);
            if x < 0 || y < 0 || x >= self.width as isize || y >= self.height as isize {
                return false;
            }
            self.depth[y as usize * self.width + x as usize] > own + jump
        };
        let (reach, slant) = (reach as isize, slant as isize);
        nearer(reach, 0)
            || nearer(-reach, 0)
            || nearer(0, reach)
            || nearer(0, -reach)
            || nearer(slant, slant)
            || nearer(-slant, slant)
            || nearer(slant, -slant)
            || nearer(-slant, -slant)
    }
}

/// What all pixels of one body share.
struct Scene<'a> {
    look: &'a Look,
    tints: Vec<[f32; 3]>,
    far: f32,
    near: f32,
}

impl Scene<'_> {
    fn colour(&self, index: u16, light: f32, depth: f32) -> [f32; 3] {
        const HAZE: f32 = 0.30;
        let tint = self.tints[usize::from(index)];
        let haze = self.look.haze.channels();
        let away = ((self.near - depth) / (self.near - self.far).max(1.0)).clamp(0.0, 1.0) * HAZE;
        // Shadows lean to blue, as under a sky: plain darkening looks dirty.
        let cool = [0.96, 0.99, 1.06];
        std::array::from_fn(|channel| {
            let shadow = (1.0 - light).clamp(0.0, 1.0);
            let lit = tint[channel] * light * (1.0 + (cool[channel] - 1.0) * shadow * 2.0);
            lit + (haze[channel] - lit) * away
        })
    }
}

impl Floor {
    /// Opacity of a sample by its height: what is under the floor shows faintly.
    fn shows(self, row: usize, depth: f32) -> f32 {
        let height = self.rise.0 * -(row as f32 + 0.5) / SAMPLES as f32 + self.rise.1 * depth / SAMPLES as f32;
        if height < self.level { 0.35 } else { 1.0 }
    }
}

/// Light on a surface by its normal in panel axes.
fn light(normal: Vec3) -> f32 {
    // From above, the left and the viewer; wrapped a little around the edge of the light, which flatters limbs.
    const KEY: Vec3 = Vec3::new(-0.42, 0.70, 0.577);
    let key = ((normal.dot(KEY) + 0.30) / 1.30).max(0.0);
    (0.56 + 0.52 * key + 0.05 * normal.y).clamp(0.0, 1.08)
}

/// A rectangle of samples, both ends in.
#[derive(Clone, Copy)]
struct Span {
    left: usize,
    right: usize,
    top: usize,
    bottom: usize,
}

impl Span {
    fn with(self, other: Span) -> Span {
        Span {
            left: self.left.min(other.left),
            right: self.right.max(other.right),
            top: self.top.min(other.top),
            bottom: self.bottom.max(other.bottom),
        }
    }
}

/// A tapered capsule prepared for rays along z.
struct Cone {
    from: Vec3,
    to: Vec3,
    radius_from: f32,
    radius_to: f32,
    /// Unit axis, length, and growth of the radius per length; `None` when one ball holds the other.
    side: Option<(Vec3, f32, f32)>,
}

impl Cone {
    fn new(from: Vec3, to: Vec3, radius_from: f32, radius_to: f32) -> Option<Cone> {
        let finite = from.is_finite() && to.is_finite() && radius_from.is_finite() && radius_to.is_finite();
        if !finite || radius_from <= 0.0 || radius_to <= 0.0 {
            return None;
        }
        let axis = to - from;
        let length = axis.length();
        let growth = radius_to - radius_from;
        let side = (length > growth.abs() + 1e-3).then(|| (axis / length, length, growth / length));
        Some(Cone { from, to, radius_from, radius_to, side })
    }

    /// The samples it may cover; `None` when it lies outside.
    fn span(&self, width: usize, height: usize) -> Option<Span> {
        let reach = Vec3::splat(1.0);
        let low = (self.from - reach * self.radius_from).min(self.to - reach * self.radius_to);
        let high = (self.from + reach * self.radius_from).max(self.to + reach * self.radius_to);
        let clip = |low: f32, high: f32, size: usize| {
            (high >= 0.0 && low < size as f32 && size > 0)
                .then(|| (low.max(0.0) as usize, (high.max(0.0) as usize).min(size - 1)))
        };
        let (left, right) = clip(low.x, high.x, width)?;
        let (top, bottom) = clip(-high.y, -low.y, height)?;
        Some(Span { left, right, top, bottom })
    }

    /// Depth and unit normal of the surface nearest to the viewer on the ray through (x, y).
    fn hit(&self, x: f32, y: f32) -> Option<(f32, Vec3)> {
        let mut best = nearer(ball(self.from, self.radius_from, x, y), ball(self.to, self.radius_to, x, y));
        if let Some((axis, length, growth)) = self.side {
            // Distance to a tapered capsule is ρ·c − k·h − r₀, with h along the axis from the first ball, ρ across it,
            // k the growth of the radius and c² = 1 − k². It is 0 where c²ρ² = (r₀ + k·h)². With h = h₀ + s·a and
            // ρ² = u² + s² − h² along the ray, that is A·s² + 2B·s + C = 0 in the depth s.
            let (right, up) = (x - self.from.x, y - self.from.y);
            let along = right * axis.x + up * axis.y;
            let cosine2 = 1.0 - growth * growth;
            let a = cosine2 - axis.z * axis.z;
            let b = -axis.z * (along + growth * self.radius_from);
            let c = cosine2 * (right * right + up * up)
                - along * along
                - 2.0 * growth * self.radius_from * along
                - self.radius_from * self.radius_from;
            let root = b * b - a * c;
            if root >= 0.0 && a.abs() > 1e-6 {
                let root = root.sqrt();
                for depth in [(-b + root) / a, (-b - root) / a] {
                    best = nearer(best, self.on_side(axis, length, growth, cosine2, right, up, depth));
                }
            }
        }
        best
    }

    /// The surface point at this depth, if it belongs to the cone between the balls.
    #[allow(clippy::too_many_arguments, reason = "the terms of one formula")]
    fn on_side(
        &self,
        axis: Vec3,
        length: f32,
        growth: f32,
        cosine2: f32,
        right: f32,
        up: f32,
        depth: f32,
    ) -> Option<(f32, Vec3)> {
        let point = Vec3::new(right, up, depth);
        let along = point.dot(axis);
        let across = (point.length_squared() - along * along).max(0.0).sqrt();
        // Centre of the ball that touches the surface here.
        let centre = along + across * growth / cosine2.sqrt();
        let radius = self.radius_from + growth * centre;
        (centre >= 0.0 && centre <= length && radius > 0.0)
            .then(|| (self.from.z + depth, (point - axis * centre) / radius))
    }
}

fn ball(centre: Vec3, radius: f32, x: f32, y: f32) -> Option<(f32, Vec3)> {
    let (right, up) = (x - centre.x, y - centre.y);
    let rest = radius * radius - right * right - up * up;
    (rest >= 0.0).then(|| {
        let depth = rest.sqrt();
        (centre.z + depth, Vec3::new(right, up, depth) / radius)
    })
}

fn nearer(a: Option<(f32, Vec3)>, b: Option<(f32, Vec3)>) -> Option<(f32, Vec3)> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if b.0 > a.0 { b } else { a }),
        (a, b) => a.or(b),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The depth at which marching towards the body first meets one of very many balls strung along the axis.
    fn hit_of_strung_balls(cone: &Cone, x: f32, y: f32) -> Option<f32> {
        (0..=4_000)
            .filter_map(|step| {
                let share = step as f32 / 4_000.0;
                let centre = cone.from.lerp(cone.to, share);
                ball(centre, cone.radius_from + (cone.radius_to - cone.radius_from) * share, x, y)
            })
            .map(|(depth, _)| depth)
            .fold(None, |best: Option<f32>, depth| Some(best.map_or(depth, |best| best.max(depth))))
    }

    #[test]
    fn a_tapered_capsule_is_the_hull_of_balls_strung_along_it() {
        let shapes = [
            (Vec3::new(10.0, -40.0, 5.0), Vec3::new(60.0, -20.0, -30.0), 12.0, 5.0),
            (Vec3::new(30.0, -30.0, 0.0), Vec3::new(31.0, -30.0, 60.0), 9.0, 14.0),
            (Vec3::new(30.0, -30.0, 60.0), Vec3::new(35.0, -33.0, 0.0), 6.0, 15.0),
            (Vec3::new(20.0, -20.0, 0.0), Vec3::new(22.0, -20.0, 0.0), 15.0, 4.0),
            (Vec3::new(20.0, -50.0, 0.0), Vec3::new(60.0, -50.0, 0.0), 8.0, 8.0),
        ];
        for (from, to, radius_from, radius_to) in shapes {
            let cone = Cone::new(from, to, radius_from, radius_to).unwrap();
            for row in 0..70 {
                for column in 0..80 {
                    let (x, y) = (column as f32 + 0.37, -(row as f32) - 0.61);
                    let expected = hit_of_strung_balls(&cone, x, y);
                    let found = cone.hit(x, y);
                    match (expected, found) {
                        // The string of balls is bumpy by far less than this; the rim is steep.
                        (Some(expected), Some((found, normal))) => {
                            assert!((expected - found).abs() < 0.3, "{expected} {found} at {x} {y}");
                            assert!((normal.length() - 1.0).abs() < 0.02);
                        }
                        (None, None) => {}
                        // Only the very rim may differ, where the string of balls is a hair too thin.
                        (None, Some((_, normal))) => assert!(normal.z.abs() < 0.1, "{normal} at {x} {y}"),
                        (Some(_), None) => panic!("hole at {x} {y}"),
                    }
                }
            }
        }
    }
}
