//! The figure in WebKitGTK, of Safari's engine, driven by WebDriver (<https://www.w3.org/TR/webdriver2/>).

use std::io::{Read as _, Write as _};
use std::net::{TcpListener, TcpStream};
use std::process::Stdio;
use std::thread;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use svbrdf_core::model::convention::{ALL, PRINTED};
use svbrdf_core::model::scene::sample;
use svbrdf_core::picture::content::PictureContent;
use svbrdf_core::picture::quantity::Quantity;

use super::numbers::{decoded, largest, pictured, rendered, showing};
use super::{figure, noise};
use crate::support::desktop::{Desktop, Running};
use crate::support::tolerance::PAGE_PIXELS;

const PATIENCE: Duration = Duration::from_secs(120);
/// Scenes of each convention.
const SCENES: [usize; 2] = [2, 2];

/// A window of the browser.
struct WebKit {
    desktop: Desktop,
    _driver: Running,
    port: u16,
    session: String,
}

impl WebKit {
    fn start() -> Self {
        let desktop = Desktop::start();
        let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
        let mut driver = desktop.command("WebKitWebDriver");
        driver.arg(format!("--port={port}")).stdout(Stdio::null()).stderr(Stdio::null());
        let _driver = Running(driver.spawn().unwrap());
        let started = Instant::now();
        while TcpStream::connect(("127.0.0.1", port)).is_err() {
            assert!(started.elapsed() < PATIENCE, "the driver does not start");
            thread::sleep(Duration::from_millis(50));
        }
        let mut browser = Self { desktop, _driver, port, session: String::new() };
        let answer = browser.request("POST", "/session", &json!({ "capabilities": {} }));
        browser.session = format!("/session/{}", answer["sessionId"].as_str().unwrap());
        browser
    }

    /// The value that the driver answers.
    fn request(&self, method: &str, path: &str, body: &Value) -> Value {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        let (body, path) = (body.to_string(), format!("{}{path}", self.session));
        let length = body.len();
        let head = format!("{method} {path} HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json");
        write!(stream, "{head}\r\nContent-Length: {length}\r\nConnection: close\r\n\r\n{body}").unwrap();
        let mut answer = String::new();
        stream.read_to_string(&mut answer).unwrap();
        let (_, body) = answer.split_once("\r\n\r\n").unwrap();
        let value = serde_json::from_str::<Value>(body).unwrap()["value"].clone();
        assert!(value["error"].is_null(), "{method} {path}: {value}");
        value
    }

    /// Opens a page with a figure as a file, and waits until its figure is there.
    fn open(&self, html: &str) {
        let file = self.desktop.folder.path().join("report.html");
        std::fs::write(&file, html).unwrap();
        self.request("POST", "/url", &json!({ "url": format!("file://{}", file.display()) }));
        let ready = "!!window.svbrdf || document.getElementById('problem').hidden === false";
        let started = Instant::now();
        while self.evaluate(ready) != json!(true) {
            assert!(started.elapsed() < PATIENCE, "the page does not start");
            thread::sleep(Duration::from_millis(50));
        }
        assert_eq!(self.evaluate("document.getElementById('problem').textContent"), json!(""));
    }

    /// The value of an expression of JavaScript.
    fn evaluate(&self, expression: &str) -> Value {
        let script = format!("return {expression}");
        self.request("POST", "/execute/sync", &json!({ "script": script, "args": [] }))
    }

    /// Waits for two frames, then evaluates.
    fn after_frame(&self, expression: &str) -> Value {
        let script = format!(
            "const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(() => done({expression})))"
        );
        self.request("POST", "/execute/async", &json!({ "script": script, "args": [] }))
    }

    /// A drag with the left button.
    fn drag(&self, [from, to]: [[i32; 2]; 2]) {
        let place = |[x, y]: [i32; 2]| json!({ "type": "pointerMove", "duration": 50, "x": x, "y": y });
        let button = |kind: &str| json!({ "type": kind, "button": 0 });
        let actions = json!([place(from), button("pointerDown"), place(to), button("pointerUp")]);
        self.perform(&json!({ "type": "pointer", "id": "mouse", "actions": actions }));
    }

