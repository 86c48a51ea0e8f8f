//! The tests of `masonry-report`, one module for each kind of output.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]
#![allow(unreachable_pub, reason = "modules of helpers")]

mod data;
mod files;
mod forces;
mod motion;
mod svg;
mod synthetic;
