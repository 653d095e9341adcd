//! What a subcommand compares.

use svbrdf::model::convention::Convention;

use super::materials::MaterialArgs;
use super::session::SessionSettings;

#[derive(Debug, clap::Args)]
pub struct ComparisonArgs {
    /// Convention: printed, single-image-2018, multi-image-2019 or guided-2020 [default: printed, or as in the session]
    #[arg(long, value_name = "NAME")]
    convention: Option<Convention>,

    #[command(flatten)]
    pub materials: MaterialArgs,
}

impl ComparisonArgs {
    /// The convention: as specified, or as in the session, or the default.
    pub fn convention(&self) -> Convention {
        // A session that cannot be read is an error wherever its materials are opened.
        let of_session = || SessionSettings::of(&self.materials).ok().flatten().map(|saved| saved.convention);
        self.convention.or_else(of_session).unwrap_or_default()
    }
}
