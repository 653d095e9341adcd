//! The scenes of a subcommand, as arguments.

use std::path::PathBuf;

use svbrdf_core::error::Error;
use svbrdf_core::loss::{Request, Sampling, SceneChoice, Texels};
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_files::scene_file;

use super::Given;
use super::lights::LightsArgs;
use super::values::{triple, whole};
use crate::cli::output::CommandError;

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Scenes")]
pub struct SceneArgs {
    /// Number of near-field scenes [default: 128; with --distant two for each distant one]
    #[arg(long, value_name = "N", value_parser = whole::<usize>, allow_negative_numbers = true)]
    near: Option<usize>,

    /// Number of distant scenes [default: 64; with --near one for two near-field ones]
    #[arg(long, value_name = "N", value_parser = whole::<usize>, allow_negative_numbers = true)]
    distant: Option<usize>,

    /// Seed of the sampled scenes
    #[arg(long, value_name = "N", value_parser = whole::<u64>, allow_negative_numbers = true, default_value_t = 0)]
    seed: u64,

    /// Sampler of scenes: random, or sobol, which gives less error with as many scenes
    #[arg(long, value_name = "random|sobol", default_value = "sobol")]
    sampler: Sampler,

    /// Uses the scenes of a JSON file instead of sampled ones, or those of a MaterialGAN capture (render.json)
    #[arg(long, value_name = "FILE", conflicts_with_all = ["near", "distant", "seed", "sampler", "lights", "fov"])]
    scenes: Option<PathBuf>,

    #[command(flatten)]
    lights: LightsArgs,
}

impl SceneArgs {
    /// The scenes, and how they were sampled where they were.
    ///
    /// # Errors
    /// As [`SceneArgs::request`].
    pub fn scenes(
        &self,
        convention: &Convention,
        given: &Given,
    ) -> Result<(Option<Sampling>, Vec<Scene>), CommandError> {
        match self.request(given)? {
            Request::Listed(scenes) => Ok((None, scenes)),
            Request::Scenes(sampling) => Ok((Some(sampling), sampling.scenes(convention)?)),
            _ => Err(Error::Internal("scenes without a list".to_owned()).into()),
        }
    }

    /// The request for these scenes on all texels.
    ///
    /// # Errors
    /// Where a scene file cannot be read, or there are no scenes; [`CommandError::Usage`] for options that the scenes do not use.
    pub fn request(&self, given: &Given) -> Result<Request, CommandError> {
        if let Some(scenes) = self.lights.scenes(given)? {
            return Ok(Request::Listed(scenes));
        }
        if let Some(path) = &self.scenes {
            return Ok(Request::Listed(scene_file::read(path)?));
        }
        let Self { near, distant, seed, sampler, .. } = *self;
        let choice = SceneChoice { near, distant, ..SceneChoice::default() };
        let [near, distant] = choice.counts([128, 64]);
        let sampling = Sampling { near, distant, seed, sampler, texels: Texels::All };
        sampling.check()?;
        Ok(Request::Scenes(sampling))
    }
}

/// The seed of a command that samples its scenes itself.
#[derive(Clone, Copy, Debug, clap::Args)]
pub struct SeedArgs {
    /// Seed of the sampled scenes
    #[arg(
        help_heading = "Scenes",
        long,
        value_name = "N",
        value_parser = whole::<u64>,
        allow_negative_numbers = true,
        default_value_t = 0
    )]
    pub seed: u64,
}

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Light and view")]
pub struct OneSceneArgs {
    /// Position of the viewer, or its direction with --distant [default: 0,0,2.5, or as in the session]
    #[arg(long, value_name = "X,Y,Z", value_parser = triple, allow_hyphen_values = true)]
    view: Option<[f64; 3]>,

    /// Position of the light, or its direction with --distant [default: 0.4,0.5,1.2, or as in the session]
    #[arg(long, value_name = "X,Y,Z", value_parser = triple, allow_hyphen_values = true)]
    light: Option<[f64; 3]>,

    /// Places light and viewer infinitely far away
    #[arg(long)]
    distant: bool,
}

impl OneSceneArgs {
    /// The scene; `saved` is that of a session.
    ///
    /// # Errors
    /// [`CommandError::Usage`] where such a scene cannot be rendered.
    pub fn scene(&self, saved: Option<Scene>) -> Result<Scene, CommandError> {
        let usual = Scene { kind: Kind::Near, view: [0.0, 0.0, 2.5], light: [0.4, 0.5, 1.2] };
        let usual = saved.unwrap_or(usual);
        let kind = if self.distant { Kind::Distant } else { usual.kind };
        let (view, light) = (self.view.unwrap_or(usual.view), self.light.unwrap_or(usual.light));
        let scene = Scene { kind, view, light };
        scene.check().map_err(|problem| CommandError::Usage(Error::UnusableScene { problem }.to_string()))?;
        Ok(scene)
    }
}
