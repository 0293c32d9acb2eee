//! A character that reaches: the reach source on the stage.

use crate::Stage;
use crate::actor::Actor;
use crate::scene::TrackerKind;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Node, Pose, exp, log};
use sinew_control::{ReachHand, ReachOrder, Target};
use sinew_reach::{Goal, Obstacle, Reacher, Start, Style};
use sinew_world::{BodyState, CharacterFrame, Entity, Form, Frame, Held, Solid};

/// Where a hand is to come.
#[derive(Clone, Copy, Debug)]
enum Aimed {
    Point(DVec3),
    /// A prop's centre and how far from it, world \[m\].
    Prop(usize, DVec3),
}

/// How far along a reach is.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Phase {
    /// On its way, or there.
    Reaching,
    /// Standing up again; then back to the clip or pose.
    Rising,
    /// Handing over since a time \[s\].
    Leaving(f64),
}

/// A reach under way.
pub(crate) struct Reaching {
    reacher: Reacher,
    order: ReachOrder,
    /// When the reacher's time began \[s\].
    began_secs: f64,
    aimed: [Option<Aimed>; 2],
    phase: Phase,
    /// The time is up.
    has_arrived: bool,
    /// The hands have been on their targets.
    is_there: bool,
    /// When the clip was left, where there is one \[s\].
    left_clip_secs: f64,
    has_resumed: bool,
}

/// How long handing over takes \[s\].
const HAND_OVER_SECS: f64 = 0.6;

/// How near the hand must be to what it grasps, beyond where it was sent \[m\]: the body may be off its wanted pose.
const GRASP_M: f64 = 0.08;

/// How near counts as there \[m\].
const THERE_M: f64 = 0.02;

/// A hand's own thickness, between its centre and what it touches \[m\].
const PALM_M: f64 = 0.035;

impl Reaching {
    /// The wanted pose at a time of the stage \[s\].
    pub fn pose_at(&self, time_secs: f64, without: impl FnOnce() -> Pose) -> Pose {
        let own = self.reacher.pose_at(time_secs - self.began_secs);
        let Phase::Leaving(since) = self.phase else { return own };
        let share = ((time_secs - since) / HAND_OVER_SECS).clamp(0.0, 1.0);
        let share = share * share * share * (10.0 + share * (6.0 * share - 15.0));
        mixed(&own, &without(), share)
    }

    /// Another source takes over.
    pub fn leave(&mut self) {
        if self.phase == Phase::Reaching {
            self.reacher.release();
            self.phase = Phase::Rising;
        }
    }

    /// Both hands' targets now.
    fn goal(&self, frame: &Frame) -> Goal {
        let at = |aimed: Option<Aimed>| match aimed? {
            Aimed::Point(point) => Some(point),
            Aimed::Prop(prop, offset) => Some(frame.props.get(prop)?.centre + offset),
        };
        Goal { left: at(self.aimed[0]), right: at(self.aimed[1]) }
    }
}

/// Writes a pose into a target, with the velocity of its joints from the one a step later.
pub(crate) fn write(poses: &[Pose; 2], step_secs: f64, target: &mut Target) {
    for node in Node::ALL.into_iter().skip(1) {
        let joint = target.joint_mut(node);
        let (local, after) = (poses[0].local(node), poses[1].local(node));
        joint.rotation = local.normalize();
        joint.velocity = log((local.conjugate() * after).normalize()) / step_secs;
        joint.gain = 1.0;
        joint.damping = 1.0;
    }
    target.root = Some((poses[0].hips_position, poses[0].world[0]));
}

fn mixed(from: &Pose, to: &Pose, share: f64) -> Pose {
    let mut pose = *from;
    pose.hips_position = from.hips_position.lerp(to.hips_position, share);
    for node in Node::ALL {
        let (one, other) = (from.world[node.index()], to.world[node.index()]);
        pose.world[node.index()] = (one * exp(log(one.conjugate() * other) * share)).normalize();
    }
    pose
}

impl Actor {
    /// Stands up from a reach and goes back to what was before. False when there is none.
    pub(crate) fn end_reach(&mut self, now_secs: f64) -> bool {
        let Some(reaching) = &mut self.reaching else { return false };
        reaching.reacher.advance(now_secs - reaching.began_secs);
        let was = reaching.phase;
        reaching.leave();
        was == Phase::Reaching
    }
}