    fn press(&self, key: &str) {
        let actions = ["keyDown", "keyUp"].map(|kind| json!({ "type": kind, "value": key }));
        self.perform(&json!({ "type": "key", "id": "keyboard", "actions": actions }));
    }

    fn perform(&self, actions: &Value) {
        self.request("POST", "/actions", &json!({ "actions": [actions] }));
    }
}

impl Drop for WebKit {
    fn drop(&mut self) {
        // The driver ends the browser; the answer does not matter.
        if let Ok(mut stream) = TcpStream::connect(("127.0.0.1", self.port)) {
            let request =
                format!("DELETE {} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n", self.session);
            let _ = stream.write_all(request.as_bytes());
            let _ = stream.read_to_end(&mut Vec::new());
        }
    }
}

#[cfg(target_os = "linux")]
#[test]
fn ci_has_webkit() {
    let is_needed = std::env::var_os("CI").is_some() && cfg!(feature = "viewer");
    assert!(cfg!(has_webkit) || !is_needed, "CI must have webkit2gtk-driver and Xvfb, which ./test installs");
}

#[test]
#[cfg_attr(not(has_webkit), ignore = "needs WebKitWebDriver and Xvfb, which are not installed")]
fn webkit_has_the_pixels_of_render() {
    let browser = WebKit::start();
    let materials = [noise(1), noise(2)];
    for convention in ALL {
        browser.open(&figure(&materials, convention));
        for (i, scene) in sample(11, SCENES[0], SCENES[1], &convention).iter().enumerate() {
            let exposure = [0.0, 2.0, -1.5][i % 3];
            browser.evaluate(&format!("void {}", showing(scene, Quantity::Rendering, exposure)));
            let shown = [&materials[i % 2]];
            let core = rendered(&shown, PictureContent::default(), scene, &convention, exposure);
            let off = largest(&decoded(&browser.evaluate(&pictured(i % 2, None))), &core[0]);
            assert!(off <= PAGE_PIXELS, "{}: {scene:?}: off by {off}", convention.name);
        }
    }
}

#[test]
#[cfg_attr(not(has_webkit), ignore = "needs WebKitWebDriver and Xvfb, which are not installed")]
fn webkit_follows_mouse_and_keys_without_errors() {
    let browser = WebKit::start();
    browser.open(&figure(&[noise(1), noise(2)], PRINTED));
    browser.evaluate("void (window.errors = [], addEventListener('error', e => errors.push(e.message)))");
    let found = browser.after_frame(
        "(() => { const c = document.getElementById('canvas').getBoundingClientRect(), b = svbrdf.figure.boxes()[0]; \
         return [c.left + b.width / 2, c.top + b.height / 2, Math.min(b.width, b.height)]; })()",
    );
    let [x, y, side] = [0, 1, 2].map(|i| found[i].as_f64().unwrap() as i32);
    let before = browser.evaluate(&pictured(0, None));
    browser.drag([[x, y], [x + side / 4, y]]);
    let light = browser.after_frame("svbrdf.figure.state.scene.light");
    let expected = 0.5 * 1.03 * 48.0 / 47.0;
    assert!(
        (light[0].as_f64().unwrap() - expected).abs() < 0.02 && light[1].as_f64().unwrap().abs() < 0.02,
        "{light}"
    );
    assert_ne!(browser.evaluate(&pictured(0, None)), before);
    // The readouts stay after the press, which WebKit ends with a leave.
    let readouts = browser.after_frame("[...document.querySelectorAll('.readout')].map(e => e.textContent)");
    assert!(
        readouts.as_array().unwrap().iter().all(|text| text.as_str().unwrap().starts_with('(')),
        "{readouts}"
    );
    browser.press("d");
    let legend =
        browser.after_frame("[svbrdf.figure.state.difference, document.getElementById('legend').hidden]");
    assert_eq!(legend, json!([true, false]));
    browser.press("m");
    assert_eq!(browser.after_frame("svbrdf.figure.state.quantity"), json!("normal"));
    assert_eq!(browser.evaluate("errors"), json!([]));
}
