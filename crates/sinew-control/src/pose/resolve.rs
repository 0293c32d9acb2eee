//! Resolves key poses of files on a body.

use super::key_pose::{mirrored, rotation_of};
use super::{BLEND_SECS, FullJointSpec, IkSpec, JointSpec, KeyPose, PartName, PoseError, PoseSpec, number};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Limb, LimbGoal, Node, Pose, solve_limb};
use std::collections::BTreeMap;

/// Maximum number of poses of a scene.
pub const MAX_POSES: usize = 2000;

/// Maximum depth of base poses.
const MAX_DEPTH: usize = 64;

/// The built-in pose that others start from.
pub const STAND: &str = "stand";

/// Tolerance at a limit \[rad\]: angles rounded to degrees in files.
const LIMIT_SLACK: f64 = 1e-6;

/// Maximum distance of an IK link of a pose from its target \[m\].
const REACH_SLACK_M: f64 = 1e-3;

/// The poses of a scene on a body, by name; `stand` is always among them.
///
/// # Errors
/// The first error, see [`PoseError`].
pub fn resolve_poses(specs: &BTreeMap<String, PoseSpec>, body: &Body) -> Result<BTreeMap<String, KeyPose>, PoseError> {
    if specs.len() > MAX_POSES {
        return Err(PoseError::TooMany { what: "poses".to_owned(), count: specs.len(), most: MAX_POSES });
    }
    // A file may define `stand`, as long as it is the built-in pose.
    if specs.get(STAND).is_some_and(|spec| *spec != PoseSpec::default()) {
        return Err(PoseError::Stand);
    }
    let mut drafts: BTreeMap<&str, Draft> = BTreeMap::from([(STAND, Draft::STAND)]);
    for name in specs.keys() {
        draft(name, specs, body, &mut drafts)?;
    }
    Ok(drafts.into_iter().map(|(name, draft)| (name.to_owned(), draft.finish())).collect())
}

/// A pose with separate gains, as derived poses need them.
#[derive(Clone)]
struct Draft {
    rotations: [DQuat; Node::COUNT],
    joint_gains: [f64; Node::COUNT],
    joint_dampings: [f64; Node::COUNT],
    gain: f64,
    damping: f64,
    blend_secs: f64,
    follow_velocity: bool,
}

impl Draft {
    const STAND: Draft = Draft {
        rotations: [DQuat::IDENTITY; Node::COUNT],
        joint_gains: [1.0; Node::COUNT],
        joint_dampings: [1.0; Node::COUNT],
        gain: 1.0,
        damping: 1.0,
        blend_secs: BLEND_SECS,
        follow_velocity: false,
    };

    fn finish(self) -> KeyPose {
        KeyPose {
            rotations: self.rotations,
            gains: self.joint_gains.map(|gain| gain * self.gain),
            dampings: self.joint_dampings.map(|damping| damping * self.damping),
            blend_secs: self.blend_secs,
            follow_velocity: self.follow_velocity,
        }
    }

    fn mirrored(&self) -> Draft {
        let other = |at: usize| Node::of(Node::ALL[at].part().mirrored()).index();
        Draft {
            rotations: std::array::from_fn(|at| mirrored(self.rotations[other(at)])),
            joint_gains: std::array::from_fn(|at| self.joint_gains[other(at)]),
            joint_dampings: std::array::from_fn(|at| self.joint_dampings[other(at)]),
            ..self.clone()
        }
    }

    fn apply(&mut self, name: &str, spec: &PoseSpec, body: &Body) -> Result<(), PoseError> {
        let wrong = |place: &str, problem: String| PoseError::Number {
            pose: name.to_owned(),
            place: place.to_owned(),
            problem,
        };
        let set = |to: &mut f64, value: Option<f64>, range, place: &str, what: &str| match value {
            Some(value) => {
                *to = number::checked(value, range, what).map_err(|problem| wrong(place, problem))?;
                Ok(())
            }
            None => Ok(()),
        };
        set(&mut self.blend_secs, spec.blend_secs, &number::SECS, "blend_secs", "the time")?;
        set(&mut self.gain, spec.gain, &number::FACTOR, "gain", "the factor")?;
        set(&mut self.damping, spec.damping, &number::FACTOR, "damping", "the factor")?;
        self.follow_velocity = spec.follow_velocity.unwrap_or(self.follow_velocity);
        for (joint, joint_spec) in &spec.joints {
            if joint.0 == Node::Hips {
                return Err(PoseError::Root { pose: name.to_owned() });
            }
            let full = match joint_spec {
                JointSpec::Turn(turn) => FullJointSpec { turn_deg: Some(*turn), ..FullJointSpec::default() },
                JointSpec::Full(full) => full.clone(),
            };
            let (at, place) = (joint.0.index(), joint.to_string());
            if let Some(degrees) = full.turn_deg {
                let degrees = number::turn(degrees).map_err(|problem| wrong(&place, problem))?;
                self.rotations[at] = rotation_of(degrees);
            }
            set(&mut self.joint_gains[at], full.gain, &number::FACTOR, &place, "the gain")?;
            set(&mut self.joint_dampings[at], full.damping, &number::FACTOR, &place, "the damping")?;
        }
        if spec.ik.len() > Limb::ALL.len() {
            let what = format!("ik targets of pose {name:?}");
            return Err(PoseError::TooMany { what, count: spec.ik.len(), most: Limb::ALL.len() });
        }
        for ik in &spec.ik {
            number::checked_three(ik.target_m, &number::PLACE_M, "a coordinate in metres")
                .map_err(|problem| wrong("ik", problem))?;
            self.reach(name, ik, body)?;
        }
        self.check_limits(name, body)
    }

