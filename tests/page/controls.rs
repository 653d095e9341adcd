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

/// That numbers of the state are these, to 0.02.
fn assert_near(page: &mut Page, member: &str, expected: &[f64]) {
    let found = state(page, member);
    let numbers = |found: &Value| found.as_array().map_or(vec![found.clone()], Clone::clone);
    let near = |(found, expected): (Value, &f64)| (found.as_f64().unwrap() - expected).abs() < 0.02;
    assert!(numbers(&found).into_iter().zip(expected).all(near), "{member}: {found}, expected {expected:?}");
}

/// The figure as it begins with these changes: the middle of the first pane, and half of the side of the material in it.
fn start(page: &mut Page, changes: &str) -> ([f64; 2], f64) {
    page.evaluate(&format!("window.svbrdf.figure.set({{ ...window.svbrdf.figure.start(), ...{changes} }})"));
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
fn mouse_fingers_and_pen_move_light_view_picture_and_wipe() {
    let mut page = open();
    let page = &mut page;
    // From the middle, in halves of the material.
    let drags = [
        ("left", 0, [0.5, 0.25], "scene.light", vec![0.5, 0.25, 1.2]),
        ("right", 0, [-0.5, -0.25], "scene.view", vec![-0.5, -0.25, 2.5]),
        ("left", SHIFT, [0.1, 0.0], "scene.view", vec![0.1, 0.0, 2.5]),
        ("middle", 0, [0.5, 0.0], "pan", vec![0.475, 0.0]),
        ("middle", 0, [0.0, 0.5], "pan", vec![0.0, 0.475]),
    ];
    for (button, modifiers, [dx, dy], member, expected) in drags {
        let ([x, y], unit) = start(page, "{}");
        page.drag(button, modifiers, [x, y], [x + dx * unit, y - dy * unit]);
        assert_near(page, member, &expected);
    }
    assert_readouts(page, "(2");
    let ([x, y], _) = start(page, "{}");
    for (modifiers, member, expected) in [(0, "zoom", 1.15), (SHIFT, "scene.light[2]", 1.32)] {
        page.mouse("mouseWheel", [x, y], json!({ "deltaX": 0, "deltaY": -100, "modifiers": modifiers }));
        assert_near(page, member, &[expected]);
    }
    let ([x, y], _) = start(page, "{ layout: 'wipe' }");
    let width = page.number("window.svbrdf.figure.boxes()[0].width");
    page.drag("left", 0, [x, y], [x + 0.2 * width, y]);
    assert_near(page, "wipe", &[0.7]);
    assert_eq!(state(page, "scene.light"), json!([0.4, 0.5, 1.2]));

    let ([x, y], unit) = start(page, "{}");
    page.touch(&[[[x, y], [x - 0.5 * unit, y - 0.5 * unit]]]);
    assert_near(page, "scene.light", &[-0.5, 0.5]);
    page.touch(&[[[x - 40.0, y], [x - 80.0, y]], [[x + 40.0, y], [x + 80.0, y]]]);
    assert!((state(page, "zoom").as_f64().unwrap() - 2.0).abs() < 0.1);
    page.touch(&[[[x - 40.0, y], [x - 40.0, y - 60.0]], [[x + 40.0, y], [x + 40.0, y - 60.0]]]);
    assert!(state(page, "pan[1]").as_f64().unwrap() > 0.1);
    // The numbers of the last texel stay after the finger.
    assert_readouts(page, "(");

    let ([x, y], unit) = start(page, "{}");
    for (kind, share, buttons) in
        [("mousePressed", 0.0, 1), ("mouseMoved", 0.5, 1), ("mouseReleased", 0.5, 0)]
    {
        let pen = json!({ "button": "left", "buttons": buttons, "pointerType": "pen" });
        page.mouse(kind, [x + share * unit, y], pen);
    }
    assert_near(page, "scene.light", &[0.5, 0.0]);
    let [x, y] = page.place("#peek");
    let touch = json!({ "type": "touchStart", "touchPoints": [{ "x": x, "y": y }] });
    page.send("Input.dispatchTouchEvent", touch);
    assert_eq!(page.panes(), json!([0, 0, 0]), "a finger holds the ground truth");
    page.send("Input.dispatchTouchEvent", json!({ "type": "touchEnd", "touchPoints": [] }));
    assert_eq!(page.panes(), json!([0, 1, 2]));
}

#[needs(browser)]
fn keys_and_controls_change_the_figure_and_the_page_requests_nothing() {
    let mut page = open();
    let keys = [
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
        ("ArrowRight", 0, "scene.light", json!([0.45, 0.5, 1.2])),
        ("ArrowUp", SHIFT, "scene.view", json!([0, 0.05, 2.5])),
    ];
    for (key, modifiers, member, expected) in keys {
        page.press(key, modifiers);
        assert_eq!(state(&mut page, member), expected, "{key}");
    }
    for (kind, panes) in [("keyDown", json!([0, 0, 0])), ("keyUp", json!([0, 1, 2]))] {
        page.key(kind, "g", 0);
        assert_eq!(page.panes(), panes);
    }

    page.evaluate("document.body.focus(); document.activeElement.blur()");
    let mut reached = Vec::new();
    for _ in 0..24 {
        page.press("Tab", 0);
        reached.push(page.evaluate("document.activeElement.id"));
    }
    let ids = "quantity difference layout prediction drag exposure peek fit reset canvas";
    for id in ids.split(' ') {
        assert!(reached.contains(&json!(id)), "{id} is not among {reached:?}");
    }
    let fields = [
        ("quantity", "roughness", "quantity", json!("roughness")),
        ("layout", "single", "layout", json!("single")),
        ("prediction", "1", "prediction", json!(1)),
        ("drag", "view", "drag", json!("view")),
        ("exposure", "-1.5", "exposure", json!(-1.5)),
    ];
    for (id, value, member, expected) in fields {
        page.input(id, value);
        assert_eq!(state(&mut page, member), expected, "{id}");
    }
    page.click("difference");
    assert_eq!(state(&mut page, "difference"), json!(true));
    assert_eq!(page.evaluate("document.getElementById('legend').hidden"), json!(false));
    assert_eq!(page.evaluate("document.getElementById('ticks').textContent"), json!("00.50001.000"));
    page.click("reset");
    assert_eq!(state(&mut page, "quantity"), json!("rendering"));

    assert_nothing_is_requested(&mut page);
}

fn assert_nothing_is_requested(page: &mut Page) {
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
