//! The labels of the figure in other languages.

use serde_json::Value;

use svbrdf_core::model::convention::PRINTED;

use super::browser::Page;
use super::{labelled, noise};

/// What people read in the figure: texts and names with a word in them, in every state of difference and camera.
fn texts(html: &str) -> Vec<String> {
    let mut page = Page::open(html, [1200, 900]);
    let mut all = Vec::new();
    for (quantity, layout) in [("rendering", "wipe"), ("normal", "side-by-side"), ("roughness", "single")] {
        page.evaluate(&format!(
            "window.svbrdf.figure.set({{ quantity: {quantity:?}, layout: {layout:?}, difference: {} }})",
            quantity != "roughness"
        ));
        // The histogram and the status come after a pause.
        page.evaluate("new Promise(done => setTimeout(done, 700))");
        let found = page.evaluate(
            "(() => { const root = document.getElementById('figure'), all = []; \
             const walker = document.createTreeWalker(root, NodeFilter.SHOW_TEXT); \
             while (walker.nextNode()) { const e = walker.currentNode.parentElement; \
               if (!e.closest('noscript, .caption, kbd')) all.push(walker.currentNode.data.trim()); } \
             for (const e of root.querySelectorAll('*')) for (const a of ['title', 'aria-label']) all.push(e.getAttribute(a) ?? ''); \
             return [...all, document.documentElement.lang]; })()",
        );
        all.extend(found.as_array().unwrap().iter().filter_map(Value::as_str).map(str::to_owned));
    }
    all.retain(|text| text.split(|c: char| !c.is_alphabetic()).any(|word| word.chars().count() > 1));
    all.sort();
    all.dedup();
    all
}

/// The figure in a language.
fn figure(language: &str) -> String {
    labelled(&[noise(1), noise(2), noise(3)], PRINTED, language.parse().unwrap())
}

/// The texts of a page that are among the English ones, but for data and words that both languages share.
fn left(html: &str, english: &[String], shared: &[&str]) -> Vec<String> {
    // Names of materials and formulas are the same in every language.
    let is_data = |text: &str| {
        text.starts_with("|ln")
            || text.starts_with("noise ") && !text.contains("(ground truth)") && !text.contains("difference")
    };
    let mut found = texts(html);
    found.retain(|text| english.contains(text) && !is_data(text) && !shared.contains(&text.as_str()));
    found
}

#[test]
#[cfg_attr(not(has_browser), ignore = "needs chromium, which is not installed")]
fn every_label_of_the_figure_is_in_its_language() {
    let english = texts(&figure("en"));
    assert!(english.len() > 60 && english.contains(&"Ground truth".to_owned()), "{english:?}");
    let french = ["angle", "Angle"];
    for (language, shared) in [("de", &["Rendering"][..]), ("fr", &french)] {
        assert_eq!(left(&figure(language), &english, shared), Vec::<String>::new(), "{language}");
    }
    // A label that is not translated is found.
    let planted = figure("de").replace("\"Wischen\"", "\"Wipe\"");
    assert_eq!(left(&planted, &english, &["Rendering"]), ["Wipe"]);
}
