//! What a subcommand compares.

use svbrdf::model::convention::Convention;

use super::materials::MaterialArgs;

#[derive(Debug, clap::Args)]
pub struct ComparisonArgs {
    /// Convention: printed, single-image-2018, multi-image-2019 or guided-2020
    #[arg(long, value_name = "NAME", default_value = "printed")]
    pub convention: Convention,

    #[command(flatten)]
    pub materials: MaterialArgs,
}
