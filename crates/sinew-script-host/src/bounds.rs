//! The sandbox of the process: the kernel enforces it, whatever the script finds in the interpreter.

use sinew_script::Limits;
use std::io;

#[cfg(unix)]
pub(super) fn give_up_rights(limits: &Limits) -> io::Result<()> {
    use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
    end_with_the_parent()?;
    let lower = |resource: Resource, to: u64| {
        let hard = getrlimit(resource).maximum.unwrap_or(u64::MAX);
        let to = Some(to.min(hard));
        setrlimit(resource, Rlimit { current: to, maximum: to })
    };
    #[cfg(target_os = "linux")]
    {
        lower(Resource::As, address_space()?.saturating_add(limits.memory_bytes))?;
        // No trace of the script's memory is left on disk when it ends badly, not even by a crash reporter.
        rustix::process::set_dumpable_behavior(rustix::process::DumpableBehavior::NotDumpable)?;
    }
    #[cfg(not(target_os = "linux"))]
    let _ = limits;
    lower(Resource::Core, 0)?;
    // Standard input, output, error and the copy of the output.
    lower(Resource::Nofile, 4)?;
    lower(Resource::Fsize, 0)?;
    lower(Resource::Nproc, 0)?;
    Ok(())
}

#[cfg(not(unix))]
pub(super) fn give_up_rights(_limits: &Limits) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

/// Memory that the process has reserved so far \[bytes\].
#[cfg(target_os = "linux")]
fn address_space() -> io::Result<u64> {
    let text = std::fs::read_to_string("/proc/self/statm")?;
    let pages = text.split(' ').next().and_then(|pages| pages.parse::<u64>().ok());
    let pages = pages.ok_or_else(|| io::Error::other("/proc/self/statm is not what it was"))?;
    Ok(pages * rustix::param::page_size() as u64)
}

/// A thread that waits for the other end of standard input to close: a script that does not come back must not outlive a
/// parent that could not kill it.
#[cfg(unix)]
fn end_with_the_parent() -> io::Result<()> {
    use rustix::event::{PollFd, PollFlags, poll};
    let watch = || {
        let input = io::stdin();
        loop {
            // Nothing is asked for, so that it wakes for the end alone.
            let mut watched = [PollFd::new(&input, PollFlags::empty())];
            let woken = poll(&mut watched, None);
            if woken.is_ok() || woken != Err(rustix::io::Errno::INTR) {
                std::process::exit(1);
            }
        }
    };
    std::thread::Builder::new().stack_size(64 << 10).spawn(watch).map(drop)
}
