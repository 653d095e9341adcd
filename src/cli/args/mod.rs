//! Arguments that several subcommands share, their values, and the refusal of options that a mode of a subcommand does not use.

pub mod comparison;
pub mod named_path;
pub mod offered;
pub mod protocol;
pub mod reading;
pub mod scenes;
pub mod specified;
pub mod trust;
pub mod values;
pub mod wildcards;

pub use comparison::{ComparisonArgs, MaterialArgs};
pub use named_path::{NamedPath, is_there};
pub use offered::offered;
pub use specified::{Specified, refuse};
pub use trust::TrustArgs;
