//! Every control of the figure, by mouse, keyboard and touch; and the page offline.

use serde_json::{Value, json};

use svbrdf_core::model::convention::PRINTED;
use svbrdf_needs::needs;

use super::browser::Page;
use super::{figure, noise};

const SHIFT: u32 = 8;

fn open() -> Page {
    let mut page = Page::open(&figure(&[noise(1), noise(2), noise(3)], PRINTED), [1200, 900]);
    page.evaluate("document.getElementById('canvas').focus()");
    page
}

fn state(page: &mut Page, member: &str) -> Value {
    page.after_frame(&format!("window.svbrdf.figure.state.{member}"))
}

fn number(page: &mut Page, member: &str) -> f64 {
    state(page, member).as_f64().unwrap()
}

fn near(found: &Value, expected: [f64; 2]) -> bool {
    (0..2).all(|i| (found[i].as_f64().unwrap() - expected[i]).abs() < 0.02)
}

/// The figure as it begins, and its [`pane`].
fn start(page: &mut Page) -> ([f64; 2], f64) {
    page.evaluate("Object.assign(window.svbrdf.figure.state, window.svbrdf.figure.start())");
    page.evaluate("window.svbrdf.figure.set({})");
    pane(page)
}

/// The middle of the first pane, and half of its side, of a square material.
fn pane(page: &mut Page) -> ([f64; 2], f64) {
    page.place("#canvas");
    let found = page.after_frame(
        "(() => { const c = document.getElementById('canvas').getBoundingClientRect(); const b = window.svbrdf.figure.boxes()[0]; \
         return [c.left + b.x + b.width / 2, c.top + b.y + b.height / 2, Math.min(b.width, b.height) / 2 / 1.03 * 47 / 48]; })()",
    );
    let at = |i: usize| found[i].as_f64().unwrap();
    ([at(0), at(1)], at(2))
}

/// That the readouts of all panes begin so.
fn assert_readouts(page: &mut Page, begin: &str) {
    let texts = page.after_frame("[...document.querySelectorAll('.readout')].map(e => e.textContent)");
    let begins = |text: &Value| text.as_str().unwrap().starts_with(begin);
    assert!(texts.as_array().unwrap().len() == 3 && texts.as_array().unwrap().iter().all(begins), "{texts}");
}

#[needs(browser)]
#[test]
fn mouse_fingers_and_pen_move_light_view_picture_and_wipe() {
    let mut page = open();
    let ([x, y], unit) = start(&mut page);
    page.mouse("mouseMoved", [x, y], json!({}));
    assert_readouts(&mut page, "(2");
    page.drag("left", 0, [x, y], [x + 0.5 * unit, y - 0.25 * unit]);
    assert!(near(&state(&mut page, "scene.light"), [0.5, 0.25]));
    page.drag("right", 0, [x, y], [x - 0.5 * unit, y + 0.25 * unit]);
    assert!(near(&state(&mut page, "scene.view"), [-0.5, -0.25]));
    page.drag("left", SHIFT, [x, y], [x + 0.1 * unit, y]);
    assert!(near(&state(&mut page, "scene.view"), [0.1, 0.0]));
    let wheel = |page: &mut Page, modifiers: u32| {
        page.mouse("mouseWheel", [x, y], json!({ "deltaX": 0, "deltaY": -100, "modifiers": modifiers }));
    };
    wheel(&mut page, 0);
    assert!((number(&mut page, "zoom") - 1.15).abs() < 1e-9);
    wheel(&mut page, SHIFT);
    assert!((number(&mut page, "scene.light[2]") - 1.32).abs() < 1e-9);
    page.drag("middle", 0, [x, y], [x + 40.0, y]);
    assert!(number(&mut page, "pan[0]") > 0.1);

    start(&mut page);
    page.evaluate("window.svbrdf.figure.set({ layout: 'wipe' })");
    let width = page.number("window.svbrdf.figure.boxes()[0].width");
    let ([x, y], _) = pane(&mut page);
    page.drag("left", 0, [x, y], [x + 0.2 * width, y]);
    assert!((number(&mut page, "wipe") - 0.7).abs() < 0.01);
    assert_eq!(state(&mut page, "scene.light"), json!([0.4, 0.5, 1.2]));

    let ([x, y], unit) = start(&mut page);
    page.touch(&[[[x, y], [x - 0.5 * unit, y - 0.5 * unit]]]);
    assert!(near(&state(&mut page, "scene.light"), [-0.5, 0.5]));
    page.touch(&[[[x - 40.0, y], [x - 80.0, y]], [[x + 40.0, y], [x + 80.0, y]]]);
    assert!((number(&mut page, "zoom") - 2.0).abs() < 0.1);
    page.touch(&[[[x - 40.0, y], [x - 40.0, y - 60.0]], [[x + 40.0, y], [x + 40.0, y - 60.0]]]);
    assert!(number(&mut page, "pan[1]") > 0.1);
    assert_eq!(state(&mut page, "scene.light[2]"), json!(1.2));
    // The numbers of the last texel stay after the finger.
    assert_readouts(&mut page, "(");

    let ([x, y], unit) = start(&mut page);
    for (kind, share, buttons) in
        [("mousePressed", 0.0, 1), ("mouseMoved", 0.5, 1), ("mouseReleased", 0.5, 0)]
    {
        let pen = json!({ "button": "left", "buttons": buttons, "pointerType": "pen" });
        page.mouse(kind, [x + share * unit, y], pen);
    }
    assert!(near(&state(&mut page, "scene.light"), [0.5, 0.0]));
    let [x, y] = page.place("#peek");
    page.send(
        "Input.dispatchTouchEvent",
        json!({ "type": "touchStart", "touchPoints": [{ "x": x, "y": y }] }),
    );
    assert_eq!(page.panes(), json!([0, 0, 0]), "a finger holds the ground truth");
    page.send("Input.dispatchTouchEvent", json!({ "type": "touchEnd", "touchPoints": [] }));
    assert_eq!(page.panes(), json!([0, 1, 2]));
}

