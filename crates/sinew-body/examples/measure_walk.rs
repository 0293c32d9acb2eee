//! Measures the mean walk of the normal walks in the shared motion-capture set and prints the table that
//! `src/walk/walk_table.rs` holds: `cargo run -p sinew-body --example measure_walk > rows.txt`. How well it went is told on
//! standard error.
//!
//! From each clip one gait cycle, the one whose ends agree best. Its poses become those of the 18-body humanoid, its
//! local rotations rotation vectors in anatomical frames, at 64 phases from the moment when the left foot is farthest
//! ahead of the hips. Vectors are averaged over the clips, then over the two sides: the right side, mirrored and half a
//! cycle later, is taken as another left one, so that the mean walker is symmetric. Last, every coordinate is fitted by a
//! Fourier series by least squares.
//!
//! What it does not do: it does not weigh the clips, and it takes no path of the hips: the generator sets that from
//! the standing foot.

use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Node, Person, Pose, Reduction, exp, log};
use sinew_motion::formats::{Parsed, amc, bvh};
use sinew_motion::{Humanoid, Limits, Part, Side, contacts, find_cycle, guess_space, heading, stature};
use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// The normal walks, one clip per person. Looked at and left out: 12_01, whose left foot and arms are turned by 26 and 38
/// degrees against all others'; sneaks, swaggers, stylised walks and walks with something in the hands.
const CLIPS: [&str; 7] = [
    "cmu_asfamc/02_01.amc",
    "cmu_asfamc/07_01.amc",
    "cmu_asfamc/08_01.amc",
    "cmu_asfamc/16_15.amc",
    "cmu_asfamc/35_01.amc",
    "accad_bvh/Female1_B03_Walk1.bvh",
    "dialects/bvhtoolbox_walk01.bvh",
];

/// Phases at which a cycle is looked at.
const PHASES: usize = 64;
/// Phases in which the left foot is flat on the floor in every clip.
const FLAT: std::ops::Range<usize> = 12..21;
/// Highest harmonic of the series.
const ORDER: usize = 5;

/// One person's cycle: a rotation vector \[rad\] for every phase and node, and how the person walked.
struct Measured {
    vectors: Vec<[DVec3; Node::COUNT]>,
    /// Hips from their even progress, in statures: left, up (from the mean), forward.
    hips: Vec<DVec3>,
    stature_m: f64,
    period_secs: f64,
    stride_m: f64,
    /// Phase at which the left foot lands, and at which it leaves.
    stance: Option<(f64, f64)>,
}

/// The rows of the table, from the motion-capture folder.
pub fn table(folder: &Path) -> Result<String, Box<dyn Error>> {
    let mut people = Vec::new();
    for name in CLIPS {
        let person = measure(&folder.join(name)).map_err(|error| format!("{name}: {error}"))?;
        eprintln!("{name}: {}", person.in_words());
        people.push(person);
    }
    eprintln!("{}", means(&people));
    let mean = symmetric_mean(&people);
    let mut table = String::new();
    for node in Node::ALL.into_iter().filter(|node| !node.is_right()) {
        writeln!(table, "    // {}\n    [", node.part())?;
        for axis in 0..3 {
            let degrees = |row: &[DVec3; Node::COUNT]| row[node.index()].to_array()[axis].to_degrees();
            let values: Vec<f64> = mean.iter().map(degrees).collect();
            let (series, residual) = fit(&values);
            // Adding 0 after rounding turns -0 into 0.
            let numbers: Vec<String> =
                series.iter().map(|value| format!("{:.3}", (value * 1000.0).round() / 1000.0 + 0.0)).collect();
            writeln!(table, "        [{}],", numbers.join(", "))?;
            // How far each person differs from the mean, root mean square over the cycle.
            let spread = people.iter().map(|person| {
                let own = symmetric_mean(std::slice::from_ref(person));
                let squares = own.iter().zip(&values).map(|(row, mean)| (degrees(row) - mean) * (degrees(row) - mean));
                format!("{:.0}", (squares.sum::<f64>() / PHASES as f64).sqrt())
            });
            eprintln!(
                "{} {}: the series leaves {residual:.2}°, people differ by {}°",
                node.part(),
                ["x", "y", "z"][axis],
                spread.collect::<Vec<_>>().join(" ")
            );
        }
        writeln!(table, "    ],")?;
    }
    Ok(table)
}

#[allow(dead_code, reason = "the test of the table uses the rest of this file")]
fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::var_os("SINEW_SHARED")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared"), PathBuf::from)
        .join("mocap");
    let table = table(&folder)?;
    // Four midline nodes and seven of the left side.
    assert_eq!(table.matches("    // ").count(), 11, "every node should have its rows");
    print!("{table}");
    Ok(())
}

