//! Names of files and layers, and the map that each stands for.

mod label;
mod listing;
mod set_labels;
mod words;

pub(crate) use label::Label;
pub use listing::EXTENSIONS;
pub(crate) use listing::{LISTING, PICTURES, extension, folders, is_junk, list, listing, material_name};
pub(crate) use set_labels::set_labels;
pub use set_labels::sets;
pub(crate) use set_labels::word_beside;
pub(crate) use words::{is_named_as, is_named_within, size, words};
