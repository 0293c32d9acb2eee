//! Two sources layered with a weight over time, as animators layer motions: a wave over a walk, one walk into another.

use super::spec::{Named, SourceContext, SourceFault, SourceKind, SourceSpec};
use super::{ClipPlay, Moment, PoseBook, Source, SourceEvent};
use crate::ik::between;
use crate::{OrderError, OrderErrorKind as Kind, Root, Wanted};
use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sinew_body::humanoid::{Body, Node, Pose, log};
use sinew_world::CharacterFrame;
use std::sync::Arc;

/// Two sources layered. Each is a table as `source` itself, without `live` and `reach`; blends may nest four deep.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct BlendSpec {
    /// What is wanted at weight 0, and of the parts that are not layered.
    pub base: Box<SourceSpec>,
    /// What is wanted at weight 1.
    pub over: Box<SourceSpec>,
    /// Keys of the weight: time since the source began \[s\] and weight, 0 to 1, in the order of time. Between two keys it eases in and
    /// out; before the first and after the last it stays. Always 1 when left out.
    pub weight: Vec<[f64; 2]>,
    /// Only these parts are layered, by part or alias; all, and the place of the hips, when left out.
    pub parts: Vec<String>,
}

/// Keys of a weight at most.
const MAX_KEYS: usize = 1000;

/// Blends within blends at most.
const MAX_DEPTH: usize = 4;

/// Two sources layered, at work: local rotations are blended on the shortest arc, the hips' place on a straight line.
#[derive(Clone, Debug)]
pub struct Blend {
    base: Box<dyn Source>,
    over: Box<dyn Source>,
    weight: Vec<[f64; 2]>,
    is_layered: [bool; Node::COUNT],
    began_secs: f64,
    /// The end of the step that goes on \[s\].
    until_secs: f64,
}

sinew_snapshot::snapshot!(Blend { base, over, began_secs, until_secs } fixed { weight, is_layered });

impl SourceKind for BlendSpec {
    fn check(&self, _: &SourceSpec, exists: &dyn Fn(Named) -> Result<(), OrderError>) -> Result<(), SourceFault> {
        if self.depth() > MAX_DEPTH {
            return Err(SourceFault::at("blend", format!("blends are nested deeper than {MAX_DEPTH}; layer fewer")));
        }
        let layers = [("base", &self.base), ("over", &self.over)];
        for (key, layer) in layers {
            let inside = |fault: SourceFault| fault.within(key).within("blend");
            if layer.live.is_some() || layer.reach.is_some() {
                let problem = "only what acts by itself is layered; write live or reach beside blend";
                return Err(inside(SourceFault {
                    keys: Vec::new(),
                    error: OrderError::new(Kind::Contradiction, problem),
                }));
            }
            layer.check(exists).map_err(inside)?;
        }
        let at = |kind, problem: String| Err(SourceFault::of("weight", OrderError::new(kind, problem)).within("blend"));
        if self.weight.len() > MAX_KEYS {
            return at(Kind::TooLarge, format!("{} keys are more than {MAX_KEYS}; leave some out", self.weight.len()));
        }
        for [secs, weight] in &self.weight {
            if !(0.0..=86_400.0).contains(secs) || !(0.0..=1.0).contains(weight) {
                return at(
                    Kind::OutOfRange,
                    format!("[{secs}, {weight}] is no key; write [seconds, weight from 0 to 1]"),
                );
            }
        }
        if self.weight.windows(2).any(|keys| keys[1][0] <= keys[0][0]) {
            return at(Kind::Contradiction, "keys are not in the order of time; sort them".to_owned());
        }
        let part =
            |name: &String| exists(Named::Part(name)).map_err(|error| SourceFault::of("parts", error).within("blend"));
        self.parts.iter().try_for_each(part)
    }

    fn clips(&self, _: &SourceSpec) -> Vec<ClipPlay> {
        let mut clips = self.base.clips();
        clips.extend(self.over.clips());
        clips
    }

    fn build(&self, _: &SourceSpec, context: &dyn SourceContext) -> Result<Box<dyn Source>, OrderError> {
        let nothing = || OrderError::new(Kind::Contradiction, "a layer states no source");
        let layer = |spec: &SourceSpec| spec.build(context)?.ok_or_else(nothing);
        let mut is_layered = [self.parts.is_empty(); Node::COUNT];
        let node =
            |part: &str| context.node(part).ok_or_else(|| OrderError::new(Kind::NotFound, format!("no part `{part}`")));
        for part in &self.parts {
            is_layered[node(part)?.index()] = true;
        }
        let began_secs = context.now_secs();
        Ok(Box::new(Blend {
            base: layer(&self.base)?,
            over: layer(&self.over)?,
            weight: self.weight.clone(),
            is_layered,
            began_secs,
            until_secs: began_secs,
        }))
    }
}

