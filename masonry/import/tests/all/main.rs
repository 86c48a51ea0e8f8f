//! The tests of `masonry-import`.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]
#![allow(unreachable_pub, reason = "modules of helpers")]

mod common;

mod errors;
mod formats;
mod walls;
