//! Which characters, props, joints and ropes go and come when one scene becomes another.

use crate::populate::Newcomers;
use crate::scene::{PropJointSpec, PropSpec, RopeSpec, Scene};
use std::collections::{BTreeMap, BTreeSet};

/// What goes and what comes. What changes goes and comes.
pub(super) struct Plan<'a> {
    pub characters_gone: Vec<&'a str>,
    pub props_gone: Vec<&'a str>,
    pub joints_gone: Vec<&'a str>,
    pub ropes_gone: Vec<&'a str>,
    pub new: Newcomers<'a>,
    /// Props that come again where they are.
    pub rebuilt: Vec<&'a str>,
}

impl<'a> Plan<'a> {
    pub fn between(old: &'a Scene, new: &'a Scene) -> Plan<'a> {
        let (characters_gone, characters) = changes(&old.characters, &new.characters, |_, _| false);
        let (ropes_gone, ropes) = changes(&old.ropes, &new.ropes, |one: &RopeSpec, other| one != other);
        let pieces = |scene: &'a Scene, names: &[&str]| -> BTreeSet<String> {
            let of = |name: &&str| {
                let count = scene.ropes.get(*name).map_or(0, |rope| rope.pieces);
                (1..=count).map(|number| RopeSpec::piece(name, number)).collect::<Vec<_>>()
            };
            names.iter().flat_map(of).collect()
        };
        let (old_pieces, new_pieces) = (pieces(old, &ropes_gone), pieces(new, &ropes));
        let (mut props_gone, mut props) = (Vec::new(), Vec::new());
        let mut rebuilt = Vec::new();
        for (name, spec) in &old.props {
            match new.props.get(name) {
                Some(other) if !old_pieces.contains(name) && !is_another_body(spec, other) => {}
                Some(_) if !old_pieces.contains(name) && !new_pieces.contains(name) => {
                    props_gone.push(name.as_str());
                    rebuilt.push(name.as_str());
                }
                _ => props_gone.push(name.as_str()),
            }
        }
        for name in new.props.keys() {
            if !old.props.contains_key(name) || props_gone.contains(&name.as_str()) {
                props.push(name.as_str());
            }
        }
        let is_moved = |end: &str| props_gone.contains(&end) || props.contains(&end);
        let (joints_gone, joints) = changes(&old.joints, &new.joints, |one: &PropJointSpec, other| {
            without_aim(one) != without_aim(other) || other.between.iter().any(|end| is_moved(end))
        });
        let new = Newcomers { props, characters, joints, ropes, places: BTreeMap::new() };
        Plan { characters_gone, props_gone, joints_gone, ropes_gone, new, rebuilt }
    }
}

impl Plan<'_> {
    /// Whether all that is there stays, and nothing comes.
    pub fn is_empty(&self) -> bool {
        let gone = [&self.characters_gone, &self.props_gone, &self.joints_gone, &self.ropes_gone];
        let new = [&self.new.characters, &self.new.props, &self.new.joints, &self.new.ropes];
        gone.into_iter().chain(new).all(Vec::is_empty)
    }
}

/// Names that go and names that come; those that are in both and changed do both.
fn changes<'a, T>(
    old: &'a BTreeMap<String, T>,
    new: &'a BTreeMap<String, T>,
    is_changed: impl Fn(&T, &T) -> bool,
) -> (Vec<&'a str>, Vec<&'a str>) {
    let stays = |name: &String| match (old.get(name), new.get(name)) {
        (Some(one), Some(other)) => !is_changed(one, other),
        _ => false,
    };
    let gone = old.keys().filter(|name| !stays(name)).map(String::as_str).collect();
    let come = new.keys().filter(|name| !stays(name)).map(String::as_str).collect();
    (gone, come)
}

/// Whether a prop must be built anew: what commands set, and how it looks, is the same body.
pub(super) fn is_another_body(one: &PropSpec, other: &PropSpec) -> bool {
    let body = |spec: &PropSpec| PropSpec {
        position_m: [0.0; 3],
        velocity_m_s: [0.0; 3],
        gravity_scale: None,
        colour: None,
        controller: None,
        ..spec.clone()
    };
    body(one) != body(other)
}

fn without_aim(joint: &PropJointSpec) -> PropJointSpec {
    let mut joint = joint.clone();
    if let Some(motor) = &mut joint.motor {
        (motor.speed_rad_s, motor.angle_deg, motor.speed_m_s, motor.shift_m) = (None, None, None, None);
    }
    joint
}