impl Stage {
    /// Begins to reach, from whatever pose the character is in. None when it does so already.
    pub(crate) fn begin_reach(&mut self, index: usize, order: &ReachOrder) -> Result<Option<String>, String> {
        order.check()?;
        let frame = self.world.frame();
        let now_secs = frame.time_secs;
        let seed = self.scene.stage.seed.wrapping_add(index as u64);
        let style = Style {
            flexibility: order.flexibility,
            speed_m_s: order.speed_m_s.filter(|_| order.time_secs.is_none()),
            time_secs: order.time_secs,
            seed,
            ..Style::default()
        };
        if let Some(reaching) = &self.actors[index].reaching
            && reaching.order == *order
            && reaching.phase == Phase::Reaching
        {
            return Ok(None);
        }
        let character = frame.characters.get(index).ok_or("the character is not in the world")?;
        let aimed = self.aim_of(character, order)?;
        let obstacles = self.obstacles(&order.avoid)?;
        let frame = self.world.frame().clone();
        let start = self.start_of(index, &frame.characters[index], now_secs);
        let actor = &mut self.actors[index];
        let mut reaching = match actor.reaching.take() {
            // On from the reach before: nothing jumps.
            Some(mut before) if !matches!(before.phase, Phase::Leaving(_)) => {
                before.reacher.advance(now_secs - before.began_secs);
                before.reacher.set_style(&style).map_err(|error| error.to_string())?;
                before
            }
            _ => Reaching {
                reacher: Reacher::new(actor.body(), &style, &start).map_err(|error| error.to_string())?,
                order: order.clone(),
                began_secs: now_secs,
                aimed,
                phase: Phase::Reaching,
                has_arrived: false,
                is_there: false,
                left_clip_secs: now_secs,
                has_resumed: false,
            },
        };
        reaching.order = order.clone();
        reaching.aimed = aimed;
        reaching.phase = Phase::Reaching;
        reaching.has_arrived = false;
        reaching.is_there = false;
        reaching.reacher.set_obstacles(&obstacles);
        let goal = reaching.goal(&frame);
        let outcome = reaching.reacher.reach(&goal).clone();
        actor.reaching = Some(reaching);
        let what = order.object.clone().unwrap_or_else(|| {
            let point = goal.left.or(goal.right).unwrap_or_default();
            format!("{point:.2}")
        });
        let how = match outcome.steps.len() {
            0 => String::new(),
            1 => ", with a step".to_owned(),
            many => format!(", with {many} steps"),
        };
        let fails = outcome.reason.map_or(String::new(), |reason| format!("; {}", reason.text()));
        Ok(Some(format!(
            "reaches for {what} in {:.2} s{how}{fails}",
            outcome.arrives_secs - (now_secs - self.began(index))
        )))
    }

    fn began(&self, index: usize) -> f64 {
        self.actors[index].reaching.as_ref().map_or(0.0, |reaching| reaching.began_secs)
    }

    /// The wanted pose and how it moves; of a body that springs or nothing drives, its own.
    fn start_of(&self, index: usize, character: &CharacterFrame, now_secs: f64) -> Start {
        let ago = 1.0 / f64::from(self.scene.stage.motion_hz);
        let actor = &self.actors[index];
        if matches!(actor.tracker, TrackerKind::Kinematic | TrackerKind::Response) && actor.motion.is_some() {
            let before = actor.wanted_pose(now_secs - ago);
            return Start { pose: actor.wanted_pose(now_secs), before: Some((before, ago)) };
        }
        let pose = character.pose();
        let speed = character.centre_velocity.length();
        let before = (speed > STILL_M_S).then(|| (earlier(&character.parts, &pose, ago), ago));
        Start { pose, before }
    }

