//! What the tab *Why* asks: where and by what the predictions are wrong.

pub mod questions;
pub mod thumbnails;

pub use thumbnails::{MOST as MOST_THUMBNAILS, Thumbnails};
