//! Priorities of threads: they yield to those of the window and of its driver: slow work must not make frames late.

use std::sync::atomic::{AtomicBool, Ordering};

/// Their priority on the scale of `nice`: they get a tenth of a processor that others want, and all of an idle one.
#[cfg(target_os = "linux")]
const NICE: i32 = 10;

/// The lowest priority.
#[cfg(target_os = "linux")]
const NICEST: i32 = 19;

/// Whether slow work yields: in the window of a person. Tests drive many windows at once, and wait for its results.
static YIELDS: AtomicBool = AtomicBool::new(false);

/// Lowers the priority of tasks from now on, and of the threads that compute in parallel, unless they run already.
pub fn yield_to_window() {
    YIELDS.store(true, Ordering::Relaxed);
    let _ = rayon::ThreadPoolBuilder::new().start_handler(|_| lower()).build_global();
}

/// Threads for what nobody waits for: they get what other slow work leaves.
///
/// # Errors
/// Where the system has no more threads.
pub fn background_pool() -> Result<rayon::ThreadPool, rayon::ThreadPoolBuildError> {
    let lower = || {
        #[cfg(target_os = "linux")]
        if YIELDS.load(Ordering::Relaxed) {
            let _ = rustix::process::setpriority_process(None, NICEST);
        }
    };
    rayon::ThreadPoolBuilder::new().start_handler(move |_| lower()).build()
}

/// Lowers the priority of the thread that calls it, where slow work yields.
pub fn lower_this_thread() {
    if YIELDS.load(Ordering::Relaxed) {
        lower();
    }
}

/// Lowers the priority of this thread. Elsewhere than on Linux it does nothing: there priorities are those of whole processes, or
/// adapters are not software.
fn lower() {
    #[cfg(target_os = "linux")]
    let _ = rustix::process::setpriority_process(None, NICE);
}

/// The priority of the thread that calls it, as `nice` counts.
#[cfg(all(test, target_os = "linux"))]
pub fn nice_of_this_thread() -> i32 {
    #[expect(clippy::disallowed_methods, reason = "a file of the system, which nobody names")]
    let stat = std::fs::read_to_string("/proc/thread-self/stat").unwrap_or_default();
    // The 19th field; the second is a name in parentheses.
    let after_name = stat.rsplit_once(") ").map_or("", |(_, rest)| rest);
    after_name.split(' ').nth(16).and_then(|field| field.parse().ok()).unwrap_or(i32::MAX)
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn only_in_the_window_of_a_person_does_work_yield_and_the_window_never() {
        let before = nice_of_this_thread();
        let worker = || {
            lower_this_thread();
            nice_of_this_thread()
        };
        let run = || std::thread::spawn(worker).join().unwrap();
        assert_eq!(run(), before);
        YIELDS.store(true, Ordering::Relaxed);
        let lowered = run();
        YIELDS.store(false, Ordering::Relaxed);
        assert_eq!((lowered, nice_of_this_thread()), (before.max(NICE), before));
    }
}
