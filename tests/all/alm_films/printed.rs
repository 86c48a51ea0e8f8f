//! Films as the paper prints them: bonded where they are in contact, and brought up to date after every solution.
//!
//! If the parts of the films are given, all films are elastic, and the structure is a contact problem of its blocks
//! and dry joints. Its displacements give new parts. That need not end.

use std::ops::ControlFlow;

use lcp::Status;
use masonry::paper::alm::{AlmAnswer, AlmSettings, MortaredWall, Parts, solve};

use super::updating::{Settling, UpdateHistory, Updating};

/// How parts in contact are brought up to date.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Updates {
    /// What decides on contact.
    pub updating: Updating,
    /// The share of their way by which the ends of a part move, above 0 and at most 1.
    pub relaxation: f64,
    /// Updates at most.
    pub limit: usize,
    /// Ends that move less, relative to the length of their film, have settled, and those that come as near
    /// to where they were before have come back.
    pub near: f64,
}

impl Default for Updates {
    fn default() -> Self {
        Self { updating: Updating::Printed, relaxation: 1.0, limit: 40, near: 1e-6 }
    }
}

/// What the updates came to.
#[derive(Debug, Clone)]
pub struct Updated {
    /// `Solved` only where the parts settled; `Cycling` where they came back, `IterationLimit` where they
    /// still moved at the last update, or why a solution between two updates failed.
    pub status: Status,
    /// What the parts did at last.
    pub settling: Settling,
    /// The films in the last solution.
    pub parts: Parts,
    /// The last solution.
    pub answer: AlmAnswer,
    /// How far the ends of the parts moved, update by update: the mean over the films, relative to their
    /// lengths \[-\].
    pub moved: Vec<f64>,
}

impl Updated {
    /// Solves with all films bonded, drops what is not in contact, and so on until nothing changes, or what
    /// changed comes back.
    pub fn of(wall: &MortaredWall, settings: &AlmSettings, updates: &Updates) -> Self {
        let Updates { updating, relaxation, limit, near } = *updates;
        let lengths: Vec<f64> = wall.films().iter().map(|it| it.film.strip().length()).collect();
        let mut history = UpdateHistory::new(lengths.clone(), near);
        let mut parts = wall.bonded();
        let mut settling = history.record(&parts);
        let mut moved = Vec::new();
        loop {
            let problem = wall.with_parts(&parts).unwrap();
            let answer = solve(&problem, settings, &mut |_| ControlFlow::Continue(())).unwrap();
            let status = match settling {
                _ if answer.status != Status::Solved => answer.status,
                Settling::Settled => Status::Solved,
                Settling::Cycle { .. } => Status::Cycling,
                Settling::Moving if moved.len() >= limit => Status::IterationLimit,
                Settling::Moving => {
                    let u = &answer.state.u;
                    let next: Parts = wall
                        .films()
                        .iter()
                        .zip(&parts)
                        .map(|(film, part)| {
                            let strip = film.film.strip();
                            let new = updating.contact_part(strip, &film.displacements(u));
                            relaxed(*part, new, relaxation)
                        })
                        .collect();
                    moved.push(distance(&parts, &next, &lengths));
                    settling = history.record(&next);
                    parts = next;
                    continue;
                }
            };
            return Self { status, settling, parts, answer, moved };
        }
    }
}

/// A part on its way to another one. What opens shrinks to its middle, what closes grows at once.
fn relaxed(old: Option<[f64; 2]>, new: Option<[f64; 2]>, share: f64) -> Option<[f64; 2]> {
    let (Some(old), true) = (old, share < 1.0) else { return new };
    let middle = 0.5 * (old[0] + old[1]);
    let to = new.unwrap_or([middle; 2]);
    Some([0, 1].map(|end| old[end] + share * (to[end] - old[end])))
}

/// The mean distance of the ends of two lists of parts, relative to the lengths of the films.
fn distance(old: &Parts, new: &Parts, lengths: &[f64]) -> f64 {
    let apart = old.iter().zip(new).zip(lengths).map(|(parts, length)| {
        let apart = match parts {
            (Some(p), Some(q)) => 0.5 * ((p[0] - q[0]).abs() + (p[1] - q[1]).abs()),
            (Some(p), None) | (None, Some(p)) => p[1] - p[0],
            (None, None) => 0.0,
        };
        apart / length
    });
    apart.sum::<f64>() / lengths.len().max(1) as f64
}
