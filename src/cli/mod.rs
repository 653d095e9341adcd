//! The command line: one file per subcommand.

mod analysis;
mod args;
mod conform;
mod conventions;
mod convert;
#[cfg(test)]
mod every_option;
mod generate;
mod help;
mod info;
mod job;
mod machine;
mod output;
mod photo;
mod picture_file;
mod rank;
mod render;
mod report;
mod strip;
mod strip_methods;
mod study;
mod verify;
mod view;

use std::process::ExitCode;

use clap::error::ErrorKind;
use clap::{ArgAction, CommandFactory as _, FromArgMatches as _, Parser, Subcommand};

use svbrdf_files::Error;

use args::{Specified, TrustArgs};
use job::NewJob;
use output::CommandError;
use output::exit::{exit_code, explain, put};

/// The licences of the crates and fonts in this program.
const THIRD_PARTY: &str = include_str!("../../packaging/THIRD-PARTY");

/// Shows SVBRDF materials under a light you drag; computes their rendering loss.
///
/// A material is a packed image (photos, then normal | diffuse | roughness | specular, or another order), a layered
/// EXR or npz, a glTF, MaterialX or MTL file, or a folder or name prefix with one file per map. Without a subcommand: `view`.
#[derive(Debug, Parser)]
#[command(version, disable_version_flag = true, args_conflicts_with_subcommands = true)]
struct Cli {
    /// Prints the version; with --verbose what reports of faults need
    ///
    /// Commit, features, processor and graphics adapter.
    #[arg(short = 'V', long, action = ArgAction::Version)]
    version: (),
    /// Prints the licences of svbrdf and of what is in it
    #[arg(long, exclusive = true)]
    licenses: bool,
    #[command(subcommand)]
    command: Option<Subcommands>,
    #[command(flatten)]
    trust: TrustArgs,
    #[command(flatten)]
    view: view::ViewArgs,
}

#[derive(Debug, Subcommand)]
enum Subcommands {
    /// Opens a ground truth and predictions, or the built-in pair, in the window
    View(view::ViewArgs),
    Render(render::RenderArgs),
    Strip(strip::StripArgs),
    Report(report::ReportArgs),
    Rank(rank::RankArgs),
    Verify(verify::VerifyArgs),
    #[command(flatten)]
    Analysis(analysis::AnalysisArgs),
    Photo(photo::PhotoArgs),
    Study(study::StudyArgs),
    Conform(conform::ConformArgs),
    Conventions(conventions::ConventionsArgs),
    Info(info::InfoArgs),
    Convert(convert::ConvertArgs),
    Adapters(machine::AdaptersArgs),
    Completions(generate::CompletionsArgs),
    Man(generate::ManArgs),
}

/// Runs the program with the arguments of this process.
pub fn main() -> ExitCode {
    svbrdf_files::disk::signals::outlive_size_limits();
    // Nothing else writes messages of libraries to stderr.
    #[cfg(feature = "viewer")]
    if std::env::var_os("RUST_LOG").is_some() {
        env_logger::init();
    }
    if let Some(result) = before_parsing() {
        return exit_code(result);
    }
    match help::program(Cli::command())
        .try_get_matches()
        .and_then(|matches| Ok((Cli::from_arg_matches(&matches)?, matches)))
    {
        Ok((cli, matches)) => exit_code(cli.run(&Specified::of(&matches))),
        Err(version) if version.kind() == ErrorKind::DisplayVersion => exit_code(print_version()),
        Err(unusual) => explain(unusual),
    }
}

/// What the parser of the command line does not know: a topic of the help, and a mistyped command, which it would take for a file.
fn before_parsing() -> Option<Result<(), CommandError>> {
    let [first, second] = [1, 2].map(|n| std::env::args_os().nth(n).and_then(|word| word.into_string().ok()));
    let first = first?;
    if first == "help" {
        return Some(put(&help::topic(&second?)?).map_err(CommandError::from));
    }
    help::mistyped(&first).map(|problem| Err(CommandError::Usage(problem)))
}

/// The parser of the command line stops at `--version`, wherever `--verbose` stands.
fn print_version() -> Result<(), CommandError> {
    let is_verbose = |argument: String| argument == "--verbose" || argument == "-v";
    Ok(put(&machine::version(std::env::args().any(is_verbose)))?)
}

/// The ranking of the words of a command line, where they are one.
fn parsed(words: Vec<String>) -> verify::Parsed {
    let matches = help::program(Cli::command()).try_get_matches_from(words)?;
    let command = Cli::from_arg_matches(&matches)?.command;
    let rank = if let Some(Subcommands::Rank(rank)) = command { Some(rank) } else { None };
    Ok(rank.map(|rank| (rank, Specified::of(&matches))))
}

impl Cli {
    /// Prints what is asked of the program itself, or runs a command.
    fn run(self, given: &Specified) -> Result<(), CommandError> {
        if self.licenses {
            return Ok(put(THIRD_PARTY)?);
        }
        self.trust.apply();
        let command = self.command.unwrap_or(Subcommands::View(self.view));
        if !matches!(command, Subcommands::View(_)) {
            svbrdf_files::disk::inputs::protect_all();
        }
        match command {
            Subcommands::Conventions(args) => conventions::run(&args),
            Subcommands::Adapters(args) => machine::list(args),
            Subcommands::Verify(args) => verify::run(&args, parsed),
            Subcommands::Completions(args) => generate::completions(&args, help::program(Self::command())),
            Subcommands::Man(args) => generate::man(&args, help::program(Self::command())),
            command => command.job(given)?.run(),
        }
    }
}

impl Subcommands {
    /// What a command does.
    fn job(self, given: &Specified) -> NewJob {
        match self {
            Self::View(args) => args.job(given),
            Self::Render(args) => args.job(given),
            Self::Strip(args) => args.job(given),
            Self::Report(args) => args.job(given),
            Self::Rank(args) => args.job(given),
            Self::Analysis(args) => args.job(given),
            Self::Photo(args) => args.job(given),
            Self::Study(args) => args.job(given),
            Self::Conform(args) => args.job(),
            Self::Info(args) => args.job(),
            Self::Convert(args) => args.job(),
            Self::Conventions(_)
            | Self::Verify(_)
            | Self::Adapters(_)
            | Self::Completions(_)
            | Self::Man(_) => {
                Err(Error::Internal("a command about the program has no job".to_owned()).into())
            }
        }
    }
}
