//! Threads of the work: panics in them as errors, with message and location, and their priorities: they yield to those of the window and
//! of its driver.

use std::any::Any;
use std::panic::{AssertUnwindSafe, PanicHookInfo};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, Once, PoisonError};

use crate::error::Error;

/// The latest panic of any thread: one of a thread of a pool is passed on to the thread that waits for it.
static LATEST: Mutex<Option<String>> = Mutex::new(None);
/// Whether panics are written to standard error, too.
static ARE_PRINTED: AtomicBool = AtomicBool::new(true);

/// Whether panics from now on are written to standard error, too. The window reports them itself.
pub fn print_panics(on: bool) {
    record();
    ARE_PRINTED.store(on, Ordering::Relaxed);
}

/// Does `work`; a panic in it is an error with its message and location.
///
/// # Errors
/// Those of the work, and an internal one.
pub fn caught<T>(work: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
    record();
    std::panic::catch_unwind(AssertUnwindSafe(work))
        .unwrap_or_else(|payload| Err(Error::internal(report(payload.as_ref()))))
}

/// Records panics from now on.
fn record() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let earlier = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |info| {
            let text = text(info);
            *LATEST.lock().unwrap_or_else(PoisonError::into_inner) = Some(text);
            if ARE_PRINTED.load(Ordering::Relaxed) {
                earlier(info);
            }
        }));
    });
}

/// The message and the location of the panic that has been caught.
fn report(payload: &(dyn Any + Send)) -> String {
    let latest = LATEST.lock().unwrap_or_else(PoisonError::into_inner).take();
    latest.unwrap_or_else(|| message(payload).to_owned())
}

fn text(info: &PanicHookInfo<'_>) -> String {
    let message = message(info.payload());
    match info.location() {
        Some(at) => format!("{message} ({}:{})", short(at.file()), at.line()),
        None => message.to_owned(),
    }
}

fn message(payload: &(dyn Any + Send)) -> &str {
    let text = payload.downcast_ref::<&str>().copied();
    text.or_else(|| payload.downcast_ref::<String>().map(String::as_str))
        .unwrap_or("a panic without a message")
}

/// The path of a source file from the folder of its package on: the rest is of the machine that built the program.
fn short(file: &str) -> String {
    let parts: Vec<&str> = Path::new(file).iter().filter_map(|part| part.to_str()).collect();
    let source = parts.iter().rposition(|part| *part == "src").unwrap_or(0);
    parts[source.saturating_sub(1)..].join("/")
}

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

#[cfg(test)]
mod tests {
    use super::*;

    use svbrdf_core::error::Error as CoreError;

    fn caught_text(work: impl FnOnce() -> Result<(), Error>) -> String {
        caught(work).unwrap_err().to_string()
    }

    #[test]
    fn a_panic_is_an_error_with_its_message_and_location() {
        let text = caught_text(|| panic!("planted {}", 7));
        assert!(text.contains("planted 7 (") && text.contains("threads.rs:"), "{text}");
        assert_eq!(caught(|| Ok(3)).unwrap(), 3);
        assert!(
            caught(|| Err::<(), _>(CoreError::Cancelled.into())).is_err_and(|error| error.is_cancelled())
        );
    }

    #[test]
    fn a_panic_on_a_thread_of_the_pool_is_reported_too() {
        let work = || {
            rayon::join(|| panic!("planted in the pool"), || ());
            Ok(())
        };
        let text = caught_text(work);
        assert!(text.contains("planted in the pool"), "{text}");
    }

    #[test]
    fn a_location_names_no_folder_of_a_machine() {
        assert_eq!(
            short("/home/me/.cargo/registry/src/index/egui-0.37.0/src/context.rs"),
            "egui-0.37.0/src/context.rs"
        );
        assert_eq!(short("src/viewer/app/mod.rs"), "src/viewer/app/mod.rs");
    }

    #[cfg(target_os = "linux")]
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
