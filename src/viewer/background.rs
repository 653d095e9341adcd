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

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;
    use crate::viewer::worker::Task;

    /// The priority of the thread that calls it, as `nice` counts.
    fn nice() -> i32 {
        let stat = std::fs::read_to_string("/proc/thread-self/stat").unwrap();
        let (_, after_name) = stat.rsplit_once(") ").unwrap();
        // The 19th field; the name is the second.
        after_name.split(' ').nth(16).unwrap().parse().unwrap()
    }

    #[test]
    fn workers_yield_to_the_thread_that_starts_them() {
        let before = nice();
        let task = Task::start(&eframe::egui::Context::default(), |_| Ok(nice()));
        assert_eq!(task.wait().unwrap(), before.max(NICE));
        assert_eq!(nice(), before, "the window's thread");
    }

    #[test]
    fn parallel_work_yields() {
        let before = nice();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(2).start_handler(|_| lower_this_thread());
        assert_eq!(pool.build().unwrap().install(nice), before.max(NICE));
    }
}
