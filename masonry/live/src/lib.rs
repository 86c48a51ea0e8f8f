//! A page that solves a scene while its text is changed, and shows verdict and picture beside the text.
//!
//! The page sends questions in JSON to an [`Engine`](engine::Engine): the text of a scene goes in, and verdict, pictures and
//! places in the text come out. A [`Server`](server::Server) passes the questions on from the loopback address; the same page as
//! a single file contains the engine, compiled to WebAssembly.
//!
//! ```
//! use std::ops::ControlFlow;
//! use masonry_live::engine::Engine;
//!
//! let question = r#"{ "task": "solve", "text": "title = 1", "show": "answer", "step": null }"#;
//! let answer = Engine::default().answer(question, &mut |_| ControlFlow::Continue(()));
//! assert!(answer.contains("invalid type: integer `1`, expected a string"));
//! ```

pub mod beginnings;
pub mod engine;
pub mod page;
#[cfg(feature = "serve")]
pub mod server;
#[cfg(target_arch = "wasm32")]
pub mod wasm;
