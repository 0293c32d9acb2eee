//! The sources of a character, and their precedence.

use super::reach::ReachStep;
use super::{
    HAND_OVER_SECS, KeyPoses, Moment, Performer, PoseBook, ReachSource, Source, SourceEvent, SourceSpec, handed_over,
};
use crate::{FreeRoot, Root, Wanted};
use crate::{OrderError, OrderErrorKind};
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_world::{CharacterFrame, CharacterId, Frame};
use std::any::Any;
use std::sync::Arc;

/// One character's sources: its own; a live performer, for which the own one is the understudy; and a reach, which begins in either
/// and ends in either.
#[derive(Clone, Debug)]
pub struct Sources {
    body: Body,
    book: Arc<PoseBook>,
    /// The initial key pose.
    first: String,
    pub(super) own: Box<dyn Source>,
    /// What its own source was made from.
    pub(super) own_from: Origin,
    /// What was its own before, and since when it hands over \[s\].
    pub(super) before: Option<(Box<dyn Source>, Origin, f64)>,
    pub(super) performer: Option<Performer>,
    pub(super) reach: Option<ReachSource>,
    /// The root for sources without root motion.
    pub(super) root: FreeRoot,
    step_secs: f64,
}

/// What a source was made from, so that it can be made again.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) enum Origin {
    /// The book's key poses.
    #[default]
    KeyPoses,
    /// It was there at the start.
    Start,
    /// A source that was stated later.
    Stated(Box<SourceSpec>),
}

impl Sources {
    /// Key poses, in the pose `first` of the book, with the hips where `start` has them.
    pub fn new(body: &Body, book: Arc<PoseBook>, first: &str, start: &Pose, step_secs: f64) -> Sources {
        Sources {
            own: Box::new(KeyPoses::new(Arc::clone(&book), first, step_secs)),
            own_from: Origin::KeyPoses,
            body: body.clone(),
            book,
            first: first.to_owned(),
            before: None,
            performer: None,
            reach: None,
            root: FreeRoot::at(start, None),
            step_secs,
        }
    }

    /// Sets its own source at the start: stops following a performer, ends a reach.
    pub fn follow(&mut self, own: Box<dyn Source>) {
        (self.own, self.own_from) = (own, Origin::Start);
        self.leave_others();
    }

    /// As [`follow`](Sources::follow), in the middle of a run: what it followed before hands over from this time of the stage on \[s\].
    /// `spec` is what the source was built from.
    pub fn follow_from(&mut self, own: Box<dyn Source>, spec: &SourceSpec, now_secs: f64) {
        let before = std::mem::replace(&mut self.own, own);
        let from = std::mem::replace(&mut self.own_from, Origin::Stated(Box::new(spec.clone())));
        if !self.is_performed() {
            self.before = Some((before, from, now_secs));
        }
        self.leave_others();
    }

    /// Key poses of the book in its first pose.
    pub(super) fn first_poses(&self) -> KeyPoses {
        KeyPoses::new(Arc::clone(&self.book), &self.first, self.step_secs)
    }

    /// Length of a step of physics \[s\].
    pub(super) fn step_secs(&self) -> f64 {
        self.step_secs
    }

    /// The key poses and graphs that it can follow.
    pub fn book(&self) -> &Arc<PoseBook> {
        &self.book
    }

    /// Key poses and graphs were read anew, on the same body.
    pub fn set_book(&mut self, book: Arc<PoseBook>) {
        self.own.set_book(&book);
        if let Some((before, ..)) = &mut self.before {
            before.set_book(&book);
        }
        self.book = book;
    }

    /// The pose of the book that key poses begin in.
    pub fn first(&self) -> &str {
        &self.first
    }

    /// The body that it is for.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// Has a live performer from now on.
    pub fn set_performer(&mut self, performer: Performer) {
        self.performer = Some(performer);
    }

    /// Starts a reach from the present source.
    pub fn set_reach(&mut self, reach: ReachSource) {
        self.reach = Some(reach);
    }

    /// Its own source, whether it plays or not.
    pub fn own(&self) -> &dyn Source {
        self.own.as_ref()
    }

    /// Its own source, where that is key poses.
    pub fn key_poses(&self) -> Option<&KeyPoses> {
        (self.own.as_ref() as &dyn Any).downcast_ref()
    }

    /// Its own source, where that is key poses, to change it.
    pub fn key_poses_mut(&mut self) -> Option<&mut KeyPoses> {
        (self.own.as_mut() as &mut dyn Any).downcast_mut()
    }

    /// The performer, whether it is followed or not.
    pub fn performer(&self) -> Option<&Performer> {
        self.performer.as_ref()
    }

    /// The performer, to give it samples.
    pub fn performer_mut(&mut self) -> Option<&mut Performer> {
        self.performer.as_mut()
    }

