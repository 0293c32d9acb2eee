//! Every number of the reference files, which another program made, by both ways of cutting the body into joints.

use crate::dynamics_common::bodies::{self, Body, Root};
use crate::dynamics_common::vectors::{FILES, as_chain, as_composite, load, numbers, vector};
use serde_json::Value;
use sinew_body::dynamics::{
    Accelerations, Base, Inverse, Links, M3, MassMatrix, PointForce, State, V3, Workspace, aba, crba, inverse,
    kinematics, kinetic_energy, point_jacobian, potential_energy, rnea,
};

/// The files' own tolerance.
const TOLERANCE: f64 = 1e-9;

fn close(what: &str, ours: &[f64], theirs: &[f64]) {
    assert_eq!(ours.len(), theirs.len(), "{what}");
    for (index, (a, b)) in ours.iter().zip(theirs).enumerate() {
        assert!((a - b).abs() <= TOLERANCE * b.abs().max(1.0), "{what}[{index}]: {a} is not {b}");
    }
}

fn rows(matrix: M3<f64>) -> Vec<f64> {
    matrix.transpose().columns.iter().flat_map(|row| row.to_array()).collect()
}

fn agrees(name: &str, file: &Value, (tree, coordinates): &Body, link_of: &[Option<usize>]) {
    let n = tree.dofs();
    let [q, qd, qdd] = ["q", "qd", "qdd"].map(|key| numbers(&file[key]));
    let base = Base::at_rest(vector(&file["gravity"]));
    let (mut state, mut links) = (State::at_rest(tree), Links::new(tree));
    let (mut workspace, mut tau) = (Workspace::new(tree), vec![0.0; n]);
    coordinates.set(tree, &q, &qd, &mut state);
    kinematics(tree, &base, &state, &mut links);

    for fk in file["fk"].as_array().expect("fk") {
        let joint = fk["joint"].as_u64().expect("an index") as usize;
        let Some(link) = link_of[joint] else { continue };
        close(&format!("{name} R {joint}"), &rows(links.link(link).rotation), &numbers(&fk["R"]));
        close(&format!("{name} p {joint}"), &links.origin(link).to_array(), &numbers(&fk["p"]));
    }

    let mut forces = Vec::new();
    for ext in file["ext"].as_array().expect("ext") {
        let joint = ext["body_joint"].as_u64().expect("an index") as usize;
        let link = link_of[joint].expect("a body");
        let point = links.point(link, vector(&ext["local_point"]));
        close(&format!("{name} point"), &point.to_array(), &numbers(&ext["world_point"]));
        forces.push(PointForce { link, point, force: vector(&ext["force"]) });
        let mut columns = vec![V3::ZERO; n];
        point_jacobian(tree, &state, &links, link, point, &mut columns);
        let by_row: Vec<f64> = (0..3).flat_map(|k| columns.iter().map(move |column| column.to_array()[k])).collect();
        close(&format!("{name} J"), &by_row, &numbers(&ext["J"]));
    }

    rnea(tree, &base, &state, Accelerations::Coordinates(&qdd), &[], &mut workspace, &mut tau);
    close(&format!("{name} tau_rnea"), &tau, &numbers(&file["tau_rnea"]));
    rnea(tree, &base, &state, Accelerations::Coordinates(&qdd), &forces, &mut workspace, &mut tau);
    close(&format!("{name} tau_ext"), &tau, &numbers(&file["tau_ext"]));
    let mut second = vec![0.0; n];
    aba(tree, &base, &state, &tau, &forces, &mut workspace, &mut second);
    // Forward dynamics divides by the smallest inertia: allow for the condition of M.
    for (a, b) in second.iter().zip(&qdd) {
        assert!((a - b).abs() < 1e-8 * b.abs().max(1.0), "{name} aba: {a} is not {b}");
    }
    rnea(tree, &base, &state, Accelerations::Relative, &[], &mut workspace, &mut tau);
    close(&format!("{name} tau_bias_h"), &tau, &numbers(&file["tau_bias_h"]));

    let theirs = numbers(&file["M"]);
    let mut mass = MassMatrix::new(tree);
    crba(tree, &base, &state, &mut workspace, &mut mass);
    close(&format!("{name} M"), mass.as_slice(), &theirs);
    let mut both = Inverse::new(tree);
    inverse(tree, &base, &state, &forces, &mut workspace, &mut both);
    close(&format!("{name} fused M"), both.mass.as_slice(), &theirs);
    rnea(tree, &base, &state, Accelerations::Relative, &forces, &mut workspace, &mut tau);
    close(&format!("{name} fused tau"), &both.tau, &tau);

    close(&format!("{name} T"), &[kinetic_energy(tree, &links)], &numbers(&file["kinetic_energy"]));
    close(&format!("{name} V"), &[potential_energy(tree, &base, &links)], &numbers(&file["potential_energy"]));

    coordinates.set(tree, &q, &vec![0.0; n], &mut state);
    rnea(tree, &base, &state, Accelerations::Relative, &[], &mut workspace, &mut tau);
    close(&format!("{name} tau_gravity"), &tau, &numbers(&file["tau_gravity"]));
}

#[test]
fn chains_of_single_axes_reproduce_every_reference_number() {
    for name in FILES {
        let Some(file) = load(name) else { return };
        let (body, link_of) = as_chain(&file);
        agrees(name, &file, &body, &link_of);
    }
}

#[test]
fn composite_joints_reproduce_every_reference_number() {
    for name in FILES {
        let Some(file) = load(name) else { return };
        let (body, link_of) = as_composite(&file);
        agrees(name, &file, &body, &link_of);
    }
}

#[test]
fn the_canonical_table_is_the_body_of_the_reference_file() {
    let Some(file) = load("humanoid42_random") else { return };
    for ((ours, _), (theirs, _)) in [
        (bodies::composite(&bodies::CANONICAL, Root::Turns, |_| true), as_composite(&file).0),
        (bodies::chain(&bodies::CANONICAL), as_chain(&file).0),
    ] {
        assert_eq!(ours.dofs(), 42);
        for (a, b) in ours.links().iter().zip(theirs.links()) {
            // The table is rounded to 12 digits.
            let same = |a: V3<f64>, b: V3<f64>| (a - b).dot(a - b) < 1e-22;
            assert!(a.parent == b.parent && a.axes == b.axes && a.freedom == b.freedom);
            assert!(same(a.offset, b.offset) && same(a.centre, b.centre) && (a.mass - b.mass).abs() < 1e-11);
            assert!((0..3).all(|k| same(a.inertia.columns()[k], b.inertia.columns()[k])));
        }
        for (a, b) in ours.parent_of_dof().iter().zip(theirs.parent_of_dof()) {
            assert_eq!(a, b);
        }
    }
}
