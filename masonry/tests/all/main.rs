//! The tests of `masonry`, one module for each theme.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]
#![allow(unreachable_pub, reason = "modules of helpers")]

mod common;

mod accuracy;
mod mechanics_bending;
mod mechanics_contact;
mod mechanics_elements;
mod mechanics_film_law;
mod mechanics_films;
mod mechanics_forms;
mod mechanics_nodal_change;
mod mechanics_reduction;
mod scene_bond;
mod scene_classes;
mod scene_errors;
mod scene_openings;
mod scene_panels;
mod study;
mod verdict;
