//! The engine in a worker of a browser.

use std::fmt::Display;
use std::ops::ControlFlow;
use std::time::Duration;

use js_sys::Function;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;
use web_time::Instant;

use crate::engine::Engine;

/// Time between two pieces of news.
const NEWS: Duration = Duration::from_millis(100);

/// The engine for scripts.
#[wasm_bindgen]
#[derive(Debug, Default)]
pub struct LiveEngine(Engine);

#[wasm_bindgen]
impl LiveEngine {
    /// An engine that has solved nothing yet.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    /// The [answer](Engine::answer) to a question; `news` is called with a text while the work goes on. The work cannot
    /// be stopped through this object: a page ends the worker.
    pub fn answer(&self, question: &str, news: &Function) -> String {
        let mut last = Instant::now();
        self.0.answer(question, &mut |text: &dyn Display| {
            if last.elapsed() >= NEWS {
                last = Instant::now();
                // A worker whose page is gone ends with the page.
                let _ = news.call1(&JsValue::NULL, &JsValue::from_str(&text.to_string()));
            }
            ControlFlow::Continue(())
        })
    }
}
