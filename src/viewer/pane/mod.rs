//! Panes: their arrangement, what each displays, its marks and handles, and the gestures of the mouse in them.

pub mod cells;
pub mod difference;
pub mod displayed;
pub mod draft_policy;
pub mod gestures;
pub mod gpu_view;
pub mod handles;
pub mod legend;
pub mod marks;
pub mod placed;
pub mod readout;
pub mod scale;
pub mod scenery;
pub mod shade;
pub mod shaded;
pub mod snapshot;
pub mod statistics;
pub mod title;
pub mod viewport;
pub mod visible;
