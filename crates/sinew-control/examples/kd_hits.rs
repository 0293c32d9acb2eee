//! What a hit of 20 N s on the upper body does to a body that the tracker `kd` holds, and what its pins spend:
//! `cargo run -p sinew-control --example kd_hits`, with the name of a preset for another than `default`,
//! and `rigid` for a trunk that does not give way.

#[path = "../tests/all/performer/mod.rs"]
mod performer;

use glam::DVec3;
use performer::{Hit, Performer, standing};
use sinew_body::humanoid::Node;
use sinew_control::tracker::{KdPreset, KdSettings};
use sinew_testkit::mocap;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let preset = KdPreset::ALL.into_iter().find(|preset| words.iter().any(|word| word == preset.name()));
    let yields = !words.iter().any(|word| word == "rigid");
    let settings = KdSettings { yields, ..KdSettings::of(preset.unwrap_or_default()) };
    let mut performers = vec![("stands", standing(6.0))];
    if let Some(folder) = mocap() {
        performers.push(("walks", Performer::read(&folder.join("accad_bvh/Female1_B03_Walk1.bvh"))));
        performers.push(("boxes", Performer::read(&folder.join("cmu_bvh_daz/13_18.bvh"))));
    }
    println!(
        "performer  part           from   own cm  peak cm  after s  back s  feet cm  sunk cm  pins N  pins W  work J"
    );
    for (name, performer) in &performers {
        for node in
            [Node::Chest, Node::Head, Node::LeftShoulder, Node::LeftUpperArm, Node::LeftLowerArm, Node::LeftHand]
        {
            for (from, direction) in
                [("front", DVec3::NEG_Z), ("back", DVec3::Z), ("left", DVec3::NEG_X), ("right", DVec3::X)]
            {
                let hit = Hit::of(performer, &settings, node, direction * 20.0, 1.0);
                println!(
                    "{name:10} {:14} {from:6} {:6.1} {:8.1} {:8.2} {:7.2} {:8.1} {:8.1} {:7.0} {:7.0} {:7.1}",
                    node.part().name(),
                    hit.own_m * 100.0,
                    hit.peak_m * 100.0,
                    hit.peak_secs,
                    hit.back_secs,
                    hit.feet_m * 100.0,
                    hit.sunk_m * 100.0,
                    hit.force_n,
                    hit.power_w,
                    hit.work_j
                );
            }
        }
    }
}
