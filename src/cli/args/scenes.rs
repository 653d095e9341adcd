//! The question of a command, as arguments: the scenes of the loss, or what decides their number.

use std::path::PathBuf;

use clap::ValueEnum as _;

use svbrdf_core::loss::{ALL_SCENES_TARGET, FileScenes, LossOptions};
use svbrdf_core::model::named_scenes::NamedScenes;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_files::scene_file;

use super::given::refuse;
use super::offered;
use super::values::{degrees, percent, stops, triple, whole};
use crate::cli::output::CommandError;

/// Sampled scenes, or those of a list.
#[derive(Debug, clap::Args)]
pub struct SceneArgs {
    #[command(flatten)]
    pub sampled: SampledArgs,

    #[command(flatten)]
    pub seed: SeedArgs,

    #[command(flatten)]
    pub list: ListArgs,
}

/// How many scenes are sampled, and how.
#[derive(Clone, Copy, Debug, clap::Args)]
#[command(next_help_heading = "Scenes")]
pub struct SampledArgs {
    /// Number of near-field scenes [default: 128; with --distant two for each distant one]
    #[arg(long, value_name = "N", value_parser = whole::<usize>, allow_negative_numbers = true)]
    pub near: Option<usize>,

    /// Number of distant scenes [default: 64; with --near one for two near-field ones]
    #[arg(long, value_name = "N", value_parser = whole::<usize>, allow_negative_numbers = true)]
    pub distant: Option<usize>,

    /// Sampler of scenes: random, or sobol, which gives less error with as many scenes [default: sobol]
    #[arg(long, value_name = "random|sobol")]
    #[arg(value_parser = offered(str::parse::<Sampler>, ["random", "sobol"]), hide_possible_values = true)]
    pub sampler: Option<Sampler>,
}

/// The seed of a command that samples its scenes.
#[derive(Debug, clap::Args)]
pub struct SeedArgs {
    /// Seed of the sampled scenes [default: 0]
    #[arg(help_heading = "Scenes", long, value_name = "N", value_parser = whole::<u64>, allow_negative_numbers = true)]
    pub seed: Option<u64>,
}

/// A loss to an accuracy.
#[derive(Debug, clap::Args)]
pub struct AccuracyArgs {
    #[command(flatten)]
    target_error: TargetErrorArgs,

    #[command(flatten)]
    seed: SeedArgs,
}

/// The scenes of losses, or an accuracy that decides their number.
#[derive(Debug, clap::Args)]
pub struct QuestionArgs {
    #[command(flatten)]
    target_error: TargetErrorArgs,

    #[command(flatten)]
    scenes: SceneArgs,
}

/// The accuracy of a loss.
#[derive(Debug, clap::Args)]
pub struct TargetErrorArgs {
    /// Samples as many scenes as this relative error of every loss needs at 95% confidence [default: 1%]
    #[arg(help_heading = "Scenes", long, value_name = "PERCENT", value_parser = percent, allow_hyphen_values = true)]
    pub target_error: Option<f64>,
}

/// The scenes of a file, or those of a publication.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Scenes")]
pub struct ListArgs {
    /// Scenes of a JSON file, or of a MaterialGAN capture (render.json)
    #[arg(long, value_name = "FILE", conflicts_with_all = ["lights", "fov"])]
    pub scenes: Option<PathBuf>,

    /// Lights and views: sampled, or the fixed set of a publication
    #[arg(long, value_name = "NAME", value_enum)]
    pub lights: Option<Lights>,

    /// Angle that the width of the material spans at the camera of --lights flash [default: 45]
    #[arg(long, value_name = "DEGREES", value_parser = degrees, allow_negative_numbers = true)]
    fov: Option<f64>,
}

/// Scenes by name. `docs/conventions.md` has their sources.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Lights {
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

impl SceneArgs {
    pub fn options(&self) -> Result<LossOptions, CommandError> {
        Ok(LossOptions { seed: self.seed.seed, file: self.list.file()?, ..self.sampled.options() })
    }
}

