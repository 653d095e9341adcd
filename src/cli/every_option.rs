//! Every option in every mode of every subcommand: it changes the job, or is refused.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use clap::error::ErrorKind;
use clap::{ArgAction, CommandFactory as _, FromArgMatches as _};
use tempfile::TempDir;

use super::args::Specified;
use super::output::CommandError;
use super::{Cli, Subcommands};

/// The subcommands with arguments that select a mode; options are added to these. `@` stands for the folder of the fixture.
const MODES: &[&str] = &[
    "loss @gt.png @a.png",
    "loss @gt.png @a.png --near 4 --sampler sobol",
    "loss @gt.png @a.png --target-error 30%",
    "loss @gt.png @a.png --time-budget 2ms",
    "loss @gt.png @a.png --scenes @one.json",
    "loss @gt.png @a.png --lights hemisphere",
    "loss @s.svbrdf-session.json",
    "loss @listed.svbrdf-session.json",
    "loss",
    "render @gt.png @a.png -o @x.png",
    "render @gt.png -o @x.png",
    "render @gt.png @a.png -o @x.png --show normal",
    "render @gt.png @a.png -o @x.png --difference",
    "render @gt.png @a.png -o @x.exr --difference",
    "render @s.svbrdf-session.json -o @x.png",
    "strip @gt.png @a.png -o @x.png",
    "strip @gt.png @a.png -o @x.png --columns normal,diffuse,roughness,specular,diffuse:",
    "strip @gt.png @a.png -o @x.png --columns rendering",
    "strip @gt.png @a.png -o @x.png --lights hemisphere",
    "strip --dataset @set/gt @set/ours -o @x.png",
    "strip --dataset @set/gt @set/ours -o @x.png --columns roughness:",
    "report @gt.png @a.png -o @x.html",
    "report @gt.png @a.png -o @x.html --figure",
    "report @gt.png -o @x.html",
    "report @s.svbrdf-session.json -o @x.html",
    "report @listed.svbrdf-session.json -o @x.html",
    "rank @gt.png @a.png @b.png",
    "rank @gt.png @a.png @b.png --near 4 --sampler sobol",
    "rank @gt.png @a.png @b.png --robust",
    "rank --dataset @set/gt @set/ours",
    "rank --dataset @set/gt @set/ours --results @kept",
    "rank --dataset @set/gt @set/ours --lights flash-9",
    "rank --dataset @set/gt @set/ours --near 8 --distant 4",
    "rank --dataset @set/gt @set/ours --robust",
    "rank --dataset @set/gt @set/ours --format html -o @x.html",
    "rank --pairs @pairs.csv",
    "blame @gt.png @a.png",
    "blame @gt.png @a.png --scenes @one.json",
    "diagnose @gt.png @a.png",
    "diagnose",
    "scenes @gt.png @a.png --format csv",
    "scenes @gt.png @a.png --scenes @one.json",
    "worst @gt.png @a.png",
    "map @gt.png @a.png -o @x.csv",
    "map @gt.png @a.png -o @x.png",
    "metrics @gt.png @a.png",
    "metrics @gt.png @a.png --lights flash-9",
    "conform @answer.npz",
    "conform --points @probe.npz",
    "info @gt.png",
    "convert @gt.png @x.png",
    "convert @gt.png @x.exr",
    "study @gt.png @a.png",
    "study @s.svbrdf-session.json",
    "view",
    "view @gt.png",
    "view @s.svbrdf-session.json",
    "view --dataset @set/gt @set/ours",
    "view --pairs @pairs.csv",
    "view @gt.png @a.png --photo @photo.png",
    "photo @photo.png @gt.png @a.png --view 0,0,2 --light 0,0,1",
    "photo @cap @gt.png @a.png",
];

/// Values of the options, by option, or by subcommand and option where it means another thing there.
#[rustfmt::skip]
const VALUES: &[(&str, &str)] = &[
    ("adapter", "llvmpipe"),
    ("text-pt", "9"), ("width-mm", "120"), ("height-mm", "150"), ("columns", "roughness"),
    ("convention", "guided-2020"), ("crop", "1,1,3,3"), ("depth", "16"),
    ("distance-tail", "0.001%"), ("distant", "5"), ("exposure", "1"), ("fail-above", "0.0001"),
    ("figures", "worst:1"), ("fixed", "0.1,0.2,1"), ("format", "json"), ("fov", "30"),
    ("light", "0.1,0.2,1"), ("lights", "flash"), ("like", "gao"),
    ("map", "roughness=@gray.png"), ("mask", "alpha"), ("materials", "m"), ("metrics metrics", "psnr"), ("rank metrics", "psnr"), ("protocol", "deschaintre"), ("rank output", "@y.json"), ("near", "3"), ("output", "@y.png"),
    ("over", "lights"), ("photo", "@photo.png"), ("pick", "mean"), ("plot", "@x.svg"), ("precision", "f64"),
    ("preset", "gao"), ("range", "0.125"), ("read", "albedo=gamma2.2"), ("register", "crop=1,2"),
    ("render difference", ""), ("resize-to", "6"),
    ("results", "@kept"), ("sampler", "random"),
    ("scenes", "@two.json"), ("seed", "5"), ("shard", "1/2"), ("show", "diffuse"), ("side", "5"),
    ("target-error", "25%"), ("texels", "3"), ("time-budget", "1ms"), ("top", "3"), ("transfer", "linear"),
    ("view", "0.2,0.1,2"), ("view resize-to", "gt"),
    ("points", "@p.npz"), ("workflow", "metallic"), ("write-convention", "@m.toml"),
];

