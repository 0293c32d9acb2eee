//! Bodies with a depth buffer: every sample of a panel finds the shape nearest to the viewer.
//!
//! Painter's sorting of whole shapes fails where limbs cross (a forearm lies partly before, partly behind the trunk),
//! so depth is kept per sample. Edges come from jumps in depth, and lie on the farther side, so the nearer limb keeps its
//! full width and reads as being in front.

use glam::Vec3;

use crate::Colour;
use crate::canvas::Canvas;
use crate::solid::{Solid, Surface};

/// Samples per pixel along each axis; the edges are as smooth as this squared.
const SAMPLES: usize = 3;

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
    /// The colour to which far limbs fade.
    pub haze: Colour,
    /// Light and haze in this many steps instead of smoothly: flat areas, which a film's file holds in few bytes.
    pub steps: Option<f32>,
    /// The floor; parts below it are drawn faintly. `None` draws everything alike.
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

/// Buffers for bodies, kept from panel to panel. Between bodies every depth is [`EMPTY`].
#[derive(Default)]
pub(crate) struct Painter {
    depth: Vec<f32>,
    /// Index of the shape, where `depth` is set.
    surface: Vec<u16>,
    /// Minimum and maximum depth in each pixel.
    range: Vec<(f32, f32)>,
    /// Samples across and down.
    width: usize,
    height: usize,
}

impl Painter {
    /// Paints a body on the canvas.
    pub fn paint(&mut self, canvas: &mut Canvas, solids: &[Solid], look: &Look) {
        let (columns, rows) = (canvas.pixmap.width() as usize, canvas.pixmap.height() as usize);
        (self.width, self.height) = (columns * SAMPLES, rows * SAMPLES);
        self.depth.resize(self.width * self.height, EMPTY);
        self.surface.resize(self.width * self.height, 0);
        self.range.resize(columns * rows, (EMPTY, EMPTY));
        let mut span: Option<Span> = None;
        let scene = Scene::new(solids, look);
        for (index, (surface, _)) in scene.surfaces.iter().enumerate() {
            if let Some(drawn) = self.add(index as u16, surface) {
                span = Some(span.map_or(drawn, |span| span.with(drawn)));
            }
        }
        let Some(span) = span else { return };
        let pixels = span.pixels(look.edge_px.ceil() as usize + 1, columns, rows);
        self.find_ranges(pixels, columns);
        for row in pixels.top..=pixels.bottom {
            for column in pixels.left..=pixels.right {
                self.resolve(canvas, column, row, pixels, &scene);
            }
        }
        for row in span.top..=span.bottom {
            self.depth[row * self.width + span.left..=row * self.width + span.right].fill(EMPTY);
        }
    }

    /// Draws a shape into the depth buffer; returns the part of the buffer that it may have changed.
    fn add(&mut self, index: u16, shape: &Surface) -> Option<Span> {
        // Samples lie at half steps; y runs up, rows run down.
        let clip = |low: f32, high: f32, size: usize| {
            let (first, last) = ((low - 0.5).ceil().max(0.0), (high - 0.5).floor().min(size as f32 - 1.0));
            (first <= last).then_some((first as usize, last as usize))
        };
        let nearest = shape.depths().1;
        let (low, high) = shape.rows();
        let (top, bottom) = clip(-high, -low, self.height)?;
        let mut touched: Option<Span> = None;
        for row in top..=bottom {
            let y = -(row as f32 + 0.5);
            let Some((left, right)) = shape.columns(y).and_then(|(left, right)| clip(left, right, self.width)) else {
                continue;
            };
            let span = Span { left, right, top: row, bottom: row };
            touched = Some(touched.map_or(span, |touched| touched.with(span)));
            for column in left..=right {
                let at = row * self.width + column;
                if self.depth[at] >= nearest {
                    continue;
                }
                let Some((depth, _)) = shape.hit(column as f32 + 0.5, y) else { continue };
                if depth > self.depth[at] {
                    self.depth[at] = depth;
                    self.surface[at] = index;
                }
            }
        }
        touched
    }

    /// Notes the range of depths in each pixel of a part of the picture.
    fn find_ranges(&mut self, pixels: Span, columns: usize) {
        for row in pixels.top..=pixels.bottom {
            for column in pixels.left..=pixels.right {
                let (mut low, mut high) = (f32::INFINITY, EMPTY);
                for down in 0..SAMPLES {
                    let at = (row * SAMPLES + down) * self.width + column * SAMPLES;
                    for &depth in &self.depth[at..at + SAMPLES] {
                        (low, high) = (low.min(depth), high.max(depth));
                    }
                }
                self.range[row * columns + column] = (low, high);
            }
        }
    }

