//! A reach with arms, spine, head and legs (Huang, Kapadia and Terzopoulos 2011) as a source, from the order to standing again.

use super::Source;
use crate::{ReachHand, ReachOrder, Root, Wanted};
use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_reach::{Flight, Goal, Obstacle, Reacher, Start, Style, StyleError};
use sinew_snapshot::snapshot;
use sinew_world::{BodyState, CharacterId, Entity, Frame, Held, PropId};

/// The target of a hand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Aimed {
    /// A point, world \[m\].
    Point(DVec3),
    /// A prop's centre and an offset from it, world \[m\].
    Prop(PropId, DVec3),
    /// The target of the centre of a prop that the hand holds, world \[m\].
    Held(PropId, DVec3),
}

/// Left and right.
pub const HANDS: [Node; 2] = [Node::LeftHand, Node::RightHand];

/// The phase of a reach.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Phase {
    /// Reaching, or at the target.
    Reaching,
    /// Standing up again; then back to the previous source.
    Rising,
    /// Blending to the previous source since a time \[s\].
    Leaving(f64),
}

/// A reach as a source, with the sources before and after it.
#[derive(Clone, Debug)]
pub struct ReachSource {
    reacher: Reacher,
    order: ReachOrder<PropId>,
    /// Start of the reacher's time, and time of the last command \[s\].
    began_secs: f64,
    ordered_secs: f64,
    /// Counts the character's orders, from 1.
    number: u64,
    character: CharacterId,
    step_secs: f64,
    aimed: [Option<Aimed>; 2],
    /// A flying target: how it flies, and when a hand meets it \[s\].
    meets: Option<Meets>,
    phase: Phase,
    /// The time is up.
    has_arrived: bool,
    /// The hands have been on their targets.
    is_there: bool,
    /// Time at which the previous source was left \[s\].
    left_secs: f64,
    has_resumed: bool,
}

/// What flies, and when it is met.
#[derive(Clone, Copy, Debug, Default)]
struct Meets {
    prop: PropId,
    gravity_m_s2: f64,
    drag_per_s: f64,
    /// Time of the meeting \[s\], and its place \[m\].
    secs: f64,
    at: DVec3,
}

/// The origin.
impl Default for Aimed {
    fn default() -> Aimed {
        Aimed::Point(DVec3::ZERO)
    }
}

snapshot!(enum Aimed { 0: Point(point), 1: Prop(prop, offset), 2: Held(prop, point) });
snapshot!(Meets { prop, gravity_m_s2, drag_per_s, secs, at });
snapshot!(enum Phase { 0: Reaching, 1: Rising, 2: Leaving(since_secs) });
snapshot!(ReachSource {
    reacher,
    order,
    began_secs,
    ordered_secs,
    number,
    aimed,
    meets,
    phase,
    has_arrived,
    is_there,
    left_secs,
    has_resumed,
} fixed { character, step_secs });

/// Events of a reach with effects outside it.
#[expect(clippy::large_enum_variant, reason = "one for a step; a box would allocate during a run")]
#[derive(Clone, Debug, PartialEq)]
pub(super) enum ReachStep {
    Nothing,
    Arrives(ReachArrival),
    /// It stands, and blends to the previous source from now on, which resumes where it was left if it has a time.
    Leaves {
        standing: Pose,
        left_secs: Option<f64>,
    },
    Over,
}

/// The hands should be there.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReachArrival {
    /// Those that reach.
    pub hands: Vec<HandArrival>,
}

/// One hand should be there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HandArrival {
    /// Which.
    pub node: Node,
    /// Distance from its target \[m\].
    pub gap_m: f64,
    /// The object that it grasps now.
    pub holds: Option<Held>,
}

/// Maximum distance of the hand from its target for a grasp \[m\]: the body may deviate from its wanted pose.
const GRASP_M: f64 = 0.04;

/// Steps before and after the present one in which a hand meets what flies.
const MEETS_STEPS: f64 = 2.0;

/// Maximum distance that counts as arrived \[m\].
const THERE_M: f64 = 0.02;

impl ReachSource {
    /// For a character of the frame whose body begins like this now; it needs an [`order`](ReachSource::order) before it does anything.
    ///
    /// # Errors
    /// When the style is out of range.
    pub fn new(
        body: &Body,
        character: CharacterId,
        style: &Style,
        start: &Start,
        now_secs: f64,
        step_secs: f64,
    ) -> Result<ReachSource, StyleError> {
        Ok(ReachSource {
            reacher: Reacher::new(body, style, start)?,
            order: ReachOrder::default(),
            began_secs: now_secs,
            ordered_secs: now_secs,
            number: 0,
            character,
            step_secs,
            aimed: [None; 2],
            meets: None,
            phase: Phase::Reaching,
            has_arrived: false,
            is_there: false,
            left_secs: now_secs,
            has_resumed: false,
        })
    }

