//! Threads that yield to those of the window and of its driver: slow work must not make frames late.

/// Their priority on the scale of `nice`: they get a tenth of a processor that others want, and all of an idle one.
#[cfg(target_os = "linux")]
const NICE: i32 = 10;

/// Lowers the priority of the threads that compute in parallel, unless they run already.
pub(super) fn lower_parallel_threads() {
    let _ = rayon::ThreadPoolBuilder::new().start_handler(|_| lower_this_thread()).build_global();
}

/// Lowers the priority of the thread that calls it. Elsewhere than on Linux it does nothing: there a process has one priority, or
/// adapters are not software.
pub(super) fn lower_this_thread() {
    #[cfg(target_os = "linux")]
    let _ = rustix::process::setpriority_process(None, NICE);
}

/// The priority of the thread that calls it, as `nice` counts.
#[cfg(all(test, target_os = "linux"))]
pub(super) fn nice_of_this_thread() -> i32 {
    let stat = std::fs::read_to_string("/proc/thread-self/stat").unwrap_or_default();
    // The 19th field; the second is a name in parentheses.
    let after_name = stat.rsplit_once(") ").map_or("", |(_, rest)| rest);
    after_name.split(' ').nth(16).and_then(|field| field.parse().ok()).unwrap_or(i32::MAX)
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn a_lowered_thread_yields_and_others_do_not() {
        let before = nice_of_this_thread();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(2).start_handler(|_| lower_this_thread());
        assert_eq!(pool.build().unwrap().install(nice_of_this_thread), before.max(NICE));
        assert_eq!(nice_of_this_thread(), before);
    }
}
