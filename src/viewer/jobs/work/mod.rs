//! The mechanism of all background work: jobs with updates, progress and cancellation, the latest result for a key, the waker
//! of the window, priorities of threads, and panics as errors.

pub mod job;
pub mod panics;
pub mod picture;
pub mod priority;
pub mod waker;
