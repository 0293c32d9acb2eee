//! A text is changed while the stage runs.

use crate::scene::{info, snapshot, start};
use sinew_control::{Action, Command};

fn say(text: &str) -> Command {
    Command::to("left", Action::Say { text: text.to_owned() })
}

const COUNTING: &str =
    "class C:\n    def start(self): self.n = 0\n    def step(self):\n        self.n += 1\n        say(self.n)\n";

#[test]
fn reload_starts_the_new_text() {
    let mut script = start(COUNTING).unwrap();
    assert_eq!(script.step(&snapshot()).commands, [say("1")]);
    assert_eq!(script.step(&snapshot()).commands, [say("2")]);
    script.reload(&COUNTING.replace("self.n = 0", "self.n = 10")).unwrap();
    assert_eq!(script.step(&snapshot()).commands, [say("11")]);
}

#[test]
fn reload_hands_the_old_object_over_where_the_class_takes_it() {
    let mut script = start(COUNTING).unwrap();
    script.step(&snapshot());
    script.reload(&format!("{COUNTING}    def reload(self, old): self.n = old.n\n")).unwrap();
    assert_eq!(script.step(&snapshot()).commands, [say("2")]);
}

#[test]
fn wrong_text_names_its_line_and_the_old_controller_goes_on() {
    let mut script = start(COUNTING).unwrap();
    script.step(&snapshot());
    let error = script.reload("class C:\n    def step(self):\n        say('x'\n").unwrap_err();
    assert_eq!((error.file.as_str(), error.line), ("test.py", Some(3)), "{error}");
    let error = script.reload("class D:\n    pass\n").unwrap_err();
    assert!(error.message.contains("no class C in the file; it has: D"), "{error}");
    let error = script.reload("class C:\n    pass\n").unwrap_err();
    assert!(error.message.contains("no step(self)"), "{error}");
    let error = script.reload("x = 1\n\nraise ValueError('no')\n").unwrap_err();
    assert_eq!(error.to_string(), "test.py:3: ValueError: no");
    assert_eq!(script.step(&snapshot()).commands, [say("2")]);
}

#[test]
fn reload_mends_a_controller_that_failed() {
    let mut script = start("class C:\n    def step(self): nowhere\n").unwrap();
    assert!(script.step(&snapshot()).error.is_some());
    assert!(!script.is_running());
    script.reload(COUNTING).unwrap();
    assert!(script.is_running());
    assert_eq!(script.step(&snapshot()).commands, [say("1")]);
}

#[test]
fn reload_brings_a_killed_controller_back_in_a_new_process() {
    let mut script = start(COUNTING).unwrap();
    script.step(&snapshot());
    script.kill();
    assert_eq!(script.step(&snapshot()).commands, []);
    assert!(script.reload("class C: !").is_err());
    assert!(!script.is_running());
    script.reload(COUNTING).unwrap();
    assert_eq!(script.step(&snapshot()).commands, [say("1")]);
}

#[test]
fn lines_printed_while_the_text_is_read_come_with_the_next_step() {
    let mut script = start(&format!("print('read')\n{COUNTING}")).unwrap();
    assert_eq!(script.step(&snapshot()).printed, ["read"]);
    assert_eq!(script.step(&snapshot()).printed, Vec::<String>::new());
}

#[test]
fn nothing_can_be_sensed_or_done_before_start() {
    for text in ["getPosition('Ball')", "skeleton.getFacing()", "say('x')", "skeleton.setTargetPose('Landing')"] {
        let error = start(&format!("{text}\n{COUNTING}")).unwrap_err();
        assert_eq!(error.line, Some(1), "{error}");
        assert!(error.message.contains("from start() or step()"), "{error}");
    }
}

#[test]
fn snapshot_of_another_scene_is_refused() {
    let mut script = start(COUNTING).unwrap();
    let mut other = snapshot();
    other.objects.clear();
    assert!(script.step(&other).error.unwrap().message.contains("does not fit"));
    assert_eq!(info(COUNTING).names.objects.len(), 2);
}

#[test]
fn text_without_end_is_refused() {
    let mut script = start(COUNTING).unwrap();
    assert!(script.reload(&"#".repeat(2 << 20)).unwrap_err().message.contains("longer than"));
    assert_eq!(script.step(&snapshot()).commands, [say("1")]);
}
