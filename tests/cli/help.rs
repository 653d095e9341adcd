//! The help pages of all subcommands.

use std::collections::BTreeSet;

use super::{svbrdf, text};

/// The headings of help pages.
const HEADINGS: &str = "Usage:|Arguments:|Options:|Commands:|Scenes:|Light and view:|Photograph:|Reading materials:|Files:|\
    Environment:|Example:|Examples:|Exit codes:";

/// The help page of a subcommand, which is named by its path from the program.
pub fn page(path: &[String]) -> String {
    let output = svbrdf().args(path).arg("--help").output().unwrap();
    assert!(output.status.success(), "{path:?}: {}", text(&output.stderr));
    text(&output.stdout).to_owned()
}

/// The subcommands that a page lists, without `help`.
fn subcommands(page: &str) -> Vec<String> {
    let after = page.lines().skip_while(|line| *line != "Commands:").skip(1);
    let listed = after.take_while(|line| line.starts_with("  "));
    let first = listed.filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    first.filter(|name| !name.is_empty() && *name != "help").map(str::to_owned).collect()
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
fn the_example_of_every_subcommand_is_a_command_line_of_it() {
    const USAGE: i32 = 64;
    for (path, page) in pages().iter().filter(|(path, _)| !path.is_empty()) {
        let after = page.lines().skip_while(|line| !["Example:", "Examples:"].contains(line)).skip(1);
        let lines: Vec<_> = after.take_while(|line| line.starts_with("  svbrdf ")).collect();
        assert!((1..=3).contains(&lines.len()), "{path:?}: {page}");
        for line in lines {
            let line = line.split(" > ").next().unwrap_or_default();
            let mut words = line.split_whitespace().skip(1);
            assert_eq!(words.next(), Some(path[0].as_str()), "{line}");
            // Without its files it fails, but not as a command line.
            let folder = tempfile::tempdir().unwrap();
            let output = super::run_in(folder.path(), &line.replacen("  svbrdf ", "", 1));
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
