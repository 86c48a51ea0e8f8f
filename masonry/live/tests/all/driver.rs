//! A browser that is operated as by a hand: as much of `WebDriver` as the tests need.

use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::common::say;

/// No wait of a test is as long as this on any machine.
const PATIENCE: Duration = Duration::from_secs(60);

/// A page in a headless browser.
pub(crate) struct Page {
    driver: Child,
    host: String,
    session: String,
}

impl Page {
    /// Opens an address on a screen of a width; `None`, and a line that says so, if there is no browser.
    pub(crate) fn open(address: &str, width: u32) -> Option<Self> {
        let Some((driver, host)) = started() else {
            say(
                "not tested: there is no chromedriver on this machine, by which the page could be operated",
            );
            return None;
        };
        let mut page = Self { driver, host, session: String::new() };
        let arguments = ["--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"];
        let screen = json!({ "width": width, "height": 900, "pixelRatio": 1, "mobile": false, "touch": false });
        let options = json!({ "args": arguments, "mobileEmulation": { "deviceMetrics": screen } });
        let wanted =
            json!({ "capabilities": { "alwaysMatch": { "goog:chromeOptions": options } } });
        let session = page.call("POST", "/session", &wanted);
        session["sessionId"].as_str().expect("a session").clone_into(&mut page.session);
        let patience = 1000 * PATIENCE.as_secs();
        page.post("/timeouts", &json!({ "script": patience, "pageLoad": patience }));
        page.go(address);
        Some(page)
    }

    /// Opens another address. The browser does not ask whether to leave, since the driver misses its question now and then.
    pub(crate) fn go(&self, address: &str) {
        self.run("addEventListener('beforeunload', (it) => it.stopImmediatePropagation(), true)");
        self.post("/url", &json!({ "url": address }));
    }

    /// What a function body of a script returns.
    pub(crate) fn run(&self, script: &str) -> Value {
        self.post("/execute/sync", &json!({ "script": script, "args": [] }))
    }

    /// What the promise of an expression comes to.
    pub(crate) fn later(&self, promise: &str) -> Value {
        let script = format!(
            "const end = arguments[arguments.length - 1]; ({promise}).then(end, (it) => end(String(it)))"
        );
        self.post("/execute/async", &json!({ "script": script, "args": [] }))
    }

    /// Waits until an expression holds.
    #[track_caller]
    pub(crate) fn wait(&self, expression: &str) {
        let began = Instant::now();
        while self.run(&format!("return Boolean({expression})")) != true {
            if began.elapsed() > PATIENCE {
                let seen = self.run("return document.body.innerText");
                panic!(
                    "{expression} does not come true on the page\n{}",
                    seen.as_str().unwrap_or_default()
                );
            }
            thread::sleep(Duration::from_millis(20));
        }
    }

    /// Presses the mouse at the middle of an element, moves it by pixels in so many equal parts, and lets it go.
    #[track_caller]
    pub(crate) fn drag(&self, selector: &str, by: [f64; 2], parts: u32) {
        let [x, y] = self.middle(selector);
        let mut actions = vec![at(x, y), json!({ "type": "pointerDown", "button": 0 })];
        actions.extend((1..=parts).map(|part| {
            let done = f64::from(part) / f64::from(parts);
            at((x + by[0] * done).round(), (y + by[1] * done).round())
        }));
        actions.push(json!({ "type": "pointerUp", "button": 0 }));
        let parameters = json!({ "pointerType": "mouse" });
        let mouse = json!({ "type": "pointer", "id": "mouse", "parameters": parameters, "actions": actions });
        self.post("/actions", &json!({ "actions": [mouse] }));
    }

    #[track_caller]
    pub(crate) fn click(&self, selector: &str) {
        self.drag(selector, [0.0, 0.0], 1);
    }

    /// Presses keys, one after the other, on what has the focus; those that `held` names are held down.
    pub(crate) fn keys(&self, held: &str, keys: &str) {
        let key = |kind: &str, value: char| json!({ "type": kind, "value": value.to_string() });
        let mut actions: Vec<Value> = held.chars().map(|it| key("keyDown", it)).collect();
        actions.extend(keys.chars().flat_map(|it| [key("keyDown", it), key("keyUp", it)]));
        actions.extend(held.chars().map(|it| key("keyUp", it)));
        self.post(
            "/actions",
            &json!({ "actions": [{ "type": "key", "id": "keys", "actions": actions }] }),
        );
    }

