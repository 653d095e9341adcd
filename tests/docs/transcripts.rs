//! Commands in documents, and what they print. `cargo xtask bless transcripts` renews it.
//!
//! A line `$ COMMAND` of a console block, continued by lines `> `, is for a shell. Below it stand `? CODE` where the command fails, and
//! what it prints. In transcripts `...` stands for lines and `[..]` for the rest of a line, and numbers may differ in their last digit.

use std::fs;
use std::iter::from_fn;
use std::path::Path;
use std::process::Output;

use rayon::prelude::*;
use tempfile::TempDir;

use super::{files_of, of_repository, pages};
use crate::support::surroundings::command;

/// A folder for the lines of a page: an empty file for its patterns, and beside it the script that makes the materials of the tutorial.
fn folder() -> TempDir {
    const SCRIPT: &str = "python/examples/make_materials.py";
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir_all(folder.path().join("tutorial/out")).unwrap();
    fs::write(folder.path().join("tutorial/out/a.png"), "").unwrap();
    fs::create_dir_all(folder.path().join("python/examples")).unwrap();
    fs::copy(of_repository(SCRIPT), folder.path().join(SCRIPT)).unwrap();
    folder
}

/// Runs a line as a shell does, without a display.
fn run(line: &str, folder: &Path) -> Output {
    let program = Path::new(env!("CARGO_BIN_EXE_svbrdf")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap_or_default());
    let mut command = command("sh");
    command.args(["-c", line]).current_dir(folder).env("PATH", path).env("SLURM_ARRAY_TASK_ID", "1");
    command.output().unwrap()
}

/// The lines below a command: its exit code where it fails, and what it prints.
fn printed(output: &Output) -> Vec<String> {
    let code = output.status.code().filter(|code| *code != 0).map(|code| format!("? {code}"));
    let text = String::from_utf8_lossy(&output.stdout);
    code.into_iter().chain(text.trim_end().lines().map(str::to_owned)).collect()
}

/// The document with what its commands print where it shows something else.
fn renewed(
    text: &str,
    is_printed: impl Fn(&[&str], &[String]) -> bool,
    run: impl Fn(&str) -> Vec<String>,
) -> String {
    let mut lines = text.lines().peekable();
    let mut renewed: Vec<String> = Vec::new();
    let mut is_console = false;
    while let Some(line) = lines.next() {
        renewed.push(line.to_owned());
        is_console = line == "```console" || is_console && line != "```";
        let Some(command) = line.strip_prefix("$ ").filter(|_| is_console) else { continue };
        let continued: Vec<&str> = from_fn(|| lines.next_if(|next| next.starts_with("> "))).collect();
        renewed.extend(continued.iter().map(|&line| line.to_owned()));
        let more = continued.iter().map(|line| &line[2..]);
        let command = [command].into_iter().chain(more).collect::<Vec<_>>().join("\n");
        let is_shown = |next: &&str| !next.starts_with("$ ") && *next != "```";
        let shown: Vec<&str> = from_fn(|| lines.next_if(is_shown)).collect();
        let end = shown.iter().rposition(|line| !line.is_empty()).map_or(0, |last| last + 1);
        let printed = run(&command);
        match is_printed(&shown[..end], &printed) {
            true => renewed.extend(shown[..end].iter().map(|&line| line.to_owned())),
            false => renewed.extend(printed),
        }
        renewed.extend(shown[end..].iter().map(|&line| line.to_owned()));
    }
    renewed.join("\n") + "\n"
}

/// Whether these lines are printed.
fn is_printed(shown: &[&str], printed: &[String]) -> bool {
    match (shown, printed) {
        (["...", rest @ ..], _) => (0..=printed.len()).any(|skipped| is_printed(rest, &printed[skipped..])),
        ([line, rest @ ..], [first, others @ ..]) => is_line(line, first) && is_printed(rest, others),
        (shown, printed) => shown.is_empty() && printed.is_empty(),
    }
}

fn is_line(shown: &str, printed: &str) -> bool {
    if let Some((start, rest)) = shown.split_once("[..]") {
        let Some(printed) = printed.strip_prefix(start) else { return false };
        return (0..=printed.len())
            .any(|skipped| printed.get(skipped..).is_some_and(|end| is_line(rest, end)));
    }
    let separators = [' ', ',', '(', ')', ';', ':', '%', '[', ']'];
    let [words, found] = [shown, printed].map(|line| line.split(separators).collect::<Vec<_>>());
    words.len() == found.len() && words.iter().zip(found).all(|(word, found)| is_word(word, found))
}

/// Whether two words are equal, or numbers that differ by less than two units of the last digit, or by 2e-6.
fn is_word(shown: &str, printed: &str) -> bool {
    let decimals = shown.split_once('.').map(|(_, decimals)| decimals.len());
    let is_near = |decimals: usize| {
        let [a, b] = [shown, printed].map(|word| word.parse::<f64>().ok());
        let difference = (a? - b?).abs();
        Some(difference < 1.5 * 10f64.powf(-(decimals as f64)) || difference < 2e-6 * a?.abs())
    };
    shown == printed || decimals.and_then(is_near).unwrap_or(false)
}

