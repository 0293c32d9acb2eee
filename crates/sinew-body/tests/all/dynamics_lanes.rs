//! Characters side by side get what each would get alone.
#![cfg(feature = "lanes")]

use crate::dynamics_common::bodies::{self, Root};
use crate::dynamics_common::random::{self, Random};
use sinew_body::dynamics::{
    Accelerations, Base, Coordinates, Inverse, Joint, Real, State, Sym3, Tree, V3, Workspace, aba, inverse, rnea,
};

/// Bodies of one build whose masses and lengths differ.
fn scaled(tree: &Tree<f64>, factor: f64) -> Tree<f64> {
    let links = tree.links().iter().map(|link| {
        let mut link = *link;
        link.offset = link.offset * factor;
        link.centre = link.centre * factor;
        link.mass *= factor;
        let inertia = link.inertia.lane(0) * (factor * factor * factor);
        link.inertia = Sym3::from_lanes(|_| inertia);
        link
    });
    Tree::new(links.collect()).expect("a tree")
}

fn lanes_equal_the_scalar<S: Real>() {
    let (tree, coordinates) = bodies::composite(&bodies::CANONICAL, Root::Quaternion, |_| true);
    let n = tree.dofs();
    let trees: Vec<Tree<f64>> = (0..S::LANES).map(|lane| scaled(&tree, 1.0 - 0.05 * lane as f64)).collect();
    let mut random = Random::new(13);
    let q: Vec<Vec<f64>> = trees.iter().map(|_| random::positions(&mut random, &coordinates, 0.9)).collect();
    let qd: Vec<Vec<f64>> = trees.iter().map(|_| random.numbers(n, 2.0)).collect();
    let qdd: Vec<Vec<f64>> = trees.iter().map(|_| random.numbers(n, 10.0)).collect();
    let gather = |rows: &[Vec<f64>]| -> Vec<S> {
        (0..rows[0].len()).map(|index| S::from_lanes(|lane| rows[lane][index])).collect()
    };

    let wide_tree = Tree::<S>::side_by_side(&trees.iter().collect::<Vec<_>>()).expect("one build");
    let joints = coordinates.joints().iter().map(|joint| match joint {
        Joint::Turns(run) => Joint::Turns(run.clone()),
        Joint::Slides(run) => Joint::Slides(run.clone()),
        _ => Joint::Spherical,
    });
    let wide_coordinates = Coordinates::<S>::new(&wide_tree, joints.collect()).expect("joints");
    let gravity = glam::DVec3::new(0.0, -9.81, 0.0);
    let wide_base = Base::at_rest(V3::<S>::splat(gravity));
    let mut wide_state = State::at_rest(&wide_tree);
    wide_coordinates.set(&wide_tree, &gather(&q), &gather(&qd), &mut wide_state);
    let mut wide_workspace = Workspace::new(&wide_tree);
    let (mut wide_tau, mut wide_second) = (vec![S::ZERO; n], vec![S::ZERO; n]);
    let mut wide_out = Inverse::new(&wide_tree);
    let accelerations = gather(&qdd);
    let accelerations = Accelerations::Coordinates(&accelerations);
    rnea(&wide_tree, &wide_base, &wide_state, accelerations, &[], &mut wide_workspace, &mut wide_tau);
    inverse(&wide_tree, &wide_base, &wide_state, &[], &mut wide_workspace, &mut wide_out);
    aba(&wide_tree, &wide_base, &wide_state, &wide_tau, &[], &mut wide_workspace, &mut wide_second);

    let base = Base::at_rest(gravity.into());
    for (lane, tree) in trees.iter().enumerate() {
        let mut state = State::at_rest(tree);
        coordinates.set(tree, &q[lane], &qd[lane], &mut state);
        let (mut workspace, mut tau, mut second) = (Workspace::new(tree), vec![0.0; n], vec![0.0; n]);
        let mut out = Inverse::new(tree);
        rnea(tree, &base, &state, Accelerations::Coordinates(&qdd[lane]), &[], &mut workspace, &mut tau);
        inverse(tree, &base, &state, &[], &mut workspace, &mut out);
        aba(tree, &base, &state, &tau, &[], &mut workspace, &mut second);
        // The same operations in the same order: the same bits.
        let same = |what: &str, ours: &[S], theirs: &[f64]| {
            let ours: Vec<f64> = ours.iter().map(|number| number.lane(lane)).collect();
            assert_eq!(ours, theirs, "{what}");
        };
        same("rnea", &wide_tau, &tau);
        same("inverse tau", &wide_out.tau, &out.tau);
        same("inverse mass", wide_out.mass.as_slice(), out.mass.as_slice());
        same("aba", &wide_second, &second);
    }
}

#[test]
fn four_lanes_equal_four_lone_characters() {
    lanes_equal_the_scalar::<wide::f64x4>();
}

#[test]
fn eight_lanes_equal_eight_lone_characters() {
    lanes_equal_the_scalar::<wide::f64x8>();
}