#[needs(browser)]
#[test]
fn keys_do_what_they_do_in_the_window() {
    let mut page = open();
    let cases = [
        ("m", 0, "quantity", json!("normal")),
        ("M", SHIFT, "quantity", json!("rendering")),
        ("d", 0, "difference", json!(true)),
        ("c", 0, "layout", json!("wipe")),
        ("2", 0, "prediction", json!(1)),
        ("e", 0, "exposure", json!(0.5)),
        ("E", SHIFT, "exposure", json!(0)),
        ("+", 0, "zoom", json!(1.15)),
        ("f", 0, "zoom", json!(1)),
        ("r", 0, "layout", json!("side-by-side")),
    ];
    for (key, modifiers, member, expected) in cases {
        page.press(key, modifiers);
        assert_eq!(state(&mut page, member), expected, "{key}");
    }
    page.press("ArrowRight", 0);
    page.press("ArrowUp", SHIFT);
    assert!(near(&state(&mut page, "scene.light"), [0.45, 0.5]));
    assert!(near(&state(&mut page, "scene.view"), [0.0, 0.05]));
    page.key("keyDown", "g", 0);
    assert_eq!(page.panes(), json!([0, 0, 0]));
    page.key("keyUp", "g", 0);
    assert_eq!(page.panes(), json!([0, 1, 2]));
}

#[needs(browser)]
#[test]
fn every_control_is_reached_by_tab_and_changes_the_figure_and_the_page_requests_nothing() {
    let mut page = open();
    page.evaluate("document.body.focus(); document.activeElement.blur()");
    let mut reached = Vec::new();
    for _ in 0..24 {
        page.press("Tab", 0);
        reached.push(page.evaluate("document.activeElement.id"));
    }
    let ids = "quantity difference layout prediction near drag exposure peek fit reset canvas";
    for id in ids.split(' ') {
        assert!(reached.contains(&json!(id)), "{id} is not among {reached:?}");
    }
    let cases = [
        ("quantity", "roughness", "quantity", json!("roughness")),
        ("layout", "single", "layout", json!("single")),
        ("prediction", "1", "prediction", json!(1)),
        ("near", "distant", "scene.kind", json!("distant")),
        ("drag", "view", "drag", json!("view")),
        ("exposure", "-1.5", "exposure", json!(-1.5)),
        ("light-2", "0.8", "scene.light[2]", json!(0.8)),
        ("view-0", "-0.3", "scene.view[0]", json!(-0.3)),
    ];
    for (id, value, member, expected) in cases {
        page.input(id, value);
        assert_eq!(state(&mut page, member), expected, "{id}");
    }
    page.click("difference");
    assert_eq!(state(&mut page, "difference"), json!(true));
    assert_eq!(page.evaluate("document.getElementById('legend').hidden"), json!(false));
    let before = state(&mut page, "ranges.absolute");
    page.click("auto");
    assert_ne!(state(&mut page, "ranges.absolute"), before);
    page.click("reset");
    assert_eq!(state(&mut page, "quantity"), json!("rendering"));

    let (requests, complaints) = page.traffic();
    assert!(requests.len() >= 2 && complaints.is_empty(), "{requests:?} {complaints:?}");
    let inside = |address: &String| {
        address.starts_with("file://") && address.ends_with("/report.html")
            || address.starts_with("data:image/jpeg")
    };
    assert!(requests.iter().all(inside), "{requests:?}");
    // Shown a request and a foreign script, the policy refuses both.
    let refused = page.evaluate(
        "new Promise(done => { const found = []; document.addEventListener('securitypolicyviolation', e => { \
         found.push(e.effectiveDirective); if (found.length === 2) done(found.sort()); }); \
         fetch('https://example.invalid/').catch(() => {}); const s = document.createElement('script'); s.textContent = 'window.hit = 1'; \
         document.body.append(s); })",
    );
    assert_eq!(refused, json!(["connect-src", "script-src-elem"]));
    assert_eq!(page.evaluate("window.hit === undefined"), json!(true));
}

#[needs(browser)]
#[test]
fn a_window_without_room_for_all_predictions_has_the_chosen_one_beside_the_ground_truth() {
    let materials: Vec<_> = (1..=16).map(noise).collect();
    let mut page = Page::open(&figure(&materials, PRINTED), [360, 640]);
    assert_eq!(page.panes(), json!([0, 1]));
    page.evaluate("document.getElementById('canvas').focus()");
    page.press("3", 0);
    assert_eq!(page.panes(), json!([0, 3]));
    page.input("prediction", "14");
    assert_eq!(page.panes(), json!([0, 15]));
    page.resize([1360, 860]);
    assert_eq!(page.panes().as_array().unwrap().len(), 16);
}
