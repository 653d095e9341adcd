//! Documents: the commands of the README, of `docs/` and of the transcripts print what is shown, and links lead somewhere.

use std::fs;
use std::path::{Path, PathBuf};

#[cfg(unix)]
mod transcripts;

fn of_repository(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// The files of a folder of the repository whose names end with this extension.
fn files_of(folder: &str, extension: &str) -> Vec<PathBuf> {
    let paths = fs::read_dir(of_repository(folder)).unwrap().map(|entry| entry.unwrap().path());
    paths.filter(|path| path.extension().is_some_and(|found| found == extension)).collect()
}

/// The README and the pages, each with its text.
fn pages() -> Vec<(PathBuf, String)> {
    let others =
        ["README.md", "CHANGELOG.md", ".github/CONTRIBUTING.md", ".github/SECURITY.md", "python/README.md"];
    let paths = files_of("docs", "md").into_iter().chain(others.map(of_repository));
    paths.map(|path| (path.clone(), fs::read_to_string(&path).unwrap())).collect()
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
            let is_there = heading.is_empty() || has_heading(&fs::read_to_string(&target).unwrap(), heading);
            assert!(is_there, "{}: {link}", page.display());
            count += 1;
        }
    }
    assert!(count >= 20, "only {count} links were found");
    assert!(has_heading("## Is it, too?\n", "is-it-too") && !has_heading("## A heading\n", "a-head"));
}

#[test]
fn the_pages_are_short_to_load_and_the_readme_is_short_to_read() {
    for picture in files_of("assets/pictures", "jpg") {
        let bytes = picture.metadata().unwrap().len();
        assert!(bytes <= 250_000, "{}: {bytes} bytes", picture.display());
    }
    let lines = fs::read_to_string(of_repository("README.md")).unwrap().lines().count();
    assert!(lines <= 160, "{lines} lines");
}

#[test]
fn the_site_has_every_page_of_docs() {
    let site = fs::read_to_string(of_repository("packaging/site/zensical.toml")).unwrap();
    let pages = files_of("docs", "md");
    let name = |page: &PathBuf| format!("\"docs/{}\"", page.file_name().unwrap().to_str().unwrap());
    let missing: Vec<_> = pages.iter().map(name).filter(|name| !site.contains(name)).collect();
    assert!(pages.len() >= 20 && missing.is_empty(), "{} pages; the site lacks {missing:?}", pages.len());
}