    /// The reach, until its blend is complete.
    pub fn reach(&self) -> Option<&ReachSource> {
        self.reach.as_ref()
    }

    /// The reach, to change it.
    pub fn reach_mut(&mut self) -> Option<&mut ReachSource> {
        self.reach.as_mut()
    }

    /// Takes out the reach, so that another can continue from it. One that blends already has ended.
    pub fn take_reach(&mut self) -> Option<ReachSource> {
        self.reach.take().filter(|reach| reach.leaving_secs().is_none())
    }

    /// Sets a key pose as target, instead of any other source. False if unchanged.
    ///
    /// # Errors
    /// When there is no such pose: which there are.
    pub fn aim(&mut self, name: &str) -> Result<bool, OrderError> {
        let is_alone = self.reach.is_none() && !self.is_performed();
        if is_alone && self.key_poses().is_some_and(|poses| poses.is_at(name)) {
            return Ok(false);
        }
        self.follow_key_poses(|poses| poses.aim(name))?;
        Ok(true)
    }

    /// Starts a pose graph, instead of any other source.
    ///
    /// # Errors
    /// When there is no such graph or state: which there are.
    pub fn start_graph(&mut self, name: &str, state: Option<&str>) -> Result<(), OrderError> {
        self.follow_key_poses(|poses| poses.start_graph(name, state))
    }

    /// Follows its performer, or its own source instead. A clip ends then, and key poses remain.
    ///
    /// # Errors
    /// When it has no performer.
    pub fn follow_performer(&mut self, on: bool) -> Result<(), OrderError> {
        let Some(performer) = &mut self.performer else { return Err(no_performer()) };
        performer.follow(on);
        if on {
            match self.key_poses_mut() {
                Some(poses) => poses.rest(),
                None => (self.own, self.own_from) = (Box::new(self.first_poses()), Origin::KeyPoses),
            }
        }
        Ok(())
    }

    /// Changes the key poses and follows them; those of a character that has followed something else begin in their first pose.
    fn follow_key_poses(
        &mut self,
        change: impl FnOnce(&mut KeyPoses) -> Result<(), OrderError>,
    ) -> Result<(), OrderError> {
        if let Some(poses) = self.key_poses_mut() {
            change(poses)?;
        } else {
            let mut poses = self.first_poses();
            change(&mut poses)?;
            (self.own, self.own_from) = (Box::new(poses), Origin::KeyPoses);
        }
        self.leave_others();
        Ok(())
    }

    /// A performer is left, a reach ends.
    fn leave_others(&mut self) {
        if let Some(reach) = &mut self.reach {
            reach.leave();
        }
        if let Some(performer) = &mut self.performer {
            performer.leave();
        }
    }

    fn is_performed(&self) -> bool {
        self.performer.as_ref().is_some_and(Performer::is_followed)
    }

    /// The source with precedence, apart from a reach: the performer, else its own.
    fn acting(&self) -> &dyn Source {
        match &self.performer {
            Some(performer) if performer.is_followed() => performer.source(),
            _ => self.own.as_ref(),
        }
    }

    /// The wanted pose at a time of the stage \[s\]: that of the reach if there is one, which blends to the source beside it; else
    /// of the performer that is followed; else of its own source, to which the one before blends. This is the one place that decides
    /// precedence.
    pub fn wanted(&self, at_secs: f64, wanted: &mut Wanted) {
        wanted.smooth = None;
        match self.reach.as_ref().map(|reach| (reach, reach.leaving_secs())) {
            None => self.wanted_without_reach(at_secs, wanted),
            Some((reach, None)) => reach.wanted(at_secs, wanted),
            Some((reach, Some(since_secs))) => {
                let to = |secs: f64, wanted: &mut Wanted| self.wanted_without_reach(secs, wanted);
                self.hand_over(reach, to, since_secs, at_secs, wanted);
            }
        }
    }

    fn wanted_without_reach(&self, at_secs: f64, wanted: &mut Wanted) {
        match &self.before {
            Some((before, _, since_secs)) if !self.is_performed() => {
                let to = |secs: f64, wanted: &mut Wanted| self.own.wanted(secs, wanted);
                self.hand_over(before.as_ref(), to, *since_secs, at_secs, wanted);
            }
            _ => self.acting().wanted(at_secs, wanted),
        }
    }

    /// What is wanted between two sources.
    fn hand_over(
        &self,
        from: &dyn Source,
        to: impl Fn(f64, &mut Wanted),
        since_secs: f64,
        at_secs: f64,
        wanted: &mut Wanted,
    ) {
        let mut pose_at = |secs: f64| {
            from.wanted(secs, wanted);
            self.place(wanted);
            let before = wanted.pose;
            to(secs, wanted);
            self.place(wanted);
            handed_over(&before, &wanted.pose, secs - since_secs)
        };
        let (now, next) = (pose_at(at_secs), pose_at(at_secs + self.step_secs));
        wanted.follow_poses(&now, &next, self.step_secs);
    }

