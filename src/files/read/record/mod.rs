//! The record of a reading: assumptions and notes, as values with their words.

mod assumption;
mod evidence;
mod note;
mod reason;
mod storage_convention;

pub use assumption::{Assumption, Certainty, What};
pub use evidence::Evidence;
pub use note::{Gray, Note, SpecifiedBy, Subject, Unused};
pub use reason::{Reason, SpaceKnown};
pub use storage_convention::StorageConvention;