    /// Where each hand is to come.
    fn aim_of(&self, character: &CharacterFrame, order: &ReachOrder) -> Result<[Option<Aimed>; 2], String> {
        if order.left_m.is_some() || order.right_m.is_some() {
            let point = |place: Option<[f64; 3]>| place.map(|place| Aimed::Point(place.into()));
            return Ok([point(order.left_m), point(order.right_m)]);
        }
        let left = character.left();
        let middle = |hand: ReachHand, target: DVec3| match hand {
            ReachHand::Left => 0,
            ReachHand::Right => 1,
            _ => usize::from((target - character.parts[0].position).dot(left) < 0.06),
        };
        if let Some(point) = order.target_m {
            let point = DVec3::from(point);
            let mut aimed = [None; 2];
            aimed[middle(order.hand, point)] = Some(Aimed::Point(point));
            return Ok(aimed);
        }
        let name = order.object.as_deref().unwrap_or_default();
        let prop = self.cast.prop(name).ok_or_else(|| format!("no object `{name}`"))?;
        let state = self.world.frame().props.get(prop).ok_or("it is not in the world")?;
        let solid = self.scene.props.values().nth(prop).and_then(crate::scene::PropSpec::solid);
        let surface = |direction: DVec3| {
            let depth = solid.as_ref().map_or(0.0, |solid| depth(solid, state, direction));
            direction * (depth + PALM_M)
        };
        if order.hand == ReachHand::Both {
            return Ok([Some(Aimed::Prop(prop, surface(left))), Some(Aimed::Prop(prop, surface(-left)))]);
        }
        let side = middle(order.hand, state.centre);
        let shoulder = character.part([Node::LeftUpperArm, Node::RightUpperArm][side]).position;
        // From the shoulder's side, rather from the side than from above.
        let mut from = shoulder - state.centre;
        from.y *= 0.35;
        let mut aimed = [None; 2];
        aimed[side] = Some(Aimed::Prop(prop, surface(from.normalize_or(DVec3::Y))));
        Ok(aimed)
    }

    /// Props that arms keep clear of, where they are now.
    fn obstacles(&self, names: &[String]) -> Result<Vec<Obstacle>, String> {
        let mut all = Vec::new();
        for name in names {
            let prop = self.cast.prop(name).ok_or_else(|| format!("no object `{name}`"))?;
            let (Some(state), Some(solid)) = (
                self.world.frame().props.get(prop),
                self.scene.props.values().nth(prop).and_then(crate::scene::PropSpec::solid),
            ) else {
                continue;
            };
            all.extend(obstacles_of(&solid, state));
        }
        Ok(all)
    }

    /// A step of a character's reach: targets followed, grasps taken, the end handed over.
    pub(crate) fn step_reach(&mut self, index: usize) {
        let frame = self.world.frame();
        let now_secs = frame.time_secs;
        let Some(reaching) = &mut self.actors[index].reaching else { return };
        let own_secs = now_secs - reaching.began_secs;
        reaching.reacher.advance(own_secs);
        match reaching.phase {
            Phase::Reaching => {
                let goal = reaching.goal(frame);
                if reaching.aimed.iter().any(|aimed| matches!(aimed, Some(Aimed::Prop(..)))) {
                    reaching.reacher.follow(&goal);
                }
                if !reaching.is_there && own_secs >= reaching.reacher.outcome().arrives_secs {
                    self.arrive(index);
                }
            }
            Phase::Rising if own_secs >= reaching.reacher.done_secs() => {
                reaching.phase = Phase::Leaving(now_secs);
                let (left, resumed) = (reaching.left_clip_secs, reaching.has_resumed);
                reaching.has_resumed = true;
                let standing = reaching.reacher.pose_at(own_secs);
                let actor = &mut self.actors[index];
                actor.stand = (standing.hips_position, standing.world[0]);
                if let Some(motion) = actor.motion.as_mut().filter(|_| !resumed) {
                    motion.resume(left, now_secs, &standing);
                }
            }
            Phase::Leaving(since) if now_secs - since >= HAND_OVER_SECS => self.actors[index].reaching = None,
            Phase::Rising | Phase::Leaving(_) => {}
        }
    }

