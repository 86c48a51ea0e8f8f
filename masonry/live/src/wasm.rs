//! The engine in a web worker of a browser.

use std::fmt::Display;
use std::ops::ControlFlow;
use std::time::Duration;

use js_sys::Function;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;
use web_time::Instant;

use crate::engine::Engine;

/// Time between two calls of `news`.
const NEWS: Duration = Duration::from_millis(100);

/// The engine with an interface for scripts.
#[wasm_bindgen]
#[derive(Debug, Default)]
pub struct LiveEngine(Engine);

#[wasm_bindgen]
impl LiveEngine {
    /// Creates an engine without solved scenes.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    /// Returns the [answer](Engine::answer) to a question; `news` is called with a text from time to time during the
    /// work. The work cannot be stopped through this object: a page ends the worker instead.
    pub fn answer(&self, question: &str, news: &Function) -> String {
        let mut last = Instant::now();
        self.0.answer(question, &mut |text: &dyn Display| {
            if last.elapsed() >= NEWS {
                last = Instant::now();
                // An error of the callback is ignored: a worker ends with its page.
                let _ = news.call1(&JsValue::NULL, &JsValue::from_str(&text.to_string()));
            }
            ControlFlow::Continue(())
        })
    }
}