    /// Continues from the present state with another style.
    ///
    /// # Errors
    /// When the style is out of range.
    pub fn restyle(&mut self, style: &Style, now_secs: f64) -> Result<(), StyleError> {
        self.reacher.advance(now_secs - self.began_secs);
        self.reacher.set_style(style)
    }

    /// Reaches from now on; `number` counts the character's orders. With a `flight`, a thing that one hand is aimed at flies so: the hand
    /// goes to where it can meet it.
    pub fn order(
        &mut self,
        order: &ReachOrder<PropId>,
        aimed: [Option<Aimed>; 2],
        obstacles: &[Obstacle],
        frame: &Frame,
        flight: Option<&Flight>,
        number: u64,
    ) {
        self.number = number;
        self.ordered_secs = frame.time_secs;
        self.order = order.clone();
        self.aimed = aimed;
        self.phase = Phase::Reaching;
        (self.has_arrived, self.is_there) = (false, false);
        self.reacher.set_obstacles(obstacles);
        self.meets = None;
        if let (Some(flight), Some((side, prop, offset))) = (flight, self.flies()) {
            let meeting = self.reacher.meet(side, flight, offset);
            self.meets = meeting.map(|meeting| Meets {
                prop,
                gravity_m_s2: flight.gravity_m_s2,
                drag_per_s: flight.drag_per_s,
                secs: frame.time_secs + meeting.in_secs,
                at: meeting.at - offset,
            });
            if self.meets.is_some() {
                return;
            }
        }
        let goal = self.goal(frame);
        self.reacher.reach(&goal);
    }

    /// The one hand that is aimed at a prop.
    fn flies(&self) -> Option<(usize, PropId, DVec3)> {
        match self.aimed {
            [Some(Aimed::Prop(prop, offset)), None] => Some((0, prop, offset)),
            [None, Some(Aimed::Prop(prop, offset))] => Some((1, prop, offset)),
            _ => None,
        }
    }

    /// Looks where a flying thing is now, and so where it will be met.
    fn watch(&mut self, frame: &Frame) {
        let Some(meets) = &mut self.meets else { return };
        let left = meets.secs - frame.time_secs;
        let Some(prop) = frame.prop(meets.prop).filter(|_| left > 0.0) else { return };
        let Meets { gravity_m_s2, drag_per_s, .. } = *meets;
        let flight = Flight { at: prop.centre, velocity: prop.velocity, gravity_m_s2, drag_per_s };
        meets.at = flight.after(left);
    }

    /// The planner. Its poses are the wanted ones, not the body's.
    pub fn reacher(&self) -> &Reacher {
        &self.reacher
    }

    /// Counts the character's orders, from 1.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// A time of the stage in the reacher's time \[s\].
    pub fn own_secs(&self, time_secs: f64) -> f64 {
        time_secs - self.began_secs
    }

    /// When the last order came, in the reacher's time \[s\].
    pub fn since_secs(&self) -> f64 {
        self.ordered_secs - self.began_secs
    }

    /// Both hands' targets now, world \[m\].
    pub fn goal(&self, frame: &Frame) -> Goal {
        let at = |side: usize| match self.aimed[side]? {
            Aimed::Point(point) => Some(point),
            Aimed::Prop(_, offset) if self.meets.is_some() => Some(self.meets?.at + offset),
            Aimed::Prop(prop, offset) => Some(frame.prop(prop)?.centre + offset),
            Aimed::Held(prop, point) => {
                let hand = frame.character(self.character)?.part(HANDS[side]);
                Some(point + (hand.centre - frame.prop(prop)?.centre))
            }
        };
        Goal { left: at(0), right: at(1) }
    }

    /// Whether it reaches or is at the target.
    pub fn is_reaching(&self) -> bool {
        self.phase == Phase::Reaching
    }

    /// Whether it carries out this order now.
    pub fn is_about(&self, order: &ReachOrder<PropId>) -> bool {
        self.is_reaching() && self.order == *order
    }

    /// Whether a hand reaches for a prop now.
    pub fn is_aimed(&self, side: usize, prop: PropId) -> bool {
        self.is_reaching() && matches!(self.aimed[side], Some(Aimed::Prop(aimed, _)) if aimed == prop)
    }

    /// Since when it hands over to the source before \[s\].
    pub(super) fn leaving_secs(&self) -> Option<f64> {
        match self.phase {
            Phase::Leaving(since) => Some(since),
            Phase::Reaching | Phase::Rising => None,
        }
    }

    /// The wanted pose at a time of the stage \[s\].
    pub fn pose_at(&self, time_secs: f64) -> Pose {
        self.reacher.pose_at(self.own_secs(time_secs))
    }

