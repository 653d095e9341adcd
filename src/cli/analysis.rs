//! The commands of the analyses, made from their declarations.

use std::path::PathBuf;

use clap::builder::ValueParser;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, Error as ClapError, FromArgMatches, Subcommand};
use serde_json::{Map, Value};

use svbrdf_core::loss::{Precision, Request};
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::KeptAnswer;
use svbrdf_evaluate::analyses::{ANALYSES, AnyAnalysis, Precise};
use svbrdf_evaluate::report::{AnalysisInput, AnalysisOption, OptionValue};

use super::args::protocol::PairArgs;
use super::args::scenes;
use super::args::values::{percent, stops, whole};
use super::args::{ComparisonArgs, Specified, offered, refuse};
use super::job::{self, ComparisonJob, Job, NewJob};
use super::output::{CommandError, ReportFormat, exit, stoppable, warn_of, watched, watched_on};
use super::picture_file::{PictureArgs, PictureFile};

/// The analyses that have a command with further arguments.
const OTHERS: [&str; 1] = ["rank"];

/// The arguments of the command of an analysis.
#[derive(Debug)]
pub struct AnalysisArgs {
    pair: PairArgs,
    analysis: &'static AnyAnalysis,
    matches: ArgMatches,
    output: Output<PictureArgs>,
    comparison: ComparisonArgs,
}

#[derive(Debug, Args)]
struct FormatArgs {
    /// Output format
    #[arg(long, value_enum, default_value_t)]
    format: ReportFormat,

    /// Folder of known answers, to which this one is added
    #[arg(long, value_name = "DIR", hide_short_help = true)]
    results: Option<PathBuf>,
}

/// Where a report goes.
#[derive(Debug)]
enum Output<P> {
    Printed(FormatArgs),
    Pictures(P),
}

fn commands() -> impl Iterator<Item = &'static AnyAnalysis> {
    ANALYSES.iter().filter(|analysis| !OTHERS.contains(&analysis.name))
}

fn command(analysis: &AnyAnalysis) -> Command {
    let AnyAnalysis { name, about, details, .. } = analysis;
    let with_help = |arg: Arg| match analysis.scenes_help.iter().find(|(id, _)| arg.get_id() == id) {
        Some((_, help)) => arg.help(*help),
        None => arg,
    };
    let command = Command::new(*name);
    let command = if analysis.pictures { PictureArgs::augment_args(command) } else { command };
    let command = command
        .args(analysis.options.iter().map(own_option))
        .args(scenes::arguments(analysis.scenes).into_iter().map(with_help));
    let session = if analysis.takes_settings() { " A session has settings of its own." } else { "" };
    let command = if analysis.pictures { command } else { FormatArgs::augment_args(command) };
    let command = if analysis.paired { PairArgs::augment_args(command) } else { command };
    // What is flattened into it would bring its own words.
    ComparisonArgs::augment_args(command)
        .about(*about)
        .long_about(format!("{about}\n\n{details}{session} Without GT and PRED: the built-in materials."))
}

