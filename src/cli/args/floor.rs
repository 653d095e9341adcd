//! Repeated captures of the ground truth, as arguments.

use std::path::PathBuf;

#[derive(Debug, clap::Args)]
pub struct FloorArgs {
    /// Another capture of the ground truth, read as it is; may be given several times. The floor is the mean loss between all captures
    /// [default: the loss that rounding leaves]
    #[arg(long = "repeat", value_name = "PATH")]
    pub repeats: Vec<PathBuf>,
}
