//! A character that reaches: the reach source on the stage.

use crate::Stage;
use crate::actor::Actor;
use crate::event::{Cause, CharacterEffect, Effect, ReachTarget};
use crate::reach_aim::{self, Aimed, HANDS};
use crate::reach_back::{HAND_OVER_SECS, handed_over};
use crate::scene::TrackerKind;
use sinew_body::humanoid::{Node, Pose, exp, log};
use sinew_control::{ReachHand, ReachOrder, Target};
use sinew_reach::{Goal, Reacher, Start, Style};
use sinew_world::{BodyState, CharacterFrame, Entity, Frame, Held};

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
    /// When the reacher's time began, and when the last order came \[s\].
    began_secs: f64,
    ordered_secs: f64,
    /// Counts the character's orders, from 1.
    number: u64,
    character: usize,
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

/// A reach under way, to look at.
#[derive(Clone, Copy, Debug)]
pub struct ReachNow<'a> {
    /// Counts the character's reaches, from 1.
    pub number: u64,
    /// Who plans it. Its poses are what is wanted, not where the body is.
    pub reacher: &'a Reacher,
    /// When it was ordered, in the reacher's time \[s\].
    pub since_secs: f64,
    /// Now, in the reacher's time \[s\].
    pub now_secs: f64,
    /// Where the hands are to be now, world \[m\].
    pub goal: Goal,
}

/// How near the hand must be to where it was sent, to grasp \[m\]: the body may be off its wanted pose.
const GRASP_M: f64 = 0.04;

/// How near counts as there \[m\].
const THERE_M: f64 = 0.02;

impl Reaching {
    /// The wanted pose at a time of the stage \[s\].
    pub fn pose_at(&self, time_secs: f64, without: impl FnOnce() -> Pose) -> Pose {
        let own = self.reacher.pose_at(time_secs - self.began_secs);
        let Phase::Leaving(since) = self.phase else { return own };
        handed_over(&own, &without(), time_secs - since)
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
        reach_aim::goal(&self.aimed, frame, self.character)
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
    pub(crate) fn begin_reach(&mut self, index: usize, order: &ReachOrder) -> Result<Option<CharacterEffect>, String> {
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
        let aimed = self.aim_of(index, order)?;
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
                ordered_secs: now_secs,
                number: 0,
                character: index,
                aimed,
                phase: Phase::Reaching,
                has_arrived: false,
                is_there: false,
                left_clip_secs: now_secs,
                has_resumed: false,
            },
        };
        actor.reaches += 1;
        reaching.number = actor.reaches;
        reaching.ordered_secs = now_secs;
        reaching.order = order.clone();
        reaching.aimed = aimed;
        reaching.phase = Phase::Reaching;
        reaching.has_arrived = false;
        reaching.is_there = false;
        reaching.reacher.set_obstacles(&obstacles);
        let goal = reaching.goal(&frame);
        let outcome = reaching.reacher.reach(&goal).clone();
        let arrives_secs = reaching.began_secs + outcome.arrives_secs - now_secs;
        actor.reaching = Some(reaching);
        self.pass_through(index, &aimed);
        let point = || ReachTarget::Point(goal.left.or(goal.right).unwrap_or_default());
        Ok(Some(CharacterEffect::Reaches {
            target: order.object.clone().map_or_else(point, ReachTarget::Object),
            in_secs: arrives_secs,
            steps: outcome.steps.len(),
            fails: outcome.reason,
        }))
    }

    /// The reach that a character is about, if it reaches now.
    pub fn reach_of(&self, character: usize) -> Option<ReachNow<'_>> {
        let frame = self.world.frame();
        let reaching = self.actors.get(character)?.reaching.as_ref()?;
        (reaching.phase == Phase::Reaching).then(|| ReachNow {
            number: reaching.number,
            reacher: &reaching.reacher,
            since_secs: reaching.ordered_secs - reaching.began_secs,
            now_secs: frame.time_secs - reaching.began_secs,
            goal: reaching.goal(frame),
        })
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

    /// Whether a hand reaches for a prop now.
    pub(crate) fn is_aimed(&self, index: usize, side: usize, prop: usize) -> bool {
        let reaching = self.actors[index].reaching.as_ref().filter(|reaching| reaching.phase == Phase::Reaching);
        reaching.is_some_and(|reaching| matches!(reaching.aimed[side], Some(Aimed::Prop(aimed, _)) if aimed == prop))
    }

    /// A step of a character's reach: targets followed, grasps taken, the end handed over.
    pub(crate) fn step_reach(&mut self, index: usize) {
        if !self.actors[index].through.is_empty() {
            self.end_passing(index);
        }
        let frame = self.world.frame();
        let now_secs = frame.time_secs;
        let Some(reaching) = &mut self.actors[index].reaching else { return };
        let own_secs = now_secs - reaching.began_secs;
        reaching.reacher.advance(own_secs);
        match reaching.phase {
            Phase::Reaching => {
                let goal = reaching.goal(frame);
                if reaching.aimed.iter().any(|aimed| matches!(aimed, Some(Aimed::Prop(..) | Aimed::Held(..)))) {
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
                let body = actor.body().clone();
                if let Some(motion) = actor.motion.as_mut().filter(|_| !resumed) {
                    motion.resume(&body, left, now_secs, &standing);
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
        let (mut notes, mut worst): (Vec<CharacterEffect>, f64) = (Vec::new(), 0.0);
        let mut holds = Vec::new();
        for (side, target) in [goal.left, goal.right].into_iter().enumerate() {
            let Some(target) = target else { continue };
            let node = HANDS[side];
            let hand = frame.characters[index].part(node);
            let gap = (hand.centre - target).length();
            let prop = match self.actors[index].reaching.as_ref().and_then(|reaching| reaching.aimed[side]) {
                Some(Aimed::Prop(prop, _)) => Some(prop),
                _ => None,
            };
            worst = worst.max(gap);
            notes.push(CharacterEffect::HandArrives { node, gap_m: gap });
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
            notes.push(CharacterEffect::Holds { node, object: self.cast.props()[prop].clone() });
        }
        for note in notes {
            self.note(Cause::ReachArrives, Effect::of(&who, note));
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