impl Measured {
    fn in_words(&self) -> String {
        format!(
            "stature {:.3} m, {:.3} m/s, {:.1} steps/min, stride {:.3} statures, stance {:.3?}",
            self.stature_m,
            self.stride_m / self.period_secs,
            120.0 / self.period_secs,
            self.stride_m / self.stature_m,
            self.stance
        )
    }
}

fn read(path: &Path) -> Result<Parsed, Box<dyn Error>> {
    let bytes = std::fs::read(path)?;
    let limits = Limits::default();
    if path.extension().is_some_and(|extension| extension == "amc") {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        let skeleton = path.with_file_name(format!("{}.asf", name.split('_').next().unwrap_or_default()));
        Ok(amc::read(&bytes, &std::fs::read(skeleton)?, &limits)?)
    } else {
        Ok(bvh::read(&bytes, &limits)?)
    }
}

fn measure(path: &Path) -> Result<Measured, Box<dyn Error>> {
    let parsed = read(path)?;
    let humanoid = Humanoid::of(&parsed.clip, &[])?;
    let guess = guess_space(&parsed.clip, &humanoid, parsed.unit_m, parsed.world_from_source);
    let clip = guess.space.clip_to_world(&parsed.clip);
    let cycle = find_cycle(&clip, &humanoid).ok_or("nobody walks here")?;
    let stature_m = stature(&clip, &humanoid);
    let reduction = Reduction::new(&clip, &humanoid, stature_m, Person::default())?;
    let length = (cycle.last - cycle.first) as f64;
    // Position of the middle between the hip joints: rigs put the hips' own joint at will.
    let hips = |frame: usize| {
        let world = clip.world(frame);
        let joint = |part| humanoid.joint(part).map_or(DVec3::ZERO, |joint| world[joint].translation);
        0.5 * (joint(Part::LeftUpperLeg) + joint(Part::RightUpperLeg))
    };
    let (start, end) = (hips(cycle.first), hips(cycle.last));
    let way = DVec3::new(end.x - start.x, 0.0, end.z - start.z);
    let travel_from_world = heading(way).conjugate();
    // What differs between both ends of the cycle is taken out evenly.
    let closed = |values: &[DVec3], phase: f64| {
        let at = phase * length;
        let below = (at.floor() as usize).min(values.len() - 2);
        let value = values[below].lerp(values[below + 1], at - below as f64);
        value - (values[values.len() - 1] - values[0]) * (phase - 0.5)
    };
    let frames: Vec<usize> = (cycle.first..=cycle.last).collect();
    let mut poses: Vec<Pose> = frames.iter().map(|&frame| reduction.pose(&clip.world(frame))).collect();
    for (foot, own_foot) in [(Node::LeftFoot, Side::Left), (Node::RightFoot, Side::Right)] {
        let shift = if own_foot == cycle.foot { 0 } else { PHASES / 2 };
        level(&mut poses, foot, shift);
    }
    let tracks: Vec<Vec<DVec3>> = Node::ALL
        .iter()
        .map(|&node| {
            poses
                .iter()
                .map(|pose| {
                    let local = pose.local(node);
                    log(if node == Node::Hips { travel_from_world * local } else { local })
                })
                .collect()
        })
        .collect();
    let path: Vec<DVec3> = frames.iter().map(|&frame| travel_from_world * hips(frame) / stature_m).collect();
    let middle = path.iter().sum::<DVec3>() / path.len() as f64;
    let step = |index: usize| index as f64 / PHASES as f64;
    let mut vectors: Vec<[DVec3; Node::COUNT]> =
        (0..PHASES).map(|index| Node::ALL.map(|node| closed(&tracks[node.index()], step(index)))).collect();
    let mut hips: Vec<DVec3> = (0..PHASES).map(|index| closed(&path, step(index)) - middle).collect();
    let stands = contacts(&clip, &humanoid);
    let phase_of = |frame: usize| (frame as f64 - cycle.first as f64) / length;
    let stance = stands
        .stances(cycle.foot)
        .into_iter()
        .map(|(from, to)| (phase_of(from), phase_of(to)))
        .find(|(from, to)| from.abs() < 0.2 && (0.4..0.9).contains(to));
    if cycle.foot == Side::Right {
        vectors = vectors.iter().map(mirrored).collect();
        hips.iter_mut().for_each(|hips| hips.x = -hips.x);
    }
    Ok(Measured { vectors, hips, stature_m, period_secs: cycle.period_secs, stride_m: cycle.stride_m, stance })
}