#[test]
fn commands_of_documents_print_what_they_show() {
    let transcripts = files_of("tests/transcripts", "md");
    let count = transcripts.len();
    // What takes longest first.
    let transcripts = transcripts.into_iter().map(|path| (path.clone(), fs::read_to_string(&path).unwrap()));
    let pages = pages().into_iter().chain(transcripts).filter(|(_, text)| text.contains("```console"));
    let pages: Vec<_> = pages.collect();
    assert!(pages.len() > count && count > 0, "{count} transcripts");
    let checked = |(page, text): (std::path::PathBuf, String)| {
        let renewed = match page.parent().unwrap().ends_with("transcripts") {
            true => {
                let folder = crate::cli::folder_of_transcripts();
                renewed(&text, is_printed, |line| printed(&run(&format!("exec 2>&1\n{line}"), folder.path())))
            }
            false => {
                let folder = folder();
                renewed(
                    &text,
                    |shown, printed| shown == printed,
                    |line| printed(&run(line, &folder.path().join("tutorial"))),
                )
            }
        };
        let is_right = renewed == text;
        if !is_right && std::env::var_os("SVBRDF_BLESS").is_some() {
            fs::write(&page, &renewed).unwrap();
        }
        let lines = renewed.lines().filter(|line| !text.lines().any(|shown| shown == *line));
        (!is_right)
            .then(|| format!("{} does not show\n{}", page.display(), lines.collect::<Vec<_>>().join("\n")))
    };
    let wrong: Vec<String> = pages.into_par_iter().filter_map(checked).collect();
    assert!(wrong.is_empty(), "{}\ncargo xtask bless transcripts writes what is printed", wrong.join("\n\n"));
}

/// The commands of the blocks of shell lines.
#[cfg(feature = "viewer")]
fn shell_lines(text: &str) -> impl Iterator<Item = &str> {
    let blocks = text.split("```sh\n").skip(1).filter_map(|rest| rest.split("```").next());
    blocks.flat_map(str::lines).filter(|line| line.starts_with("svbrdf "))
}

#[cfg(feature = "viewer")]
#[test]
fn every_command_line_of_the_pages_is_one() {
    const USAGE: i32 = 64;
    // Without the files that it names it may fail, but not as a command line.
    let code = |line: &str| run(line, &folder().path().join("tutorial")).status.code();
    let pages = pages();
    let lines: Vec<&str> = pages.iter().flat_map(|(_, text)| shell_lines(text)).collect();
    let wrong: Vec<_> = lines.par_iter().filter(|line| code(line) == Some(USAGE)).collect();
    assert!(lines.len() >= 30 && wrong.is_empty(), "of {} commands: {wrong:?}", lines.len());
    assert_eq!(code("svbrdf loss --no-such-option"), Some(USAGE), "a planted fault");
}

/// The losses and intervals in a table of docs/loss.md.
fn losses(text: &str) -> Vec<&str> {
    let rows = text.lines().map(|line| line.split('|').map(str::trim).collect::<Vec<_>>());
    let rows = rows.filter(|cells| cells.len() == 6 && cells[4].contains(" to "));
    rows.flat_map(|cells| [cells[3], cells[4]]).collect()
}

#[test]
fn the_page_of_the_loss_has_the_losses_that_commands_print() {
    let pages = pages();
    let (page, others): (Vec<_>, Vec<_>) = pages.iter().partition(|(page, _)| page.ends_with("loss.md"));
    let few = printed(&run("svbrdf loss --near 64 --distant 32", folder().path())).join("\n");
    let losses = losses(&page[0].1);
    let is_printed =
        |number: &str| others.iter().any(|(_, text)| text.contains(number)) || few.contains(number);
    let missing: Vec<_> = losses.iter().filter(|number| !is_printed(number)).collect();
    assert!(losses.len() == 10 && missing.is_empty(), "{losses:?}: no command prints {missing:?}");
    assert!(!is_printed("0.321779"), "a planted fault");
}

#[test]
fn planted_faults_of_a_transcript_are_seen() {
    let output = ["a 0.123456 x", "b", "c of 7.5%"].map(str::to_owned);
    let text =
        |shown: &str| format!("$ no\n```console\n$ one\n> two\n{shown}\n\n$ three\n{shown}\n```\n$ no\n");
    let run =
        |command: &str| if ["one\ntwo", "three"].contains(&command) { output.to_vec() } else { Vec::new() };
    for right in ["a 0.123456 x\nb\nc of 7.5%", "a 0.123457 x\n...\nc [..] 7.6%", "...\n[..]%", "a [..]\n..."]
    {
        assert_eq!(renewed(&text(right), is_printed, run), text(right));
    }
    for wrong in [
        "x",
        "a 0.123458 x\nb\nc of 7.5%",
        "a 0.123456 x\nb",
        "...\nc of 7.7%",
        "a\n...",
        "? 1\n...\n[..]7.5%",
    ] {
        assert_eq!(renewed(&text(wrong), is_printed, run), text(&output.join("\n")), "{wrong}");
    }
}
