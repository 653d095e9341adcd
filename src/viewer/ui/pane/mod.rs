//! Panes: their arrangement, what each displays, its marks and handles, and the gestures of the mouse in them.

pub mod cells;
pub mod gestures;
pub mod handles;
pub mod hovered;
pub mod marks;
pub mod placed;
pub mod scale;
pub mod scenery;
pub mod texels;
pub mod title;
pub mod viewport;
