//! Reading and writing of materials. Files are written completely or not at all.
//!
//! ```no_run
//! use std::path::Path;
//!
//! use svbrdf::files::read::{self, Read, ReadOptions};
//! use svbrdf::files::write::{self, FileKind, WriteOptions};
//! use svbrdf::progress::Progress;
//!
//! let read: Read<f32> = read::read(Path::new("brick.png"), &ReadOptions::AUTO, &Progress::default())?;
//! for assumption in &read.assumptions {
//!     println!("{assumption}");
//! }
//! let output = Path::new("brick.exr");
//! let options = WriteOptions::default();
//! write::write(&read.material, output, FileKind::new(output, &options)?)?;
//! # Ok::<(), svbrdf::error::Error>(())
//! ```

#[cfg(not(feature = "testing"))]
pub(crate) mod atomic;
#[cfg(feature = "testing")]
pub mod atomic;
pub mod open;
pub mod read;
pub mod session;
pub mod stamp;
mod step_names;
pub mod steps;
pub mod write;