    /// Has the page in dark colours.
    pub(crate) fn darken(&self) {
        let features = json!([{ "name": "prefers-color-scheme", "value": "dark" }]);
        let command =
            json!({ "cmd": "Emulation.setEmulatedMedia", "params": { "features": features } });
        self.post("/goog/cdp/execute", &command);
    }

    /// Writes what is seen as a PNG file.
    pub(crate) fn picture(&self, path: &Path) {
        let picture =
            self.call("GET", &format!("/session/{}/screenshot", self.session), &Value::Null);
        let script =
            "return Array.from(Uint8Array.from(atob(arguments[0]), it => it.charCodeAt(0)))";
        let bytes = self.post("/execute/sync", &json!({ "script": script, "args": [picture] }));
        let bytes: Vec<u8> = serde_json::from_value(bytes).unwrap();
        std::fs::write(path, bytes).unwrap();
    }

    /// The middle of an element, scrolled into sight.
    #[track_caller]
    fn middle(&self, selector: &str) -> [f64; 2] {
        let middle = self.run(&format!(
            "const it = document.querySelector({selector:?}); it.scrollIntoView({{ block: 'center', inline: 'nearest' }}); \
             const box = it.getBoundingClientRect(); return [box.x + box.width / 2, box.y + box.height / 2]"
        ));
        [0, 1].map(|k| middle[k].as_f64().expect("an element on the page").round())
    }

    fn post(&self, path: &str, body: &Value) -> Value {
        self.call("POST", &format!("/session/{}{path}", self.session), body)
    }

    fn call(&self, method: &str, path: &str, body: &Value) -> Value {
        let body = if body.is_null() { String::new() } else { body.to_string() };
        let mut stream = TcpStream::connect(&self.host).unwrap();
        // The driver itself ends a script that takes longer than its patience.
        stream.set_read_timeout(Some(2 * PATIENCE)).unwrap();
        let (host, length) = (&self.host, body.len());
        let head = format!(
            "{method} {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\nContent-Length: {length}\r\n\r\n"
        );
        stream.write_all((head + &body).as_bytes()).unwrap();
        // The driver leaves the connection open.
        let mut reader = BufReader::new(stream);
        let mut length = 0;
        loop {
            let mut line = String::new();
            reader.read_line(&mut line).unwrap();
            let line = line.trim().to_ascii_lowercase();
            if line.is_empty() {
                break;
            }
            if let Some(value) = line.strip_prefix("content-length:") {
                length = value.trim().parse().unwrap();
            }
        }
        let mut answer = vec![0; length];
        reader.read_exact(&mut answer).unwrap();
        let value = serde_json::from_slice::<Value>(&answer).unwrap()["value"].take();
        assert!(value["error"].is_null(), "{method} {path}: {value}");
        value
    }
}

/// A driver and the address at which it listens; `None` if there is none on this machine.
fn started() -> Option<(Child, String)> {
    /// Of two that start at once, both may choose the same port, and one ends.
    const ATTEMPTS: usize = 5;
    for _ in 0..ATTEMPTS {
        let mut command = Command::new("chromedriver");
        let quiet = command.arg("--port=0").stdout(Stdio::piped()).stderr(Stdio::null());
        let mut driver = quiet.spawn().ok()?;
        let said = BufReader::new(driver.stdout.take()?).lines();
        let port = said.map_while(Result::ok).find_map(|line| {
            let rest = line.split("successfully on port ").nth(1)?;
            Some(rest.trim_end_matches('.').to_owned())
        });
        if let Some(port) = port {
            return Some((driver, format!("127.0.0.1:{port}")));
        }
        driver.wait().ok()?;
    }
    panic!("chromedriver has named no port in {ATTEMPTS} attempts");
}

/// The pointer goes to a place of the window within a frame of the screen.
fn at(x: f64, y: f64) -> Value {
    json!({ "type": "pointerMove", "duration": 16, "x": x, "y": y, "origin": "viewport" })
}

impl Drop for Page {
    fn drop(&mut self) {
        if !self.session.is_empty() && !thread::panicking() {
            self.call("DELETE", &format!("/session/{}", self.session), &Value::Null);
        }
        let _ = self.driver.kill();
        let _ = self.driver.wait();
    }
}