impl SampledArgs {
    pub fn options(self) -> LossOptions {
        let Self { near, distant, sampler } = self;
        LossOptions { near, distant, sampler, ..LossOptions::default() }
    }
}

impl AccuracyArgs {
    /// The target error, 1% where it is not specified, and the seed.
    pub fn target_and_seed(&self) -> (f64, u64) {
        (self.target_error.target_error.unwrap_or(ALL_SCENES_TARGET), self.seed.seed.unwrap_or(0))
    }

    pub fn options(&self) -> LossOptions {
        let (target_error, seed) = (self.target_error.target_error, self.seed.seed);
        LossOptions { target_error, seed, ..LossOptions::default() }
    }
}

impl QuestionArgs {
    pub fn options(&self) -> Result<LossOptions, CommandError> {
        Ok(LossOptions { target_error: self.target_error.target_error, ..self.scenes.options()? })
    }

    /// The target error, 1% where it is not specified, and the seed.
    pub fn target_and_seed(&self) -> (f64, u64) {
        (self.target_error.target_error.unwrap_or(ALL_SCENES_TARGET), self.scenes.seed.seed.unwrap_or(0))
    }

    /// The options of the scenes as they are typed, but for the seed.
    pub fn words(&self) -> Vec<String> {
        let SceneArgs { sampled: SampledArgs { near, distant, sampler }, list, .. } = &self.scenes;
        let options = [
            ("--near", near.map(|count| count.to_string())),
            ("--distant", distant.map(|count| count.to_string())),
            ("--sampler", sampler.map(|sampler| sampler.to_string())),
            ("--scenes", list.scenes.as_ref().map(|path| path.display().to_string())),
            ("--lights", list.lights.and_then(|one| Some(one.to_possible_value()?.get_name().to_owned()))),
            ("--fov", list.fov.map(|angle| angle.to_string())),
        ];
        let given = options.into_iter().filter_map(|(option, value)| Some([option.to_owned(), value?]));
        given.flatten().collect()
    }
}

impl ListArgs {
    /// The scenes of the list; `None` where scenes are sampled.
    pub fn file(&self) -> Result<Option<FileScenes>, CommandError> {
        let is_flash = self.lights == Some(Lights::Flash);
        refuse(self.fov.is_some() && !is_flash, "fov", "a field of view belongs to `--lights flash`")?;
        if let Some(path) = &self.scenes {
            return Ok(Some(scene_file::read_named(path)?));
        }
        let named = match self.lights.unwrap_or_default() {
            Lights::Papers => return Ok(None),
            Lights::Flash => NamedScenes::Flash { fov_degrees: self.fov.unwrap_or(NamedScenes::FOV_DEGREES) },
            Lights::Flash9 => NamedScenes::Flash9,
            Lights::Hemisphere => NamedScenes::Hemisphere,
        };
        let (name, scenes) = (named.name().to_owned(), named.scenes()?);
        Ok(Some(FileScenes { name, path: PathBuf::new(), scenes }))
    }
}

/// The light, view and exposure of pictures.
#[derive(Debug, clap::Args)]
pub struct RenderingArgs {
    #[command(flatten)]
    pub scene: OneSceneArgs,

    /// Exposure of renderings in stops [default: 0, or as in the session]
    #[arg(long, value_name = "EV", value_parser = stops, allow_hyphen_values = true)]
    pub exposure: Option<f32>,
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
    /// Whether light and view are specified.
    pub fn is_specified(&self) -> bool {
        self.view.is_some() && self.light.is_some()
    }

    /// The scene; `saved` is that of a session.
    pub fn scene(&self, saved: Option<Scene>) -> Result<Scene, CommandError> {
        let usual = Scene { kind: Kind::Near, view: [0.0, 0.0, 2.5], light: [0.4, 0.5, 1.2] };
        let usual = saved.unwrap_or(usual);
        let kind = if self.distant { Kind::Distant } else { usual.kind };
        let (view, light) = (self.view.unwrap_or(usual.view), self.light.unwrap_or(usual.light));
        let scene = Scene { kind, view, light };
        scene.check_usable().map_err(|error| CommandError::Usage(error.to_string()))?;
        Ok(scene)
    }
}
