//! The README and the pages of `docs/`: their commands run and print what the pages say, and their links lead somewhere.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use tempfile::TempDir;

use crate::support::surroundings::command;

/// The README and the pages, each with its text.
fn pages() -> Vec<(PathBuf, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let in_docs = fs::read_dir(root.join("docs")).unwrap().map(|entry| entry.unwrap().path());
    let others =
        ["README.md", "CHANGELOG.md", ".github/CONTRIBUTING.md", ".github/SECURITY.md", "python/README.md"];
    let paths = in_docs.chain(others.map(|name| root.join(name)));
    let markdown = paths.filter(|path| path.extension().is_some_and(|extension| extension == "md"));
    markdown.map(|path| (path.clone(), fs::read_to_string(&path).unwrap())).collect()
}

/// The blocks of code of a language, without their fences.
fn blocks<'a>(text: &'a str, language: &str) -> Vec<&'a str> {
    let fence = format!("```{language}\n");
    text.split(&fence).skip(1).map(|rest| rest.split("```").next().unwrap_or_default()).collect()
}

/// The commands of a console block, each with the output that the page shows.
fn commands(block: &str) -> Vec<(&str, &str)> {
    let parts = block.split("$ ").filter(|part| !part.is_empty());
    parts.map(|part| part.split_once('\n').unwrap_or((part, ""))).collect()
}

/// A folder for the lines of a page: an empty file for its patterns, and beside it the script that makes the materials of the tutorial.
fn folder() -> TempDir {
    const SCRIPT: &str = "python/examples/make_materials.py";
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir_all(folder.path().join("tutorial/out")).unwrap();
    fs::write(folder.path().join("tutorial/out/a.png"), "").unwrap();
    fs::create_dir_all(folder.path().join("python/examples")).unwrap();
    fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join(SCRIPT), folder.path().join(SCRIPT)).unwrap();
    folder
}

/// Runs a line of a page as a shell does, without a display, in a folder.
fn run(line: &str, folder: &TempDir) -> Output {
    let program = Path::new(env!("CARGO_BIN_EXE_svbrdf")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap_or_default());
    let mut command = command("sh");
    command.args(["-c", line]).current_dir(folder.path().join("tutorial")).env("PATH", path);
    command.env("SLURM_ARRAY_TASK_ID", "1").output().unwrap()
}

/// What a page shows and the program does not print.
fn differences(shown: &str, printed: &str) -> Option<String> {
    (shown.trim_end() != printed.trim_end())
        .then(|| format!("the page shows\n{shown}\nbut it prints\n{printed}"))
}

#[test]
fn commands_of_the_pages_print_what_the_pages_show() {
    let mut count = 0;
    for (page, text) in pages() {
        let folder = folder();
        for (command, shown) in blocks(&text, "console").into_iter().flat_map(commands) {
            let output = run(command, &folder);
            let printed = String::from_utf8_lossy(&output.stdout);
            assert!(output.status.success(), "{}: {command}: {output:?}", page.display());
            if let Some(differences) = differences(shown, &printed) {
                panic!("{}: {command}: {differences}", page.display());
            }
            count += 1;
        }
    }
    assert!(count >= 12, "only {count} commands were found");
}

#[cfg(feature = "viewer")]
#[test]
fn every_command_line_of_the_pages_is_one() {
    const USAGE: i32 = 64;
    let mut count = 0;
    for (page, text) in pages() {
        for line in
            blocks(&text, "sh").into_iter().flat_map(str::lines).filter(|line| line.starts_with("svbrdf "))
        {
            // Without the files that it names it may fail, but not as a command line.
            let output = run(line, &folder());
            assert_ne!(output.status.code(), Some(USAGE), "{}: {line}: {output:?}", page.display());
            count += 1;
        }
    }
    assert!(count >= 30, "only {count} commands were found");
    assert_eq!(run("svbrdf loss --no-such-option", &folder()).status.code(), Some(USAGE), "a planted fault");
}

