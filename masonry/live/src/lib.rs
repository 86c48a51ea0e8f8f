//! A page on which a wall or an arch answers while its scene is changed: the text of the scene beside its picture.
//!
//! The page asks an [`Engine`](engine::Engine) questions in JSON: the text of a scene goes in, and verdict, pictures and places in
//! the text come out. A [`Server`](server::Server) takes the questions to the engine on the loopback address; the same page as a
//! single file has the engine beside it, compiled to WebAssembly.
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
