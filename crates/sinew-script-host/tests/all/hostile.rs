//! Scripts that mean harm or know no better: an error or a kill, and a stage that goes on.

use crate::scene::{error_of, host, info, snapshot, start, step_of};
use sinew_script::{Limits, Script, ScriptHost, StepOutcome};
use std::io::Write;
use std::process::{Command, Stdio};

/// A host that gives up quickly where the test waits for just that.
fn impatient() -> ScriptHost {
    ScriptHost { limits: Limits { step_secs: 0.3, startup_secs: 3.0, ..Limits::default() }, ..host() }
}

/// What comes of a second step with this body, which has only the short limit.
fn second_step(body: &str) -> (Script, StepOutcome) {
    let lines: String = body.lines().map(|line| format!("        {line}\n")).collect();
    let source = format!(
        "class C:\n    n = 0\n    def step(self):\n        self.n += 1\n        if self.n == 1: return\n{lines}"
    );
    let mut script = Script::start(impatient(), &info(&source)).unwrap();
    assert_eq!(script.step(&snapshot()), StepOutcome::default());
    let outcome = script.step(&snapshot());
    (script, outcome)
}

/// It was killed, and what is left of it does nothing.
fn assert_killed(body: &str) -> String {
    let (mut script, outcome) = second_step(body);
    let reason = outcome.killed.unwrap_or_else(|| panic!("goes on after {body:?}: {:?}", outcome.error));
    assert!(!script.is_running());
    assert_eq!(script.step(&snapshot()), StepOutcome::default());
    reason
}

/// It either met Python's own error or was killed: which of them is the interpreter's choice.
fn assert_stopped(body: &str) {
    let (mut script, outcome) = second_step(body);
    assert!(outcome.killed.is_some() || outcome.error.is_some(), "goes on after {body:?}");
    assert!(!script.is_running());
    assert_eq!(script.step(&snapshot()), StepOutcome::default());
}

#[test]
fn endless_loops_are_killed() {
    assert!(assert_killed("while True: pass").contains("0.3 s"));
    assert_killed("while True:\n    try:\n        while True: pass\n    except: pass");
    assert_killed("for _ in iter(int, 1): pass");
}

#[test]
fn endless_print_is_killed_and_fills_nothing() {
    assert_killed("while True: print('x' * 1000)");
}

#[test]
fn long_native_calls_are_killed() {
    assert_stopped("10 ** 10 ** 8");
    assert_stopped("sum(range(10 ** 12))");
    assert_stopped("list(range(10 ** 12))");
}

#[test]
fn memory_bombs_burst_in_their_own_process() {
    assert_stopped("'a' * 10 ** 10");
    assert_stopped("[0] * 10 ** 10");
    assert_stopped("bytearray(10 ** 10)");
    assert_stopped("a = []\nwhile True: a.append(bytearray(10 ** 7))");
    assert_stopped("a = 'a' * 1000\nwhile True: a += a");
}

#[test]
fn memory_is_held_to_the_limit() {
    let text = "class C:\n    def step(self):\n        self.kept = bytearray(100_000_000)\n";
    let small = Limits { memory_bytes: 50 << 20, ..host().limits };
    let mut script = Script::start(ScriptHost { limits: small, ..host() }, &info(text)).unwrap();
    let outcome = script.step(&snapshot());
    assert!(outcome.killed.is_some() || outcome.error.is_some());
    // 100 MB of the default 512 MiB.
    assert_eq!(start(text).unwrap().step(&snapshot()), StepOutcome::default());
}

#[test]
fn deep_recursion_is_an_error_of_python() {
    let outcome = step_of("def f(): f()\nf()");
    assert!(outcome.error.unwrap().message.starts_with("RecursionError"));
    // Twice as many calls with every level: an endless loop in all but name.
    assert_stopped("def f():\n    try: f()\n    finally: f()\nf()");
}

#[test]
fn deep_nesting_of_data_or_text_stops_at_most_its_own_process() {
    assert_stopped("a = []\nfor _ in range(10 ** 5): a = [a]\nrepr(a)\nraise ValueError");
    let nested =
        format!("class C:\n    x = {}{}\n    def step(self): pass\n", "(".repeat(100_000), ")".repeat(100_000));
    assert!(start(&nested).is_err());
}

#[test]
fn exit_is_an_error() {
    assert!(error_of("exit()").starts_with("SystemExit"));
    assert!(error_of("raise SystemExit(0)").starts_with("SystemExit"));
    assert!(error_of("raise KeyboardInterrupt").starts_with("KeyboardInterrupt"));
}

