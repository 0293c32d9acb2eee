//! A scene to test in: two characters of three parts, a ball and a rim.

use sinew_script::{
    CharacterNames, CharacterState, JointName, JointState, Limits, Names, ObjectState, PartState, Script, ScriptError,
    ScriptHost, Snapshot, StartInfo, StepOutcome,
};
use std::path::PathBuf;

pub const HIPS: usize = 0;
pub const RIGHT_HAND: usize = 1;
pub const LEFT_FOOT: usize = 2;
pub const BALL: usize = 0;
pub const RIM: usize = 1;

/// A quarter turn about y: z becomes x.
const QUARTER_ABOUT_Y: [f64; 4] = [0.0, std::f64::consts::FRAC_1_SQRT_2, 0.0, std::f64::consts::FRAC_1_SQRT_2];

fn strings(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.to_owned()).collect()
}

/// The child, with limits that a loaded machine holds and a test can wait for.
pub fn host() -> ScriptHost {
    let limits = Limits { step_secs: 1.0, startup_secs: 30.0, ..Limits::default() };
    ScriptHost { program: PathBuf::from(env!("CARGO_BIN_EXE_sinew-script-host")), args: Vec::new(), limits }
}

/// A script of a class `C` in `test.py`.
pub fn info(source: &str) -> StartInfo {
    let aliases = vec![("RightArm".to_owned(), "rightHand".to_owned())];
    let names = Names {
        parts: strings(&["hips", "rightHand", "leftFoot"]),
        characters: vec![
            CharacterNames { name: "left".to_owned(), aliases },
            CharacterNames { name: "right".to_owned(), aliases: Vec::new() },
        ],
        objects: strings(&["Ball", "Rim"]),
        joints: vec![
            JointName { name: "wheel".to_owned(), turns: true },
            JointName { name: "drawer".to_owned(), turns: false },
        ],
        poses: strings(&["PrepareDunk", "Landing"]),
        graphs: strings(&["walk"]),
        shapes: strings(&["own", "none", "skis"]),
        reflexes: strings(&["balance"]),
        trackers: strings(&["kinematic", "pd", "response"]),
    };
    StartInfo {
        source: source.to_owned(),
        file: "test.py".to_owned(),
        class: "C".to_owned(),
        own: "left".to_owned(),
        seed: 7,
        names,
    }
}

/// Everything in a place of its own.
pub fn snapshot() -> Snapshot {
    let character = |x: f64| CharacterState {
        parts: (0..3)
            .map(|part| PartState {
                position: [x, f64::from(part), 0.5],
                rotation: [0.0, 0.0, 0.0, 1.0],
                velocity: [0.0, 0.0, f64::from(part)],
            })
            .collect(),
        centre_of_mass: [x, 0.9, 0.0],
        centre_velocity: [0.0, -0.5, 0.0],
        facing: [0.0, 0.0, 1.0],
        support: vec![[x - 0.1, 0.0, 0.0], [x + 0.1, 0.0, 0.0], [x, 0.0, 0.2]],
        attached: Vec::new(),
    };
    Snapshot {
        step: 12,
        time_secs: 0.05,
        step_secs: 1.0 / 240.0,
        characters: vec![character(0.0), character(2.0)],
        objects: vec![
            ObjectState { position: [0.25, 1.5, 0.5], rotation: QUARTER_ABOUT_Y, ..ObjectState::default() },
            ObjectState { position: [0.0, 3.05, 1.0], rotation: [0.0, 0.0, 0.0, 1.0], ..ObjectState::default() },
        ],
        joints: vec![
            JointState { place: 30.0, speed: 2.0, is_whole: true },
            JointState { place: 0.25, speed: -1.0, is_whole: false },
        ],
        contacts: Vec::new(),
    }
}

pub fn start(source: &str) -> Result<Script, ScriptError> {
    Script::start(host(), &info(source))
}

/// What comes of the first step of a class `C` with this body of `step`.
pub fn step_of(body: &str) -> StepOutcome {
    let lines: String = body.lines().map(|line| format!("        {line}\n")).collect();
    let source = format!("class C:\n    def step(self):\n{lines}");
    start(&source).unwrap().step(&snapshot())
}

/// The message of the error of such a step.
pub fn error_of(body: &str) -> String {
    let outcome = step_of(body);
    outcome.error.unwrap_or_else(|| panic!("no error: {:?}", outcome.commands)).message
}
