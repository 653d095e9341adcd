//! Contrast of texts and names for screen readers, of reports and rankings, in light and dark colours.

use serde_json::{Value, json};
use svbrdf_needs::needs;

use super::browser::Page;
use super::{hostile, ranking};

/// Contrast that WCAG 2 demands of texts (AA).
const CONTRAST: f64 = 4.5;
/// Every visible text with its contrast: of its colour against the colours behind it.
const CONTRASTS: &str = "(() => { \
    const numbers = text => text.match(/[\\d.]+/g).map(Number); \
    const linear = v => v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4; \
    const luminance = ([r, g, b]) => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b); \
    const over = ([r, g, b, a = 1], under) => [r, g, b].map((c, i) => c * a + under[i] * (1 - a)); \
    const behind = e => { const all = []; \
      for (let n = e; n; n = n.parentElement) all.unshift(numbers(getComputedStyle(n).backgroundColor)); \
      return all.reduce((under, layer) => over(layer, under), [255, 255, 255]); }; \
    const found = []; \
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT); \
    while (walker.nextNode()) { \
      const text = walker.currentNode.data.trim(), e = walker.currentNode.parentElement; \
      if (!text || e.matches('script, option, noscript') || !e.checkVisibility()) continue; \
      const style = getComputedStyle(e), under = behind(e); \
      const colour = over(numbers(e.closest('svg') ? style.fill : style.color), under); \
      const [a, b] = [luminance(colour), luminance(under)].sort((x, y) => y - x); \
      found.push([text.slice(0, 40), (a + 0.05) / (b + 0.05)]); \
    } \
    return found; })()";
/// Roles that have a name.
const NAMED: &str = "application button checkbox columnheader combobox image link radio region rowheader slider spinbutton textbox";

/// The texts below the contrast, and the number of all.
fn weak(page: &mut Page) -> (Vec<Value>, usize) {
    let all = page.evaluate(CONTRASTS);
    let all = all.as_array().unwrap();
    (all.iter().filter(|text| text[1].as_f64().unwrap() < CONTRAST).cloned().collect(), all.len())
}

/// What a screen reader would announce by its role alone, and the number of all with a role that has a name.
fn unnamed(page: &mut Page) -> (Vec<Value>, usize) {
    page.send("Accessibility.enable", json!({}));
    let tree = page.send("Accessibility.getFullAXTree", json!({}));
    let nodes = tree["nodes"].as_array().unwrap().iter();
    let of_role = |node: &&Value| NAMED.split(' ').any(|role| node["role"]["value"] == json!(role));
    let all: Vec<&Value> = nodes.filter(|node| node["ignored"] != json!(true)).filter(of_role).collect();
    let has_name =
        |node: &&&Value| node["name"]["value"].as_str().is_some_and(|name| !name.trim().is_empty());
    (all.iter().filter(|node| !has_name(node)).map(|node| (**node).clone()).collect(), all.len())
}

/// Looks at a report of these materials, then at a ranking, in a window of this size, unfolded and with differences.
fn each_page(names: [&str; 2], size: [u32; 2], look: fn(&mut Page)) {
    let report = || Page::open(&hostile::report_of(names), size);
    let ranking = || Page::open_until(&ranking::page(), size, ranking::READY);
    for open in [&report as &dyn Fn() -> Page, &ranking] {
        let mut page = open();
        page.evaluate("document.querySelectorAll('details').forEach(e => { e.open = true; })");
        page.evaluate("window.svbrdf?.figure.set({ difference: true })");
        look(&mut page);
    }
}

#[needs(browser)]
fn texts_have_contrast_in_light_and_dark_and_what_is_used_has_a_name() {
    each_page(hostile::NAMES, [1000, 900], |page| {
        for scheme in ["light", "dark"] {
            page.scheme(scheme);
            page.evaluate("new Promise(done => setTimeout(done, 400))");
            let (weak, all) = weak(page);
            assert!(weak.is_empty() && all > 20, "{scheme}: {weak:?} of {all}");
        }
        let (unnamed, all) = unnamed(page);
        assert!(unnamed.is_empty() && all > 10, "{unnamed:?} of {all}");
        // A weak text and a button without a name are found.
        page.evaluate("document.querySelector('h1').style.color = '#777'");
        assert_eq!(self::weak(page).0.len(), 1);
        page.evaluate("document.body.append(document.createElement('button'))");
        assert_eq!(self::unnamed(page).0.len(), 1);
    });
}

/// What is wider than the window or smaller than a fingertip; links within a text may be.
const MISPLACED: &str = "(() => { const found = []; const width = document.documentElement.clientWidth; \
    if (document.documentElement.scrollWidth > width) found.push(`the page has ${document.documentElement.scrollWidth} pixels`); \
    for (const e of document.querySelectorAll('button, select, input, summary')) { \
      if (!e.checkVisibility()) continue; \
      const { width, height } = (e.closest('label') ?? e).getBoundingClientRect(); \
      if (Math.min(width, height) < 24) found.push(`${e.id || e.textContent}: ${width} x ${height}`); } \
    return found; })()";

#[needs(browser)]
fn long_names_fit_a_phone_and_every_target_a_fingertip() {
    let long = "a_long_name".repeat(11);
    each_page([&long, &long], [360, 640], |page| {
        let found = page.evaluate(&format!("new Promise(done => setTimeout(() => done({MISPLACED}), 400))"));
        assert_eq!(found, json!([]));
        let first = "(() => { const of = (id) => document.getElementById(id)?.getBoundingClientRect(); \
                     return !of('hint') || of('hint').bottom <= of('canvas').top; })()";
        assert_eq!(page.evaluate(first), json!(true), "a reader sees what to do before the figure");
        // A button that is too small and a text that is too wide are found.
        page.evaluate("document.body.insertAdjacentHTML('beforeend', '<button>x</button><pre></pre>')");
        page.evaluate("Object.assign(document.querySelector('body > button').style, { minHeight: '10px', height: '10px' })");
        page.evaluate("document.querySelector('body > pre').style.width = '500px'");
        assert_eq!(page.evaluate(MISPLACED).as_array().unwrap().len(), 2);
    });
}