    /// Releases the target and stands up; then the previous source continues. False if it does so already.
    pub fn leave(&mut self) -> bool {
        let was_reaching = self.is_reaching();
        if was_reaching {
            self.reacher.release();
            self.phase = Phase::Rising;
        }
        was_reaching
    }

    /// As [`leave`](ReachSource::leave), from where it is at a time of the stage \[s\].
    pub fn leave_at(&mut self, now_secs: f64) -> bool {
        self.reacher.advance(self.own_secs(now_secs));
        self.leave()
    }

    /// Advances by a step: follows targets, grasps, and blends at the end.
    pub(super) fn step(&mut self, frame: &Frame) -> ReachStep {
        let now_secs = frame.time_secs;
        let own_secs = self.own_secs(now_secs);
        self.reacher.advance(own_secs);
        match self.phase {
            Phase::Reaching => {
                self.watch(frame);
                let goal = self.goal(frame);
                if self.aimed.iter().any(|aimed| matches!(aimed, Some(Aimed::Prop(..) | Aimed::Held(..)))) {
                    self.reacher.follow(&goal);
                }
                if !self.is_there && own_secs >= self.reacher.outcome().arrives_secs {
                    return self.arrive(frame).map_or(ReachStep::Nothing, ReachStep::Arrives);
                }
                ReachStep::Nothing
            }
            Phase::Rising if own_secs >= self.reacher.done_secs() => {
                self.phase = Phase::Leaving(now_secs);
                let left_secs = (!std::mem::replace(&mut self.has_resumed, true)).then_some(self.left_secs);
                ReachStep::Leaves { standing: self.reacher.pose_at(own_secs), left_secs }
            }
            Phase::Leaving(since) if now_secs - since >= super::HAND_OVER_SECS => ReachStep::Over,
            Phase::Rising | Phase::Leaving(_) => ReachStep::Nothing,
        }
    }

    /// Nearest that a hand and what it meets in flight come in the steps about now \[m\]; `None` for what does not fly.
    fn misses_m(&self, frame: &Frame, side: usize, hand: &BodyState) -> Option<f64> {
        let (Some(meets), Some(Aimed::Prop(_, offset))) = (&self.meets, self.aimed[side]) else { return None };
        let prop = frame.prop(meets.prop)?;
        let apart = prop.centre + offset - hand.centre;
        let speed = prop.velocity - hand.velocity;
        let about = MEETS_STEPS * self.step_secs;
        let nearest_secs = (-apart.dot(speed) / speed.length_squared().max(1e-9)).clamp(-about, about);
        Some((apart + speed * nearest_secs).length())
    }

    /// The hands should have arrived: checks whether they have, and grasps. A hand that was hit arrives later.
    fn arrive(&mut self, frame: &Frame) -> Option<ReachArrival> {
        let is_late = std::mem::replace(&mut self.has_arrived, true);
        let character = frame.character(self.character)?;
        let goal = self.goal(frame);
        let is_reachable = self.reacher.outcome().reason.is_none();
        let mut arrival = ReachArrival::default();
        let mut worst: f64 = 0.0;
        for (side, target) in [goal.left, goal.right].into_iter().enumerate() {
            let Some(target) = target else { continue };
            let node = HANDS[side];
            let gap_m = (character.part(node).centre - target).length();
            let misses_m = self.misses_m(frame, side, character.part(node)).unwrap_or(gap_m);
            worst = worst.max(gap_m);
            let holds = match self.aimed[side] {
                Some(Aimed::Prop(prop, _)) if self.order.grasp && is_reachable && misses_m < GRASP_M => Some(Held {
                    character: self.character,
                    node,
                    object: Entity::Prop(prop),
                    // Both hands: the second attachment is soft, otherwise the two would oppose each other.
                    soft: side == 1 && self.order.hand == ReachHand::Both,
                    break_force_n: None,
                }),
                _ => None,
            };
            arrival.hands.push(HandArrival { node, gap_m, holds });
        }
        let is_there = worst < THERE_M;
        if is_late && !is_there {
            return None;
        }
        self.is_there = is_there || !is_reachable;
        let hands = self.reacher.hands_at(self.reacher.outcome().arrives_secs);
        for arrived in arrival.hands.iter().filter(|hand| hand.holds.is_some()) {
            let side = usize::from(arrived.node == HANDS[1]);
            self.aimed[side] = Some(Aimed::Point(hands[side]));
        }
        Some(arrival)
    }
}

impl Source for ReachSource {
    fn cloned(&self) -> Box<dyn Source> {
        Box::new(self.clone())
    }

    fn root(&self) -> Root {
        Root::Placed
    }

    fn wanted(&self, at_secs: f64, wanted: &mut Wanted) {
        wanted.follow_poses(&self.pose_at(at_secs), &self.pose_at(at_secs + self.step_secs), self.step_secs);
    }
}
