//! Reading of materials: openings of several at once, retries, and the watch over their files.

pub mod opening;
pub mod read;
pub mod watch;