    /// The gains of the joints; a reach uses their own gains.
    pub fn firmness(&self, wanted: &mut Wanted) {
        match &self.reach {
            Some(reach) => reach.firmness(wanted),
            None => self.acting().firmness(wanted),
        }
    }

    /// Whether the wanted pose has root motion.
    pub fn root(&self) -> Root {
        let hands_over = self.reach.is_some() || self.before.is_some();
        if hands_over { Root::Placed } else { self.acting().root() }
    }

    /// The whole wanted pose at a time of the stage \[s\].
    pub fn pose_at(&self, at_secs: f64) -> Pose {
        let mut wanted = Wanted::STANDING;
        self.wanted(at_secs, &mut wanted);
        self.place(&mut wanted);
        wanted.pose
    }

    /// The pose of its own source at a time of the stage \[s\], whether it plays or not.
    pub fn own_pose_at(&self, at_secs: f64) -> Pose {
        let mut wanted = Wanted::STANDING;
        self.own.wanted(at_secs, &mut wanted);
        self.place(&mut wanted);
        wanted.pose
    }

    fn place(&self, wanted: &mut Wanted) {
        if wanted.root == Root::Free {
            wanted.pose = self.root.pose(&self.body, wanted);
        }
    }

    /// Places a wanted pose without root motion, once a motion frame.
    pub fn place_root(&mut self, character: &CharacterFrame, wanted: &mut Wanted) {
        self.root.place(&self.body, character, wanted);
    }

    /// A tracker takes over the body: without root motion the root starts at the body's position. `sole_m` as in
    /// [`FreeRoot::at`].
    pub fn begin_root(&mut self, character: &CharacterFrame, sole_m: Option<f64>) {
        self.root = FreeRoot::at(&character.pose(), sole_m);
        if sole_m.is_some() {
            self.root.stand_where_it_is(character);
        }
    }

    /// Pins are on again: without root motion the root starts at the body's position.
    pub fn stand_where_it_is(&mut self, character: &CharacterFrame) {
        if self.root() == Root::Free {
            self.root.stand_where_it_is(character);
        }
    }

    /// A signal for pose graphs.
    pub fn signal(&mut self, word: &str) {
        self.own.signal(word);
    }

    /// Starts at the body's present pose: something else has moved it until now.
    pub fn match_body(&mut self, character: &CharacterFrame) {
        self.own.match_body(character);
    }

    /// Advances all sources by a step, also those that do not play. Events are appended to `events`. `own` is the
    /// character's index in the frame; without the layer of key poses, graphs stay in their states.
    pub fn advance(&mut self, frame: &Frame, own: CharacterId, has_poses_layer: bool, events: &mut Vec<SourceEvent>) {
        let now_secs = frame.time_secs;
        let understudy = self.performer.as_ref().filter(|performer| performer.has_understudy_on());
        let understudy = understudy.map(|_| self.pose_at(now_secs));
        if let Some(performer) = &mut self.performer {
            if let Some(body) = frame.character(own) {
                performer.source_mut().body_is_at(body.part(Node::Hips).position);
            }
            let change = performer.advance(now_secs, self.step_secs, understudy.as_ref());
            events.extend(change.map(SourceEvent::Stream));
            if change.is_some_and(|change| change.replaces_understudy) {
                // There is one.
                let _ = self.follow_performer(true);
            }
        }
        match self.reach.as_mut().map_or(ReachStep::Nothing, |reach| reach.step(frame)) {
            ReachStep::Nothing => {}
            ReachStep::Arrives(arrival) => events.push(SourceEvent::Reach(arrival)),
            ReachStep::Leaves { standing, left_secs } => {
                self.root.stand_at(&standing);
                if let Some(left_secs) = left_secs {
                    self.own.resume(&self.body, left_secs, now_secs, &standing);
                }
            }
            ReachStep::Over => self.reach = None,
        }
        if self.before.as_ref().is_some_and(|(.., since_secs)| now_secs - since_secs >= HAND_OVER_SECS) {
            self.before = None;
        }
        let moment = Moment { frame, own, body: &self.body, step_secs: self.step_secs, has_poses_layer };
        if let Some((before, ..)) = &mut self.before {
            before.advance(&moment, events);
        }
        self.own.advance(&moment, events);
    }
}

/// The error without a performer.
pub fn no_performer() -> OrderError {
    let problem = "it has no performer; write source = { live = {} } in its table";
    OrderError::new(OrderErrorKind::NotHonoured, problem)
}