    /// Whether a pixel may hold an edge: whether a clearly nearer sample lies within the width of an edge.
    fn may_hold_edge(&self, column: usize, row: usize, pixels: Span, look: &Look) -> bool {
        let columns = self.width / SAMPLES;
        let reach = look.edge_px.ceil() as usize;
        let limit = self.range[row * columns + column].0 + look.edge_jump_px * SAMPLES as f32;
        (row.saturating_sub(reach).max(pixels.top)..=(row + reach).min(pixels.bottom)).any(|row| {
            let left = column.saturating_sub(reach).max(pixels.left);
            let right = (column + reach).min(pixels.right);
            self.range[row * columns + left..=row * columns + right].iter().any(|range| range.1 > limit)
        })
    }

    /// Averages the samples of one pixel onto the canvas.
    fn resolve(&self, canvas: &mut Canvas, column: usize, row: usize, pixels: Span, scene: &Scene) {
        let look = scene.look;
        let edges = self.may_hold_edge(column, row, pixels, look);
        let (low, high) = self.range[row * (self.width / SAMPLES) + column];
        if !edges && high == EMPTY {
            return;
        }
        if !edges && low > EMPTY && self.is_one_surface(column, row) {
            // Most pixels: the middle sample represents all, since light changes slowly.
            let (tint, opacity) =
                self.sample(column * SAMPLES + SAMPLES / 2, row * SAMPLES + SAMPLES / 2, false, scene, &mut None);
            canvas.blend(column as i32, row as i32, tint, opacity);
            return;
        }
        let (mut colour, mut cover) = ([0.0f32; 3], 0.0f32);
        // Light changes slowly: within a pixel each shape is lit once.
        let mut lit: Option<(u16, [f32; 3])> = None;
        for down in 0..SAMPLES {
            for right in 0..SAMPLES {
                let (x, y) = (column * SAMPLES + right, row * SAMPLES + down);
                let (tint, opacity) = self.sample(x, y, edges, scene, &mut lit);
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

    /// Whether every sample of a pixel lies on the same shape.
    fn is_one_surface(&self, column: usize, row: usize) -> bool {
        let first = self.surface[row * SAMPLES * self.width + column * SAMPLES];
        (0..SAMPLES).all(|down| {
            let at = (row * SAMPLES + down) * self.width + column * SAMPLES;
            self.surface[at..at + SAMPLES].iter().all(|&surface| surface == first)
        })
    }

    /// Colour and opacity of one sample; `lit` is the shape lit last and its colour.
    fn sample(
        &self,
        x: usize,
        y: usize,
        edges: bool,
        scene: &Scene,
        lit: &mut Option<(u16, [f32; 3])>,
    ) -> ([f32; 3], f32) {
        let look = scene.look;
        let at = y * self.width + x;
        let own = self.depth[at];
        let (mut tint, mut opacity) = ([0.0; 3], 0.0);
        if own > EMPTY {
            let index = self.surface[at];
            tint = match *lit {
                Some((known, tint)) if known == index => tint,
                _ => scene.colour(index, x, y, own),
            };
            *lit = Some((index, tint));
            opacity = look.opacity * look.floor.map_or(1.0, |floor| floor.shows(y, own));
        }
        if edges && self.is_edge(x, y, own, look) {
            let share = look.edge_opacity + opacity * (1.0 - look.edge_opacity);
            let under = opacity * (1.0 - look.edge_opacity);
            let edge = look.edge.channels();
            tint = std::array::from_fn(|channel| {
                (edge[channel] * look.edge_opacity + tint[channel] * under) / share.max(1e-6)
            });
            opacity = share;
        }
        (tint, opacity)
    }

    /// Whether something clearly nearer lies within the width of an edge.
    fn is_edge(&self, x: usize, y: usize, own: f32, look: &Look) -> bool {
        let reach = ((look.edge_px * SAMPLES as f32) as isize).max(1);
        let slant = (reach * 7 / 10).max(1);
        let jump = look.edge_jump_px * SAMPLES as f32;
        let around = [
            (reach, 0),
            (-reach, 0),
            (0, reach),
            (0, -reach),
            (slant, slant),
            (-slant, slant),
            (slant, -slant),
            (-slant, -slant),
        ];
        around.iter().any(|&(right, down)| {
            let (x, y) = (x as isize + right, y as isize + down);
            let inside = x >= 0 && y >= 0 && x < self.width as isize && y < self.height as isize;
            inside && self.depth[y as usize * self.width + x as usize] > own + jump
        })
    }
}

/// Data shared by all pixels of one body.
struct Scene<'a> {
    look: &'a Look,
    /// The shapes in samples, and their tints.
    surfaces: Vec<(Surface, [f32; 3])>,
    /// Farthest and nearest point \[samples\].
    far: f32,
    near: f32,
}

impl<'a> Scene<'a> {
    fn new(solids: &[Solid], look: &'a Look) -> Scene<'a> {
        let surface = |solid: &Solid| {
            let tint = look.single.unwrap_or(solid.shade.colour()).channels();
            Some((solid.form.surface(SAMPLES as f32)?, tint))
        };
        let mut surfaces: Vec<(Surface, [f32; 3])> =
            solids.iter().take(usize::from(u16::MAX)).filter_map(surface).collect();
        let depths = surfaces.iter().map(|(surface, _)| surface.depths());
        let (far, near) = depths.fold((f32::MAX, f32::MIN), |(far, near), own| (far.min(own.0), near.max(own.1)));
        // The nearest first: most of what lies behind is then rejected by depth.
        surfaces.sort_by(|a, b| b.0.depths().1.total_cmp(&a.0.depths().1));
        Scene { look, surfaces, far, near }
    }

    /// Colour of a shape at a sample.
    fn colour(&self, index: u16, x: usize, y: usize, depth: f32) -> [f32; 3] {
        const HAZE: f32 = 0.30;
        // Shadows lean to blue, as under a sky: plain darkening looks dirty.
        const COOL: [f32; 3] = [-0.08, -0.02, 0.12];
        let (surface, tint) = &self.surfaces[usize::from(index)];
        let normal = surface.hit(x as f32 + 0.5, -(y as f32 + 0.5)).map_or(Vec3::Z, |hit| hit.1);
        let light = stepped(light(normal), self.look.steps);
        let shadow = (1.0 - light).clamp(0.0, 1.0);
        let haze = self.look.haze.channels();
        let away = ((self.near - depth) / (self.near - self.far).max(1.0)).clamp(0.0, 1.0);
        let away = stepped(away, self.look.steps.map(|steps| steps / 4.0)) * HAZE;
        std::array::from_fn(|channel| {
            let lit = tint[channel] * light * (1.0 + COOL[channel] * shadow);
            lit + (haze[channel] - lit) * away
        })
    }
}

impl Floor {
    /// Opacity of a sample by its height: parts under the floor are faint.
    fn shows(self, row: usize, depth: f32) -> f32 {
        let height = self.rise.0 * -(row as f32 + 0.5) / SAMPLES as f32 + self.rise.1 * depth / SAMPLES as f32;
        if height < self.level { 0.35 } else { 1.0 }
    }
}

/// A share, rounded to a number of steps.
pub(crate) fn stepped(share: f32, steps: Option<f32>) -> f32 {
    steps.map_or(share, |steps| (share * steps).round() / steps)
}

/// Light on a surface by its normal in panel axes.
fn light(normal: Vec3) -> f32 {
    // From above, the left and the viewer; wrapped a little around the edge of the light, which flatters limbs.
    const KEY: Vec3 = Vec3::new(-0.42, 0.70, 0.577);
    let key = ((normal.dot(KEY) + 0.30) / 1.30).max(0.0);
    (0.56 + 0.52 * key + 0.05 * normal.y).clamp(0.0, 1.08)
}

/// A rectangle of samples or pixels, both ends in.
#[derive(Clone, Copy)]
struct Span {
    left: usize,
    right: usize,
    top: usize,
    bottom: usize,
}

impl Span {
    /// The pixels of these samples and of a margin around them.
    fn pixels(self, margin: usize, columns: usize, rows: usize) -> Span {
        Span {
            left: (self.left / SAMPLES).saturating_sub(margin),
            right: (self.right / SAMPLES + margin).min(columns - 1),
            top: (self.top / SAMPLES).saturating_sub(margin),
            bottom: (self.bottom / SAMPLES + margin).min(rows - 1),
        }
    }

    fn with(self, other: Span) -> Span {
        Span {
            left: self.left.min(other.left),
            right: self.right.max(other.right),
            top: self.top.min(other.top),
            bottom: self.bottom.max(other.bottom),
        }
    }
}
