//! Changes of a material that may explain a loss: its values in another reading, its texels elsewhere, its radiance brighter.

mod change;
mod placement;
mod reading;
mod symmetry;

pub use change::{Change, displacement, shifted};
pub use placement::{Placement, Taps, interpolated};
pub use reading::Reading;
pub use symmetry::Symmetry;
