//! Sets of scenes by name, as arguments.

use svbrdf_core::model::named_scenes::NamedScenes;
use svbrdf_core::model::scene::Scene;

use super::values::degrees;
use super::{Given, modes};
use crate::cli::output::CommandError;

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Scenes")]
pub struct LightsArgs {
    /// Lights and views: sampled, or the fixed set of a publication [default: papers]
    #[arg(long, value_name = "NAME", value_enum)]
    lights: Option<Lights>,

    /// Angle that the width of the material spans at the camera of --lights flash [default: 45]
    #[arg(long, value_name = "DEGREES", value_parser = degrees, allow_negative_numbers = true)]
    fov: Option<f64>,
}

/// Scenes by name. `docs/conventions.md` has their sources.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
enum Lights {
    /// Sampled near-field and distant scenes (Algorithms 1 and 2)
    #[default]
    Papers,
    /// One flash at the camera, straight above the centre, at the distance of --fov
    Flash,
    /// Nine flashes at the camera (Guo et al. 2020, MaterialGAN)
    #[value(name = "flash-9")]
    Flash9,
    /// 128 lights on the hemisphere, the camera above the centre (Sartor and Peers 2023)
    Hemisphere,
}

impl LightsArgs {
    /// Whether the scenes are a fixed set.
    pub fn is_named(&self) -> bool {
        self.lights.is_some_and(|lights| lights != Lights::Papers)
    }

    /// The scenes of a fixed set; `None` where scenes are sampled or of a file.
    ///
    /// # Errors
    /// [`CommandError::Usage`] for options that the set does not use.
    pub fn scenes(&self, given: &Given) -> Result<Option<Vec<Scene>>, CommandError> {
        if self.lights != Some(Lights::Flash) {
            given.check(&modes::NO_FLASH)?;
        }
        let named = match self.lights.unwrap_or_default() {
            Lights::Papers => return Ok(None),
            Lights::Flash => NamedScenes::Flash { fov_degrees: self.fov.unwrap_or(NamedScenes::FOV_DEGREES) },
            Lights::Flash9 => NamedScenes::Flash9,
            Lights::Hemisphere => NamedScenes::Hemisphere,
        };
        given.check(&modes::NAMED_SCENES)?;
        Ok(Some(named.scenes()?))
    }
}
