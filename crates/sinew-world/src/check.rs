//! Checks whether a body makes a stable ragdoll: one call, numbers with their bounds, and the problems as text.

use crate::joint::violation;
use crate::{CharacterSpec, Drive, SpecError, World, WorldSettings, never_collide};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose, exp};
use std::fmt;

/// The result of [`check_ragdoll`].
#[derive(Clone, Debug, PartialEq)]
pub struct RagdollReport {
    /// The largest mass ratio of two neighbours, and the child of the two.
    pub mass_ratio: (f64, Node),
    /// Minimum margin of the rest pose (that of the spec) to a joint limit, with its joint \[rad\]; negative beyond a
    /// limit.
    pub room_rad: (f64, Node),
    /// Pairs that are not neighbours and overlap when standing: they never collide.
    pub overlaps: Vec<(Node, Node)>,
    /// Time until the limp body, laid on its back on the ground, sleeps \[s\]; `None` if it does not within
    /// [`CHECKED_SECS`].
    pub sleeps_after_secs: Option<f64>,
    /// Maximum displacement of a part in the rest of that time \[m\].
    pub limp_drift_m: f64,
    /// Maximum displacement of a part in [`CHECKED_SECS`] with springs in its joints and fixed hips \[m\].
    pub held_drift_m: f64,
    /// The largest gap at a joint at the end of either \[m\].
    pub gap_m: f64,
}

/// Duration of the simulation of the body at rest \[s\].
pub const CHECKED_SECS: f64 = 10.0;

impl RagdollReport {
    /// Maximum mass ratio of neighbours: an iterative solver cannot hold springs between more different masses.
    pub const MAX_MASS_RATIO: f64 = 60.0;
    /// Maximum excess of a rest pose over its limits \[rad\]: two degrees.
    pub const MIN_ROOM_RAD: f64 = -0.035;
    /// Maximum number of overlapping pairs: more mean that the shapes do not fit the bones.
    pub const MAX_OVERLAPS: usize = 30;
    /// Maximum drift of a body at rest \[m\].
    pub const MAX_DRIFT_M: f64 = 1e-3;
    /// Maximum gap of joints at rest \[m\].
    pub const MAX_GAP_M: f64 = 1e-3;

    /// The problems as text; empty for a stable ragdoll.
    pub fn faults(&self) -> Vec<String> {
        let mut faults = Vec::new();
        let (ratio, node) = self.mass_ratio;
        if ratio > Self::MAX_MASS_RATIO {
            let name = node.part().name();
            faults.push(format!(
                "{name} and its neighbour differ in mass by {ratio:.0}: springs between them will sag; make it heavier"
            ));
        }
        let (room, node) = self.room_rad;
        if room < Self::MIN_ROOM_RAD {
            let (name, degrees) = (node.part().name(), -room.to_degrees());
            faults.push(format!("{name} rests {degrees:.1}° beyond its limit; widen the limit to the pose"));
        }
        if self.overlaps.len() > Self::MAX_OVERLAPS {
            faults.push(format!("{} pairs of parts lie in each other; make the shapes thinner", self.overlaps.len()));
        }
        if self.sleeps_after_secs.is_none() {
            faults.push(format!("laid on the ground it does not come to rest within {CHECKED_SECS} s"));
        }
        for (drift, how) in [(self.limp_drift_m, "lying limp"), (self.held_drift_m, "held by springs")] {
            if drift > Self::MAX_DRIFT_M {
                faults.push(format!("{how} it drifts by {:.2} mm in {CHECKED_SECS} s", drift * 1e3));
            }
        }
        if self.gap_m > Self::MAX_GAP_M {
            faults.push(format!("its joints gape by {:.2} mm at rest", self.gap_m * 1e3));
        }
        faults
    }

    /// Whether there are no problems.
    pub fn is_sound(&self) -> bool {
        self.faults().is_empty()
    }
}

impl fmt::Display for RagdollReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (ratio, heavy) = self.mass_ratio;
        let (room, near) = self.room_rad;
        writeln!(f, "masses: neighbours differ by up to {ratio:.1} ({})", heavy.part().name())?;
        writeln!(f, "limits: the rest pose lies {:.1}° inside ({})", room.to_degrees(), near.part().name())?;
        writeln!(f, "shapes: {} pairs overlap standing and never collide", self.overlaps.len())?;
        match self.sleeps_after_secs {
            Some(secs) => writeln!(
                f,
                "limp on the ground: sleeps after {secs:.1} s, then drifts {:.3} mm",
                self.limp_drift_m * 1e3
            )?,
            None => writeln!(f, "limp on the ground: does not come to rest, drifts {:.3} mm", self.limp_drift_m * 1e3)?,
        }
        writeln!(f, "held by springs: drifts {:.3} mm in {CHECKED_SECS} s", self.held_drift_m * 1e3)?;
        write!(f, "joints: gape {:.3} mm at rest", self.gap_m * 1e3)?;
        for fault in self.faults() {
            write!(f, "\nfault: {fault}")?;
        }
        Ok(())
    }
}

