//! The help: commands in groups, examples, usual options first, and the topics of `svbrdf help`.

use std::path::Path;

use clap::error::{ContextKind, ContextValue};
use clap::{Arg, Args as _, Command};

use svbrdf_evaluate::analyses::ANALYSES;

use super::args::is_there;
use super::args::reading::{PairReadingArgs, READING};
use super::output::foreign;

/// The commands in groups, after those of analyses, each with what it answers; below it stand its examples, without `svbrdf COMMAND`.
const COMMANDS: &str = "\
Look
view: opens materials, or methods over a data set, in the window
  gt.png a.png b.png
  --dataset gt/ ours/ theirs/
  gt.png a.png --photo photo.png
render: renderings, maps and differences as a picture
  gt.png a.png --light 0.4,0.5,1.2 -o pair.png
  gt.png a.png --difference=log -o error.png
strip: a labelled figure for a paper
  gt.png a.png --columns normal,roughness:,rendering -o figure.pdf
  gt.png a.png --width-mm 88 --crop 40,60,32,32 -o figure.svg
  --dataset gt/ ours/ theirs/ --results losses/ -o methods.pdf
report: a page for any browser, which readers light themselves
  gt.png a.png b.png -o report.html
  gt.png a.png --figure -o figure.html
Compare
photo: how renderings differ from photographs
  photo.png a.png b.png --view 0,0,2.4 --light 0,0,2.4
  card_blue/capture.json a.png b.png
verify: whether a table of a ranking is what its files give
  table.tex
conform: whose renderer yours is
  --points probe.npz
  answer.npz --convention svbrdf-estimation-2022
study: time against error of the loss on this machine
  gt.png a.png -o study.csv
Explain
Prepare
info: what files hold, and what is assumed in reading them
  gt.png
  textures/ --read normal-y=down --save
convert: the same material as EXR, PNG, glTF or a folder
  textures/ brick.exr
  textures/ brick.glb
conventions: lists the named conventions, or prints one
  svbrdf-estimation-2022
  loss
adapters: lists the graphics adapters, the one of the window first
  > adapters.txt
completions: completions for a shell
  bash > svbrdf.bash
man: writes the man pages
  man1";

/// The name of a command, what it answers, and its examples.
type Entry = (&'static str, &'static str, Vec<&'static str>);

/// The groups of [`COMMANDS`].
fn groups() -> Vec<(&'static str, Vec<Entry>)> {
    let mut groups: Vec<(_, Vec<Entry>)> = Vec::new();
    for line in COMMANDS.lines() {
        let entries = groups.last_mut().map(|(_, entries)| entries);
        match (entries, line.strip_prefix("  "), line.split_once(": ")) {
            (Some(entries), Some(example), _) => {
                entries.last_mut().into_iter().for_each(|one| one.2.push(example))
            }
            (Some(entries), None, Some((name, answer))) => entries.push((name, answer, Vec::new())),
            _ => groups.push((line, analyses(line))),
        }
    }
    groups
}

/// The analyses of a group.
fn analyses(group: &str) -> Vec<Entry> {
    let of_group = ANALYSES.iter().filter(|analysis| analysis.group == group);
    of_group.map(|one| (one.name, one.answers, one.examples.to_vec())).collect()
}

fn entries() -> impl Iterator<Item = Entry> {
    groups().into_iter().flat_map(|(_, entries)| entries)
}

/// Options that the short help leaves out, of a command or of all.
#[rustfmt::skip]
const RARE: [(&str, &[&str]); 6] = [
    ("", &["sampler", "precision"]),
    ("loss", &["texels", "time_budget", "fov"]),
    ("rank", &["fov", "shard", "pick", "fail_above", "figures"]),
    ("strip", &["fov", "results", "range", "lights", "pairs", "convention", "scenes"]),
    ("metrics", &["fov"]),
    ("view", &["target_error", "seed", "results", "adapter"]),
];

/// The options of the headings of several commands.
#[rustfmt::skip]
const HEADED: [(&str, &[&str]); 2] = [
    ("Scenes", &["target_error", "time_budget", "near", "distant", "seed", "sampler", "texels", "scenes", "lights", "fov"]),
    ("Light and view", &["view", "light", "distant", "exposure"]),
];

const MORE: &str = "All options: --help. Options of reading files: svbrdf help reading.";

const OF_PROGRAM: &str = "\
Examples:
  svbrdf                                           opens the built-in pair
  svbrdf loss gt.png a.png b.png                   prints the losses of two
  svbrdf rank --dataset gt/ ours/ theirs/ -o t.tex   writes a table for a paper";

const OF_ENVIRONMENT: &str = "\
Environment:
  RUST_LOG      messages of window and graphics libraries: warn, info, debug, or wgpu=info
  WGPU_BACKEND  graphics interfaces that may be used: vulkan, metal, dx12, gl
  WGPU_ADAPTER_NAME, WGPU_POWER_PREF=low
                graphics adapter of this name, or one that saves power

Exit codes:
   0  success
   1  invalid input, or the operation failed
   2  no display or no graphics adapter
  64  invalid command line
 130  interrupted by Ctrl+C; existing files are unchanged";

/// The command line `program` with its help.
pub fn program(program: Command) -> Command {
    let line = |(name, answer, _): &Entry| format!("  {name:12} {answer}\n");
    let group = |(group, entries): &(&str, Vec<Entry>)| {
        format!("{group}:\n{}\n", entries.iter().map(line).collect::<String>())
    };
    let groups: String = groups().iter().map(group).collect();
    let template = format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{groups}Options:\n{{options}}{{after-help}}"
    );
    // The options of the window are those of `view`.
    let of_program = |arg: Arg| match arg.get_id().as_str() {
        "allow_outside" | "max_memory" => arg.hide_short_help(true),
        "licenses" | "version" => arg,
        _ => arg.hide_short_help(true).hide_long_help(true),
    };
    program
        .override_usage("svbrdf [GT] [PRED]... [OPTIONS]\n       svbrdf COMMAND ...")
        .help_template(template)
        .after_help(format!("{OF_PROGRAM}\n\n{MORE}"))
        .after_long_help(format!("{OF_PROGRAM}\n\n{MORE}\n\n{OF_ENVIRONMENT}"))
        .mut_args(of_program)
        .mut_subcommands(with_help)
}

