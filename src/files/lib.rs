//! Reading and writing of materials. Files are written completely or not at all.
//!
//! ```no_run
//! use std::path::Path;
//!
//! use svbrdf_files::read::{self, Read, ReadOptions};
//! use svbrdf_files::write::{self, FileKind};
//! use svbrdf_core::progress::Progress;
//!
//! let read: Read<f32> = read::read(Path::new("brick.png"), &ReadOptions::AUTO, &Progress::default())?;
//! for assumption in &read.assumptions {
//!     println!("{assumption}");
//! }
//! let output = Path::new("brick.exr");
//! write::write(&read.material, output, FileKind::new(output, None)?)?;
//! # Ok::<(), svbrdf_files::Error>(())
//! ```

pub mod arrays;
pub mod changes;
pub mod convention;
pub mod disk;
mod error;
pub mod export;
mod npy;
pub mod photograph;
pub mod read;
pub mod samples;
pub mod scene_file;
pub mod session;
pub mod source;
pub mod write;

pub use error::{Error, Guess, OutputProblem};
