//! Many cases at once, and what failed of them.

use std::fmt::Write;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Does a job for every item on all cores; the results have the order of the items.
///
/// ```
/// assert_eq!(sinew_testkit::work(&[1, 2, 3], |number| number * number), [1, 4, 9]);
/// ```
///
/// # Panics
/// When a job panics.
pub fn work<T: Sync, R: Send>(items: &[T], job: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let done: Mutex<Vec<(usize, R)>> = Mutex::new(Vec::with_capacity(items.len()));
    let threads = std::thread::available_parallelism().map_or(2, std::num::NonZero::get);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while let Some((at, item)) = {
                    let at = next.fetch_add(1, Ordering::Relaxed);
                    items.get(at).map(|item| (at, item))
                } {
                    let result = job(item);
                    done.lock().unwrap_or_else(std::sync::PoisonError::into_inner).push((at, result));
                }
            });
        }
    });
    let mut done = done.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    done.sort_by_key(|(at, _)| *at);
    done.into_iter().map(|(_, result)| result).collect()
}

/// Fails, showing the first thirty failures, unless there are none and something was tried.
///
/// # Panics
/// When something failed, or nothing was tried.
#[track_caller]
pub fn none_of(total: usize, failures: &[String]) {
    let mut text = String::new();
    for failure in failures.iter().take(30) {
        let _ = writeln!(text, "  {failure}");
    }
    assert!(failures.is_empty(), "{} of {total} fail:\n{text}", failures.len());
    assert!(total > 0, "nothing was tried");
}