#[test]
fn every_link_of_the_pages_leads_to_a_file_and_its_heading() {
    let mut count = 0;
    for (page, text) in pages() {
        for link in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            if link.starts_with("http") || link.contains(' ') {
                continue;
            }
            let (file, heading) = link.split_once('#').unwrap_or((link, ""));
            let target = if file.is_empty() { page.clone() } else { page.with_file_name("").join(file) };
            assert!(target.exists(), "{} links to {link}", page.display());
            if !heading.is_empty() {
                assert!(
                    has_heading(&fs::read_to_string(&target).unwrap(), heading),
                    "{}: {link}",
                    page.display()
                );
            }
            count += 1;
        }
    }
    assert!(count >= 20, "only {count} links were found");
}

#[test]
fn the_pages_are_short_to_load_and_the_readme_is_short_to_read() {
    const LARGEST: u64 = 250_000;
    let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/pictures");
    for picture in fs::read_dir(assets).unwrap() {
        let picture = picture.unwrap();
        let bytes = picture.metadata().unwrap().len();
        assert!(bytes <= LARGEST, "{}: {bytes} bytes", picture.path().display());
    }
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/example-report.html");
    let bytes = example.metadata().unwrap().len();
    assert!(bytes <= 2_000_000, "{}: {bytes} bytes", example.display());
    let lines =
        fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md")).unwrap().lines().count();
    assert!(lines <= 160, "{lines} lines");
}

/// The losses and intervals in a table of docs/loss.md.
fn losses(text: &str) -> Vec<&str> {
    let rows = text.lines().map(|line| line.split('|').map(str::trim).collect::<Vec<_>>());
    let rows = rows.filter(|cells| cells.len() == 6 && cells[4].contains(" to "));
    rows.flat_map(|cells| [cells[3], cells[4]]).collect()
}

#[test]
fn the_page_of_the_loss_has_the_losses_that_commands_print() {
    let (page, others): (Vec<_>, Vec<_>) =
        pages().into_iter().partition(|(page, _)| page.ends_with("loss.md"));
    let output = run("svbrdf loss --near 64 --distant 32", &folder());
    let few = String::from_utf8_lossy(&output.stdout).into_owned();
    let printed: Vec<_> =
        others.iter().flat_map(|(_, text)| blocks(text, "console")).chain([few.as_str()]).collect();
    let losses = losses(&page[0].1);
    let is_printed = |number: &str| printed.iter().any(|text| text.contains(number));
    let missing: Vec<_> = losses.iter().filter(|number| !is_printed(number)).collect();
    assert!(losses.len() == 10 && missing.is_empty(), "{losses:?}: no command prints {missing:?}");
    assert!(!is_printed("0.321779"), "a planted fault");
}

#[test]
fn the_site_has_every_page_of_docs() {
    let site = Path::new(env!("CARGO_MANIFEST_DIR")).join("packaging/site/zensical.toml");
    let site = fs::read_to_string(site).unwrap();
    let names = pages().into_iter().filter(|(page, _)| page.parent().unwrap().ends_with("docs"));
    let names: Vec<_> =
        names.map(|(page, _)| page.file_name().unwrap().to_str().unwrap().to_owned()).collect();
    let missing: Vec<_> = names.iter().filter(|name| !site.contains(&format!("\"docs/{name}\""))).collect();
    assert!(names.len() >= 20 && missing.is_empty(), "{} pages; the site lacks {missing:?}", names.len());
}

/// Whether a page has a heading with this anchor, which has no punctuation.
fn has_heading(text: &str, anchor: &str) -> bool {
    let of_line = |line: &str| {
        let words = line.trim_start_matches('#').trim().to_lowercase().replace(' ', "-");
        words.replace(|c: char| !c.is_alphanumeric() && c != '-' && c != '_', "")
    };
    text.lines().filter(|line| line.starts_with('#')).any(|line| of_line(line) == anchor)
}

#[test]
fn planted_faults_of_a_page_are_seen() {
    let text = "## A heading\n```console\n$ svbrdf one\n1\n$ svbrdf two\n2\n```\n```sh\nsvbrdf three\n```\n";
    let found: Vec<_> = blocks(text, "console").into_iter().flat_map(commands).collect();
    assert_eq!(found, [("svbrdf one", "1\n"), ("svbrdf two", "2\n")]);
    assert!(differences("1\n", "1").is_none() && differences("1\n", "2\n").is_some());
    assert!(has_heading(text, "a-heading") && !has_heading(text, "a-head"));
    assert!(has_heading("## Is it, too?\n", "is-it-too"));
}
