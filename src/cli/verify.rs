//! `svbrdf verify`: whether a table of a ranking is what its files give.

use std::path::PathBuf;

use svbrdf_evaluate::dataset::{self, TableDifference};
use svbrdf_files::disk::inputs;
use svbrdf_files::disk::open::NamedFile;

use super::args::Specified;
use super::output::exit::put_text;
use super::output::{CommandError, exit};
use super::rank::{self, RankArgs, RankFormat};

/// The most differences that are printed.
const MOST: usize = 20;
/// Below this share, numbers differ in the last digits, as those of other processors do.
const LAST_DIGITS: f64 = 1e-6;

/// Computes a table of `svbrdf rank` again, and says whether it is the same
///
/// The table has the command that repeats it, and digests of the files of every material. Run it in the folder that the table was written in. The
/// exit code is 1 where a digit, a file or an option differs.
#[derive(Debug, clap::Args)]
pub struct VerifyArgs {
    /// Table of a ranking of a data set: .tex, .json, .csv or .html
    table: PathBuf,
}

/// A ranking of the words of a command line, with what they specify.
pub type Parsed = Result<Option<(RankArgs, Specified)>, clap::Error>;

/// Prints what differs; `parse` reads the words of a command line.
pub fn run(args: &VerifyArgs, parse: impl FnOnce(Vec<String>) -> Parsed) -> Result<(), CommandError> {
    let path = args.table.display();
    let written = NamedFile::by_user(&args.table).text()?;
    inputs::protect(&args.table);
    let none = || {
        let problem =
            "expected a table that `svbrdf rank --dataset ... -o` wrote, found no command that repeats it";
        CommandError::Usage(format!("{path}: {problem}; give its .tex, .json, .csv or .html"))
    };
    let command = dataset::command(&written).ok_or_else(none)?;
    exit::tell(&format!("note: {command}"));
    let bad = |problem: clap::Error| {
        let first = problem.to_string().lines().next().unwrap_or_default().to_owned();
        CommandError::Usage(format!("{path}: the command that repeats it was altered: {first}"))
    };
    let words = dataset::without_decisions(dataset::shell_words(&command), &written);
    let (rank, specified) = parse(words).map_err(bad)?.ok_or_else(none)?;
    let computed = rank::written(rank, &specified, format_of(&written))?;
    let found = dataset::differences(&written, &computed);
    let are_last = found.iter().all(|one| one.share < LAST_DIGITS);
    if are_last {
        let but = if found.is_empty() { "" } else { ", but for the last digits of another processor" };
        return Ok(put_text(&format!("{path}: the same{but}\n"))?);
    }
    let lines: String = found.iter().take(MOST).map(|one: &TableDifference| format!("{one}\n")).collect();
    put_text(&lines)?;
    let places = found.len();
    Err(CommandError::Failed(format!(
        "{path} differs in {places} places from what is computed; correct it, or find the files that it is of"
    )))
}

/// The format of a table, by its first character.
fn format_of(written: &str) -> RankFormat {
    match written.trim_start().chars().next() {
        Some('{') => RankFormat::Json,
        Some('<') => RankFormat::Html,
        Some('%' | '\\') => RankFormat::Latex,
        _ => RankFormat::Csv,
    }
}
