//! "We see how the effect of a pull on the object causes an immediate physical response in the other character."

use super::stage::{centre, lower_ankle_m, shipped, until};
use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_stage::Stage;

fn upper(stage: &Stage, who: &str) -> [DVec3; 3] {
    [Node::LeftHand, Node::RightHand, Node::Chest].map(|node| centre(stage, who, node))
}

#[test]
fn who_pulls_draws_the_other_closer_at_once_and_both_keep_their_feet() {
    // Blue alone heaves, from 1 s on; without blue's heave red is where its own performer has it.
    let alone = [("graphs.blue.states.hold.to.0.after_secs", "100"), ("graphs.red.states.hold.to.0.after_secs", "100")];
    let (mut pulled, mut quiet) = (shipped("tug-of-war", &alone[1..]), shipped("tug-of-war", &alone));
    until(&mut pulled, 1.0, |_| ());
    until(&mut quiet, 1.0, |_| ());
    let (mut first, mut most) = (None, DVec3::ZERO);
    for step in 0..360 {
        pulled.step();
        quiet.step();
        let moved = upper(&pulled, "red")[0] - upper(&quiet, "red")[0];
        if moved.length() > 0.002 && first.is_none() {
            first = Some(f64::from(step) / 240.0);
        }
        if moved.length() > most.length() {
            most = moved;
        }
    }
    // The rope sags by a few centimetres before it is taut.
    assert!(first.unwrap() < 0.4, "{first:?}");
    // Towards blue, which stands at -z.
    assert!(most.z < -0.03, "{most}");
    until(&mut pulled, 8.0, |stage| {
        for who in ["blue", "red"] {
            let ankle = lower_ankle_m(stage, who);
            assert!(ankle < 0.13, "{who}: {ankle}");
        }
    });
}

#[test]
fn the_rope_is_one_rope() {
    let mut stage = shipped("tug-of-war", &[]);
    let pieces: Vec<usize> =
        (1..=16).map(|piece| stage.cast().prop(&format!("rope_{piece}")).unwrap().slot()).collect();
    let mut gap: f64 = 0.0;
    until(&mut stage, 8.0, |stage| {
        let props = &stage.frame().props;
        for pair in pieces.windows(2) {
            let end = props[pair[0]].point(DVec3::Y * 0.0625);
            let begin = props[pair[1]].point(DVec3::Y * -0.0625);
            gap = gap.max((end - begin).length());
        }
    });
    // A tenth of a piece.
    assert!(gap < 0.0125, "{gap} m between two pieces");
}
