//! Changes of a material that may explain a loss: its values in another reading, its texels elsewhere, its radiance brighter.

mod change;
mod reading;
mod remedy;
mod shift;
mod storage;
mod symmetry;

pub use change::{Change, displacement};
pub use reading::Reading;
pub use remedy::Remedy;
pub use shift::shifted;
pub use storage::{Storage, StoredEncoding};
pub use symmetry::Symmetry;