impl BlendSpec {
    fn depth(&self) -> usize {
        let of = |layer: &SourceSpec| layer.blend.as_ref().map_or(0, BlendSpec::depth);
        1 + of(&self.base).max(of(&self.over))
    }
}

impl Blend {
    /// The weight of the layer at a time of the stage \[s\], and how fast it changes \[1/s\].
    fn weight_at(&self, at_secs: f64) -> (f64, f64) {
        let secs = at_secs - self.began_secs;
        let after = self.weight.partition_point(|key| key[0] <= secs);
        let (Some(before), Some(next)) = (self.weight.get(after.wrapping_sub(1)), self.weight.get(after)) else {
            // Before the first key, after the last, or without any.
            let end = if after == 0 { self.weight.first() } else { self.weight.last() };
            return (end.map_or(1.0, |key| key[1]), 0.0);
        };
        let lasts = next[0] - before[0];
        let (x, rise) = ((secs - before[0]) / lasts, next[1] - before[1]);
        (before[1] + rise * x * x * (3.0 - 2.0 * x), rise * 6.0 * x * (1.0 - x) / lasts)
    }

    /// Of one part.
    fn part_weight(&self, node: Node, (weight, rate): (f64, f64)) -> (f64, f64) {
        if self.is_layered[node.index()] { (weight, rate) } else { (0.0, 0.0) }
    }

    /// The hips: of the layer that knows a place, or between both.
    fn hips(&self, base: &Wanted, over: &Wanted, weight: f64) -> (DVec3, glam::DQuat) {
        let of = |wanted: &Wanted| (wanted.pose.hips_position, wanted.pose.world[0]);
        match (base.root, over.root) {
            (Root::Placed, Root::Free) => of(base),
            (Root::Free, Root::Placed) => of(over),
            _ => {
                let ((from, turn), (to, other)) = (of(base), of(over));
                (from.lerp(to, weight), between(turn, other, weight))
            }
        }
    }
}

impl Source for Blend {
    fn cloned(&self) -> Box<dyn Source> {
        Box::new(self.clone())
    }

    fn advance(&mut self, moment: &Moment, events: &mut Vec<SourceEvent>) {
        self.until_secs = moment.frame.time_secs + moment.step_secs;
        self.base.advance(moment, events);
        self.over.advance(moment, events);
    }

    fn set_book(&mut self, book: &Arc<PoseBook>) {
        self.base.set_book(book);
        self.over.set_book(book);
    }

    fn signal(&mut self, word: &str) {
        self.base.signal(word);
        self.over.signal(word);
    }

    fn root(&self) -> Root {
        if self.base.root() == Root::Placed { Root::Placed } else { self.over.root() }
    }

    fn wanted(&self, at_secs: f64, wanted: &mut Wanted) {
        let mut over = wanted.clone();
        self.base.wanted(at_secs, wanted);
        self.over.wanted(at_secs, &mut over);
        let weight = self.weight_at(at_secs);
        let (position, rotation) = self.hips(wanted, &over, self.part_weight(Node::Hips, weight).0);
        for node in Node::ALL.into_iter().skip(1) {
            let (weight, rate) = self.part_weight(node, weight);
            let (joint, other) = (wanted.joint_mut(node), over.joint(node));
            let turn = log((joint.rotation.conjugate() * other.rotation).normalize());
            joint.rotation = between(joint.rotation, other.rotation, weight);
            joint.velocity = joint.velocity.lerp(other.velocity, weight) + turn * rate;
        }
        (wanted.root, wanted.smooth) = (self.root(), None);
        if wanted.root == Root::Placed {
            wanted.pose = wanted.pose_with_hips(position, rotation);
        }
    }

    fn firmness(&self, wanted: &mut Wanted) {
        let mut over = wanted.clone();
        self.base.firmness(wanted);
        self.over.firmness(&mut over);
        let weight = self.weight_at(self.until_secs);
        for node in Node::ALL {
            let weight = self.part_weight(node, weight).0;
            let (joint, other) = (wanted.joint_mut(node), over.joint(node));
            joint.gain += (other.gain - joint.gain) * weight;
            joint.damping += (other.damping - joint.damping) * weight;
        }
    }

    fn motion(&self) -> Option<&[Pose]> {
        self.base.motion()
    }

    fn resume(&mut self, body: &Body, left_secs: f64, now_secs: f64, at: &Pose) {
        self.base.resume(body, left_secs, now_secs, at);
        self.over.resume(body, left_secs, now_secs, at);
    }

    fn match_body(&mut self, character: &CharacterFrame) {
        self.base.match_body(character);
        self.over.match_body(character);
    }
}
