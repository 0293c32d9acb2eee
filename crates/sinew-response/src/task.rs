//! Tasks of a body besides following its motion: the paper's further objectives (keep a cup upright, avoid obstacles).

use crate::objective::Row;
use crate::upper_body::DOFS;
use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Pose, UPPER_NODES};

/// One further objective of a step. It is a soft objective: met as far as joints, limits and motion allow.
///
/// An arm's task turns the arm's joints alone, and leaves the trunk to the motion. Tasks of hips and legs do nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Task {
    /// Points an axis of a part in a direction of the world; the rotation about it is free.
    Aim {
        /// The part.
        node: Node,
        /// The axis, in the part's anatomical frame.
        axis: DVec3,
        /// The wanted direction, in the world.
        direction: DVec3,
        /// Time in which the error falls to 1/e \[s\].
        within_secs: f64,
        /// Weight, relative to tracking (200) and damping (600 at 60 Hz) \[1/rad\].
        weight: f64,
    },
    /// Keeps a point of a part on the side of a plane to which its normal points.
    Clear {
        /// The part.
        node: Node,
        /// The point, in the part's anatomical frame from its joint \[m\].
        point: DVec3,
        /// A point of the plane, in the world as on ground at rest \[m\].
        through: DVec3,
        /// The plane's normal.
        normal: DVec3,
        /// Depth beyond the plane at which the weight is full \[m\]: it begins at 0, so that the motion does not jerk.
        full_depth_m: f64,
        /// Time in which the depth falls to 1/e \[s\].
        within_secs: f64,
        /// As of [`Task::Aim`], times an arm's length \[1/m\].
        weight: f64,
    },
}

impl Task {
    /// Appends the rows of this task. `kept` is the next pose with an unchanged deviation from the input; `joints` are
    /// its positions.
    pub(crate) fn add_rows(
        &self,
        kept: &Pose,
        joints: &[DVec3; Node::COUNT],
        time_step_secs: f64,
        rows: &mut Vec<Row<f64>>,
    ) {
        match *self {
            Task::Aim { node, axis, direction, within_secs, weight } => {
                let (Some(axis), Some(direction)) = (axis.try_normalize(), direction.try_normalize()) else { return };
                let axis = kept.world[node.index()] * axis;
                let turn = shortest_turn(axis, direction);
                let share = share(time_step_secs, within_secs);
                let first = axis.any_orthonormal_vector();
                for across in [first, axis.cross(first)] {
                    let row = Row {
                        direction: row_of(node, kept, joints, |about, _| about.dot(across)),
                        wanted: turn.dot(across) * share,
                        weight,
                    };
                    push(row, rows);
                }
            }
            Task::Clear { node, point, through, normal, full_depth_m, within_secs, weight } => {
                let Some(normal) = normal.try_normalize() else { return };
                let place = joints[node.index()] + kept.world[node.index()] * point;
                let depth = (through - place).dot(normal);
                if depth > 0.0 {
                    let row = Row {
                        direction: row_of(node, kept, joints, |about, joint| about.cross(place - joint).dot(normal)),
                        wanted: depth * share(time_step_secs, within_secs),
                        weight: weight * (depth / full_depth_m.max(1e-6)).min(1.0),
                    };
                    push(row, rows);
                }
            }
        }
    }
}

/// Maximum number of rows of one step: two for each body.
pub(crate) const MAX_ROWS: usize = 2 * UPPER_NODES;

/// Maximum weight of a row: far above every other row, far below a loss of digits.
const HEAVIEST: f64 = 1e5;

/// Appends a row that is finite and reaches a joint, while there is room.
pub(crate) fn push(row: Row<f64>, rows: &mut Vec<Row<f64>>) {
    let finite =
        row.wanted.is_finite() && row.weight.is_finite() && row.direction.iter().all(|value| value.is_finite());
    let reaches = row.direction.iter().any(|&value| value != 0.0);
    if finite && reaches && row.weight > 0.0 && rows.len() < MAX_ROWS {
        rows.push(Row { weight: row.weight.min(HEAVIEST), ..row });
    }
}

/// Part of an error that is removed in a step if the whole falls to 1/e in a time.
pub(crate) fn share(time_step_secs: f64, within_secs: f64) -> f64 {
    -libm::expm1(-time_step_secs / within_secs.max(1e-6))
}

/// Rotation vector that takes one unit vector to another \[rad\].
fn shortest_turn(from: DVec3, to: DVec3) -> DVec3 {
    let (cross, cos) = (from.cross(to), from.dot(to));
    let sin = cross.length();
    if sin < 1e-9 {
        return if cos > 0.0 { DVec3::ZERO } else { from.any_orthonormal_vector() * std::f64::consts::PI };
    }
    cross * (libm::atan2(sin, cos) / sin)
}

/// A row over the coordinates: the effect of each, from its axis and its joint's position in the world.
pub(crate) fn row_of(
    node: Node,
    pose: &Pose,
    joints: &[DVec3; Node::COUNT],
    effect: impl Fn(DVec3, DVec3) -> f64,
) -> [f64; DOFS.len()] {
    let mut chain = [false; Node::COUNT];
    let mut at = Some(node).filter(|node| !node.is_leg());
    while let Some(link) = at {
        chain[link.index()] = true;
        at = link.parent().filter(|&parent| parent != Node::Chest);
    }
    std::array::from_fn(|dof| {
        let (turned, axis) = (DOFS[dof].node.index(), DOFS[dof].axis);
        if chain[turned] { effect(pose.world[turned] * DVec3::AXES[axis as usize], joints[turned]) } else { 0.0 }
    })
}

/// Appends the rows of tasks, see [`Task::add_rows`].
pub(crate) fn rows_of(tasks: &[Task], kept: &Pose, body: &Body, time_step_secs: f64, rows: &mut Vec<Row<f64>>) {
    let joints = kept.positions(body);
    for task in tasks {
        task.add_rows(kept, &joints, time_step_secs, rows);
    }
}
