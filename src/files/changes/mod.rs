//! Changes of a material that may explain a loss: its values in another reading, its texels elsewhere, its radiance brighter.

mod change;
mod reading;
mod remedy;
mod storage;
mod symmetry;

pub use change::shifted;
pub use change::{Change, displacement};
pub use reading::Reading;
pub use remedy::Remedy;
pub use storage::{Storage, StoredEncoding};
pub use symmetry::Symmetry;