/// An option of the analysis itself.
fn own_option(option: &AnalysisOption) -> Arg {
    let AnalysisOption { name, about, value } = *option;
    let arg = Arg::new(name).long(name.replace('_', "-")).help(about).allow_hyphen_values(true);
    match value {
        OptionValue::Count(default) => {
            let parser = ValueParser::new(|text: &str| whole::<u64>(text).map(Value::from));
            arg.value_name("N").default_value(default.to_string()).value_parser(parser)
        }
        OptionValue::Share(default) => {
            let parser = ValueParser::new(|text: &str| percent(text).map(Value::from));
            arg.value_name("PERCENT").default_value(format!("{}%", 100.0 * default)).value_parser(parser)
        }
        OptionValue::Stops(default) => {
            let parser = ValueParser::new(|text: &str| stops(text).map(Value::from));
            arg.value_name("EV").default_value(default.to_string()).value_parser(parser)
        }
        OptionValue::Words(words) => {
            let parser = offered(|text| Ok::<_, String>(Value::from(text)), words());
            let arg = arg.value_name("WORDS,...").value_parser(parser).hide_possible_values(true);
            arg.value_delimiter(',').action(ArgAction::Append)
        }
    }
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
        let output = match analysis.pictures {
            true => Output::Pictures(PictureArgs::from_arg_matches(matches)?),
            false => Output::Printed(FormatArgs::from_arg_matches(matches)?),
        };
        let comparison = ComparisonArgs::from_arg_matches(matches)?;
        let pair = if analysis.paired { PairArgs::from_arg_matches(matches)? } else { PairArgs::default() };
        Ok(Self { analysis, matches: matches.clone(), output, comparison, pair })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), ClapError> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl AnalysisArgs {
    pub fn job(self, given: &Specified) -> NewJob {
        let Self { analysis, matches, output, comparison: args, pair } = self;
        let mut comparison = ComparisonJob::with_predictions(&args, given)?;
        if !analysis.paired {
            comparison.materials.refuse_mask(&format!("{} is over all texels", analysis.name))?;
        }
        let precision = scenes::value(&matches, "precision").unwrap_or_default();
        let typed = scenes::options(&matches)?;
        let (convention, scenes) = pair.protocol.decided(args.convention.as_ref(), typed, given)?;
        if let Some(chosen) = convention {
            comparison.convention = chosen.convention;
        }
        let own = |AnalysisOption { name, value, .. }: &AnalysisOption| {
            let mut found = matches.get_many(name)?.cloned();
            let is_list = matches!(value, OptionValue::Words(_));
            Some(((*name).to_owned(), if is_list { found.collect() } else { found.next()? }))
        };
        let mut options: Map<_, _> = analysis.options.iter().filter_map(own).collect();
        if let Some(protocol) = &pair.protocol.protocol
            && analysis.options.iter().any(|option| option.name == "metrics")
        {
            refuse(options.contains_key("metrics"), "metrics", "the protocol decides the metrics")?;
            options.insert("metrics".to_owned(), Vec::from(protocol.selection()).into());
        }
        let options = Value::from(options);
        comparison.materials.compare(&pair);
        let saved = comparison.session.as_ref().and_then(|session| session.loss.as_ref());
        let request = analysis.request(&scenes, saved)?;
        let few_scenes = saved.is_none() && scenes.is_open();
        let output = match output {
            Output::Printed(args) => {
                let is_timed = args.results.is_some() && scenes.time_budget.is_some();
                refuse(is_timed, "results", "a loss in a time is another one each time")?;
                Output::Printed(args)
            }
            Output::Pictures(args) => Output::Pictures(PictureFile::new(args)?),
        };
        Ok(Box::new(AnalysisJob { analysis, comparison, request, few_scenes, precision, options, output }))
    }
}

/// An analysis of materials that are not opened yet.
#[derive(Debug)]
struct AnalysisJob {
    analysis: &'static AnyAnalysis,
    comparison: ComparisonJob,
    request: Request,
    few_scenes: bool,
    precision: Precision,
    /// Its own options: a JSON object.
    options: Value,
    output: Output<PictureFile>,
}

impl Job for AnalysisJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        match self.precision {
            Precision::F32 => self.answer::<f32>(),
            Precision::F64 => self.answer::<f64>(),
        }
    }
}

impl AnalysisJob {
    /// Prints the report to stdout, and writes its pictures; fails where it could not be kept, and with `--strict` where a target error is
    /// not reached, after that.
    fn answer<T: Precise>(self) -> Result<(), CommandError> {
        let Self { analysis, comparison, request, few_scenes, options, output, .. } = self;
        let ComparisonJob { convention, materials, .. } = comparison;
        let opened = materials.open::<T>()?;
        if let Output::Pictures(file) = &output {
            file.check()?;
        }
        let input = job::input(&opened, &materials, convention, request);
        let input = AnalysisInput { few_scenes, ..input };
        if let Output::Printed(FormatArgs { format, results: Some(folder) }) = &output {
            let ask = |progress: &Progress| analysis.kept(&input, options, folder, progress);
            let KeptAnswer { answer: mut views, notes, unkept } =
                stoppable(|progress| watched_on(progress, analysis.doing, ask))?;
            notes.iter().for_each(|note| exit::tell(&format!("note: {note}")));
            let missed = std::mem::take(&mut views.missed);
            exit::put(&format.of(views))?;
            warn_of(missed, materials.strict)?;
            return unkept.map_or(Ok(()), |problem| Err(CommandError::Failed(problem)));
        }
        let report = watched(analysis.doing, |progress| analysis.run(&input, options, progress))?;
        match output {
            Output::Printed(args) => exit::put(&args.format.write(&*report)?)?,
            Output::Pictures(file) => {
                let predictions = input.predictions.iter().copied();
                let materials: Vec<_> = std::iter::once(input.ground_truth).chain(predictions).collect();
                let names: Vec<_> = materials.iter().map(|material| material.name()).collect();
                let colours = file.write(&*report, &names, convention.name)?;
                exit::put_text(&(report.text() + &colours))?;
            }
        }
        warn_of(report.missed(), materials.strict)
    }
}
