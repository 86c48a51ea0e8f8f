//! Motions against viscosity, each the solution of a convex program, and how viscous they are.

use faer::sparse::FaerError;

use super::constants::{
    AS_FREE, CREEPING, FIRST_VISCOSITY, FLOWING, LESS_VISCOUS, LONGER_MOTION, MORE_VISCOUS, MOVED,
    SAME_LENGTH, SLOWER, SOFTEST, WARM,
};
use super::factors::Factors;
use super::homogeneous::{Accuracy, solved_from};
use super::program::{Program, associated};
use super::variables::Variables;
use crate::Status;
use crate::states::{Condensed, Scaled, Springs};

/// Bodies that move with associated flow.
///
/// Slips open gaps by `mu` times their size then, and forces are the solution of a convex program, which interior points
/// always find. The next motion has the gaps as they are and slips from zero, so that bodies fall back on each other;
/// where they come to rest nothing slips, and forces and gaps are those of Coulomb's law (Anitescu 2006).
pub(super) struct Motions {
    edges: Program,
    factors: Factors,
    /// The solution of the last program: part of the start of the next (Skajaa, Andersen and Ye 2013).
    last: Option<Variables>,
}

/// Where bodies are after a motion, and the forces on the way, by contact point.
pub(super) struct Moved {
    pub(super) u: Vec<f64>,
    pub(super) forces: Vec<(f64, f64)>,
}

impl Motions {
    pub(super) fn of(problem: &Scaled) -> Result<Self, FaerError> {
        let edges = associated(problem);
        let factors = Factors::of(&edges)?;
        Ok(Self { edges, factors, last: None })
    }

    /// The factorisations of all motions.
    pub(super) fn factorisations(&self) -> usize {
        self.factors.factorisations
    }

    /// One motion from displacements, with slips as the problem measures them; `None` where it cannot be computed, or
    /// `stop` says so, which is asked before every step, with the residual.
    pub(super) fn advance(
        &mut self,
        problem: &Scaled,
        from: &[f64],
        (viscosity, accuracy): (f64, f64),
        stop: impl FnMut(f64) -> Option<Status>,
    ) -> Option<Moved> {
        let Self { edges, factors, last } = self;
        for (f, (load, from)) in edges.f.iter_mut().zip(problem.f.iter().zip(from)) {
            *f = load + viscosity * from;
        }
        for (x_0, (point, mu)) in edges.x_0.iter_mut().zip(problem.edges()) {
            *x_0 = point.x_0 + mu * point.s_0;
        }
        let accuracy = Accuracy::of_all(accuracy).of_loads(MOVED / accuracy);
        let mut at = Variables::start(edges, factors, viscosity)?;
        if let Some(last) = last {
            at = at.mixed(last, WARM);
        }
        let how = (viscosity, accuracy);
        let (moved, status) = solved_from(at, (edges, factors), how, stop, |_| false);
        if status != Status::Solved {
            return None;
        }
        let (u, forces) = (moved.u.clone(), problem.of_edges(moved.t.iter().copied()));
        *last = Some(moved);
        Some(Moved { u, forces })
    }
}

/// The part of motions that neither bodies nor closed contacts resist: what is left of them when a very soft spring acts on
/// every displacement.
pub(super) fn unresisted(
    problem: &Scaled,
    condensed: &mut Condensed,
    (motion, closed): (&[f64], &[bool]),
) -> Vec<f64> {
    let spring = |is_closed: &bool| Springs { nn: f64::from(*is_closed), ..Springs::default() };
    let springs: Vec<Springs> = closed.iter().map(spring).collect();
    condensed.factorise(problem, &springs, SOFTEST);
    let mut left: Vec<f64> = motion.iter().map(|v| SOFTEST * v).collect();
    condensed.solve(&mut left);
    left
}

/// How viscous motions are: less and less, and as before while they become longer for it, until they are as short as
/// before or go on for ever.
pub(super) struct Viscosity {
    pub(super) value: f64,
    /// The length of the last motion, and of the longest.
    last: f64,
    longest: f64,
    /// The length of the first motion with this viscosity, where it stays as it is.
    held: Option<f64>,
    /// How many motions in sequence have been as long as the one before and as the first of them.
    same: usize,
    /// The length of that one.
    first: f64,
    /// Length times viscosity of the last motion with more viscosity.
    resisted: f64,
}

impl Default for Viscosity {
    fn default() -> Self {
        let (last, first) = (f64::INFINITY, f64::INFINITY);
        Self {
            value: FIRST_VISCOSITY,
            last,
            longest: 0.0,
            held: None,
            same: 0,
            first,
            resisted: first,
        }
    }
}

impl Viscosity {
    /// Takes note of the length of a motion.
    pub(super) fn follow(&mut self, length: f64) {
        let before = std::mem::replace(&mut self.last, length);
        self.longest = self.longest.max(length);
        self.held = match self.held {
            None if length > LONGER_MOTION * before => Some(length),
            Some(first) if length > SLOWER * first => Some(first),
            _ => None,
        };
        let is_same = self.held.is_some() && length > SAME_LENGTH * before.max(self.first);
        (self.same, self.first) = if is_same { (self.same + 1, self.first) } else { (0, length) };
    }

    /// Whether bodies may be at rest.
    pub(super) fn may_rest(&self) -> bool {
        self.held.is_none() && self.value < FIRST_VISCOSITY
    }

    /// Whether bodies move on as before.
    pub(super) fn is_steady(&self) -> bool {
        self.same > FLOWING
    }

    /// Whether they move next to nothing.
    pub(super) fn creeps(&self) -> bool {
        self.last < CREEPING * self.longest
    }

    /// Keeps it at a value, for motions that lead to no rest that is found.
    pub(super) fn hold(&mut self, value: f64) {
        // After one of no length the next is longer.
        *self = Self { value, last: 0.0, longest: self.longest, ..Self::default() };
    }

    /// Whether it stays as it is.
    pub(super) fn is_held(&self) -> bool {
        self.held.is_some()
    }

    /// Whether a motion is about as long as the last one.
    pub(super) fn is_as_long(&self, length: f64) -> bool {
        length > AS_FREE * self.last
    }

    /// Whether the last motion is longer than that with more viscosity by about the factor between the two: then nothing
    /// else resists it.
    pub(super) fn goes_on(&self) -> bool {
        self.value * self.last > AS_FREE * self.resisted
    }

    /// Takes motions of the same length for those of bodies that something soft resists.
    pub(super) fn release(&mut self) {
        (self.held, self.same) = (None, 0);
    }

    /// For the next motion.
    pub(super) fn decrease(&mut self) {
        self.resisted = self.value * self.last;
        self.value /= LESS_VISCOUS;
    }

    /// For a motion that cannot be computed otherwise. The viscosity may be larger now than that of the motion before.
    pub(super) fn increase(&mut self) {
        self.value *= MORE_VISCOUS;
        self.resisted = f64::INFINITY;
    }
}