    /// The hand should be there: says whether it is, and grasps. One that was bumped arrives later.
    fn arrive(&mut self, index: usize) {
        let frame = self.world.frame();
        let Some(reaching) = &mut self.actors[index].reaching else { return };
        let is_late = reaching.has_arrived;
        reaching.has_arrived = true;
        let goal = reaching.goal(frame);
        let (order, outcome) = (reaching.order.clone(), reaching.reacher.outcome().clone());
        let who = self.cast.characters()[index].clone();
        let (mut notes, mut worst): (Vec<String>, f64) = (Vec::new(), 0.0);
        let mut holds = Vec::new();
        for (side, target) in [goal.left, goal.right].into_iter().enumerate() {
            let Some(target) = target else { continue };
            let node = [Node::LeftHand, Node::RightHand][side];
            let hand = frame.characters[index].part(node);
            let gap = (hand.centre - target).length();
            let prop = match self.actors[index].reaching.as_ref().and_then(|reaching| reaching.aimed[side]) {
                Some(Aimed::Prop(prop, _)) => Some(prop),
                _ => None,
            };
            worst = worst.max(gap);
            notes.push(format!("{who}'s {} is {:.0} mm from its target", node.part(), gap * 1e3));
            if order.grasp
                && outcome.reason.is_none()
                && gap < GRASP_M
                && let Some(prop) = prop
            {
                holds.push((side, node, prop));
            }
        }
        let is_there = worst < THERE_M;
        if is_late && !is_there {
            return;
        }
        if let Some(reaching) = &mut self.actors[index].reaching {
            reaching.is_there = is_there || outcome.reason.is_some();
        }
        for (side, node, prop) in holds {
            // Both hands: the second holds softly, or the two would fight.
            self.world.attach(Held {
                character: index,
                node,
                object: Entity::Prop(prop),
                soft: side == 1 && order.hand == ReachHand::Both,
                break_force_n: None,
            });
            if let Some(reaching) = &mut self.actors[index].reaching {
                let target = reaching.reacher.hands_at(reaching.reacher.outcome().arrives_secs)[side];
                reaching.aimed[side] = Some(Aimed::Point(target));
            }
            notes.push(format!("{who}'s {} holds {}", node.part(), self.cast.props()[prop]));
        }
        for note in notes {
            self.note("the reach arrives", note);
        }
    }
}

/// A body slower than this begins at rest \[m/s\].
const STILL_M_S: f64 = 0.15;

/// The pose a moment before, by the parts' velocities.
fn earlier(parts: &[BodyState; Node::COUNT], pose: &Pose, ago: f64) -> Pose {
    let mut before = *pose;
    for node in Node::ALL {
        let spin = parts[node.index()].angular_velocity;
        before.world[node.index()] = (exp(spin * -ago) * pose.world[node.index()]).normalize();
    }
    let hips = &parts[0];
    let arm = hips.position - hips.centre;
    let velocity = hips.velocity + hips.angular_velocity.cross(arm);
    before.hips_position -= velocity * ago;
    before
}

/// How far a prop's surface is from its centre in a direction \[m\].
fn depth(solid: &Solid, state: &BodyState, direction: DVec3) -> f64 {
    let turn = state.rotation * solid.rotation;
    let local = turn.conjugate() * direction;
    match &solid.form {
        Form::Ball { radius_m } => *radius_m,
        Form::Capsule { radius_m, length_m } => radius_m + 0.5 * length_m * local.y.abs(),
        Form::Box { size_m } => {
            // Where the ray leaves the box.
            let half = *size_m * 0.5;
            let share = |axis: usize| half[axis] / local[axis].abs().max(1e-9);
            share(0).min(share(1)).min(share(2))
        }
        Form::Ring { radius_m, tube_m } => radius_m + tube_m,
        Form::Hull { points_m } => points_m.iter().map(|point| point.dot(local)).fold(0.0, f64::max),
        Form::Mesh { points_m, .. } => points_m.iter().map(|point| point.dot(local)).fold(0.0, f64::max),
    }
}

/// A prop as what must not be touched; a ring as its hull's box, meshes and hulls by the box around them.
fn obstacles_of(solid: &Solid, state: &BodyState) -> Vec<Obstacle> {
    let centre = state.position + state.rotation * solid.centre;
    let turn: DQuat = (state.rotation * solid.rotation).normalize();
    let around = |points: &[DVec3]| {
        let low = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        Obstacle::Box { centre: centre + turn * ((low + high) * 0.5), turn, half_m: (high - low) * 0.5 }
    };
    vec![match &solid.form {
        Form::Ball { radius_m } => Obstacle::Capsule { from: centre, to: centre, radius_m: *radius_m },
        Form::Capsule { radius_m, length_m } => {
            let half = turn * DVec3::Y * (0.5 * length_m);
            Obstacle::Capsule { from: centre - half, to: centre + half, radius_m: *radius_m }
        }
        Form::Box { size_m } => Obstacle::Box { centre, turn, half_m: *size_m * 0.5 },
        Form::Ring { radius_m, tube_m } => {
            let reach = radius_m + tube_m;
            Obstacle::Box { centre, turn, half_m: DVec3::new(reach, *tube_m, reach) }
        }
        Form::Hull { points_m } => around(points_m),
        Form::Mesh { points_m, .. } => around(points_m),
    }]
}
