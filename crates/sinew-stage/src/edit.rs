//! A scene's text is edited, and the running stage follows as far as it can without a restart.
//!
//! What the stage follows becomes commands, which are carried out, recorded and undone like any others: a take of an edited run
//! replays. What no command can change takes effect when the scene is started again, and [`Edited`] says so for each key.

use crate::Stage;
use crate::scene::{CharacterSpec, NAMED, REFLEXES, SceneError, SceneSpec};
use sinew_control::{Action, Command, Layer};
use toml::{Table, Value};

/// A key whose value was edited, and what becomes of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Edited {
    /// The key's path, as `characters.left.pose_gain`.
    pub path: String,
    /// Whether the running stage follows.
    pub outcome: EditOutcome,
}

/// Whether a running stage follows an edit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum EditOutcome {
    /// It does, from the next step on.
    Applied,
    /// It takes effect when the scene is started again.
    NeedsRestart,
}

/// Keys of a change, with the commands that follow it; `None` for what needs a restart.
type Followed = Option<Vec<Command>>;

impl Stage {
    /// Takes an edited text of the scene: the stage follows what it can from its next step on. Says for every key that
    /// differs from what runs whether it does. Gains, gravity of characters and props, reflexes, layers, the source's pose or graph,
    /// tracker, controller, plane, settings and weights of `kd`, places and velocities of props, motors and key bindings are followed;
    /// bodies, clips, shapes, joints, rates, and who and what is there need a restart.
    ///
    /// ```
    /// use sinew_stage::scene::SceneDocument;
    /// use sinew_stage::{EditOutcome, Scene, Stage};
    /// let text = "format = 1\n[characters.one] # she boxes\nmass_kg = 60\n";
    /// let mut stage = Stage::new(Scene::from_text(text)?, None)?;
    /// stage.step();
    /// let mut document = SceneDocument::parse(text)?;
    /// document.set("characters.one.pose_gain", "0.5")?;
    /// document.set("characters.one.mass_kg", "70")?;
    /// let edited = stage.edit(&document.to_string())?;
    /// let outcomes: Vec<(&str, EditOutcome)> = edited.iter().map(|one| (one.path.as_str(), one.outcome)).collect();
    /// assert_eq!(
    ///     outcomes,
    ///     [
    ///         ("characters.one.mass_kg", EditOutcome::NeedsRestart),
    ///         ("characters.one.pose_gain", EditOutcome::Applied),
    ///     ]
    /// );
    /// stage.step();
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A text that is no sound scene: nothing is changed then.
    pub fn edit(&mut self, text: &str) -> Result<Vec<Edited>, SceneError> {
        let new = self.scene.with_text(text)?;
        let mut running = match self.running.take() {
            Some(running) => running,
            None => table(self.scene.text()),
        };
        let wanted = table(text);
        let mut paths = Vec::new();
        differences(&Value::Table(running.clone()), &Value::Table(wanted.clone()), &mut Vec::new(), &mut paths);
        let mut edited = Vec::new();
        let mut commands: Vec<Command> = Vec::new();
        for path in paths {
            let keys: Vec<&str> = path.iter().map(String::as_str).collect();
            let outcome = match follow(&new, &keys) {
                Some(followed) => {
                    put(&mut running, &keys, &wanted);
                    // Two keys of one command ask for it twice.
                    commands
                        .extend(followed.into_iter().filter(|command| !commands.contains(command)).collect::<Vec<_>>());
                    EditOutcome::Applied
                }
                None => EditOutcome::NeedsRestart,
            };
            edited.push(Edited { path: path.join("."), outcome });
        }
        commands.into_iter().for_each(|command| self.command(command));
        self.keys.clone_from(&new.keys);
        self.running = Some(running);
        Ok(edited)
    }
}

/// How the stage follows a key; the new scene is sound.
fn follow(new: &SceneSpec, keys: &[&str]) -> Followed {
    match keys {
        ["name" | "keys" | "camera", ..] | ["stage", "duration_secs"] | [_, _, "colour"] => Some(Vec::new()),
        ["characters", who, key, rest @ ..] => {
            let spec = new.characters.get(*who)?;
            let actions = follow_character(spec, key, rest)?;
            Some(actions.into_iter().map(|action| Command::to(*who, action)).collect())
        }
        ["props", prop, key @ ("position_m" | "velocity_m_s" | "gravity_scale"), ..] => {
            let spec = new.props.get(*prop)?;
            let object = (*prop).to_owned();
            Some(vec![Command::stage(match *key {
                "position_m" => Action::Place { object, position_m: Some(spec.position_m), velocity_m_s: None },
                "velocity_m_s" => Action::Place { object, position_m: None, velocity_m_s: Some(spec.velocity_m_s) },
                _ => Action::Gravity {
                    scale: spec.gravity_scale.unwrap_or(1.0),
                    on: Some(object),
                    part: None,
                    over_secs: None,
                    for_secs: None,
                },
            })])
        }
        ["joints", joint, "motor", "speed_rad_s" | "angle_deg" | "speed_m_s" | "shift_m"] => {
            let motor = new.joints.get(*joint)?.motor?;
            Some(vec![Command::stage(Action::Motor {
                joint: (*joint).to_owned(),
                speed_rad_s: motor.speed_rad_s,
                angle_deg: motor.angle_deg,
                speed_m_s: motor.speed_m_s,
                shift_m: motor.shift_m,
            })])
        }
        _ => None,
    }
}

