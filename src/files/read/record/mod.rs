//! The record of a reading: assumptions and notes, as values, and the sentences for them.

mod assumption;
mod evidence;
mod note;
mod note_text;
mod reason;
mod reason_text;
mod storage_convention;

pub use assumption::{Assumption, Certainty, What};
pub use evidence::Evidence;
pub use note::{Gray, Note, SpecifiedBy, Subject, Unused};
pub use reason::{Reason, SpaceKnown};
pub use storage_convention::StorageConvention;
