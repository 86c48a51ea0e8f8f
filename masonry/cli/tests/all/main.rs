//! The tests of the command `masonry`, one module for each theme.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod common;

mod arches;
mod block_list;
mod broken_scenes;
mod cli;
mod cli_runs;
mod combinations;
mod guide;
mod import_command;
mod limit;
mod live;
mod new_scenes;
mod page;
mod readme;
mod study;
