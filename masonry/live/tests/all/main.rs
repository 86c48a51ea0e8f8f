//! Tests of the live page: its engine, its server, and the page itself in a browser.

mod browser;
mod common;
mod driver;
mod engine;
mod hostile;
mod single;
