//! How the stage follows the change of one key.

use super::RestartReason as Reason;
use super::plan::is_another_body;
use crate::scene::{CharacterSpec, REFLEXES, SceneSpec};
use sinew_control::source::SourceSpec;
use sinew_control::{Action, Command, Layer};

/// How the change of a key is followed.
pub(super) enum Followed {
    /// By commands alone; by none where nothing follows from it.
    Values(Vec<Command>),
    /// By what comes, goes or is read anew, and then commands.
    Structure(Vec<Command>),
}

use Followed::{Structure, Values};

/// How the stage follows a key, from the scene that runs to a sound one; else why it does not.
pub(super) fn follow(old: &SceneSpec, new: &SceneSpec, keys: &[&str]) -> Result<Followed, Reason> {
    match keys {
        ["name" | "keys" | "camera", ..] | ["stage", "duration_secs"] | [_, _, "colour"] => Ok(Values(Vec::new())),
        ["stage", "gravity_m_s2" | "pose_files"]
        | ["at" | "when" | "poses" | "graphs" | "shapes" | "ropes", ..]
        | ["characters" | "props" | "joints" | "controllers", _] => Ok(Structure(Vec::new())),
        ["stage", "physics_hz" | "motion_hz"] => Err(Reason::Rates),
        ["stage", "seed"] => Err(Reason::Seed),
        ["stage", ..] => Err(Reason::World),
        ["controllers", name, key] => match (*key, new.controllers.get(*name)) {
            ("class", _) | (_, None) => Err(Reason::Controller),
            (_, Some(_)) => {
                Ok(Structure(vec![Command::stage(Action::Reload { name: (*name).to_owned(), text: None })]))
            }
        },
        ["characters", who, key, rest @ ..] => {
            let (Some(before), Some(spec)) = (old.characters.get(*who), new.characters.get(*who)) else {
                return Err(Reason::Unknown);
            };
            let to_who =
                |actions: Vec<Action>| actions.into_iter().map(|action| Command::to(*who, action)).collect::<Vec<_>>();
            Ok(match follow_character(before, spec, key, rest)? {
                (actions, false) => Values(to_who(actions)),
                (actions, true) => Structure(to_who(actions)),
            })
        }
        ["props", prop, key, ..] => follow_prop(old, new, prop, key),
        ["joints", joint, "motor", "speed_rad_s" | "angle_deg" | "speed_m_s" | "shift_m"] => {
            match new.joints.get(*joint).and_then(|spec| spec.motor) {
                Some(motor) => Ok(Values(vec![Command::stage(Action::Motor {
                    joint: (*joint).to_owned(),
                    speed_rad_s: motor.speed_rad_s,
                    angle_deg: motor.angle_deg,
                    speed_m_s: motor.speed_m_s,
                    shift_m: motor.shift_m,
                })])),
                None => Ok(Structure(Vec::new())),
            }
        }
        ["joints", ..] => Ok(Structure(Vec::new())),
        _ => Err(Reason::Unknown),
    }
}

fn follow_prop(old: &SceneSpec, new: &SceneSpec, prop: &str, key: &str) -> Result<Followed, Reason> {
    let (Some(before), Some(spec)) = (old.props.get(prop), new.props.get(prop)) else { return Err(Reason::Unknown) };
    let object = prop.to_owned();
    let command = |action| Ok(Values(vec![Command::stage(action)]));
    match key {
        "position_m" => command(Action::Place { object, position_m: Some(spec.position_m), velocity_m_s: None }),
        "velocity_m_s" => command(Action::Place { object, position_m: None, velocity_m_s: Some(spec.velocity_m_s) }),
        "gravity_scale" => command(Action::Gravity {
            scale: spec.gravity_scale.unwrap_or(1.0),
            on: Some(object),
            part: None,
            over_secs: None,
            for_secs: None,
        }),
        "controller" => Ok(Structure(Vec::new())),
        _ if is_another_body(before, spec) && is_known_to_others(new, prop) => Err(Reason::Fastened),
        _ => Ok(Structure(Vec::new())),
    }
}

/// Whether a joint fastens a prop, or the tracker of a character knows it.
fn is_known_to_others(scene: &SceneSpec, prop: &str) -> bool {
    let is_it = |name: &String| name == prop;
    let is_fastened = scene.joints.values().any(|joint| joint.between.iter().any(is_it));
    let is_known = |spec: &CharacterSpec| {
        let known = [&spec.kd.stands_on, &spec.response.stands_on];
        known.into_iter().flatten().chain(&spec.response.avoid).any(is_it)
    };
    is_fastened || scene.characters.values().any(is_known)
}

