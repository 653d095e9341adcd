//! The example report of the documentation.

use std::fs;
use std::path::Path;

use serde_json::Value;

use super::browser::Page;

use crate::support::surroundings::command;

/// The command of docs/report.md.
const COMMAND: &str = "report -o docs/example-report.html --max-size 2MB";

/// The text between two others.
fn between<'a>(text: &'a str, start: &str, end: &str) -> &'a str {
    let from = text.find(start).unwrap_or_else(|| panic!("no {start}")) + start.len();
    &text[from..from + text[from..].find(end).unwrap()]
}

/// The words and the numbers that a reader sees.
fn text(page: &str) -> (String, Vec<f64>) {
    let body = between(page, "<body>", "<script");
    let texts = body.split('<').filter_map(|part| part.split_once('>')).map(|(_, text)| text);
    let text = texts.collect::<Vec<_>>().join(" ");
    let is_of_number = |c: char| c.is_ascii_digit() || c == '.';
    let numbers = text.split(|c| !is_of_number(c)).filter_map(|number| number.parse().ok()).collect();
    (text.replace(is_of_number, ""), numbers)
}

#[test]
fn the_example_is_what_its_command_writes() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    assert!(fs::read_to_string(root.join("docs/report.md")).unwrap().contains(&format!("svbrdf {COMMAND}")));
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("docs")).unwrap();
    let mut command = command(env!("CARGO_BIN_EXE_svbrdf"));
    assert!(command.args(COMMAND.split(' ')).current_dir(folder.path()).status().unwrap().success());
    let [kept, made] = [root, folder.path()]
        .map(|folder| fs::read_to_string(folder.join("docs/example-report.html")).unwrap());
    for (start, end) in [("<head>", "</head>"), (r#"<script type="module">"#, "</script>")] {
        let is_same = between(&kept, start, end) == between(&made, start, end);
        assert!(is_same, "{start} has changed: cargo xtask bless report");
    }
    let data = |page: &str| {
        let mut data: Value = serde_json::from_str(between(page, r#"id="data">"#, "</script>")).unwrap();
        // Their last digits are of the processor.
        data["scenes"].take();
        data
    };
    assert!(data(&kept) == data(&made), "the figure has changed: cargo xtask bless report");
    let ((kept, kept_numbers), (made, made_numbers)) = (text(&kept), text(&made));
    assert_eq!(kept, made, "cargo xtask bless report");
    assert!(kept_numbers.len() > 150 && kept_numbers.len() == made_numbers.len());
    for (kept, made) in kept_numbers.iter().zip(made_numbers) {
        assert!(
            (kept - made).abs() <= 2e-3 * made.max(0.1),
            "{kept} is {made} now: cargo xtask bless report"
        );
    }
}

#[test]
#[ignore = "writes assets/pictures/report.jpg: cargo xtask bless report-picture"]
fn write_the_picture_of_the_report() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    let html = fs::read_to_string(docs.join("example-report.html")).unwrap();
    let mut page = Page::open(&html, [1366, 1180]);
    page.save_jpeg(&docs.join("assets/report.jpg"));
}
