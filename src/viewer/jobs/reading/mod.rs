//! Reading of materials: openings of several at once, retries, uploads to the adapter, and the watch over their files.

pub mod opening;
pub mod read;
pub mod upload;
pub mod watch;
