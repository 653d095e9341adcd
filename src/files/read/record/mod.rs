//! The record of a reading: what was assumed and noticed, as values, and the sentences for them.

pub(super) mod assumption;
pub(super) mod evidence;
pub(super) mod note;
mod note_text;
pub(super) mod reason;
mod reason_text;
pub(super) mod storage_convention;
