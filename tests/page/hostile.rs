//! Names of materials and files are data, never markup.

use serde_json::json;

use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::progress::Progress;
use svbrdf_core::text::line;
use svbrdf_needs::needs;
use svbrdf_page::PageReport;

use super::browser::Page;
use super::{findings, noise, report};

pub const NAMES: [&str; 2] = [
    "</script><img src=x onerror=window.hit=1><!--<script>",
    "\"'><svg onload=window.hit=1>{{data}}\u{202e}&lt;",
];

/// A whole report of materials with these names.
pub fn report_of(names: [&str; 2]) -> String {
    let [truth, prediction] = [0, 1].map(|i| noise(i as u32).renamed(names[i]));
    let progress = Progress::default();
    let findings = findings([&truth, &prediction], None);
    let materials = [&truth, &prediction];
    let report = PageReport {
        findings: Some(findings),
        readings: names.map(|name| vec![name.to_owned()]).to_vec(),
        command: Some(names.concat()),
        ..report(&materials, PRINTED)
    };
    report.page(&progress).unwrap().html
}

#[test]
fn hostile_names_add_no_elements() {
    let html = report_of(NAMES);
    let count = |text: &str| html.matches(text).count();
    assert_eq!(
        [count("<script"), count("</script"), count("<img src=x"), count("<svg onload")],
        [2, 2, 0, 0]
    );
    assert_eq!(count("id=\"data\""), 1);
    assert!(count("&lt;/script&gt;&lt;img src=x") > 3);
}

#[needs(browser)]
fn hostile_names_run_nothing_and_are_read_as_lines() {
    let mut page = Page::open(&report_of(NAMES), [900, 900]);
    assert_eq!(page.after_frame("window.hit === undefined"), json!(true));
    assert_eq!(page.evaluate("window.svbrdf.figure.materials.map(m => m.name)"), json!(NAMES.map(line)));
    let title = page.evaluate("document.querySelector('.pane .title').textContent");
    assert_eq!(title, json!(format!("{} (ground truth)", NAMES[0])));
    let (_, complaints) = page.traffic();
    assert!(complaints.is_empty(), "{complaints:?}");
    page.evaluate("document.querySelector('button[data-scene=\"0\"]').click()");
    let scene = page.after_frame("window.svbrdf.figure.state.scene");
    assert_ne!(scene["light"], json!([0.4, 0.5, 1.2]));
}
