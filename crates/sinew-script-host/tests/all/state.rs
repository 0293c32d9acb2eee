//! A script's state is kept as far as it can be had, and what cannot is named.

use crate::scene::{info, snapshot, start};
use sinew_control::{Action, Command};
use sinew_script::{Script, ScriptState};

fn says(script: &mut Script) -> Vec<String> {
    let outcome = script.step(&snapshot());
    assert_eq!((outcome.error, outcome.killed), (None, None));
    let word = |command: &Command| match &command.action {
        Action::Say { text } => text.clone(),
        other => panic!("{other:?}"),
    };
    outcome.commands.iter().map(word).collect()
}

/// Values of every kind, shared and nested ones, objects of own classes, bound methods, random numbers.
const EVERYTHING: &str = r"
import random, math
count = 0
big = 1
table = {'a': [1, 2.5, None, True], (1, 'x'): {}}
class Leg:
    made = 0
    def __init__(self, owner, side):
        Leg.made += 1
        self.owner, self.side, self.load = owner, side, 0.1
class C:
    def __init__(self):
        self.legs = [Leg(self, 'left'), Leg(self, 'right')]
    def start(self):
        self.phase = self.up
        self.home = Vector(1.0, 2.0, 3.0)
        self.words = self.other = ['x']
        self.nested = ((1, (2, self.words)), float('inf'), -0.0)
        self.loop = []
        self.loop.append(self.loop)
    def up(self):
        self.phase = self.down
    def down(self):
        self.phase = self.up
        Leg(self, 'third')
    def step(self):
        global count, big, late
        count += 1
        big = big * 1000003 + count
        late = [count]
        table['a'].append(random.random())
        table[count] = self.home * float(count)
        self.phase()
        self.legs[count % 2].load += 0.1 * count
        self.words.append(str(count))
        say((count, big, self.phase.__name__, self.legs[0].load, self.legs[1].owner is self, Leg.made))
        say((self.other is self.words, self.nested[0][1][1] is self.words, len(self.words), self.nested[1], self.nested[2]))
        say((self.loop[0] is self.loop, list(table.keys())[-1], table['a'][-1], type(self.home).__name__, late))
";

#[test]
fn a_script_that_is_restored_says_the_same_again() {
    let mut script = start(EVERYTHING).unwrap();
    for kept_at in 0..4 {
        let state = script.state().unwrap();
        assert_eq!(state.lost(), [""; 0]);
        let first: Vec<_> = (0..5).map(|_| says(&mut script)).collect();
        let after = script.state().unwrap();
        script.restore(&state).unwrap();
        assert_eq!(script.state().unwrap(), state, "kept at {kept_at}");
        assert_eq!((0..5).map(|_| says(&mut script)).collect::<Vec<_>>(), first, "restored in place");
        // Into another process, too, and into one that was killed.
        let mut other = start(EVERYTHING).unwrap();
        says(&mut other);
        other.restore(&state).unwrap();
        assert_eq!((0..5).map(|_| says(&mut other)).collect::<Vec<_>>(), first, "in another process");
        other.kill();
        other.restore(&state).unwrap();
        assert_eq!((0..5).map(|_| says(&mut other)).collect::<Vec<_>>(), first, "in a process that was killed");
        assert_eq!(other.state().unwrap(), after);
        script.restore(&state).unwrap();
        says(&mut script);
    }
}

#[test]
fn what_cannot_be_kept_is_named_and_is_as_the_text_leaves_it() {
    let text = "def numbers():\n    n = 0\n    while True:\n        yield n\n        n += 1\n\
                hooks = {'a': lambda: 1}\n\
                class C:\n    def __init__(self):\n        self.walk = numbers()\n        self.n = 0\n        self.deep = [[numbers()]]\n    \
                def step(self):\n        self.n += 1\n        self.late = numbers()\n        say((self.n, next(self.walk), hooks['a']()))\n";
    let mut script = start(text).unwrap();
    says(&mut script);
    says(&mut script);
    let state = script.state().unwrap();
    let lost = state.lost().join("; ");
    for name in ["self.walk (generator)", "self.late (generator)", "self.deep (generator)", "hooks (function)"] {
        assert!(lost.contains(name), "{lost}");
    }
    assert_eq!(says(&mut script), ["(3, 2, 1)"]);
    script.restore(&state).unwrap();
    assert_eq!(says(&mut script), ["(3, 0, 1)"], "the generator begins anew, the number goes on");
}

#[test]
fn a_stopped_script_is_restored_as_a_stopped_one_and_a_changed_text_with_its_text() {
    let text = "class C:\n    n = 0\n    def step(self):\n        self.n += 1\n        say(self.n)\n        if self.n == 3: nowhere\n";
    let mut script = start(text).unwrap();
    says(&mut script);
    let early = script.state().unwrap();
    script.reload(&text.replace("+= 1", "+= 10")).unwrap();
    assert_eq!(says(&mut script), ["10"]);
    let changed = script.state().unwrap();
    script.restore(&early).unwrap();
    assert_eq!(says(&mut script), ["2"]);
    assert!(script.step(&snapshot()).error.is_some());
    let stopped = script.state().unwrap();
    script.restore(&changed).unwrap();
    assert_eq!(says(&mut script), ["20"]);
    script.restore(&stopped).unwrap();
    assert!(!script.is_running());
}

#[test]
fn bytes_that_are_no_state_stop_the_script_and_nothing_else() {
    let mut script = start(EVERYTHING).unwrap();
    says(&mut script);
    let bytes = {
        let mut to = sinew_snapshot::Writer::new();
        sinew_snapshot::Snapshot::save(&script.state().unwrap(), &mut to);
        to.into_bytes()
    };
    let from = bytes.len() - 200;
    for place in (from..bytes.len() - 10).step_by(7) {
        let mut changed = bytes.clone();
        changed[place] ^= 0x11;
        let mut state = ScriptState::default();
        let mut reader = sinew_snapshot::Reader::new(&changed);
        if sinew_snapshot::Snapshot::restore(&mut state, &mut reader).is_ok() && script.restore(&state).is_ok() {
            script.step(&snapshot());
        }
    }
    let mut other = Script::start(crate::scene::host(), &info(EVERYTHING)).unwrap();
    says(&mut other);
}
