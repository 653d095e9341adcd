//! Memory: one limit for everything that is read, asked before it is allocated.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};

use sysinfo::{CGroupLimits, MemoryRefreshKind, System};

use crate::error::Error;

/// What is left where the system does not tell.
const UNKNOWN: u64 = 8 << 30;

static SPECIFIED: OnceLock<u64> = OnceLock::new();
static RESERVED: AtomicU64 = AtomicU64::new(0);

/// Sets the limit in bytes, once, before anything is read.
pub fn set_limit(bytes: u64) {
    let _ = SPECIFIED.set(bytes);
}

/// The limit in bytes: the one that was set, or half of what the machine, its control group and the limits of the process
/// leave when it is first asked for.
pub fn limit() -> u64 {
    *SPECIFIED.get_or_init(|| available() / 2)
}

/// Memory that is put aside until this is dropped.
#[derive(Debug, PartialEq, Eq)]
#[must_use = "the memory is put aside until this is dropped"]
pub struct Reserved(u64);

/// Puts `bytes` aside for `what`, which is put into words only for an error.
///
/// # Errors
/// [`Error::Memory`] where that is more than the limit leaves beside all that is put aside at this moment;
/// [`Error::NoMemory`] where the system does not give as much now.
pub fn reserve(bytes: u64, what: impl FnOnce() -> String) -> Result<Reserved, Error> {
    let limit = limit();
    let add = |reserved: u64| reserved.checked_add(bytes).filter(|sum| *sum <= limit);
    if RESERVED.fetch_update(Ordering::Relaxed, Ordering::Relaxed, add).is_err() {
        return Err(Error::Memory { what: what(), bytes, limit });
    }
    let reserved = Reserved(bytes);
    if is_given(bytes) { Ok(reserved) } else { Err(Error::NoMemory { what: what(), bytes }) }
}

/// Whether the system gives this much memory at this moment. Decoders allocate by themselves, and abort where it does not.
fn is_given(bytes: u64) -> bool {
    usize::try_from(bytes).is_ok_and(|bytes| Vec::<u8>::new().try_reserve_exact(bytes).is_ok())
}

impl Drop for Reserved {
    fn drop(&mut self) {
        RESERVED.fetch_sub(self.0, Ordering::Relaxed);
    }
}

/// The memory that this process may still take.
fn available() -> u64 {
    let mut system = System::new();
    system.refresh_memory_specifics(MemoryRefreshKind::nothing().with_ram());
    let machine = Some(system.available_memory()).filter(|bytes| *bytes > 0);
    let group = system.cgroup_limits().map(of_group);
    [machine, group, of_process()].into_iter().flatten().min().unwrap_or(UNKNOWN)
}

/// The memory that a control group leaves. It counts cached files as used, whose memory the system gives back.
fn of_group(limits: CGroupLimits) -> u64 {
    limits.total_memory.saturating_sub(limits.rss)
}

/// The limit of the address space of this process (`ulimit -v`).
#[cfg(unix)]
fn of_process() -> Option<u64> {
    rustix::process::getrlimit(rustix::process::Resource::As).current
}

#[cfg(not(unix))]
fn of_process() -> Option<u64> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cached_files_of_a_control_group_do_not_count() {
        let limits = CGroupLimits { total_memory: 8 << 30, free_memory: 1 << 20, free_swap: 0, rss: 2 << 30 };
        assert_eq!(of_group(limits), 6 << 30);
    }

    #[test]
    fn no_more_is_put_aside_than_the_limit() {
        let limit = limit();
        assert!(limit > 1 << 20, "{limit}");
        let error = reserve(limit + 1, || "a picture".to_owned()).unwrap_err().to_string();
        assert!(error.contains("a picture"), "{error}");
        let half = || reserve(limit / 2 + 1, String::new);
        let first = half().unwrap();
        assert!(half().is_err());
        drop(first);
        assert!(half().is_ok());
    }

    #[test]
    fn what_the_system_does_not_give_is_not_given() {
        assert!(is_given(0) && is_given(1 << 20));
        assert!(!is_given(1 << 62) && !is_given(u64::MAX));
    }
}