/// Makes a ragdoll of a body and checks masses, limits around the spec's pose, overlaps, and drift over ten seconds,
/// lying limp and held by springs. Takes about half a second.
///
/// ```
/// use glam::DVec3;
/// use sinew_body::humanoid::{Body, Pose};
/// use sinew_world::{CharacterSpec, Surface, check_ragdoll};
/// let body = Body::standard(80.0, 1.7);
/// let spec = CharacterSpec { body, pose: Pose::STANDING, velocity: DVec3::ZERO, surface: Surface::BODY };
/// let report = check_ragdoll(&spec)?;
/// assert!(report.is_sound(), "{report}");
/// # Ok::<(), sinew_world::SpecError>(())
/// ```
///
/// # Errors
/// The body cannot be made into a ragdoll at all.
pub fn check_ragdoll(spec: &CharacterSpec) -> Result<RagdollReport, SpecError> {
    let body = &spec.body;
    let (mut mass_ratio, mut room_rad) = ((1.0, Node::Hips), (f64::INFINITY, Node::Hips));
    for node in Node::ALL {
        let Some(parent) = node.parent() else { continue };
        let (own, its) = (body.link(node).mass_kg, body.link(parent).mass_kg);
        let ratio = (own / its).max(its / own);
        if ratio > mass_ratio.0 {
            mass_ratio = (ratio, node);
        }
        let room = -violation(node, &body.link(node).limit, spec.pose.local(node).normalize());
        if room < room_rad.0 {
            room_rad = (room, node);
        }
    }
    let limp = lie(spec)?;
    let (held_drift_m, held_gap_m) = drift(spec)?;
    Ok(RagdollReport {
        mass_ratio,
        room_rad,
        overlaps: never_collide(body),
        sleeps_after_secs: limp.sleeps_after_secs,
        limp_drift_m: limp.drift_m,
        held_drift_m,
        gap_m: limp.gap_m.max(held_gap_m),
    })
}

struct Lying {
    sleeps_after_secs: Option<f64>,
    drift_m: f64,
    gap_m: f64,
}

/// Lays the limp body on its back.
fn lie(spec: &CharacterSpec) -> Result<Lying, SpecError> {
    let mut world = World::new(WorldSettings::default());
    let on_its_back = exp(DVec3::X * -std::f64::consts::FRAC_PI_2);
    let mut pose = Pose { hips_position: DVec3::ZERO, world: [on_its_back; Node::COUNT] };
    pose.hips_position.y = 1.02 * deepest_m(&spec.body, &pose);
    let id = world.add_character(CharacterSpec { pose, velocity: DVec3::ZERO, ..spec.clone() })?;
    let mut lying = Lying { sleeps_after_secs: None, drift_m: 0.0, gap_m: 0.0 };
    let mut rest = None;
    for _ in 0..steps(&world) {
        world.step();
        if lying.sleeps_after_secs.is_none() && world.is_asleep(id) {
            lying.sleeps_after_secs = Some(world.frame().time_secs);
            rest = Some(places(&world));
        }
    }
    lying.drift_m = rest.map_or(f64::INFINITY, |rest| farthest_apart(&rest, &places(&world)));
    lying.gap_m = world.largest_joint_gap_m();
    Ok(lying)
}

/// Fixes the body's hips and holds its joints by springs of 5 Hz: returns drift and largest gap.
fn drift(spec: &CharacterSpec) -> Result<(f64, f64), SpecError> {
    let mut world = World::new(WorldSettings { floor: None, ..WorldSettings::default() });
    let id = world.add_character(CharacterSpec { velocity: DVec3::ZERO, ..spec.clone() })?;
    let omega = std::f64::consts::TAU * 5.0;
    for node in Node::ALL {
        let inertia = world.outboard_inertia(id, node);
        let rotation = spec.pose.local(node);
        let (stiffness, damping) = (inertia * omega * omega, 2.0 * inertia * omega);
        world.set_drive(id, node, Drive { rotation, stiffness, damping, ..Drive::limp(0.0) });
    }
    world.set_forces(id, Node::Hips, false);
    // It sags first.
    for _ in 0..steps(&world) / 2 {
        world.step();
    }
    let (start, mut drift_m) = (places(&world), 0.0f64);
    for _ in 0..steps(&world) {
        world.step();
        drift_m = drift_m.max(farthest_apart(&start, &places(&world)));
    }
    Ok((drift_m, world.largest_joint_gap_m()))
}

fn steps(world: &World) -> usize {
    (CHECKED_SECS * world.settings().physics_hz) as usize
}

/// Extent of the body's shapes below its hips.
fn deepest_m(body: &Body, pose: &Pose) -> f64 {
    let positions = pose.positions(body);
    let reach = |node: Node| {
        let shape = body.link(node).shape;
        let end = |end: DVec3, radius_m: f64| radius_m - (positions[node.index()] + pose.world[node.index()] * end).y;
        end(shape.from, shape.from_radius_m).max(end(shape.to, shape.to_radius_m))
    };
    Node::ALL.into_iter().map(reach).fold(0.0, f64::max)
}

fn places(world: &World) -> [(DVec3, DQuat); Node::COUNT] {
    world.frame().characters[0].parts.map(|part| (part.centre, part.rotation))
}

fn farthest_apart(one: &[(DVec3, DQuat); Node::COUNT], other: &[(DVec3, DQuat); Node::COUNT]) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a.0 - b.0).length()).fold(0.0, f64::max)
}