/// Everything that a mode names. Only scenes, sessions and lists are read before a job runs.
fn fixture() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    };
    let materials = ["gt.png", "a.png", "b.png", "set/gt/m.png", "set/gt/n.png", "set/ours/m.png"];
    for name in
        materials.into_iter().chain(["set/ours/n.png", "photo.png", "cap/photo.png", "cap/second.png"])
    {
        write(name, "");
    }
    let scene = r#"{"kind": "near", "view": [0, 0, 2], "light": [0.5, 0.5, 1]}"#;
    write("one.json", &format!(r#"{{"scenes": [{scene}]}}"#));
    write("two.json", &format!(r#"{{"scenes": [{scene}, {scene}]}}"#));
    let session = |loss: &str| {
        format!(
            r#"{{"svbrdf-session": 1, "convention": "printed", "scene": {scene}, "window": {{{loss}}},
            "materials": [{{"path": "gt.png"}}, {{"path": "a.png"}}]}}"#
        )
    };
    write("s.svbrdf-session.json", &session(""));
    let list = format!(r#""loss": {{"ask": "File", "file": {{"name": "one", "scenes": [{scene}]}}}}"#);
    write("listed.svbrdf-session.json", &session(&list));
    let photographs =
        ["photo", "second"].map(|name| format!(r#"{{"file": "{name}.png", "scene": {scene}}}"#));
    write("cap/capture.json", &format!(r#"{{"photographs": [{}]}}"#, photographs.join(", ")));
    write("pairs.csv", "ground_truth,prediction\ngt.png,a.png\ngt.png,b.png\n");
    folder
}

/// The job of a command line, as its text.
fn job(folder: &Path, line: &str) -> Result<String, CommandError> {
    let line = line.replace('@', &format!("{}/", folder.display()));
    let arguments = ["svbrdf"].into_iter().chain(line.split_whitespace());
    let matches = Cli::command().try_get_matches_from(arguments).map_err(|problem| match problem.kind() {
        ErrorKind::ArgumentConflict | ErrorKind::MissingRequiredArgument => {
            CommandError::Usage(problem.to_string())
        }
        other => panic!("{line}: {other}: {problem}"),
    })?;
    let command: Subcommands = Cli::from_arg_matches(&matches).unwrap().command.unwrap();
    match command.job(&Specified::of(&matches)) {
        Ok(job) => Ok(format!("{job:?}")),
        Err(problem) => Err(problem),
    }
}

/// By option, or by subcommand and option where it means another thing there.
fn value(mode: &str, option: &str) -> Option<&'static str> {
    let own = format!("{} {option}", mode.split(' ').next().unwrap());
    let of = |name: &str| VALUES.iter().find(|row| row.0 == name).map(|row| row.1);
    of(&own).or_else(|| of(option))
}

/// The options that a mode does not specify, as they are typed.
fn options(mode: &str) -> BTreeSet<(String, String)> {
    let program = Cli::command();
    let command = program.find_subcommand(mode.split(' ').next().unwrap()).unwrap();
    let typed: Vec<&str> = mode.split(' ').collect();
    let is_new = |argument: &&clap::Arg| {
        let long = format!("--{}", argument.get_long().unwrap_or_default());
        let short = argument.get_short().map(|short| format!("-{short}")).unwrap_or_default();
        argument.get_long().is_some() && !typed.iter().any(|word| *word == long || *word == short)
    };
    let new = command.get_arguments().filter(is_new);
    new.map(|argument| {
        let option = argument.get_long().unwrap();
        let value = value(mode, option);
        let is_flag = matches!(argument.get_action(), ArgAction::SetTrue);
        assert!(is_flag || value.is_some(), "{mode}: --{option} has no value in this test");
        let value = value.filter(|value| !is_flag && !value.is_empty());
        (option.to_owned(), value.map_or(format!("--{option}"), |value| format!("--{option}={value}")))
    })
    .collect()
}

#[test]
fn every_option_changes_the_job_or_is_refused() {
    let folder = fixture();
    let (mut count, mut problems) = (0, Vec::new());
    for mode in MODES {
        for (_, typed) in options(mode) {
            count += 1;
            let without = job(folder.path(), mode).unwrap_or_else(|refusal| panic!("{mode}: {refusal}"));
            match job(folder.path(), &format!("{mode} {typed}")) {
                Ok(with) if with == without => problems.push(format!("{mode} ignores {typed}")),
                Err(CommandError::Usage(refusal)) if !refusal.contains("--") => {
                    problems.push(format!("{mode} {typed}: {refusal}"));
                }
                _ => {}
            }
        }
    }
    assert!(problems.is_empty(), "{} of {count}:\n{}", problems.len(), problems.join("\n"));
    assert!(count > 600, "{count} options");
}