    /// Solves one limb with the hips where a standing body has them.
    fn reach(&mut self, name: &str, ik: &IkSpec, body: &Body) -> Result<(), PoseError> {
        let limb = Limb::of(ik.link.0)
            .filter(|limb| limb.nodes()[2] == ik.link.0)
            .ok_or_else(|| PoseError::NoLimb { pose: name.to_owned(), link: ik.link })?;
        let [upper, lower, end] = limb.nodes();
        let hips = DVec3::Y * sinew_world::hips_over_soles_m(body, &Pose::STANDING);
        let pose = Pose::from_locals(hips, &self.rotations);
        let goal = LimbGoal {
            joint: pose.positions(body)[upper.index()],
            world_from_parent: pose.world[upper.parent().map_or(0, Node::index)],
            end: self.rotations[end.index()],
            effector: body.link(end).centre,
            target: DVec3::from_array(ik.target_m) * (body.stature_m() / 1.7),
            near: [self.rotations[upper.index()], self.rotations[lower.index()]],
        };
        let out_of_reach = |miss_m: f64| PoseError::OutOfReach { pose: name.to_owned(), link: ik.link, miss_m };
        let turns = solve_limb(body, limb, &goal).ok_or_else(|| out_of_reach(f64::INFINITY))?;
        if turns.miss_m > REACH_SLACK_M {
            return Err(out_of_reach(turns.miss_m));
        }
        self.rotations[upper.index()] = turns.upper;
        self.rotations[lower.index()] = turns.lower;
        Ok(())
    }

    fn check_limits(&self, name: &str, body: &Body) -> Result<(), PoseError> {
        for node in Node::ALL.into_iter().skip(1) {
            let excess = body.link(node).limit.excess(self.rotations[node.index()]);
            if excess > LIMIT_SLACK {
                return Err(PoseError::Limit {
                    pose: name.to_owned(),
                    joint: PartName(node),
                    excess_deg: excess.to_degrees(),
                });
            }
        }
        Ok(())
    }
}

/// Makes the draft of a pose and of all its bases.
fn draft<'a>(
    name: &'a str,
    specs: &'a BTreeMap<String, PoseSpec>,
    body: &Body,
    drafts: &mut BTreeMap<&'a str, Draft>,
) -> Result<(), PoseError> {
    // From the pose down to a base that is there already.
    let mut way: Vec<(&'a str, &'a PoseSpec)> = Vec::new();
    let mut at = name;
    while !drafts.contains_key(at) {
        let Some((at_key, spec)) = specs.get_key_value(at) else {
            let pose = way.last().map_or(name, |(above, _)| above).to_owned();
            let base = at.chars().take(60).collect();
            return Err(PoseError::UnknownBase { pose, base, known: known(specs) });
        };
        way.push((at_key, spec));
        at = spec.base.as_deref().unwrap_or(STAND);
        if way.iter().any(|(above, _)| *above == at) {
            let names: Vec<&str> = way.iter().map(|(above, _)| *above).chain([at]).collect();
            return Err(PoseError::Cycle { pose: at.to_owned(), way: names.join(" -> ") });
        }
        if way.len() > MAX_DEPTH {
            let what = format!("bases below pose {name:?}");
            return Err(PoseError::TooMany { what, count: way.len(), most: MAX_DEPTH });
        }
    }
    for (name, spec) in way.into_iter().rev() {
        let base = &drafts[spec.base.as_deref().unwrap_or(STAND)];
        let mut draft = if spec.mirror { base.mirrored() } else { base.clone() };
        draft.apply(name, spec, body)?;
        drafts.insert(name, draft);
    }
    Ok(())
}

/// The names that there are, for a message.
fn known(specs: &BTreeMap<String, PoseSpec>) -> String {
    let names: Vec<&str> = specs.keys().map(String::as_str).chain([STAND]).collect();
    crate::pose::list(&names)
}
