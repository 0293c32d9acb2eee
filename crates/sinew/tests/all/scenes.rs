//! Every shipped scene without a controller runs, gives the bits of golden.json, and replays to them.

use crate::golden::scenes;
use sinew::jobs::run::{RunJob, replay, run};
use sinew::stage::Scene;
use sinew_testkit::repository;

scenes! {
    false:
    balance "balance"
    balloon "balloon"
    blend_wave "blend_wave"
    block "block"
    car "car"
    duel "duel"
    giant "giant"
    hop "hop"
    interactive "interactive"
    kick "kick"
    lean_back "lean_back"
    performer "performer"
    pick_up "pick_up"
    pile "pile"
    punch "punch"
    reach_a_apple "reach_a_apple"
    reach_b_basketball "reach_b_basketball"
    reach_bag "reach_bag"
    reach_bag_kd "reach_bag_kd"
    reach_c_full_step "reach_c_full_step"
    reach_d_half_step "reach_d_half_step"
    reach_e_stoop "reach_e_stoop"
    reach_f_squat "reach_f_squat"
    reach_g_low_ball "reach_g_low_ball"
    reach_h_high_apple "reach_h_high_apple"
    reach_moving "reach_moving"
    reach_walk "reach_walk"
    respond_balls "respond_balls"
    respond_cup "respond_cup"
    respond_obstacles "respond_obstacles"
    respond_platform "respond_platform"
    sit_on_box "sit_on_box"
    ski "ski"
    tetherball "tetherball"
    tug_of_war "tug-of-war"
    walk2d "walk2d"
}

#[test]
fn a_replay_with_another_gain_is_another_run_of_the_same_commands() {
    let scene = Scene::read(&repository("scenes/block.toml")).unwrap();
    let job = RunJob { for_secs: Some(0.5), ..RunJob::default() };
    let ran = run(scene, &job, &mut []).unwrap();
    let sets = [("characters.left.pose_gain".to_owned(), "2".to_owned())];
    let other = replay(&ran.take, &sets, Some(&repository("scenes")), None, &mut []).unwrap();
    assert_ne!(other.take.hash, ran.take.hash);
    assert_eq!(other.report.steps, ran.report.steps);
}
