//! Signals that end the program: SIGINT (Ctrl+C), SIGTERM, SIGHUP, and others that batch systems send.

#[cfg(unix)]
pub use unix::{on_end, outlive_size_limits};
#[cfg(not(unix))]
pub use windows::{on_end, outlive_size_limits};

#[cfg(unix)]
mod unix {
    use std::sync::Arc;
    use std::sync::atomic::AtomicBool;
    use std::thread;

    use signal_hook::consts::{
        SIGALRM, SIGHUP, SIGINT, SIGPROF, SIGQUIT, SIGTERM, SIGUSR1, SIGUSR2, SIGVTALRM, SIGXCPU, SIGXFSZ,
    };
    use signal_hook::iterator::Signals;

    use svbrdf_files::disk::open::NamedFile;

    /// The signals that end a program that does not handle them, other than those of its own faults.
    const ENDING: [i32; 10] =
        [SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF, SIGXCPU];

    /// Calls `then` for every signal that ends the program, on a thread of its own. A signal that is ignored, as SIGINT in the
    /// background of a script and SIGHUP under nohup, stays ignored; the others are handled nevertheless.
    pub fn on_end(then: impl Fn() + Send + 'static) {
        let ignored = ignored();
        let handled = ENDING.into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0);
        let Ok(mut signals) = Signals::new(handled) else { return };
        thread::spawn(move || signals.forever().for_each(|_| then()));
    }

    /// Lets a write fail at the limit of the size of files (`ulimit -f`), which ends the program otherwise, its temporary files
    /// left behind.
    pub fn outlive_size_limits() {
        let _ = signal_hook::flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false)));
    }

    /// The signals that this process was started to ignore, a bit each. Only Linux tells without unsafe code.
    fn ignored() -> u64 {
        let Ok(status) = NamedFile::by_user("/proc/self/status").text() else { return 0 };
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
    }
}

#[cfg(not(unix))]
mod windows {
    /// Calls `then` for Ctrl+C and its like, on a thread of its own.
    pub fn on_end(then: impl Fn() + Send + 'static) {
        let _ = ctrlc::try_set_handler(then);
    }

    /// There is no such signal.
    pub fn outlive_size_limits() {}
}
