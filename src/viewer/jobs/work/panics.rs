//! Panics as errors: the message and the location of a panic become an internal [`Error`].

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
pub fn print(on: bool) {
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

#[cfg(test)]
mod tests {
    use svbrdf_core::error::Error as CoreError;

    use super::*;

    fn caught_text(work: impl FnOnce() -> Result<(), Error>) -> String {
        caught(work).unwrap_err().to_string()
    }

    #[test]
    fn a_panic_is_an_error_with_its_message_and_location() {
        let text = caught_text(|| panic!("planted {}", 7));
        assert!(text.contains("planted 7 (") && text.contains("panics.rs:"), "{text}");
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
}
