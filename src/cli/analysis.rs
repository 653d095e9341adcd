//! The commands of the analyses, made from their declarations.

use clap::builder::ValueParser;
use clap::{Arg, ArgMatches, Args, Command, Error as ClapError, FromArgMatches, Subcommand};
use serde_json::{Map, Value};

use svbrdf_core::loss::{LossOptions, Request};
use svbrdf_evaluate::analyses::{ANALYSES, AnyAnalysis};
use svbrdf_evaluate::report::{AnalysisInput, AnalysisOption, SceneOptions};

use super::args::scenes::{ListArgs, SampledArgs, SeedArgs, TargetErrorArgs};
use super::args::values::{percent, whole};
use super::args::{ComparisonArgs, Given};
use super::job::{ComparisonJob, Job, NewJob};
use super::output::{CommandError, ReportFormat, exit, warn_of, watched};

/// The analyses that have a command with further arguments.
const OTHERS: [&str; 1] = ["metrics"];

/// The arguments of the command of an analysis.
#[derive(Debug)]
pub struct AnalysisArgs {
    analysis: &'static AnyAnalysis,
    seed: Option<SeedArgs>,
    target_error: Option<TargetErrorArgs>,
    sampled: Option<SampledArgs>,
    list: Option<ListArgs>,
    options: Value,
    output: OutputArgs,
}

#[derive(Debug, Args)]
struct OutputArgs {
    /// Output format
    #[arg(long, value_enum, default_value_t)]
    format: ReportFormat,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

fn commands() -> impl Iterator<Item = &'static AnyAnalysis> {
    ANALYSES.iter().filter(|analysis| !OTHERS.contains(&analysis.name))
}

fn command(analysis: &AnyAnalysis) -> Command {
    let AnyAnalysis { name, about, details, .. } = analysis;
    let command = Command::new(*name).args(analysis.options.iter().map(own_option));
    let scenes = analysis.scenes.iter().fold(command, |command, scenes| match scenes {
        SceneOptions::Seed => SeedArgs::augment_args(command),
        SceneOptions::TargetError => TargetErrorArgs::augment_args(command).mut_arg("target_error", |arg| {
            arg.help("Samples as many scenes as this relative error of the loss needs at 95% confidence, at most 49,152 [default: 1%]")
        }),
        SceneOptions::Sampled => SampledArgs::augment_args(command),
        SceneOptions::List => ListArgs::augment_args(command),
    });
    // What is flattened into it would bring its own words.
    OutputArgs::augment_args(scenes.next_help_heading(None::<&str>))
        .about(*about)
        .long_about(format!("{about}\n\n{details} Without GT and PRED: the built-in materials."))
}

/// An option of the analysis itself.
fn own_option(option: &AnalysisOption) -> Arg {
    let AnalysisOption { name, about, default, is_share } = *option;
    let (value_name, default, parser) = match is_share {
        true => ("PERCENT", format!("{}%", 100.0 * default), ValueParser::new(parsed_share)),
        false => ("N", default.to_string(), ValueParser::new(parsed_count)),
    };
    let arg = Arg::new(name).long(name.replace('_', "-")).help(about);
    arg.value_name(value_name).value_parser(parser).default_value(default).allow_hyphen_values(true)
}

fn parsed_share(text: &str) -> Result<Value, String> {
    percent(text).map(Value::from)
}

fn parsed_count(text: &str) -> Result<Value, String> {
    Ok(whole::<u64>(text)?.into())
}

impl Subcommand for AnalysisArgs {
    fn augment_subcommands(program: Command) -> Command {
        program.subcommands(commands().map(command))
    }

    fn augment_subcommands_for_update(program: Command) -> Command {
        Self::augment_subcommands(program)
    }

    fn has_subcommand(name: &str) -> bool {
        commands().any(|analysis| analysis.name == name)
    }
}

impl FromArgMatches for AnalysisArgs {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, ClapError> {
        let unknown = || ClapError::new(clap::error::ErrorKind::InvalidSubcommand);
        let (name, matches) = matches.subcommand().ok_or_else(unknown)?;
        let analysis = AnyAnalysis::named(name).ok_or_else(unknown)?;
        let value =
            |option: &AnalysisOption| Some((option.name.to_owned(), matches.get_one(option.name).cloned()?));
        Ok(Self {
            analysis,
            seed: args_of(analysis, SceneOptions::Seed, matches)?,
            target_error: args_of(analysis, SceneOptions::TargetError, matches)?,
            sampled: args_of(analysis, SceneOptions::Sampled, matches)?,
            list: args_of(analysis, SceneOptions::List, matches)?,
            options: analysis.options.iter().filter_map(value).collect::<Map<_, _>>().into(),
            output: OutputArgs::from_arg_matches(matches)?,
        })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), ClapError> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// The arguments of these scenes, where the analysis has them.
fn args_of<A: Args>(
    analysis: &AnyAnalysis,
    scenes: SceneOptions,
    matches: &ArgMatches,
) -> Result<Option<A>, ClapError> {
    analysis.scenes.contains(&scenes).then(|| A::from_arg_matches(matches)).transpose()
}

impl AnalysisArgs {
    pub fn job(self, given: &Given) -> NewJob {
        let Self { analysis, seed, target_error, sampled, list, options, output } = self;
        let comparison = ComparisonJob::with_predictions(&output.comparison, given)?;
        let sampled = sampled.map(|sampled| sampled.options()).unwrap_or_default();
        let request = analysis.request(&LossOptions {
            seed: seed.and_then(|seed| seed.seed),
            target_error: target_error.and_then(|target| target.target_error),
            file: list.map_or(Ok(None), |list| list.file())?,
            ..sampled
        })?;
        Ok(Box::new(AnalysisJob { analysis: *analysis, comparison, request, options, format: output.format }))
    }
}

/// An analysis of materials that are not opened yet.
#[derive(Debug)]
pub struct AnalysisJob {
    pub analysis: AnyAnalysis,
    pub comparison: ComparisonJob,
    pub request: Request,
    /// Its own options: a JSON object.
    pub options: Value,
    pub format: ReportFormat,
}

/// Prints the report to stdout; with `--strict` fails where a target error is not reached, after the report is printed.
impl Job for AnalysisJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let Self {
            analysis,
            comparison: ComparisonJob { convention, materials, .. },
            request,
            options,
            format,
        } = *self;
        let opened = materials.open::<f32>()?;
        let (ground_truth, predictions) = (&opened.ground_truth, opened.predictions.iter().collect());
        let input = AnalysisInput { ground_truth, predictions, convention, request };
        let report = watched(analysis.doing, |progress| analysis.run(&input, options, progress))?;
        exit::put(&format.write(&*report)?)?;
        warn_of(report.missed(), materials.strict)
    }
}
