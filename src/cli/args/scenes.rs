//! Arguments about scenes: of the loss, or what decides their number; of a picture.

use std::marker::PhantomData;
use std::path::PathBuf;

use clap::builder::ValueParser;
use clap::{Arg, ArgMatches, Args as _, Command, FromArgMatches};

use svbrdf_core::loss::{FileScenes, LossOptions, Precision, Texels};
use svbrdf_core::model::named_scenes::NamedScenes;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_evaluate::analyses::RankReport;
use svbrdf_evaluate::report::{Analysis as _, SCENE_OPTIONS};
use svbrdf_files::scene_file;

use super::values::{degrees, duration, percent, stops, triple, whole};
use super::{offered, refuse};
use crate::cli::output::CommandError;

/// The arguments of options by name, in this order; `scenes` has those of named scenes, too.
pub fn arguments(options: &[&str]) -> Vec<Arg> {
    let list = ListArgs::augment_args(Command::new("list"));
    let of = |name: &&str| match SCENE_OPTIONS.iter().find(|option| option[0] == *name) {
        Some(option) => vec![argument(*option)],
        None => list.get_arguments().cloned().collect(),
    };
    let all = options.iter().flat_map(of).enumerate();
    all.map(|(order, arg)| arg.display_order(order)).collect()
}

fn argument([name, about, open]: [&'static str; 3]) -> Arg {
    let default = if open.is_empty() { String::new() } else { format!(" [default: {open}]") };
    let help = |example: &str| format!("{about}{example}{default}").replace('{', "--").replace('}', "");
    let arg = Arg::new(name).long(name.replace('_', "-")).help_heading("Scenes").help(help(""));
    let arg = arg.hide_possible_values(true).allow_negative_numbers(true);
    match name {
        "target_error" => {
            arg.value_name("PERCENT").value_parser(ValueParser::new(percent)).allow_hyphen_values(true)
        }
        "time_budget" => {
            let arg = arg.value_name("TIME").value_parser(ValueParser::new(duration));
            arg.allow_hyphen_values(true).help(help(", such as 500ms or 2s"))
        }
        "sampler" => {
            let sampler = offered(str::parse::<Sampler>, ["random", "sobol"]);
            arg.value_name("random|sobol").value_parser(sampler)
        }
        "texels" => arg.value_name("all|N").value_parser(offered(str::parse::<Texels>, ["all"])),
        "precision" => {
            let precision = offered(str::parse::<Precision>, ["f32", "f64"]);
            arg.value_name("f32|f64").value_parser(precision).default_value("f32").help_heading(None::<&str>)
        }
        "seed" => arg.value_name("N").value_parser(ValueParser::new(whole::<u64>)),
        _ => arg.value_name("N").value_parser(ValueParser::new(whole::<usize>)),
    }
}

/// The options of `matches`, which may lack some arguments.
pub fn options(matches: &ArgMatches) -> Result<LossOptions, CommandError> {
    let list = ListArgs {
        scenes: value(matches, "scenes"),
        lights: value(matches, "lights"),
        fov: value(matches, "fov"),
    };
    Ok(LossOptions {
        near: value(matches, "near"),
        distant: value(matches, "distant"),
        seed: value(matches, "seed"),
        sampler: value(matches, "sampler"),
        texels: value(matches, "texels"),
        target_error: value(matches, "target_error"),
        time_budget: value(matches, "time_budget"),
        file: list.file()?,
    })
}

/// The value of an argument that there may not be.
pub fn value<T: Clone + Send + Sync + 'static>(matches: &ArgMatches, id: &str) -> Option<T> {
    matches.try_get_one(id).ok().flatten().cloned()
}

/// The names of the options of scenes that a command has.
pub trait SceneOptions {
    const NAMES: &'static [&'static str];
}

/// An accuracy, and the seed of its scenes.
#[derive(Debug)]
pub struct Accuracy;

impl SceneOptions for Accuracy {
    const NAMES: &'static [&'static str] = &["target_error", "seed"];
}

/// The numbers of scenes, or a list of them.
#[derive(Debug)]
pub struct FixedNumber;

impl SceneOptions for FixedNumber {
    const NAMES: &'static [&'static str] = &["near", "distant", "sampler", "scenes"];
}

impl SceneOptions for RankReport {
    const NAMES: &'static [&'static str] = Self::SCENES;
}

/// The options `K` of scenes, as they are typed.
#[derive(Debug)]
pub struct SceneArgs<K>(ArgMatches, PhantomData<K>);

impl<K: SceneOptions> clap::Args for SceneArgs<K> {
    fn augment_args(command: Command) -> Command {
        command.args(arguments(K::NAMES))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<K> FromArgMatches for SceneArgs<K> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        Ok(Self(matches.clone(), PhantomData))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl<K> SceneArgs<K> {
    pub fn options(&self) -> Result<LossOptions, CommandError> {
        options(&self.0)
    }
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
