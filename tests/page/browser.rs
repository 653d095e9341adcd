//! Chromium without a window, driven by its own protocol through two pipes: one browser, one page at a time.

use std::io::{BufRead as _, BufReader, Write as _};
use std::path::Path;
use std::process::{ChildStdin, ChildStdout, Command, Stdio};
use std::sync::{LazyLock, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use base64::Engine as _;
use serde_json::{Value, json};
use tempfile::TempDir;

/// The longest that a page takes to start.
const PATIENCE: Duration = Duration::from_secs(180);
const ARGUMENTS: &str = "--headless --no-sandbox --disable-gpu --use-angle=swiftshader --enable-unsafe-swiftshader \
    --disable-quic --no-first-run --disable-background-networking --disable-component-update \
    --disable-sync --disable-dev-shm-usage --disable-renderer-backgrounding --disable-backgrounding-occluded-windows --remote-debugging-pipe";

/// The browser of all tests. It ends with the program of the tests, which closes its pipes.
static BROWSER: LazyLock<Mutex<Browser>> = LazyLock::new(|| Mutex::new(Browser::start()));

struct Browser {
    input: ChildStdin,
    output: BufReader<ChildStdout>,
    sent: u64,
}

impl Browser {
    #[allow(clippy::zombie_processes, reason = "it lives as long as the tests")]
    fn start() -> Self {
        let profile = tempfile::tempdir().unwrap().keep();
        let names = ["chromium", "chromium-browser"];
        let path = std::env::var_os("PATH").unwrap_or_default();
        let found = |name: &&str| std::env::split_paths(&path).any(|folder| folder.join(name).is_file());
        let program = names.into_iter().find(found).expect("CI must have Debian's chromium");
        // The protocol is spoken on descriptors 3 and 4. The shell outlives the browser, and removes its profile.
        let script = r#"p=$1; shift; "$0" "$@" --user-data-dir="$p" 3<&0 4>&1 0</dev/null 1>/dev/null 2>/dev/null; rm -rf "$p""#;
        let mut command = Command::new("sh");
        command.args(["-c", script, program]).arg(profile).args(ARGUMENTS.split(' '));
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
        let output = BufReader::new(child.stdout.take().unwrap());
        Self { input: child.stdin.take().unwrap(), output, sent: 0 }
    }

    /// The result of a command to a session, or to the browser where it has no name; what comes before it are events.
    fn call(&mut self, session: &str, method: &str, params: &Value, events: &mut Vec<Value>) -> Value {
        self.sent += 1;
        let mut message = json!({ "id": self.sent, "method": method, "params": params });
        if !session.is_empty() {
            message["sessionId"] = json!(session);
        }
        self.input.write_all(format!("{message}\0").as_bytes()).unwrap();
        loop {
            let mut bytes = Vec::new();
            assert!(self.output.read_until(0, &mut bytes).unwrap() > 0, "the browser has ended");
            let answer: Value = serde_json::from_slice(bytes.strip_suffix(b"\0").unwrap()).unwrap();
            if answer["id"] == json!(self.sent) {
                assert!(answer["error"].is_null(), "{method}: {}", answer["error"]);
                return answer["result"].clone();
            }
            if answer["sessionId"] == json!(session) {
                events.push(answer);
            }
        }
    }
}

/// A page in a tab of its own.
pub struct Page {
    browser: MutexGuard<'static, Browser>,
    session: String,
    /// Events of the page so far.
    pub events: Vec<Value>,
    folder: TempDir,
}

impl Page {
    /// Opens a page with a figure as a file, in a window of `width` x `height` CSS pixels, and waits until its figure is there.
    pub fn open(html: &str, size: [u32; 2]) -> Self {
        const STARTED: &str = "!!window.svbrdf || document.getElementById('problem')?.hidden === false";
        Self::open_until(html, size, STARTED)
    }

    /// Opens `html` as a file, and waits until an expression of JavaScript is true.
    pub fn open_until(html: &str, [width, height]: [u32; 2], ready: &str) -> Self {
        let mut browser = BROWSER.lock().unwrap_or_else(PoisonError::into_inner);
        let mut ask = |method: &str, params: Value| browser.call("", method, &params, &mut Vec::new());
        let target = ask("Target.createTarget", json!({ "url": "about:blank", "newWindow": true }));
        let attached =
            ask("Target.attachToTarget", json!({ "targetId": target["targetId"], "flatten": true }));
        let session = attached["sessionId"].as_str().unwrap().to_owned();
        let mut page = Self { browser, session, events: Vec::new(), folder: tempfile::tempdir().unwrap() };
        for domain in ["Network", "Runtime", "Log", "Page"] {
            page.send(&format!("{domain}.enable"), json!({}));
        }
        page.resize([width, height]);
        page.scheme("light");
        page.send("Emulation.setFocusEmulationEnabled", json!({ "enabled": true }));
        page.send("Emulation.setTouchEmulationEnabled", json!({ "enabled": true, "maxTouchPoints": 2 }));
        let file = page.folder.path().join("report.html");
        std::fs::write(&file, html).unwrap();
        page.send("Page.navigate", json!({ "url": format!("file://{}", file.display()) }));
        let started = Instant::now();
        while page.evaluate(ready) != json!(true) {
            assert!(started.elapsed() < PATIENCE, "the page does not start: {:?}", page.events);
            thread::sleep(Duration::from_millis(50));
        }
        page
    }

    /// A window of this size, in CSS pixels.
    pub fn resize(&mut self, [width, height]: [u32; 2]) {
        let size = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
        self.send("Emulation.setDeviceMetricsOverride", size);
    }

    /// Colours that are `light` or `dark`, as a reader sets them.
    pub fn scheme(&mut self, scheme: &str) {
        // Scrolling that takes time would move what is clicked.
        let features = json!([
            { "name": "prefers-reduced-motion", "value": "reduce" },
            { "name": "prefers-color-scheme", "value": scheme },
        ]);
        self.send("Emulation.setEmulatedMedia", json!({ "features": features }));
    }

    /// The result of a command of the protocol.
    pub fn send(&mut self, method: &str, params: Value) -> Value {
        self.browser.call(&self.session, method, &params, &mut self.events)
    }

    /// The value of an expression of JavaScript in the page, awaited where it is a promise.
    pub fn evaluate(&mut self, expression: &str) -> Value {
        let params = json!({ "expression": expression, "returnByValue": true, "awaitPromise": true });
        let result = self.send("Runtime.evaluate", params);
        assert!(result["exceptionDetails"].is_null(), "{expression}: {}", result["exceptionDetails"]);
        result["result"]["value"].clone()
    }

    /// Waits for two frames, then evaluates.
    pub fn after_frame(&mut self, expression: &str) -> Value {
        let frames = "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))";
        self.evaluate(&format!("{frames}.then(() => ({expression}))"))
    }

    pub fn number(&mut self, expression: &str) -> f64 {
        self.after_frame(expression).as_f64().unwrap()
    }

    pub fn click(&mut self, id: &str) {
        self.evaluate(&format!("document.getElementById({id:?}).click()"));
    }

    /// Enters a value into a field, or chooses it.
    pub fn input(&mut self, id: &str, value: &str) {
        self.evaluate(&format!(
            "(() => {{ const e = document.getElementById({id:?}); e.value = {value:?}; e.dispatchEvent(new Event('input', {{ bubbles: true }})); }})()"
        ));
    }

    /// The materials in the panes.
    pub fn panes(&mut self) -> Value {
        self.after_frame("window.svbrdf.figure.panes().map(pane => pane.material)")
    }

    /// The middle of an element in the window, after it is scrolled there.
    pub fn place(&mut self, selector: &str) -> [f64; 2] {
        let rectangle = self.evaluate(&format!(
            "(() => {{ const e = document.querySelector({selector:?}); e.scrollIntoView({{ block: 'center' }}); \
             const r = e.getBoundingClientRect(); return [r.left + r.width / 2, r.top + r.height / 2]; }})()"
        ));
        [0, 1].map(|i| rectangle[i].as_f64().unwrap())
    }

    /// An event of the mouse, or of what `more` says.
    pub fn mouse(&mut self, kind: &str, [x, y]: [f64; 2], more: Value) {
        let mut params = json!({ "type": kind, "x": x, "y": y, "clickCount": 1 });
        params.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        self.send("Input.dispatchMouseEvent", params);
    }

    /// Writes a picture of the window, after a pause: the status of a figure comes late.
    pub fn save_jpeg(&mut self, path: &Path) {
        self.send("Emulation.setScrollbarsHidden", json!({ "hidden": true }));
        self.evaluate("new Promise(done => setTimeout(done, 1000))");
        let picture = self.send("Page.captureScreenshot", json!({ "format": "jpeg", "quality": 80 }));
        let bytes = base64::prelude::BASE64_STANDARD.decode(picture["data"].as_str().unwrap()).unwrap();
        std::fs::write(path, bytes).unwrap();
    }

    /// A drag of the mouse in three moves.
    pub fn drag(&mut self, button: &str, modifiers: u32, from: [f64; 2], to: [f64; 2]) {
        let buttons = 1 << ["left", "right", "middle"].iter().position(|name| *name == button).unwrap();
        let mut event = |kind: &str, at, buttons: i32| {
            self.mouse(kind, at, json!({ "button": button, "buttons": buttons, "modifiers": modifiers }));
        };
        event("mouseMoved", from, 0);
        event("mousePressed", from, buttons);
        for share in [0.3, 0.7, 1.0] {
            event("mouseMoved", [0, 1].map(|i| from[i] + share * (to[i] - from[i])), buttons);
        }
        event("mouseReleased", to, 0);
    }

    /// Touches that go along these paths together.
    pub fn touch(&mut self, paths: &[[[f64; 2]; 2]]) {
        for (kind, share) in [("touchStart", 0.0), ("touchMove", 0.5), ("touchMove", 1.0)] {
            let point = |(id, [from, to]): (usize, &[[f64; 2]; 2])| {
                let [x, y] = [0, 1].map(|i| from[i] + share * (to[i] - from[i]));
                json!({ "x": x, "y": y, "id": id })
            };
            let points: Vec<Value> = paths.iter().enumerate().map(point).collect();
            self.send("Input.dispatchTouchEvent", json!({ "type": kind, "touchPoints": points }));
        }
        self.send("Input.dispatchTouchEvent", json!({ "type": "touchEnd", "touchPoints": [] }));
    }

    /// Presses and releases a key, such as `m` or `ArrowLeft`.
    pub fn press(&mut self, key: &str, modifiers: u32) {
        self.key("keyDown", key, modifiers);
        self.key("keyUp", key, modifiers);
    }

    /// `keyDown` or `keyUp`.
    pub fn key(&mut self, kind: &str, key: &str, modifiers: u32) {
        let text = if key.len() == 1 && kind == "keyDown" { key } else { "" };
        let code = match key {
            "ArrowLeft" => 37,
            "ArrowUp" => 38,
            "ArrowRight" => 39,
            "ArrowDown" => 40,
            "Tab" => 9,
            "Enter" => 13,
            _ => u32::from(key.to_ascii_uppercase().as_bytes()[0]),
        };
        let params = json!({ "type": kind, "key": key, "text": text, "modifiers": modifiers, "windowsVirtualKeyCode": code });
        self.send("Input.dispatchKeyEvent", params);
    }

    /// The addresses that the page has requested, and what it complained about.
    pub fn traffic(&self) -> (Vec<String>, Vec<String>) {
        let of = |method: &'static str| self.events.iter().filter(move |event| event["method"] == method);
        let requests = of("Network.requestWillBeSent")
            .map(|event| event["params"]["request"]["url"].as_str().unwrap_or_default().to_owned());
        let complaints = of("Runtime.exceptionThrown").chain(of("Log.entryAdded")).map(Value::to_string);
        let complaints =
            complaints.filter(|text| text.contains("error") && !text.contains("GL Driver Message"));
        (requests.collect(), complaints.collect())
    }
}

impl Drop for Page {
    /// Closes the tab.
    fn drop(&mut self) {
        if !thread::panicking() {
            self.send("Page.close", json!({}));
        }
    }
}
