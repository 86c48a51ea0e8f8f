//! Tests of the live page: its engine, its server, and the page itself in a browser.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod browser;
mod browser_files;
mod common;
mod driver;
mod engine;
mod hostile;
mod single;