/// The entry of a command.
fn entry(name: &str) -> Option<Entry> {
    entries().find(|entry| entry.0 == name)
}

/// A command with its examples, GT and PRED first in its usage, and a short help without rare options.
fn with_help(command: Command) -> Command {
    let name = command.get_name().to_owned();
    let Some((_, _, examples)) = entry(&name) else { return command };
    let lines: String = examples.iter().map(|rest| format!("\n  svbrdf {name} {rest}")).collect();
    let examples = format!("{}:{lines}", if examples.len() > 1 { "Examples" } else { "Example" });
    let is_pair = command.get_positionals().any(|arg| arg.get_id() == "predictions") && name != "photo";
    let required = command.get_arguments().filter(|arg| arg.is_required_set() && arg.get_long().is_some());
    let typed = |arg: &Arg| {
        let value = arg.get_value_names().and_then(|names| names.first()).map_or("", |name| name.as_str());
        format!(" --{} <{value}>", arg.get_long().unwrap_or_default())
    };
    let required: String = required.map(typed).collect();
    let command = match is_pair {
        true => command.override_usage(format!("svbrdf {name} [GT] [PRED]...{required} [OPTIONS]")),
        false => command,
    };
    let is_rare = |arg: &Arg| {
        let of_reading = arg.get_help_heading() == Some(READING);
        let is_one_of = |(of, ids): &(&str, &[&str])| {
            (*of == name || of.is_empty()) && ids.iter().any(|id| arg.get_id() == id)
        };
        of_reading || RARE.iter().any(is_one_of)
    };
    // The heading of a group of options is also that of what is declared after the group.
    let is_below = |arg: &Arg| {
        let of = HEADED.iter().find(|(heading, _)| arg.get_help_heading() == Some(heading));
        arg.is_positional() || of.is_some_and(|(_, ids)| ids.iter().all(|id| arg.get_id() != id))
    };
    command
        .mut_args(|arg| if is_rare(&arg) { arg.hide_short_help(true) } else { arg })
        .mut_args(|arg| if is_below(&arg) { arg.help_heading(None::<&str>) } else { arg })
        .after_help(format!("{examples}\n\n{MORE}"))
        .after_long_help(examples)
}

/// The help on a topic that is no command: `svbrdf help TOPIC`.
pub fn topic(name: &str) -> Option<String> {
    let about = "Options of reading, of every command that reads materials\n\nWhat files hold is inferred from their names and \
        pixels, and reported. These options override it. docs/formats.md describes the forms.";
    let reading = || {
        PairReadingArgs::augment_args(Command::new("reading"))
            .help_template("{about}\n\n{all-args}\n")
            .disable_help_flag(true)
            .long_about(about)
    };
    (name == "reading").then(|| reading().render_long_help().to_string())
}

