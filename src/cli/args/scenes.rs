//! The question of a command, as arguments: the scenes of the loss, or what decides their number.

use std::path::PathBuf;
use std::time::Duration;

use clap::{Arg, ArgMatches, Args as _, Command, ValueEnum as _};

use svbrdf_core::loss::{ALL_SCENES_TARGET, FileScenes, LossOptions, Precision, Texels};
use svbrdf_core::model::named_scenes::NamedScenes;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_files::scene_file;

use super::given::refuse;
use super::offered;
use super::values::{degrees, duration, percent, stops, triple, whole};
use crate::cli::output::CommandError;

/// How many scenes are sampled, and how.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Scenes")]
pub struct SampledArgs {
    /// Number of near-field scenes [default: 128; with --distant two for each distant one]
    #[arg(long, value_name = "N", value_parser = whole::<usize>, allow_negative_numbers = true)]
    near: Option<usize>,

    /// Number of distant scenes [default: 64; with --near one for two near-field ones]
    #[arg(long, value_name = "N", value_parser = whole::<usize>, allow_negative_numbers = true)]
    distant: Option<usize>,

    /// Sampler of scenes: random, or sobol, which gives less error with as many scenes [default: sobol]
    #[arg(long, value_name = "random|sobol")]
    #[arg(value_parser = offered(str::parse::<Sampler>, ["random", "sobol"]), hide_possible_values = true)]
    sampler: Option<Sampler>,
}

/// The seed of a command that samples its scenes.
#[derive(Debug, clap::Args)]
pub struct SeedArgs {
    /// Seed of the sampled scenes [default: 0]
    #[arg(help_heading = "Scenes", long, value_name = "N", value_parser = whole::<u64>, allow_negative_numbers = true)]
    seed: Option<u64>,
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
    sampled: SampledArgs,

    #[command(flatten)]
    seed: SeedArgs,

    #[command(flatten)]
    list: ListArgs,
}

/// All options of the analyses that decide scenes, texels and precision; each analysis has some of them.
#[derive(Debug, clap::Args)]
pub struct AnalysisSceneArgs {
    #[command(flatten)]
    question: QuestionArgs,

    /// Compares all texels, or an independent random subset of N texels per scene, which is fast on maps of any size
    /// [default: 32; with --near or --distant all]
    #[arg(help_heading = "Scenes", long, value_name = "all|N", allow_negative_numbers = true)]
    #[arg(value_parser = offered(str::parse::<Texels>, ["all"]), hide_possible_values = true)]
    texels: Option<Texels>,

    /// Samples as many scenes as fit into this time, such as 500ms or 2s
    #[arg(help_heading = "Scenes", long, value_name = "TIME", value_parser = duration, allow_hyphen_values = true)]
    time_budget: Option<Duration>,

    /// Floating-point precision
    #[arg(help_heading = None::<&str>, long, value_name = "f32|f64", default_value = "f32")]
    #[arg(value_parser = offered(str::parse::<Precision>, ["f32", "f64"]), hide_possible_values = true)]
    precision: Precision,
}

impl AnalysisSceneArgs {
    /// The arguments of these options, in their order; `scenes` has those of named scenes, too.
    pub fn arguments(options: &[&str]) -> Vec<Arg> {
        fn option(arg: &Arg) -> &str {
            let id = arg.get_id().as_str();
            if ["lights", "fov"].contains(&id) { "scenes" } else { id }
        }
        let all = Self::augment_args(Command::new("all"));
        let named = |name| all.get_arguments().filter(move |arg| option(arg) == name).cloned();
        let all = options.iter().flat_map(|name| named(*name)).enumerate();
        all.map(|(order, arg)| arg.display_order(order)).collect()
    }

    /// The options and the precision of `matches`, which may lack some arguments.
    pub fn options(matches: &ArgMatches) -> Result<(LossOptions, Precision), CommandError> {
        fn value<T: Clone + Send + Sync + 'static>(matches: &ArgMatches, id: &str) -> Option<T> {
            matches.try_get_one(id).ok().flatten().cloned()
        }
        let list = ListArgs {
            scenes: value(matches, "scenes"),
            lights: value(matches, "lights"),
            fov: value(matches, "fov"),
        };
        let options = LossOptions {
            near: value(matches, "near"),
            distant: value(matches, "distant"),
            seed: value(matches, "seed"),
            sampler: value(matches, "sampler"),
            texels: value(matches, "texels"),
            target_error: value(matches, "target_error"),
            time_budget: value(matches, "time_budget"),
            file: list.file()?,
        };
        Ok((options, value(matches, "precision").unwrap_or_default()))
    }
}

/// The accuracy of a loss.
#[derive(Debug, clap::Args)]
pub struct TargetErrorArgs {
    /// Samples as many scenes as this relative error of every loss needs at 95% confidence [default: 1%]
    #[arg(help_heading = "Scenes", long, value_name = "PERCENT", value_parser = percent, allow_hyphen_values = true)]
    target_error: Option<f64>,
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
        let Self { target_error, sampled: SampledArgs { near, distant, sampler }, seed, list } = self;
        Ok(LossOptions {
            near: *near,
            distant: *distant,
            sampler: *sampler,
            seed: seed.seed,
            target_error: target_error.target_error,
            file: list.file()?,
            ..LossOptions::default()
        })
    }

    /// The target error, 1% where it is not specified, and the seed.
    pub fn target_and_seed(&self) -> (f64, u64) {
        (self.target_error.target_error.unwrap_or(ALL_SCENES_TARGET), self.seed.seed.unwrap_or(0))
    }

    /// The options of the scenes as they are typed, but for the seed.
    pub fn words(&self) -> Vec<String> {
        let Self { sampled: SampledArgs { near, distant, sampler }, list, .. } = self;
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
