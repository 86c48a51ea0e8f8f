//! The part of a film in contact, by the law or as printed in the paper, and whether the updates converge: an experiment, since
//! those of the paper do not.
//!
//! As printed, the film is bonded on a part `[x_i, x_f]`, the structure is solved with the
//! [stiffness](Strip::stiffness) of that part, and the part is updated from the displacements: it is
//! removed where the faces separate. There is no sliding. A removed point may carry `sigma_x` and `tau`, so forces
//! jump at zero opening, and the updates may cycle. [`UpdateHistory`] detects this. The law has no such
//! jump.

use masonry::paper::film::Vector8;
use masonry::paper::film::strip::Strip;

/// How the part of a film in contact follows from the displacements of its nodes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Updating {
    /// The law decides: contact is where the elastic `sigma_y` is a pressure.
    #[default]
    Pointwise,
    /// As printed: contact where the faces do not draw apart, `eps_y <= 0`.
    Printed,
}

impl Updating {
    /// The part `[x_i, x_f]` \[m\] in contact for displacements of the nodes in local axes; `None` when
    /// the film is open everywhere.
    ///
    /// What decides is linear in `x`, so the part is exact, and one part. A film at rest is in contact.
    pub fn contact_part(self, strip: &Strip, displacements: &Vector8) -> Option<[f64; 2]> {
        let [left, right] = strip.ends();
        let parting = |x: f64| match self {
            Self::Pointwise => strip.stress(x, displacements).y,
            Self::Printed => (strip.strain_matrix(x) * displacements).y,
        };
        let [at_left, at_right] = [parting(left), parting(right)];
        let change = || left + (right - left) * (at_left / (at_left - at_right));
        let part = match (at_left > 0.0, at_right > 0.0) {
            (false, false) => return Some([left, right]),
            (true, true) => return None,
            (false, true) => [left, change()],
            (true, false) => [change(), right],
        };
        (part[0] < part[1]).then_some(part)
    }
}

/// The longest cycle that is detected.
pub const LONGEST_CYCLE: usize = 8;

/// The behaviour of a sequence of updates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Settling {
    /// The last update changed the parts, and led to none of the parts before.
    Moving,
    /// The last update changed nothing.
    Settled,
    /// The parts are those of `period` updates before, at least two, and not those of the last.
    Cycle {
        /// Number of updates after which everything repeats.
        period: usize,
    },
}

/// The parts in contact of several films, update by update.
///
/// The update depends on the parts alone, so if parts are repeated, the sequence cycles: the first repetition is
/// detected. A converging sequence that oscillates is distinguished from a cycle only by `tolerance`, which should
/// therefore be small.
#[derive(Debug, Clone, PartialEq)]
pub struct UpdateHistory {
    lengths: Vec<f64>,
    tolerance: f64,
    /// At most [`LONGEST_CYCLE`] records, the last one first.
    past: Vec<Vec<Option<[f64; 2]>>>,
}

impl UpdateHistory {
    /// No records yet, for films of these lengths \[m\]. Ends closer than `tolerance` times the length
    /// of their film count as equal.
    pub fn new(lengths: Vec<f64>, tolerance: f64) -> Self {
        Self { lengths, tolerance, past: Vec::new() }
    }

    /// Records the parts \[m\] of all films after an update.
    ///
    /// # Panics
    /// If there is not one part per film.
    pub fn record(&mut self, parts: &[Option<[f64; 2]>]) -> Settling {
        assert_eq!(parts.len(), self.lengths.len(), "one part per film");
        let settling = match self.past.iter().position(|known| self.same(known, parts)) {
            None => Settling::Moving,
            Some(0) => Settling::Settled,
            Some(before) => Settling::Cycle { period: before + 1 },
        };
        self.past.truncate(LONGEST_CYCLE - 1);
        self.past.insert(0, parts.to_vec());
        settling
    }

    fn same(&self, known: &[Option<[f64; 2]>], parts: &[Option<[f64; 2]>]) -> bool {
        self.lengths.iter().zip(known.iter().zip(parts)).all(|(length, pair)| {
            let near = self.tolerance * length;
            match pair {
                (Some(p), Some(q)) => (p[0] - q[0]).abs() <= near && (p[1] - q[1]).abs() <= near,
                (Some(p), None) | (None, Some(p)) => p[1] - p[0] <= near,
                (None, None) => true,
            }
        })
    }
}