/// What is wrong with a first argument that is neither a command nor there as a file or folder, where it looks like a command.
pub fn mistyped(word: &str) -> Option<String> {
    let is_word = |c: char| c.is_ascii_alphabetic() || c == '-';
    let is_known = word == "help" || entry(word).is_some();
    if word.starts_with('-') || !word.chars().all(is_word) || is_known || is_there(Path::new(word)) {
        return None;
    }
    let names = entries().map(|(name, ..)| Command::new(name));
    let parsed = Command::new("svbrdf").subcommands(names).try_get_matches_from(["svbrdf", word]);
    let similar = match parsed.err()?.get(ContextKind::SuggestedSubcommand) {
        Some(ContextValue::Strings(names)) => names.first().cloned(),
        Some(ContextValue::String(name)) => Some(name.clone()),
        _ => None,
    };
    let similar = similar.filter(|name| name.chars().next() == word.chars().next());
    let next = match (foreign::command(word), similar) {
        (Some(advice), _) => advice.to_owned(),
        (None, Some(name)) => format!("did you mean `{name}`?"),
        (None, None) => "`svbrdf -h` lists the commands".to_owned(),
    };
    Some(format!("no file or command `{word}`; {next}"))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use clap::CommandFactory as _;
    use clap::error::ErrorKind;

    use super::*;
    use crate::cli::Cli;

    /// The program and its commands.
    fn commands() -> Vec<Command> {
        let mut program = program(Cli::command());
        program.build();
        let commands = program.get_subcommands().filter(|command| command.get_name() != "help").cloned();
        commands.chain([program.clone()]).collect()
    }

    #[test]
    fn every_command_is_in_a_group_and_its_examples_are_command_lines_of_it() {
        let names: BTreeSet<_> = commands().iter().map(|command| command.get_name().to_owned()).collect();
        let entries: Vec<Entry> = entries().collect();
        let listed = entries.iter().map(|(name, ..)| (*name).to_owned()).chain(["svbrdf".to_owned()]);
        assert_eq!(listed.collect::<BTreeSet<_>>(), names);
        for (name, _, examples) in entries {
            assert!((1..=3).contains(&examples.len()), "{name}");
            for example in examples {
                let line = example.split("> ").next().unwrap().replace('\'', "");
                let words = ["svbrdf", name].into_iter().chain(line.split_whitespace());
                let parsed = Cli::command().try_get_matches_from(words);
                assert!(parsed.is_ok(), "{name} {example}: {parsed:?}");
            }
        }
    }

    #[test]
    fn the_short_help_fits_a_screen_and_has_the_materials_before_the_options() {
        for command in commands() {
            let mut command = command.term_width(80);
            let short = command.render_help().to_string();
            let fits = |line: &str| line.chars().count() <= 80 || !line.trim().contains(' ');
            assert!(short.lines().count() <= 48 && short.lines().all(fits), "{short}");
            let place = |word: &str| short.find(word).unwrap_or(usize::MAX);
            assert!(place("  [GT]") > short.len() || place("  [GT]") < place("Options:"), "{short}");
            assert!(!short.contains("Reading materials:"), "{short}");
        }
        let reading = topic("reading").unwrap();
        for option in ["--read", "--preset", "--strict", "--resize-to", "normal-encoding"] {
            assert!(reading.contains(option), "{option}");
        }
    }

    #[test]
    fn an_unusable_value_of_an_option_is_refused_with_what_is_expected() {
        let mut refused = 0;
        for command in commands() {
            let name = command.get_name();
            for option in command.get_arguments().filter_map(Arg::get_long) {
                for value in ["?", "nan", "-1", "1.5", "99999999999999999999"] {
                    let words = ["svbrdf", name, &format!("--{option}={value}")];
                    let Err(error) = Cli::command().try_get_matches_from(words) else { continue };
                    if matches!(error.kind(), ErrorKind::InvalidValue | ErrorKind::ValueValidation) {
                        let text = error.to_string();
                        let is_helpful = ["expected", "use one of", "possible values"]
                            .iter()
                            .any(|part| text.contains(part));
                        assert!(is_helpful, "{name} --{option} {value}: {text}");
                        refused += 1;
                    }
                }
            }
        }
        assert!(refused > 100, "{refused}");
    }
}
