//! The floor: tiles that show the travel of feet, shadows that show their height, and a ruler along its near edge.
//!
//! Tiles and ruler are fixed to the world, half a metre apart: a sliding foot moves relative to them from panel to
//! panel.

use glam::{DVec3, Vec2};

use crate::body::stepped;
use crate::canvas::Canvas;
use crate::colour::{HAIRLINE, INK_SOFT};
use crate::lens::Lens;
use crate::shadow::{Shadow, smooth, total};
use crate::text::{Anchor, Type};
use crate::{Colour, Figure};

/// Side of a tile and distance of the ruler's ticks \[m\].
pub(crate) const TILE_M: f64 = 0.5;
/// Extent of the floor from the followed point toward the viewer \[m\].
pub(crate) const NEAR_M: f64 = 0.45;
/// Extent away from the viewer \[m\]; it fades with distance.
const FAR_M: f64 = 1.5;
/// A camera lower than this (sine of its elevation) sees the floor as a line.
const FLAT: f64 = 0.02;

const LIGHT_TILE: Colour = Colour::hex(0xEAEEF3);
const DARK_TILE: Colour = Colour::hex(0xCBD4DE);
const SHADOW: Colour = Colour::hex(0x27303D);

/// Height of the floor's near edge under the followed point \[m\] in the picture.
pub(crate) fn near_drop_m(lens_up_rise: f64) -> f64 {
    if lens_up_rise > FLAT { NEAR_M * lens_up_rise } else { 0.0 }
}

/// Sine of the camera's elevation.
fn rise(lens: &Lens) -> f64 {
    lens.view.toward.y
}

/// Paints tiles and shadows down to `bottom` \[px\], in `steps` of light or smoothly.
pub(crate) fn paint(canvas: &mut Canvas, lens: &Lens, figures: [&Figure; 2], bottom: f32, steps: Option<f32>) {
    let rise = rise(lens);
    if rise <= FLAT {
        canvas.rect(0.0, lens.at.1, canvas.width(), 1.5, INK_SOFT);
        return;
    }
    let of = |figure: &Figure| {
        let boxes = figure.drawable_boxes().filter_map(|cuboid| Shadow::of_box(&cuboid, lens.origin));
        figure
            .drawable()
            .filter_map(|capsule| Shadow::of_capsule(&capsule, lens.origin))
            .chain(boxes)
            .collect::<Vec<_>>()
    };
    let shadows: Vec<Shadow> = figures.into_iter().flat_map(of).collect();
    let away = DVec3::Y.cross(lens.view.right);
    let right = lens.view.right;
    let top = (f64::from(lens.at.1) - FAR_M * rise * lens.scale).floor().max(0.0) as u32;
    let bottom = (bottom.ceil().max(0.0) as u32).min(canvas.pixmap.height());
    // World travel of one pixel: the tiles' edges are blurred by just that.
    let (across, along) = (1.0 / lens.scale, 1.0 / (lens.scale * rise));
    let blur_x = (right.x.abs() * across + away.x.abs() * along) / TILE_M;
    let blur_z = (right.z.abs() * across + away.z.abs() * along) / TILE_M;
    let (light, dark, shade) = (LIGHT_TILE.channels(), DARK_TILE.channels(), SHADOW.channels());
    for row in top..bottom {
        let depth = (f64::from(lens.at.1) - f64::from(row) - 0.5) / lens.scale / rise;
        let shown = stepped(smooth(((FAR_M - depth) / FAR_M) as f32), steps.map(|steps| steps / 2.0));
        let near: Vec<&Shadow> = shadows.iter().filter(|shadow| shadow.reaches(depth as f32, away)).collect();
        for column in 0..canvas.pixmap.width() {
            let side = (f64::from(column) + 0.5 - f64::from(lens.at.0)) / lens.scale;
            let offset = right * side + away * depth;
            let spot = lens.origin + offset;
            let parity = wave(spot.x / TILE_M, blur_x) * wave(spot.z / TILE_M, blur_z);
            let darkness = parity as f32 * 0.5 + 0.5;
            let tile = std::array::from_fn(|channel| light[channel] + (dark[channel] - light[channel]) * darkness);
            canvas.blend(column as i32, row as i32, tile, shown);
            let under = Vec2::new(offset.x as f32, offset.z as f32);
            let shadow = stepped(total(&near, under), steps);
            if shadow > 0.004 {
                canvas.blend(column as i32, row as i32, shade, shadow * shown.max(0.25));
            }
        }
    }
}

/// A square wave of period 2 (+1 on even, −1 on odd unit steps), averaged over a width.
fn wave(at: f64, width: f64) -> f64 {
    // The triangle wave is its integral.
    let integral = |at: f64| {
        let phase = at - 2.0 * (at / 2.0).floor();
        if phase < 1.0 { phase } else { 2.0 - phase }
    };
    let width = width.max(1e-9);
    (integral(at + width / 2.0) - integral(at - width / 2.0)) / width
}

/// Ticks each half metre, and each metre its axis and number, along the floor's near edge, at `top` \[px\].
pub(crate) fn ruler(canvas: &mut Canvas, lens: &Lens, top: f32, unit: f32) {
    let right = lens.view.right;
    // The world axis that runs more across the picture.
    let along_x = right.x.abs() >= right.z.abs();
    let pick = |vector: DVec3| if along_x { vector.x } else { vector.z };
    let away = DVec3::Y.cross(lens.view.right);
    let near = if rise(lens) > FLAT { NEAR_M } else { 0.0 };
    let middle = pick(lens.origin) - near * pick(away);
    let slope = pick(right);
    let width = f64::from(canvas.width());
    canvas.rect(0.0, top, canvas.width(), 1.0, HAIRLINE);
    let reach = width / lens.scale * slope.abs();
    let first = ((middle - reach) / TILE_M).ceil();
    let count = ((2.0 * reach / TILE_M) as usize).min(200);
    for step in 0..=count {
        let tick = first + step as f64;
        let x = f64::from(lens.at.0) + (tick * TILE_M - middle) / slope * lens.scale;
        if !(0.0..width).contains(&x) {
            continue;
        }
        let whole = tick % 2.0 == 0.0;
        let x = (x as f32).round();
        canvas.rect(x, top, unit.max(1.0), if whole { 6.0 } else { 4.0 } * unit, INK_SOFT);
        let font = Type::plain(11.5 * unit, INK_SOFT);
        let metres = tick * TILE_M;
        let label = if metres.abs() < 1e5 {
            format!("{} {metres:.0} m", if along_x { "x" } else { "z" }).replace('-', "−")
        } else {
            String::new()
        };
        let half = font.width(&label) / 2.0;
        if whole && x > half + 2.0 && x + half + 2.0 < canvas.width() {
            canvas.text((x, top + 18.0 * unit), Anchor::Middle, font, &label);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_alternate_each_half_metre_and_average_to_grey_when_far() {
        assert!((wave(0.5, 0.01) - 1.0).abs() < 1e-9);
        assert!((wave(1.5, 0.01) + 1.0).abs() < 1e-9);
        assert!((wave(-0.5, 0.01) + 1.0).abs() < 1e-9);
        assert!(wave(0.3, 2.0).abs() < 1e-9);
    }
}
