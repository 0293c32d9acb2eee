//! Signals to `sinew run`.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::command::sinew;
use std::process::{Command, Stdio};
use std::time::Duration;

const SCENE: &str = "format = 1\n[characters.one]\npose = \"stand\"\n";

#[test]
fn ctrl_c_and_sigterm_end_a_run_with_its_take_and_its_motion() {
    for signal in ["INT", "TERM"] {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
        // A signal that comes before the program listens ends it without results: it is then given more time to begin.
        let ended = [1, 2, 4, 8, 16].into_iter().any(|secs| {
            let words = "run scene.toml --real-time --for 600 --take t.take -o out.bvh --picture p.png";
            let mut run = Command::new(env!("CARGO_BIN_EXE_sinew"))
                .args(words.split(' '))
                .current_dir(folder.path())
                .stdin(Stdio::null())
                .stdout(Stdio::null())
                .spawn()
                .unwrap();
            std::thread::sleep(Duration::from_secs(secs));
            Command::new("kill").args([&format!("-{signal}"), &run.id().to_string()]).status().unwrap();
            run.wait().unwrap().code() == Some(0)
        });
        assert!(ended, "{signal}");
        for name in ["t.take", "out.bvh", "p.png"] {
            assert!(folder.path().join(name).is_file(), "{signal}: {name}");
        }
        let replayed = sinew(folder.path(), ["replay", "t.take"]).done();
        assert!(replayed.out.contains("the replay is the take, bit for bit"), "{}", replayed.out);
    }
}