fn follow_character(spec: &CharacterSpec, key: &str, rest: &[&str]) -> Option<Vec<Action>> {
    let one = |action| Some(vec![action]);
    match (key, rest) {
        ("pose_gain", []) => one(Action::Gain { factor: spec.pose_gain, part: None }),
        ("gravity_scale", []) => {
            one(Action::Gravity { scale: spec.gravity_scale, on: None, part: None, over_secs: None, for_secs: None })
        }
        ("reflexes", _) => Some(
            REFLEXES
                .into_iter()
                .map(|name| Action::Reflex {
                    name: name.to_owned(),
                    on: spec.reflexes.iter().any(|reflex| reflex == name),
                })
                .collect(),
        ),
        ("layers", _) => Some(
            [Layer::Poses, Layer::Scripts, Layer::Reflexes]
                .map(|layer| Action::Layer { layer, on: spec.layers.contains(&layer) })
                .to_vec(),
        ),
        ("tracker", []) => one(Action::Tracker { name: spec.tracker.name().to_owned() }),
        ("controller", []) => one(Action::Controller { name: spec.controller.clone().unwrap_or_default() }),
        ("plane", _) => one(match spec.plane_facing_deg() {
            Some(facing_deg) => Action::Plane { facing_deg: Some(facing_deg), for_secs: None },
            None => Action::PlaneOff {},
        }),
        ("source", ["pose" | "graph" | "state"]) => {
            let source = spec.source.as_ref()?;
            match (&source.pose, &source.graph) {
                (Some(name), None) => one(Action::Pose { name: name.0.clone() }),
                (None, Some(name)) => one(Action::Graph { name: name.0.clone(), state: source.state.clone() }),
                _ => None,
            }
        }
        ("source", ["reach", ..]) => one(Action::Reach(spec.source.as_ref()?.reach.clone()?)),
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
        _ => None,
    }
}

/// A text that was read before as a table.
fn table(text: &str) -> Table {
    text.parse().unwrap_or_default()
}

/// Paths of what differs: of tables their entries, of lists the whole.
fn differences(old: &Value, new: &Value, path: &mut Vec<String>, found: &mut Vec<Vec<String>>) {
    let (Value::Table(one), Value::Table(other)) = (old, new) else {
        if old != new {
            found.push(path.clone());
        }
        return;
    };
    let keys: std::collections::BTreeSet<&String> = one.keys().chain(other.keys()).collect();
    for key in keys {
        path.push(key.clone());
        match (one.get(key), other.get(key)) {
            (Some(old), Some(new)) => differences(old, new, path, found),
            // What the scene names comes and goes as a whole; other tables key by key.
            (Some(Value::Table(gone)), None) if !is_named(path) => {
                differences(&Value::Table(gone.clone()), &Value::Table(Table::new()), path, found);
            }
            (None, Some(Value::Table(come))) if !is_named(path) => {
                differences(&Value::Table(Table::new()), &Value::Table(come.clone()), path, found);
            }
            _ => found.push(path.clone()),
        }
        path.pop();
    }
}

/// Whether a path is that of something with a name: a character, a prop.
fn is_named(path: &[String]) -> bool {
    matches!(path, [list, _] if NAMED.contains(&list.as_str()))
}

/// Takes a value over by its path, or its absence.
fn put(running: &mut Table, keys: &[&str], wanted: &Table) {
    let Some((first, rest)) = keys.split_first() else { return };
    let new = wanted.get(*first);
    match (rest.is_empty(), new) {
        (false, Some(Value::Table(inside))) => {
            let entry = running.entry((*first).to_owned()).or_insert_with(|| Value::Table(Table::new()));
            if let Value::Table(table) = entry {
                put(table, rest, inside);
            }
        }
        (false, None) => {
            if let Some(Value::Table(table)) = running.get_mut(*first) {
                put(table, rest, &Table::new());
            }
        }
        (_, Some(value)) => drop(running.insert((*first).to_owned(), value.clone())),
        (true, None) => drop(running.remove(*first)),
    }
}
