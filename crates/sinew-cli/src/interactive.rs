//! Interactive input of a run: keyboard lines, and controllers that are reloaded when their files change.

use sinew::control::{Action, Command};
use sinew::stage::{Observer, Scene, Stage};
use std::io::BufRead;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, sync_channel};
use std::time::{Duration, Instant, SystemTime};

/// Applies typed lines, reloads edited controllers, and prints events.
pub(crate) struct Interactive {
    lines: Receiver<String>,
    /// Controllers with a file: name, path, time of the last change.
    files: Vec<(String, PathBuf, Option<SystemTime>)>,
    looked: Instant,
    told: usize,
}

/// Lines that wait to be applied.
const MAX_LINES: usize = 100;

/// Interval at which the controllers' files are checked.
const LOOK: Duration = Duration::from_millis(200);

impl Interactive {
    pub(crate) fn begin(scene: &Scene) -> Interactive {
        let (sender, lines) = sync_channel(MAX_LINES);
        // It ends with the program, or with the input.
        std::thread::spawn(move || {
            for line in std::io::stdin().lock().lines().map_while(Result::ok) {
                if sender.send(line).is_err() {
                    break;
                }
            }
        });
        let files = scene.controllers.iter().filter_map(|(name, controller)| {
            let path = scene.on_disk(controller.file.as_ref()?)?;
            let changed = changed(&path);
            Some((name.clone(), path, changed))
        });
        Interactive { lines, files: files.collect(), looked: Instant::now(), told: 0 }
    }
}

impl Observer for Interactive {
    fn before_step(&mut self, stage: &mut Stage) {
        for line in self.lines.try_iter().take(MAX_LINES) {
            apply(stage, line.trim());
        }
        if self.looked.elapsed() > LOOK {
            self.looked = Instant::now();
            for (name, path, before) in &mut self.files {
                let now = changed(path);
                if now.is_some() && now != *before {
                    *before = now;
                    stage.command(Command::stage(Action::Reload { name: name.clone(), text: None }));
                }
            }
        }
        for event in stage.events().list().iter().skip(self.told) {
            eprintln!("{:7.3} s  {}  ({})", event.time_secs, event.effect, event.cause);
        }
        self.told = stage.events().list().len();
    }
}

fn apply(stage: &mut Stage, line: &str) {
    if line.is_empty() {
        return;
    }
    if line.starts_with('{') {
        match serde_json::from_str(line) {
            Ok(command) => stage.command(command),
            Err(error) => eprintln!("not a valid command: {error}"),
        }
    } else if !stage.press(line) {
        let keys: Vec<&str> = stage.scene().keys.iter().map(|binding| binding.key.as_str()).collect();
        eprintln!("no key `{line}`; the scene has {}", keys.join(", "));
    }
}

fn changed(path: &std::path::Path) -> Option<SystemTime> {
    std::fs::metadata(path).ok()?.modified().ok()
}