/// Actions that follow a key of a character, and whether something is read anew before them.
fn follow_character(
    old: &CharacterSpec,
    spec: &CharacterSpec,
    key: &str,
    rest: &[&str],
) -> Result<(Vec<Action>, bool), Reason> {
    let one = |action| Ok((vec![action], false));
    match (key, rest) {
        ("mass_kg" | "height_m" | "clip" | "friction", _) => Err(Reason::Body),
        ("position_m" | "facing_deg" | "velocity_m_s" | "spin_rad_s" | "pose", _) => Err(Reason::Start),
        ("aliases" | "joints", _) => Ok((Vec::new(), true)),
        ("pose_gain", []) => one(Action::Gain { factor: spec.pose_gain, part: None }),
        ("gravity_scale", []) => {
            one(Action::Gravity { scale: spec.gravity_scale, on: None, part: None, over_secs: None, for_secs: None })
        }
        ("reflexes", _) => {
            let reflex = |name: &str| Action::Reflex {
                name: name.to_owned(),
                on: spec.reflexes.iter().any(|reflex| reflex == name),
            };
            Ok((REFLEXES.into_iter().map(reflex).collect(), false))
        }
        ("layers", _) => {
            let layer = |layer| Action::Layer { layer, on: spec.layers.contains(&layer) };
            Ok(([Layer::Poses, Layer::Scripts, Layer::Reflexes].map(layer).to_vec(), false))
        }
        ("tracker", []) => one(Action::Tracker { name: spec.tracker.name().to_owned() }),
        ("controller", []) => one(Action::Controller { name: spec.controller.clone().unwrap_or_default() }),
        ("plane", _) => one(match spec.plane_facing_deg() {
            Some(facing_deg) => Action::Plane { facing_deg: Some(facing_deg), for_secs: None },
            None => Action::PlaneOff {},
        }),
        ("source", rest) => follow_source(old, spec, rest),
        ("kd", ["preset" | "k_p" | "d_p" | "k_q" | "d_q" | "damping" | "feed_forward"]) => {
            let gains = spec.kd.gains();
            one(Action::Kd {
                preset: None,
                k_p: Some(gains.k_p),
                d_p: Some(gains.d_p),
                k_q: Some(gains.k_q),
                d_q: Some(gains.d_q),
                damping: Some(spec.kd.damping),
                feed_forward: Some(spec.kd.feed_forward),
                fade_secs: None,
                for_secs: None,
            })
        }
        ("kd", ["weights", part, ..]) => {
            let weight = spec.kd.weights.get(*part).copied().unwrap_or_default();
            one(Action::Weights {
                parts: vec![(*part).to_owned()],
                pin: Some(weight.pin),
                joint: Some(weight.joint),
                fade_secs: None,
                for_secs: None,
            })
        }
        // The tracker is made anew, with what the scene says by then.
        ("kd" | "response", _) => Ok((vec![Action::Tracker { name: spec.tracker.name().to_owned() }], true)),
        _ => Err(Reason::Unknown),
    }
}

fn follow_source(old: &CharacterSpec, spec: &CharacterSpec, rest: &[&str]) -> Result<(Vec<Action>, bool), Reason> {
    let one = |action| Ok((vec![action], false));
    let live = |spec: &CharacterSpec| spec.source.as_ref().and_then(|source| source.live.clone());
    if rest.first() == Some(&"live") || live(old) != live(spec) {
        return Err(Reason::Performer);
    }
    let stand = || Action::Pose { name: spec.pose.clone().unwrap_or_else(|| crate::scene::STAND.to_owned()) };
    let Some(source) = &spec.source else { return one(stand()) };
    if rest.first() == Some(&"reach") {
        return one(source.reach.clone().map_or(Action::ReachEnd {}, Action::Reach));
    }
    match (&source.pose, &source.graph) {
        (Some(name), None) => one(Action::Pose { name: name.0.clone() }),
        (None, Some(name)) => one(Action::Graph { name: name.0.clone(), state: source.state.clone() }),
        _ if source.clip.is_some() || source.blend.is_some() => {
            let own = SourceSpec { live: None, reach: None, ..source.clone() };
            Ok((vec![Action::Source { source: Box::new(own) }], true))
        }
        _ => one(stand()),
    }
}
