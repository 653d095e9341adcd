//! The help pages of all subcommands.

use std::collections::BTreeSet;
use std::fs;

use super::{svbrdf, text};

/// The headings of help pages.
const HEADINGS: &str = "Usage:|Arguments:|Options:|Look:|Compare:|Explain:|Prepare:|Scenes:|Light and view:|Reading materials:|Files:|\
    Environment:|Example:|Examples:|Exit codes:";

/// The help page of a subcommand, which is named by its path from the program.
pub fn page(path: &[String]) -> String {
    let output = svbrdf().args(path).arg("--help").output().unwrap();
    assert!(output.status.success(), "{path:?}: {}", text(&output.stderr));
    text(&output.stdout).to_owned()
}

/// The subcommands that a page lists in groups.
fn subcommands(page: &str) -> Vec<String> {
    let after = page.lines().skip_while(|line| *line != "Look:").take_while(|line| *line != "Options:");
    let listed = after.filter(|line| line.starts_with("  "));
    let first = listed.filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    first.filter(|name| !name.is_empty()).map(str::to_owned).collect()
}

/// The path of the program itself and those of all subcommands, each with its page.
pub fn pages() -> Vec<(Vec<String>, String)> {
    let mut pages = Vec::new();
    let mut open = vec![Vec::new()];
    while let Some(path) = open.pop() {
        let page = page(&path);
        open.extend(subcommands(&page).into_iter().map(|name| [path.as_slice(), &[name]].concat()));
        pages.push((path, page));
    }
    pages
}

/// The lines that begin a section: not indented, a few words and a colon, or the usage.
fn headings(page: &str) -> BTreeSet<&str> {
    let is_heading = |line: &&str| {
        let is_short = line.split(' ').count() <= 3 && line.ends_with(':');
        !line.starts_with(' ') && (is_short || line.starts_with("Usage:"))
    };
    page.lines().filter(is_heading).map(|line| line.split_inclusive(':').next().unwrap()).collect()
}

#[test]
fn every_heading_of_every_help_page_is_a_known_one() {
    let pages = pages();
    assert!(pages.len() >= 15, "{} pages", pages.len());
    let mut found = BTreeSet::new();
    for (path, page) in &pages {
        let headings = headings(page);
        assert!(headings.contains("Usage:") && headings.contains("Options:"), "{path:?}: {headings:?}");
        for heading in &headings {
            assert!(
                HEADINGS.split('|').any(|known| known == *heading),
                "{path:?} has the heading `{heading}`"
            );
        }
        // Names of types that a rename has put into a text.
        let is_type = |word: &str| {
            let inner = word.chars().skip(1).any(char::is_uppercase);
            inner && word.chars().any(char::is_lowercase) && word.chars().all(char::is_alphabetic)
        };
        let known =
            ["MaterialGAN", "MaterialX", "DirectX", "OpenGL", "NumPy", "NaN", "glTF", "sRGB", "COLUMNSxROWS"];
        for word in page.split(|c: char| !c.is_alphanumeric()).filter(|word| is_type(word)) {
            assert!(known.contains(&word), "{path:?} says `{word}`");
        }
        found.extend(headings);
    }
    assert_eq!(found, HEADINGS.split('|').collect(), "headings that no page has are no longer allowed");
}

#[test]
fn every_subcommand_is_in_a_group() {
    // The completions have all of them.
    let script = svbrdf().args(["completions", "fish"]).output().unwrap();
    let of_script =
        text(&script.stdout).lines().filter(|line| line.contains("__fish_svbrdf_needs_command\" -a"));
    let named = of_script.filter_map(|line| line.split(" -a \"").nth(1)?.split('"').next());
    let expected: BTreeSet<_> = named.filter(|name| *name != "help").map(str::to_owned).collect();
    assert_eq!(subcommands(&page(&[])).into_iter().collect::<BTreeSet<_>>(), expected);
    assert!(expected.len() > 20);
}

