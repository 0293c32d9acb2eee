//! Ctrl-C and SIGTERM: a run ends as it does when its time is over, and what was asked for is written.

use sinew::stage::Observer;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Exit code of a program that Ctrl-C ended.
const INTERRUPTED: i32 = 130;

/// Ends a run at the first signal. A second one ends the program at once, without its results.
pub(crate) struct Stop {
    asked: Arc<AtomicBool>,
}

impl Stop {
    /// Listens from now on. Where signals cannot be listened to, they end the program as they always do.
    pub fn listen() -> Stop {
        let asked = Arc::new(AtomicBool::new(false));
        let heard = Arc::clone(&asked);
        let handler = move || {
            if heard.swap(true, Ordering::Relaxed) {
                std::process::exit(INTERRUPTED);
            }
            eprintln!("stopping, and writing what was recorded; press Ctrl-C again to end at once");
        };
        if let Err(error) = ctrlc::set_handler(handler) {
            eprintln!("note: Ctrl-C will end the run without its results: {error}");
        }
        Stop { asked }
    }
}

impl Observer for Stop {
    fn should_stop(&self) -> bool {
        self.asked.load(Ordering::Relaxed)
    }
}
