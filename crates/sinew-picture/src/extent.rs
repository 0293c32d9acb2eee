//! How far a motion reaches around the points that its panels follow.

use glam::DVec3;

use crate::figure::is_drawable;
use crate::limits::{MAX_ARROWS, MAX_HITS, MAX_VIEW_M};
use crate::{Arrow, Figure, Hit, Panel, View, floor};

/// Objects count as far as they lie within this of the body \[m\]: a prop far away may leave the picture, or the body would be
/// small.
const NEAR_OBJECTS_M: f64 = 0.6;
/// A ghost farther away may leave the picture, likewise \[m\].
const NEAR_GHOST_M: f64 = 0.85;

/// Extent of all figures from the followed point, over all panels \[m\].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    pub left_m: f64,
    pub right_m: f64,
    pub above_m: f64,
    pub below_m: f64,
}

impl Extent {
    pub fn of(panels: &[Panel], view: &View, floor_m: f64, strongest_n: f64) -> Extent {
        let near = floor::near_drop_m(view.toward.y);
        let mut extent = Extent { left_m: 0.36, right_m: 0.36, above_m: 0.5, below_m: near.max(0.02) };
        let seen = |panel: &Panel, point: DVec3| view.view_from_world(point - DVec3 { y: floor_m, ..followed(panel) });
        for panel in panels {
            for (point, radius_m) in panel.figure.points() {
                extent.hold(seen(panel, point), radius_m, MAX_VIEW_M / 2.0);
            }
            for arrow in arrows(panel) {
                extent.hold(seen(panel, arrow.at), 0.02, MAX_VIEW_M / 2.0);
                extent.hold(seen(panel, arrow.tail(strongest_n)), 0.06, MAX_VIEW_M / 2.0);
            }
            for (point, radius_m) in panel.ghost.iter().flat_map(Figure::points) {
                extent.hold(seen(panel, point), radius_m, NEAR_GHOST_M);
            }
        }
        let body = extent;
        for panel in panels {
            for (point, radius_m) in panel.objects.points() {
                extent.hold_near(&body, seen(panel, point), radius_m);
            }
        }
        extent
    }

    fn hold(&mut self, seen: DVec3, radius_m: f64, most_m: f64) {
        self.left_m = self.left_m.max((radius_m - seen.x).min(most_m));
        self.right_m = self.right_m.max((seen.x + radius_m).min(most_m));
        self.above_m = self.above_m.max((seen.y + radius_m).min(MAX_VIEW_M));
        self.below_m = self.below_m.max((radius_m - seen.y).min(MAX_VIEW_M / 4.0));
    }

    fn hold_near(&mut self, body: &Extent, seen: DVec3, radius_m: f64) {
        self.left_m = self.left_m.max((radius_m - seen.x).min(body.left_m + NEAR_OBJECTS_M));
        self.right_m = self.right_m.max((seen.x + radius_m).min(body.right_m + NEAR_OBJECTS_M));
        self.above_m = self.above_m.max((seen.y + radius_m).min(body.above_m + NEAR_OBJECTS_M));
        self.below_m = self.below_m.max((radius_m - seen.y).min(body.below_m + NEAR_OBJECTS_M / 2.0));
    }

    pub fn width_m(&self) -> f64 {
        self.left_m + self.right_m
    }

    pub fn height_m(&self) -> f64 {
        self.above_m + self.below_m
    }
}

/// The point that a panel keeps in its place.
pub(crate) fn followed(panel: &Panel) -> DVec3 {
    let others = || [panel.ghost.as_ref(), Some(&panel.objects)].into_iter().flatten().find_map(Figure::middle);
    let followed = panel.follow.filter(|&point| is_drawable(point));
    followed.or_else(|| panel.figure.middle()).or_else(others).unwrap_or_default()
}

pub(crate) fn arrows(panel: &Panel) -> impl Iterator<Item = &Arrow> {
    panel.arrows.iter().take(MAX_ARROWS).filter(|arrow| arrow.is_drawable())
}

pub(crate) fn hits(panel: &Panel) -> impl Iterator<Item = &Hit> {
    panel.hits.iter().take(MAX_HITS).filter(|hit| is_drawable(hit.at))
}
