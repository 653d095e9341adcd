//! Former options of reading: hidden, and read as the statements that replace them. They end with the version after this one.

use clap::{Arg, ArgMatches, Command, FromArgMatches};

use svbrdf_files::Error;
use svbrdf_files::read::ReadOptions;

use super::StatedReading;
use super::statement::{Statement, Whose};

/// The former options of any material, which are the keys of their statements. Presets keep their option.
const OF_ALL: [&str; 13] = [
    "albedo",
    "specular-albedo",
    "normal-y",
    "roughness",
    "normal-encoding",
    "workflow",
    "dielectric-f0",
    "energy",
    "order",
    "grid",
    "flip-v",
    "exemplar",
    "non-finite",
];
/// The former options of one side of a comparison, and their keys.
const OF_SIDES: [(&str, &str); 6] = [
    ("gt-albedo", "albedo"),
    ("pred-albedo", "albedo"),
    ("pred-specular-albedo", "specular-albedo"),
    ("pred-normal-y", "normal-y"),
    ("pred-roughness", "roughness"),
    ("pred-energy", "energy"),
];

/// The former options of any material.
#[derive(Clone, Debug, Default)]
pub struct FormerArgs(pub Vec<Statement>);

/// The former options of one side of a comparison.
#[derive(Clone, Debug, Default)]
pub struct FormerSideArgs(pub Vec<Statement>);

/// The option that replaces `option`, or `option` itself.
pub fn current(option: &str) -> &str {
    if all().any(|(former, _)| former == option) { "read" } else { option }
}

/// The note on the former options among the arguments of a command, with the form that replaces them; `None` without any.
///
/// # Errors
/// [`Error::SpecifiedTwice`].
pub fn note(matches: &ArgMatches) -> Result<Option<String>, Error> {
    let matches = matches.subcommand().map_or(matches, |(_, matches)| matches);
    let (options, statements): (Vec<_>, Vec<_>) =
        all().filter_map(|(option, _)| Some((format!("--{option}"), given(matches, option)?))).unzip();
    let replaced = StatedReading::new(&statements)?.statements();
    let form: Vec<_> = replaced.iter().map(Statement::to_string).collect();
    let note = || format!("note: {} end with the next version; use {}", options.join(", "), form.join(" "));
    Ok((!options.is_empty()).then(note))
}

fn all() -> impl Iterator<Item = (&'static str, &'static str)> {
    OF_ALL.into_iter().map(|option| (option, option)).chain(OF_SIDES)
}

/// The statement that a former option makes where it is given.
fn given(matches: &ArgMatches, option: &str) -> Option<Statement> {
    matches.try_get_one::<Statement>(option).ok().flatten().cloned()
}

fn argument(option: &'static str, key: &'static str) -> Arg {
    let whose = match option.split_once('-') {
        Some(("gt", _)) => Whose::GroundTruth,
        Some(("pred", _)) => Whose::Predictions,
        _ => Whose::All,
    };
    let parse = move |value: &str| -> Result<Statement, Error> {
        let options: ReadOptions = format!("{key}={value}").parse()?;
        Ok(Statement { whose: whose.clone(), options })
    };
    let argument = Arg::new(option).long(option).hide(true).value_parser(parse);
    match option {
        "flip-v" => argument.num_args(0..=1).require_equals(true).default_missing_value("true"),
        "normal-encoding" => argument.alias("normal-code"),
        _ => argument.allow_negative_numbers(true),
    }
}

/// `clap` arguments from a table of options and their keys.
macro_rules! former_arguments {
    ($type:ident, $options:expr) => {
        impl clap::Args for $type {
            fn augment_args(command: Command) -> Command {
                $options.fold(command, |command, (option, key)| command.arg(argument(option, key)))
            }

            fn augment_args_for_update(command: Command) -> Command {
                Self::augment_args(command)
            }
        }

        impl FromArgMatches for $type {
            fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
                Ok(Self($options.filter_map(|(option, _)| given(matches, option)).collect()))
            }

            fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
                *self = Self::from_arg_matches(matches)?;
                Ok(())
            }
        }
    };
}
former_arguments!(FormerArgs, OF_ALL.into_iter().map(|option| (option, option)));
former_arguments!(FormerSideArgs, OF_SIDES.into_iter());
