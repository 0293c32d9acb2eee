//! Tasks of the response: keep a cup upright, avoid obstacles.

use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Pose, UPPER_NODES};
use sinew_response::Task;
use sinew_world::{PropId, World};

/// The tasks of a tracker, made anew in each motion frame.
#[derive(Clone, Debug)]
pub(crate) struct Tasks {
    /// A part, and the axis of it that is to point up.
    upright: Option<(Node, DVec3)>,
    obstacles: Vec<PropId>,
    list: Vec<Task>,
}

/// Time in which a cup comes upright again \[s\].
const UPRIGHT_SECS: f64 = 0.03;

/// Clearance from obstacles \[m\].
const CLEARANCE_M: f64 = 0.08;

/// Depth within the clearance at which avoidance has full weight \[m\].
const FULL_DEPTH_M: f64 = 0.04;

/// Time in which a part regains its clearance \[s\].
const CLEAR_SECS: f64 = 0.05;

/// Weight of a cup relative to following the motion \[1/rad\].
const UPRIGHT_WEIGHT: f64 = 2000.0;

/// Weight of clearance relative to following the motion \[1/m\].
const CLEAR_WEIGHT: f64 = 6000.0;

/// Points of a part's capsule that keep clear.
const POINTS: [f64; 3] = [0.0, 0.5, 1.0];

// The list is found anew in every frame.
sinew_snapshot::snapshot!(Tasks { upright, obstacles } fixed { list });

impl Tasks {
    pub(crate) fn none() -> Tasks {
        Tasks { upright: None, obstacles: Vec::new(), list: Vec::with_capacity(UPPER_NODES) }
    }

    /// Keeps the axis of a part that is vertical in this pose vertical.
    pub(crate) fn keep_upright(&mut self, node: Option<Node>, pose: &Pose) {
        self.upright = node.map(|node| (node, pose.world[node.index()].conjugate() * DVec3::Y));
    }

    pub(crate) fn upright(&self) -> Option<(Node, DVec3)> {
        self.upright
    }

    pub(crate) fn avoid(&mut self, props: &[PropId]) {
        self.obstacles.clear();
        self.obstacles.extend_from_slice(props);
    }

    /// The tasks of the step that follows on a pose, which is given as on ground that has not shifted.
    pub(crate) fn of(&mut self, pose: &Pose, body: &Body, ground_shift: DVec3, world: &World) -> &[Task] {
        self.list.clear();
        if let Some((node, axis)) = self.upright {
            self.list.push(Task::Aim {
                node,
                axis,
                direction: DVec3::Y,
                within_secs: UPRIGHT_SECS,
                weight: UPRIGHT_WEIGHT,
            });
        }
        if self.obstacles.is_empty() {
            return &self.list;
        }
        let joints = pose.positions(body);
        for node in Node::ALL.into_iter().skip(1).filter(|node| !node.is_leg()) {
            let (joint, rotation) = (joints[node.index()], pose.world[node.index()]);
            let deepest = self
                .obstacles
                .iter()
                .flat_map(|&prop| POINTS.map(|along| (prop, along)))
                .filter_map(|(prop, along)| {
                    let shape = &body.link(node).shape;
                    let point = shape.from.lerp(shape.to, along);
                    let radius = shape.from_radius_m + (shape.to_radius_m - shape.from_radius_m) * along;
                    let place = joint + rotation * point + ground_shift;
                    let nearest = world.nearest_on_prop(prop, place)?;
                    Some((radius + CLEARANCE_M - nearest.distance_m, radius, point, nearest))
                })
                .max_by(|a, b| a.0.total_cmp(&b.0));
            // An obstacle that approaches within this step is avoided in time: the plane is active before it is
            // reached.
            if let Some((depth, radius, point, nearest)) = deepest
                && depth > -CLEARANCE_M
            {
                let through = nearest.surface - ground_shift + nearest.outward * (radius + CLEARANCE_M);
                self.list.push(Task::Clear {
                    node,
                    point,
                    through,
                    normal: nearest.outward,
                    full_depth_m: FULL_DEPTH_M,
                    within_secs: CLEAR_SECS,
                    weight: CLEAR_WEIGHT,
                });
            }
        }
        &self.list
    }
}
