//! A performance on a virtual clock.

use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_control::perform::{LiveSettings, LiveSource};
use sinew_live::vmc::VmcReader;
use sinew_live::{ClipPlayer, Impairment};
use sinew_motion::formats::{MotionFile, ReadOptions};
use sinew_testkit::capture;

/// The rate of the physics \[Hz\].
pub const PHYSICS_HZ: f64 = 240.0;

pub fn player(name: &str, hz: f64) -> Option<ClipPlayer> {
    let file = MotionFile::read(&capture(name)?, &ReadOptions::default()).unwrap();
    Some(ClipPlayer::new(&file, hz).unwrap())
}

/// Eight seconds of a walk whose fastest point, a toe, moves by 16.6 mm in a step of physics.
pub const WALK: &str = "accad_bvh/Female1_B03_Walk1.bvh";

/// One performer and one character.
pub struct Rehearsal<'a> {
    pub player: &'a ClipPlayer,
    pub impairment: Impairment,
    /// How fast the sender's clock runs \[1\].
    pub clock: f64,
    /// Frames that are not sent at all.
    pub is_silent: Box<dyn Fn(u64) -> bool + 'a>,
    pub body: Body,
    pub source: LiveSource,
    pub malformed: u64,
    reader: VmcReader,
    next: u64,
    /// What is on its way, by arrival.
    under_way: Vec<(f64, Vec<u8>)>,
    step: u64,
}

impl<'a> Rehearsal<'a> {
    pub fn new(player: &'a ClipPlayer, impairment: Impairment) -> Rehearsal<'a> {
        Rehearsal::on(player, impairment, player.body().clone())
    }

    pub fn on(player: &'a ClipPlayer, impairment: Impairment, body: Body) -> Rehearsal<'a> {
        let mut first = Pose::STANDING;
        first.hips_position.y = sinew_world::hips_over_soles_m(&body, &first);
        Rehearsal {
            player,
            impairment,
            clock: 1.0,
            is_silent: Box::new(|_| false),
            source: LiveSource::new(&body, DVec3::ZERO, 0.0, &first, LiveSettings::default()),
            body,
            malformed: 0,
            reader: VmcReader::new(),
            next: 0,
            under_way: Vec::new(),
            step: 0,
        }
    }

    pub fn now_secs(&self) -> f64 {
        self.step as f64 / PHYSICS_HZ
    }

    /// One step of physics.
    pub fn step(&mut self) {
        let now = self.now_secs();
        let sent = |number: u64| number as f64 * self.player.interval_secs();
        while sent(self.next) / self.clock <= now {
            if !(self.is_silent)(self.next) {
                for (arrival, bytes) in self.player.datagrams(self.next, &self.impairment) {
                    let late = arrival - sent(self.next);
                    self.under_way.push((sent(self.next) / self.clock + late, bytes));
                }
            }
            self.next += 1;
        }
        self.under_way.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        let due = self.under_way.partition_point(|(arrival, _)| *arrival <= now);
        for (arrival, bytes) in self.under_way.drain(..due) {
            let source = &mut self.source;
            let read = self.reader.datagram(&bytes, arrival, &mut |sample| source.receive(&sample, now));
            self.malformed += u64::from(read.is_err());
        }
        self.source.advance(now, 1.0 / PHYSICS_HZ);
        self.step += 1;
    }

    /// So many frames are sent, and all that is under way arrives.
    pub fn until_sent(&mut self, frames: u64, mut see: impl FnMut(&Rehearsal)) {
        while self.next < frames {
            self.step();
            see(self);
        }
        self.is_silent = Box::new(|_| true);
        for _ in 0..PHYSICS_HZ as usize / 2 {
            self.step();
            see(self);
        }
    }

    /// Where all joints and the ends of hands, feet and head are.
    pub fn places(&self) -> Vec<DVec3> {
        let pose = self.source.pose();
        let joints = pose.positions(&self.body);
        let ends = Node::ALL.map(|node| joints[node.index()] + pose.world[node.index()] * self.body.link(node).tip);
        joints.into_iter().chain(ends).collect()
    }
}

/// The farthest that anything moved between two looks.
#[derive(Default)]
pub struct Farthest {
    before: Option<Vec<DVec3>>,
    pub m: f64,
}

impl Farthest {
    pub fn look(&mut self, places: Vec<DVec3>) -> f64 {
        let mut way = 0.0;
        if let Some(before) = &self.before {
            way = before.iter().zip(&places).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
            self.m = self.m.max(way);
        }
        self.before = Some(places);
        way
    }
}
