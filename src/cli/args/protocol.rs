//! A protocol on the command line, and which texels are compared.

use svbrdf_core::loss::LossOptions;
use svbrdf_evaluate::protocols::{MaskSource, Protocol};
use svbrdf_files::convention::ChosenConvention;

use super::scenes::{FixedNumber, SceneArgs};
use super::{Specified, offered, refuse};
use crate::cli::output::CommandError;

/// How the pairs of a comparison are compared.
#[derive(Debug, Default, clap::Args)]
pub struct PairArgs {
    #[command(flatten)]
    pub protocol: ProtocolArgs,

    #[command(flatten)]
    pub mask: MaskArgs,
}

/// Which texels are compared.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct MaskArgs {
    /// Compares only the texels that are opaque in the alpha of the ground truth, or white in a picture
    ///
    /// alpha, or the path of a picture of the size of the ground truth, in which {} stands for the name of the material: 'masks/{}.png'.
    #[arg(long, value_name = "alpha|FILE", hide_possible_values = true, hide_short_help = true)]
    #[arg(value_parser = offered(str::parse::<MaskSource>, ["alpha"]))]
    pub mask: Option<MaskSource>,
}

#[derive(Debug, Default, clap::Args)]
pub struct ProtocolArgs {
    /// Compares as a paper does
    ///
    /// The name of a protocol, or a .toml file. It decides reading, registration, mask, scenes, convention and metrics with their means; --read and --register count before it.
    #[arg(long, value_name = "NAME|FILE", hide_possible_values = true, hide_short_help = true)]
    #[arg(value_parser = offered(|text| Protocol::read(text).map(Box::new), Protocol::names()))]
    pub protocol: Option<Box<Protocol>>,
}

impl ProtocolArgs {
    /// The convention and the options of scenes. What the protocol decides is refused on the command line.
    pub fn decided(
        &self,
        convention: Option<&ChosenConvention>,
        typed: LossOptions,
        given: &Specified,
    ) -> Result<(Option<ChosenConvention>, LossOptions), CommandError> {
        let Some(protocol) = &self.protocol else { return Ok((convention.cloned(), typed)) };
        let reason = |what: &str| format!("the protocol {} decides {what}", protocol.name);
        let convention = match protocol.convention {
            Some(_) => {
                refuse(convention.is_some(), "convention", &reason("the convention"))?;
                Some(protocol.chosen_convention()?)
            }
            None => convention.cloned(),
        };
        if protocol.scenes.is_none() {
            return Ok((convention, typed));
        }
        given.refuse::<SceneArgs<FixedNumber>>(&reason("the scenes"))?;
        refuse(typed.target_error.is_some(), "target-error", &reason("the scenes"))?;
        refuse(typed.time_budget.is_some(), "time-budget", &reason("the scenes"))?;
        Ok((convention, protocol.options(&typed)?))
    }
}