#[test]
fn files_sockets_processes_and_clocks_are_not_there() {
    for module in
        ["os", "sys", "socket", "subprocess", "time", "io", "_io", "ctypes", "posix", "threading", "importlib"]
    {
        let message = error_of(&format!("import {module}"));
        assert!(message.starts_with("ModuleNotFoundError"), "{module}: {message}");
        assert!(message.contains("math, random, itertools"), "{message}");
    }
    for function in ["open('/etc/passwd')", "input()", "breakpoint()"] {
        assert!(error_of(function).starts_with("NameError"), "{function}");
    }
    // Through the back door: the interpreter's own modules are within reach of an object's ancestors.
    let reach = "import math\nm = type(math)\nfor c in object.__subclasses__():\n    f = getattr(c, 'load_module', None)\n    if f is None: continue\n    for name in ('posix', 'time', '_socket', 'marshal', '_thread'):\n        try: f(name)\n        except Exception as e: continue\n        print(name)";
    let outcome = step_of(reach);
    let printed: Vec<&str> = outcome.printed.iter().map(String::as_str).collect();
    assert!(printed.iter().all(|&name| name == "_thread"), "{printed:?}");
}

#[test]
fn file_beside_the_program_cannot_be_imported() {
    assert!(error_of("from . import scene").starts_with("ImportError"));
    assert!(error_of("__import__('Cargo')").starts_with("ModuleNotFoundError"));
}

#[test]
fn too_many_commands_are_an_error_at_the_script_s_line() {
    let outcome = step_of("while True:\n    skeleton.signal('x')");
    let error = outcome.error.unwrap();
    assert_eq!((error.file.as_str(), error.line), ("test.py", Some(4)));
    assert!(error.message.contains("more than 1000 commands"), "{error}");
    assert_eq!(outcome.commands.len(), 1000);
}

#[test]
fn much_text_is_cut() {
    let outcome = step_of("say('x' * 10 ** 6)\nprint('y' * 10 ** 6)\nskeleton.signal('z' * 10 ** 6)");
    assert_eq!(outcome.error, None);
    assert!(format!("{outcome:?}").len() < 5000);
    let outcome = step_of("for i in range(100_000): print(i)");
    assert_eq!(outcome.printed.len(), 101);
    assert_eq!(outcome.printed[100], "... and 99900 more lines");
    assert!(error_of("raise ValueError('x' * 10 ** 6)").len() < 3000);
}

#[test]
fn exception_whose_words_raise_is_an_error_all_the_same() {
    let message = error_of("class E(Exception):\n    def __str__(self): raise E\nraise E");
    assert_eq!(message, "E");
}

#[test]
fn exceptions_in_start_and_step_stop_the_controller_alone() {
    let mut script = start("class C:\n    def start(self): 1 / 0\n    def step(self): say('x')\n").unwrap();
    let outcome = script.step(&snapshot());
    let error = outcome.error.unwrap();
    assert_eq!(error.to_string(), "test.py:2: ZeroDivisionError: division by zero");
    assert_eq!(outcome.commands, []);
    assert!(!script.is_running());
    assert_eq!(script.step(&snapshot()), StepOutcome::default());
}

#[test]
fn text_that_never_comes_back_is_given_up() {
    let error = Script::start(impatient(), &info("while True: pass")).unwrap_err();
    assert!(error.message.contains("did not return"), "{error}");
}

#[test]
fn programs_that_are_no_host_are_told_from_one() {
    for program in ["/bin/false", "/bin/cat", "/nowhere"] {
        let host = ScriptHost { program: program.into(), ..impatient() };
        assert!(Script::start(host, &info("class C: pass")).is_err(), "{program}");
    }
    // One that never reads: the question is larger than any pipe.
    let host = ScriptHost { program: "/bin/sleep".into(), args: vec!["60".to_owned()], ..impatient() };
    let text = format!("# {}", "x".repeat(900_000));
    assert!(Script::start(host, &info(&text)).unwrap_err().message.contains("did not return"));
}

#[test]
fn endless_loop_does_not_outlive_a_parent_that_is_gone() {
    // What the parent would send, and no parent to kill it afterwards: the first kind of question is a start.
    let question = (0u8, info("while True: pass"), host().limits);
    let bytes = postcard::to_stdvec(&question).unwrap();
    let mut child = Command::new(host().program)
        .env(sinew_script::protocol::VERSION_VARIABLE, sinew_script::protocol::VERSION.to_string())
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let mut input = child.stdin.take().unwrap();
    input.write_all(&u32::try_from(bytes.len()).unwrap().to_le_bytes()).unwrap();
    input.write_all(&bytes).unwrap();
    drop(input);
    // Ends by itself; a child that went on would hang the test.
    assert!(!child.wait().unwrap().success());
}