#[test]
fn the_short_help_fits_a_screen_and_has_the_materials_before_the_options() {
    for (path, _) in pages() {
        let output = svbrdf().args(&path).arg("-h").env("COLUMNS", "80").output().unwrap();
        let page = text(&output.stdout);
        let lines = page.lines().count();
        assert!(
            lines <= 48 && page.lines().all(|line| line.chars().count() <= 80 || !line.trim().contains(' ')),
            "{path:?}: {lines} lines\n{page}"
        );
        let place = |word: &str| page.find(word).unwrap_or(usize::MAX);
        assert!(
            path.is_empty() || place("  [GT]") > page.len() || place("  [GT]") < place("Options:"),
            "{page}"
        );
        assert!(!page.contains("Reading materials:"), "{page}");
    }
    let reading = svbrdf().args(["help", "reading"]).output().unwrap();
    for option in ["--read", "--preset", "--strict", "--resize-to", "normal-encoding"] {
        assert!(text(&reading.stdout).contains(option), "{option}");
    }
}

#[test]
fn the_examples_of_every_subcommand_are_command_lines_of_it() {
    const USAGE: i32 = 64;
    for (path, page) in pages().iter().filter(|(path, _)| !path.is_empty()) {
        let after = page.lines().skip_while(|line| !matches!(*line, "Example:" | "Examples:")).skip(1);
        let lines: Vec<_> = after.take_while(|line| line.starts_with("  svbrdf ")).collect();
        assert!((1..=3).contains(&lines.len()), "{path:?}: {page}");
        for line in lines {
            let line = line.split(" > ").next().unwrap_or_default();
            let mut words = line.split_whitespace().skip(1);
            assert_eq!(words.next(), Some(path[0].as_str()), "{line}");
            // Without its files it fails, but not as a command line.
            let folder = tempfile::tempdir().unwrap();
            fs::create_dir(folder.path().join("out")).unwrap();
            fs::write(folder.path().join("out/a.png"), "").unwrap();
            let line = line.replacen("  svbrdf ", "", 1).replace('\'', "");
            let output = super::run_in(folder.path(), &line);
            assert!(output.status.code().is_some_and(|code| code != USAGE), "{line}: {output:?}");
        }
    }
}

/// Once for each option, in the first subcommand that has it.
#[test]
fn an_unusable_value_of_an_option_is_refused_with_what_is_expected() {
    let mut seen = BTreeSet::new();
    let mut refused = 0;
    // Some values name a folder that is written.
    let folder = tempfile::tempdir().unwrap();
    for (path, page) in pages() {
        let with_value = page.lines().filter_map(|line| line.split_once("--")?.1.split_once(" <"));
        for (name, _) in with_value.filter(|(name, _)| seen.insert((*name).to_owned())) {
            for value in ["?", "nan", "-1", "1.5", "99999999999999999999"] {
                let mut command = svbrdf();
                command.args(&path).arg(format!("--{name}={value}")).current_dir(folder.path());
                let output = command.output().unwrap();
                let stderr = text(&output.stderr);
                if !stderr.contains("error: invalid value") {
                    continue;
                }
                refused += 1;
                let says =
                    ["expected", "use one of", "possible values"].iter().any(|part| stderr.contains(part));
                assert!(says, "{path:?} --{name} {value}: {stderr}");
            }
        }
    }
    assert!(refused > 100, "{refused}");
}

#[test]
fn a_mistyped_command_is_no_file() {
    let folder = tempfile::tempdir().unwrap();
    for (args, words) in [
        ("los gt.png a.png", "no file or command `los`; did you mean `loss`?"),
        ("rnak --dataset gt ours", "no file or command `rnak`; did you mean `rank`?"),
        ("qqq", "no file or command `qqq`; `svbrdf -h` lists the commands"),
    ] {
        super::assert_refused(folder.path(), &[(args, 64, words)]);
    }
    // A folder of this name, and a prefix of files, are materials.
    fs::create_dir(folder.path().join("los")).unwrap();
    fs::write(folder.path().join("rnak_normal.png"), "").unwrap();
    for args in ["los --no-such-option", "rnak --no-such-option"] {
        super::assert_refused(folder.path(), &[(args, 64, "unexpected argument '--no-such-option'")]);
    }
}