/// Turns a foot's frame so that the flat foot is level, whatever the rig's rest pose has: its heading stays.
fn level(poses: &mut [Pose], foot: Node, shift: usize) {
    let frame = |phase: usize| (phase + shift) % PHASES * (poses.len() - 1) / PHASES;
    let turns: Vec<DQuat> = FLAT.map(|phase| poses[frame(phase)].world[foot.index()]).collect();
    let sum = turns.iter().fold(DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0), |sum, &turn| {
        if sum.dot(turn) < 0.0 { sum - turn } else { sum + turn }
    });
    let flat = sum.normalize();
    let level = flat.conjugate() * heading(flat * DVec3::Z);
    for pose in poses {
        pose.world[foot.index()] *= level;
    }
}

/// The mirror image of a pose, left for right. A rotation vector is an axial vector.
fn mirrored(row: &[DVec3; Node::COUNT]) -> [DVec3; Node::COUNT] {
    Node::ALL.map(|node| {
        let other = Node::of(node.part().mirrored());
        let v = row[other.index()];
        DVec3::new(v.x, -v.y, -v.z)
    })
}

fn symmetric_mean(people: &[Measured]) -> Vec<[DVec3; Node::COUNT]> {
    // Rotations are averaged about the clips' own mean, where their vectors are small: arms turn far.
    (0..PHASES)
        .map(|index| {
            let later = (index + PHASES / 2) % PHASES;
            let rows: Vec<[DVec3; Node::COUNT]> =
                people.iter().flat_map(|person| [person.vectors[index], mirrored(&person.vectors[later])]).collect();
            Node::ALL.map(|node| {
                let first = rows.iter().map(|row| row[node.index()]).sum::<DVec3>() / rows.len() as f64;
                let about: DQuat = exp(first);
                let rest = rows.iter().map(|row| log(about.conjugate() * exp(row[node.index()]))).sum::<DVec3>()
                    / rows.len() as f64;
                log(about * exp(rest))
            })
        })
        .collect()
}

/// Mean, then cosine and sine of each harmonic; and the root mean square of what is left. On even phases the least
/// squares are plain projections.
fn fit(values: &[f64]) -> ([f64; 1 + 2 * ORDER], f64) {
    let count = values.len() as f64;
    let mut series = [0.0; 1 + 2 * ORDER];
    series[0] = values.iter().sum::<f64>() / count;
    let angle = |index: usize, harmonic: usize| std::f64::consts::TAU * (harmonic * index) as f64 / count;
    for harmonic in 1..=ORDER {
        let project = |wave: fn(f64) -> f64| {
            2.0 / count
                * values.iter().enumerate().map(|(index, value)| value * wave(angle(index, harmonic))).sum::<f64>()
        };
        series[2 * harmonic - 1] = project(libm::cos);
        series[2 * harmonic] = project(libm::sin);
    }
    let left: f64 = values
        .iter()
        .enumerate()
        .map(|(index, value)| {
            let model = (1..=ORDER).fold(series[0], |sum, harmonic| {
                let (sin, cos) = libm::sincos(angle(index, harmonic));
                sum + series[2 * harmonic - 1] * cos + series[2 * harmonic] * sin
            });
            (value - model) * (value - model)
        })
        .sum();
    (series, (left / count).sqrt())
}

/// How these people walked in the mean.
fn means(people: &[Measured]) -> String {
    let mean = |value: &dyn Fn(&Measured) -> f64| people.iter().map(value).sum::<f64>() / people.len() as f64;
    let reach = |axis: usize| {
        mean(&|person: &Measured| {
            let values = person.hips.iter().map(|hips| hips.to_array()[axis]);
            values.clone().fold(f64::MIN, f64::max) - values.fold(f64::MAX, f64::min)
        })
    };
    let stances: Vec<(f64, f64)> = people.iter().filter_map(|person| person.stance).collect();
    let count = stances.len() as f64;
    format!(
        "period {:.4} s, stride {:.4} statures, speed {:.4} statures/s; hips' whole range in statures: sideways {:.4}, up \
         {:.4}, forward {:.4}; left stance from phase {:.3} to {:.3}",
        mean(&|p| p.period_secs),
        mean(&|p| p.stride_m / p.stature_m),
        mean(&|p| p.stride_m / p.stature_m / p.period_secs),
        reach(0),
        reach(1),
        reach(2),
        stances.iter().map(|stance| stance.0).sum::<f64>() / count,
        stances.iter().map(|stance| stance.1).sum::<f64>() / count
    )
}
