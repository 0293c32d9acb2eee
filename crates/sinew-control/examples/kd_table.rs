//! How well the tracker `kd` follows captured motion, for each preset and clip, with and without feed-forward:
//! `SINEW_SHARED=... cargo run -p sinew-control --example kd_table`. Add `default` for that preset alone, `02_01` for that clip, `absolute` for the damping
//! as the paper prints it.

#[path = "../tests/all/performer/mod.rs"]
mod performer;

use performer::{BASKETBALL, BOXING, Following, Performer, RUNS, WALKS};
use sinew_control::tracker::{KdDamping, KdPreset, KdSettings};
use sinew_testkit::mocap;

fn main() {
    let Some(folder) = mocap() else { return };
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let damping =
        if arguments.iter().any(|word| word == "absolute") { KdDamping::Absolute } else { KdDamping::Relative };
    let only: Vec<KdPreset> =
        KdPreset::ALL.into_iter().filter(|preset| arguments.iter().any(|word| word == preset.name())).collect();
    let clips: Vec<&String> = arguments.iter().filter(|word| word.contains('_')).collect();
    let presets = if only.is_empty() { KdPreset::ALL.to_vec() } else { only };
    println!(
        "{:8} {:4} {:32} joints deg  root cm  centres cm  lag ms  skate cm/s (own)  sunk cm  tilt deg",
        "preset", "fed", "clip"
    );
    for clip in WALKS.iter().chain(&RUNS).chain(&BOXING).chain(&BASKETBALL) {
        if clips.iter().any(|_| !clips.iter().any(|part| clip.contains(part.as_str()))) {
            continue;
        }
        let performer = Performer::read(&folder.join(clip));
        let name = clip.rsplit('/').next().unwrap_or(clip);
        // A balloon holds nobody up.
        for preset in presets.iter().filter(|preset| preset.gains().k_p > 0.0) {
            for feed_forward in [true, false] {
                let settings = KdSettings { feed_forward, damping, ..KdSettings::of(*preset) };
                let found = Following::of(&performer, settings);
                println!(
                    "{:8} {:4} {name:32} {:10.2} {:8.2} {:11.2} {:7.1} {:10.1} ({:4.1}) {:8.1} {:9.1}{}",
                    preset.name(),
                    if feed_forward { "yes" } else { "no" },
                    found.joint_deg,
                    found.root_m * 100.0,
                    found.centres_m * 100.0,
                    found.lag_secs * 1e3,
                    found.skate_m_s[0] * 100.0,
                    found.skate_m_s[1] * 100.0,
                    found.sunk_m * 100.0,
                    found.tilted_deg,
                    if found.fell() { "  FELL" } else { "" }
                );
            }
        }
    }
}
