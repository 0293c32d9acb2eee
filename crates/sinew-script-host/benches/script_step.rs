//! What a step of a Python controller costs: one question to the child process and its answer.

use criterion::{Criterion, criterion_group, criterion_main};
use sinew_script::{
    CharacterNames, CharacterState, Limits, Names, ObjectState, PartState, Script, ScriptHost, Snapshot, StartInfo,
};
use std::hint::black_box;
use std::path::PathBuf;

/// As many as a humanoid has.
const PARTS: usize = 18;

const EMPTY: &str = "class C:\n    def step(self): pass\n";

/// Ten rounds of sensing twice and steering twice.
const FORTY_CALLS: &str = "\
class C:
    def step(self):
        for _ in range(10):
            rim = getPosition('Rim')
            skeleton.isColliding('Rim')
            skeleton.setIKTarget(rim)
            skeleton.setTargetPose('Landing')
";

fn script(source: &str) -> (Script, Snapshot) {
    let names = Names {
        parts: (0..PARTS).map(|part| format!("part{part}")).collect(),
        characters: vec![CharacterNames { name: "left".to_owned(), aliases: Vec::new() }],
        objects: vec!["Ball".to_owned(), "Rim".to_owned()],
        poses: vec!["Landing".to_owned()],
        ..Names::default()
    };
    let info = StartInfo {
        source: source.to_owned(),
        file: "bench.py".to_owned(),
        class: "C".to_owned(),
        own: "left".to_owned(),
        seed: 0,
        names,
    };
    let host = ScriptHost {
        program: PathBuf::from(env!("CARGO_BIN_EXE_sinew-script-host")),
        args: Vec::new(),
        limits: Limits::default(),
    };
    let character = CharacterState { parts: vec![PartState::default(); PARTS], ..CharacterState::default() };
    let snapshot =
        Snapshot { characters: vec![character], objects: vec![ObjectState::default(); 2], ..Snapshot::default() };
    let script = Script::start(host, &info).unwrap_or_else(|error| panic!("{error}"));
    (script, snapshot)
}

fn steps(criterion: &mut Criterion) {
    for (name, source, commands) in [("empty step", EMPTY, 0), ("step with 40 calls", FORTY_CALLS, 20)] {
        let (mut script, snapshot) = script(source);
        assert_eq!(script.step(&snapshot).commands.len(), commands);
        criterion.bench_function(name, |bencher| bencher.iter(|| black_box(script.step(&snapshot))));
    }
}

criterion_group!(benches, steps);
criterion_main!(benches);
