//! Films as the paper prints them: bonded where they are in contact, and brought up to date after every solution.
//!
//! If the parts of the films are given, all films are elastic, and the structure is a contact problem of its blocks
//! and dry joints. Its displacements give new parts. That need not end: see [`updating`](crate::paper::film::updating).

use std::ops::ControlFlow;

use faer::sparse::{SparseColMat, Triplet};
use lcp::{Contact2d, Matrix, Status};

use super::{AlmError, Answer, MortaredWall, Settings, solve};
use crate::paper::film::updating::{Settling, UpdateHistory, Updating};

/// The part `[x_i, x_f]` of every segment that is in contact \[m\], in its own axis; `None` where it is open.
pub type Parts = Vec<Option<[f64; 2]>>;

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
#[non_exhaustive]
pub struct Updated {
    /// `Solved` only where the parts settled; `Cycling` where they came back, `IterationLimit` where they
    /// still moved at the last update, or why a solution between two updates failed.
    pub status: Status,
    /// What the parts did at last.
    pub settling: Settling,
    /// The films in the last solution.
    pub parts: Parts,
    /// The last solution.
    pub answer: Answer,
    /// How far the ends of the parts moved, update by update: the mean over the films, relative to their
    /// lengths \[-\].
    pub moved: Vec<f64>,
}

impl MortaredWall {
    /// All films in contact along the whole of them.
    pub fn bonded(&self) -> Parts {
        self.films().iter().map(|film| Some(film.film.strip().ends())).collect()
    }

    /// The contact problem of blocks and dry joints with all films bonded on these parts.
    ///
    /// # Errors
    /// [`lcp::Error::NotFinite`] when the data overflow.
    ///
    /// # Panics
    /// If there is not one part for every segment.
    pub fn with_parts(&self, parts: &Parts) -> Result<Contact2d, lcp::Error> {
        assert_eq!(parts.len(), self.films().len(), "one part for every segment");
        let dry = self.without_films();
        let k = dry.stiffness().triplet_iter();
        let mut entries: Vec<_> = k.map(|e| Triplet::new(e.row, e.col, *e.val)).collect();
        for (film, part) in self.films().iter().zip(parts) {
            let stiffness = film.film.strip().stiffness(part.unwrap_or([0.0; 2]));
            // Rounding errors of the product are not symmetric.
            let symmetric = 0.5 * (stiffness + stiffness.transpose());
            entries.extend(film.entries(&symmetric).map(|(i, j, value)| Triplet::new(i, j, value)));
        }
        let n = dry.displacements();
        let k = SparseColMat::try_new_from_triplets(n, n, &entries)
            .unwrap_or_else(|e| unreachable!("entries lie inside the matrix: {e:?}"));
        let [normal, tangent] = [dry.normal(), dry.tangent()].map(|c| Matrix::from(c.clone()));
        let (x_0, s_0) = (dry.initial_gaps().to_vec(), dry.initial_slips().to_vec());
        Contact2d::new(k, dry.loads().to_vec(), normal, tangent, x_0, s_0, dry.mu().to_vec())
    }

    /// Solves with all films bonded, drops what is not in contact, and so on until nothing changes, or what
    /// changed comes back.
    ///
    /// # Errors
    /// As [`solve`](super::solve), and [`AlmError::Relaxation`].
    pub fn solve_by_parts(
        &self,
        settings: &Settings,
        updates: &Updates,
    ) -> Result<Updated, AlmError> {
        let Updates { updating, relaxation, limit, near } = *updates;
        if !(relaxation > 0.0 && relaxation <= 1.0) {
            return Err(AlmError::Relaxation { relaxation });
        }
        let lengths: Vec<f64> = self.films().iter().map(|it| it.film.strip().length()).collect();
        let mut history = UpdateHistory::new(lengths.clone(), near);
        let mut parts = self.bonded();
        let mut settling = history.record(&parts);
        let mut moved = Vec::new();
        loop {
            let problem = self.with_parts(&parts)?;
            let answer = solve(&problem, settings, &mut |_| ControlFlow::Continue(()))?;
            let status = match settling {
                _ if answer.status != Status::Solved => answer.status,
                Settling::Settled => Status::Solved,
                Settling::Cycle { .. } => Status::Cycling,
                Settling::Moving if moved.len() >= limit => Status::IterationLimit,
                Settling::Moving => {
                    let u = &answer.state.u;
                    let next: Parts = self
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
            return Ok(Updated { status, settling, parts, answer, moved });
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
