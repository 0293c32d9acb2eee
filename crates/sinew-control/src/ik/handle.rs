//! IK handles keep the hand or foot of the wanted pose on a point while the body moves: the paper's `setIKTarget`.

use crate::Wanted;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Limb, LimbGoal, Node, exp, log, solve_limb};
use sinew_snapshot::snapshot;
use sinew_world::CharacterFrame;

/// The goal of a handle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reach {
    /// The point, world \[m\].
    pub target: DVec3,
    /// The effector in the frame of the hand or foot \[m\]: the centre of the held object, or its own; see
    /// [`Reach::own`].
    pub effector: DVec3,
}

impl Reach {
    /// A goal for the centre of the hand or foot itself.
    pub fn own(body: &Body, limb: Limb, target: DVec3) -> Reach {
        Reach { target, effector: body.link(limb.nodes()[2]).centre }
    }
}

/// Duration of the blend from the pose to the target and back \[s\].
const BLEND_SECS: f64 = 0.2;

/// Rate at which a limb's swivel returns to that of the pose \[1/s\]: a hand moved in circles must not wind up its
/// elbow.
const RETURN_RATE: f64 = 2.0;

/// One limb.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Handle {
    reach: Option<Reach>,
    /// 0 as in the pose, 1 at the target.
    share: f64,
    /// The last solution.
    solution: [DQuat; 2],
    miss_m: f64,
}

impl Handle {
    const IDLE: Handle = Handle { reach: None, share: 0.0, solution: [DQuat::IDENTITY; 2], miss_m: 0.0 };
}

/// The four limbs' handles, by [`Limb::index`].
#[derive(Clone, Debug, PartialEq)]
pub struct IkHandles {
    handles: [Handle; 4],
}

snapshot!(Reach { target, effector });
snapshot!(Handle { reach, share, solution, miss_m });
snapshot!(IkHandles { handles });

impl Default for IkHandles {
    fn default() -> IkHandles {
        IkHandles { handles: [Handle::IDLE; 4] }
    }
}

impl IkHandles {
    /// Sets the goal of a limb. Takes effect in the next step. Points that are not finite are ignored.
    pub fn reach(&mut self, limb: Limb, reach: Reach) {
        if reach.target.is_finite() && reach.effector.is_finite() {
            self.handles[limb.index()].reach = Some(reach);
        }
    }

    /// Returns a limb to the pose.
    pub fn release(&mut self, limb: Limb) {
        self.handles[limb.index()].reach = None;
    }

    /// Returns all limbs to the pose.
    pub fn release_all(&mut self) {
        for handle in &mut self.handles {
            handle.reach = None;
        }
    }

    /// The goal of a limb.
    pub fn of(&self, limb: Limb) -> Option<Reach> {
        self.handles[limb.index()].reach
    }

    /// Remaining distance of a limb's wanted pose from its target \[m\], at the last step; 0 without a goal.
    pub fn miss_m(&self, limb: Limb) -> f64 {
        let handle = &self.handles[limb.index()];
        if handle.reach.is_some() { handle.miss_m } else { 0.0 }
    }

    /// Solves the limbs of a wanted pose for their targets, relative to the body's present position.
    pub fn write(&mut self, character: &CharacterFrame, body: &Body, step_secs: f64, target: &mut Wanted) {
        for limb in Limb::ALL {
            self.handles[limb.index()].write(limb, character, body, step_secs, target);
        }
    }
}

impl Handle {
    fn write(&mut self, limb: Limb, character: &CharacterFrame, body: &Body, step_secs: f64, target: &mut Wanted) {
        let [upper, lower, end] = limb.nodes();
        let pose = [target.joint(upper).rotation, target.joint(lower).rotation];
        if self.share == 0.0 {
            self.solution = pose;
        }
        let change = step_secs / BLEND_SECS;
        self.share = (self.share + if self.reach.is_some() { change } else { -change }).clamp(0.0, 1.0);
        if let Some(reach) = self.reach {
            let back = 1.0 - libm::exp(-RETURN_RATE * step_secs);
            let near = [0, 1].map(|bone| between(self.solution[bone], pose[bone], back));
            let goal = LimbGoal {
                joint: character.part(upper).position,
                world_from_parent: character.part(upper.parent().unwrap_or(Node::Hips)).rotation,
                end: target.joint(end).rotation,
                effector: reach.effector,
                target: reach.target,
                near,
            };
            if let Some(turns) = solve_limb(body, limb, &goal) {
                self.solution = [turns.upper, turns.lower];
                self.miss_m = turns.miss_m;
            }
        }
        if self.share > 0.0 {
            let share = self.share * self.share * (3.0 - 2.0 * self.share);
            for (node, bone) in [(upper, 0), (lower, 1)] {
                target.joint_mut(node).rotation = between(pose[bone], self.solution[bone], share);
            }
        }
    }
}

/// Interpolates between two rotations along the shorter arc.
pub(crate) fn between(from: DQuat, to: DQuat, share: f64) -> DQuat {
    if share <= 0.0 {
        return from;
    }
    if share >= 1.0 {
        return to;
    }
    (from * exp(log(from.conjugate() * to) * share)).normalize()
}
