//! Tests of both crates together, of whole scenes, and of the files and the command of `lcp`.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]
#![allow(unreachable_pub, reason = "modules of helpers")]

mod common;

mod agreement_panels;
mod alm;
mod alm_films;
mod alm_route;
mod beam_uplift;
mod bridges;
mod checkpoints;
mod closed_forms;
mod combinations;
mod effects;
mod fallbacks;
mod hard_cases;
mod hard_walls;
mod healing;
mod history;
mod import_circles;
mod joint_law;
mod joint_stiffness;
mod judged_states;
mod kern;
mod lcp_cli;
mod lcp_files;
mod lcp_formats;
mod lcp_serde;
mod limit_cases;
mod links;
mod lintels;
mod loading;
mod loads;
mod mortar;
mod no_equilibrium;
mod panels;
#[cfg(feature = "long-tests")]
mod panels_by_all_routes;
mod patch;
mod polygons;
mod properties;
mod random_walls;
mod reduction;
mod rings;
mod routes;
mod second_loading;
mod seismic;
mod settlement;
mod shoe;
mod staircase;
mod strips;
mod strips_panels;
mod turned;
mod verdict;
