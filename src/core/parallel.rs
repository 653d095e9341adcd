//! Parallel maps over indices on all cores: one loop, which is compiled once for all of them.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

/// What `of` gives at each index below `count`, in order. For work of a microsecond or more at each.
pub fn map<R: Send>(count: usize, of: impl Fn(usize) -> R + Sync) -> Vec<R> {
    let slots: Vec<Mutex<Option<R>>> = (0..count).map(|_| Mutex::new(None)).collect();
    each(count, &|index| *slots[index].lock().unwrap_or_else(PoisonError::into_inner) = Some(of(index)));
    slots.into_iter().filter_map(|slot| slot.into_inner().unwrap_or_else(PoisonError::into_inner)).collect()
}

/// As [`map`]; after an error no other index is begun.
///
/// # Errors
/// The first error by index.
pub fn try_map<R: Send, E: Send>(
    count: usize,
    of: impl Fn(usize) -> Result<R, E> + Sync,
) -> Result<Vec<R>, E> {
    let failed = AtomicBool::new(false);
    let results = map(count, |index| {
        let result = (!failed.load(Ordering::Relaxed)).then(|| of(index))?;
        failed.fetch_or(result.is_err(), Ordering::Relaxed);
        Some(result)
    });
    results.into_iter().flatten().collect()
}

fn each(count: usize, at: &(dyn Fn(usize) + Sync)) {
    (0..count).into_par_iter().for_each(at);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_in_order_and_errors_end_the_map() {
        assert_eq!(map(1000, |index| 2 * index), (0..1000).map(|index| 2 * index).collect::<Vec<_>>());
        assert_eq!(try_map(3, Ok::<_, ()>), Ok(vec![0, 1, 2]));
        assert_eq!(try_map(1000, |index| if index > 20 { Err("above") } else { Ok(index) }), Err("above"));
    }
}
