//! Displacements, forces, gaps and slips of contact.

use lcp_linalg::Columns;

use super::Residuals;
use super::constants::MILLIONTH;
use super::judge::{Conditions, Entry, JudgedRows, Precision, RowJudge};
use super::significance::spread;
use super::weights::per_load;
use crate::parts::Parts;
use crate::problem::{column_factors, column_of, diagonal, median};
use crate::vector::WEAK;
use crate::{Contact2d, ContactState};

impl Contact2d {
    /// Residuals of a state, dimensionless, from the data as given; [`Residuals::worst`] decides.
    ///
    /// * rows are equilibrium, `K u - f - C_n^T t_n - C_t^T t_t`, gaps, `C_n u + x_0 + a_n t_n - g`, and slips,
    ///   `C_t u + s_0 + a_t t_t - s`, each measured by its own terms;
    /// * pairs are normal force and gap, and the two distances `mu t_n + t_t` and `mu t_n - t_t` to the borders of
    ///   the friction cone with the slip forwards and backwards: a force counts by its share in the terms of its
    ///   rows of equilibrium and, with compliance, of gap or slip, a gap or slip by its share in its own terms;
    /// * loads compare equilibrium with the largest load on the connected part of the structure, gaps and slips with
    ///   its largest initial one or with its deformation by the loads. Forces are not compared with
    ///   displacements, nor one part with another.
    ///
    /// Units do not matter, not even those of single displacements: a moment is not compared with a force. See
    /// [`HorizontalLcp::residuals`](crate::HorizontalLcp::residuals).
    ///
    /// # Panics
    /// If the lengths are not those of the problem.
    pub fn residuals(&self, state: &ContactState) -> Residuals {
        let (n, m) = (self.displacements(), self.points());
        let lengths = state.parts().map(<[f64]>::len);
        assert_eq!(lengths, [n, m, m, m, m], "a state has the problem's lengths");
        ContactJudge::new(self).residuals(&state.parts(), Precision::Rounded)
    }
}

impl ContactState {
    /// Displacements, normal and tangential forces, gaps and slips: the variables of the judge.
    pub(crate) fn parts(&self) -> [&[f64]; 5] {
        [&self.u, &self.t_n, &self.t_t, &self.gap, &self.slip]
    }
}

/// A contact problem with the rows equilibrium, gaps and slips.
pub(crate) struct ContactRows<'a> {
    problem: &'a Contact2d,
    /// The rows on which the forces of every point act: those of displacements, and of its gap or slip if it is
    /// compliant.
    normal: Columns,
    tangent: Columns,
    longest: usize,
}

/// A judge of states: displacements, forces, gaps and slips; the last two may be missing.
pub(crate) type ContactJudge<'a> = RowJudge<ContactRows<'a>>;

impl<'a> ContactJudge<'a> {
    pub(crate) fn new(problem: &'a Contact2d) -> Self {
        let (n, m) = (problem.displacements(), problem.points());
        let matrices = [problem.stiffness(), problem.normal(), problem.tangent()];
        let terms = |j: usize| matrices.iter().map(|it| column_of(it, j).count()).sum::<usize>();
        let longest = (0..n).map(terms).max().unwrap_or(0) + 2;
        let acting = |side: usize| {
            let own = problem.compliance().iter().map(move |a| a[side]).enumerate();
            let own = own.filter(|(_, a)| *a > 0.0).map(move |(i, a)| (i, n + side * m + i, a));
            let c = matrices[1 + side];
            let bodies = (0..n).flat_map(move |j| column_of(c, j).map(move |(i, v)| (i, j, -v)));
            Columns::by_rows(m, bodies.chain(own))
        };
        let (normal, tangent) = (acting(0), acting(1));
        let openings = problem.initial_gaps().iter().chain(problem.initial_slips());
        let c: Vec<f64> = problem.loads().iter().copied().chain(openings.map(|x| -x)).collect();
        let sizes: Vec<f64> = c.iter().map(|c| c.abs()).collect();
        let weights = weights(problem);
        // Loads down to a millionth of those around them count in full, smaller ones by their size: the terms of a body
        // that comes to rest are only rounding errors. Gaps and slips are differences of positions and have their
        // rounding errors: they count by their share in the lengths around them.
        let least = |i: usize| if i < n { MILLIONTH } else { 1.0 };
        let share = |(i, size): (usize, &f64)| (size / least(i) * weights[i]).min(1.0);
        let sources = sizes.iter().enumerate().map(share).collect();
        let rows = ContactRows { problem, normal, tangent, longest };
        Self { rows, c, sizes, sources, weights }
    }
}

impl JudgedRows for ContactRows<'_> {
    fn variables(&self) -> usize {
        self.problem.displacements() + 4 * self.problem.points()
    }

    fn longest(&self) -> usize {
        self.longest
    }

    fn for_each_entry(&self, variable: usize, mut visit: impl FnMut(usize, f64)) {
        let (problem, n, m) = (self.problem, self.problem.displacements(), self.problem.points());
        if variable < n {
            column_of(problem.stiffness(), variable).for_each(|(i, v)| visit(i, v));
            column_of(problem.normal(), variable).for_each(|(i, v)| visit(n + i, v));
            column_of(problem.tangent(), variable).for_each(|(i, v)| visit(n + m + i, v));
        } else if variable < n + m {
            self.normal.entries(variable - n).for_each(|(i, v)| visit(i, v));
        } else if variable < n + 2 * m {
            self.tangent.entries(variable - n - m).for_each(|(i, v)| visit(i, v));
        } else {
            visit(variable - 2 * m, -1.0);
        }
    }

    fn conditions(&self, x: &[f64], _: f64, out: &mut Conditions<'_, Self>) {
        let (n, m) = (self.problem.displacements(), self.problem.points());
        for (i, &mu) in self.problem.mu().iter().enumerate() {
            let entry = |part: usize| Entry::new(n + part * m + i, x[n + part * m + i]);
            let [t_n, t_t, gap, slip] = [0, 1, 2, 3].map(entry);
            out.pair(t_n, gap);
            if mu == 0.0 {
                out.zero(t_t);
            } else {
                out.friction(mu * x[n + i], t_t, slip);
            }
        }
    }
}

/// Sizes of the loads of a connected part, with displacements by their [factors](column_factors).
#[derive(Default, Clone)]
struct Loads {
    force: f64,
    /// The largest initial gap or slip.
    opening: f64,
    stiffness: Vec<f64>,
}

impl Loads {
    /// The force and the length that the part feels.
    fn felt(&mut self) -> (f64, f64) {
        let stiffness = median(&mut self.stiffness).unwrap_or(0.0);
        let deformation = if stiffness > 0.0 { self.force / stiffness } else { 0.0 };
        (self.force.max(stiffness * self.opening), self.opening.max(deformation))
    }
}

/// One over the loads that every row feels: forces of displacements, and lengths of points.
fn weights(problem: &Contact2d) -> Vec<f64> {
    let (n, m) = (problem.displacements(), problem.points());
    let factors = column_factors(problem);
    let diagonal = diagonal(problem.stiffness());
    let couplings = couplings(problem, &factors, &diagonal);
    let mut parts = Parts::new(n + m);
    for &(a, b, _) in couplings.iter().filter(|(_, _, coupling)| *coupling >= WEAK) {
        parts.join(a, b);
    }
    let mut loads = vec![Loads::default(); n + m];
    for j in 0..n {
        let part = &mut loads[parts.of(j)];
        part.force = part.force.max((problem.loads()[j] * factors[j]).abs());
        part.stiffness.extend(Some(diagonal[j] * factors[j] * factors[j]).filter(|k| *k > 0.0));
    }
    for i in 0..m {
        let part = &mut loads[parts.of(n + i)];
        let slip = if problem.mu()[i] > 0.0 { problem.initial_slips()[i].abs() } else { 0.0 };
        part.opening = part.opening.max(problem.initial_gaps()[i].abs()).max(slip);
        part.stiffness.extend(problem.springs_of(i));
    }
    let (mut forces, mut lengths): (Vec<f64>, Vec<f64>) = loads.iter_mut().map(Loads::felt).unzip();
    let part: Vec<usize> = (0..n + m).map(|i| parts.of(i)).collect();
    let weak = couplings.iter().filter(|(_, _, coupling)| *coupling < WEAK);
    let weak = weak.map(|&(a, b, coupling)| (part[a], part[b], coupling));
    let links = Columns::by_rows(
        n + m,
        weak.flat_map(|(a, b, coupling)| [(a, b, coupling), (b, a, coupling)]),
    );
    for felt in [&mut forces, &mut lengths] {
        spread(&links, felt);
        let largest = felt.iter().fold(0.0_f64, |max, v| max.max(*v));
        *felt = part.iter().map(|&part| per_load(1.0, felt[part], largest)).collect();
    }
    let forces = factors.iter().zip(&forces).map(|(factor, weight)| factor * weight);
    let slips = lengths[n..].iter().zip(problem.mu());
    let slips = slips.map(|(weight, mu)| if *mu > 0.0 { *weight } else { 0.0 });
    forces.chain(lengths[n..].iter().copied()).chain(slips).collect()
}

/// Displacements and, numbered behind them, points, with the strength of their coupling, at most one.
fn couplings(problem: &Contact2d, factors: &[f64], diagonal: &[f64]) -> Vec<(usize, usize, f64)> {
    let (n, m) = (problem.displacements(), problem.points());
    let of_points = |j: usize| {
        let tangent = column_of(problem.tangent(), j).filter(|(i, _)| problem.mu()[*i] > 0.0);
        let all = column_of(problem.normal(), j).chain(tangent).filter(|(_, v)| *v != 0.0);
        all.map(move |(i, v)| (i, v.abs() * factors[j]))
    };
    let mut largest = vec![0.0_f64; m];
    for j in 0..n {
        of_points(j).for_each(|(i, v)| largest[i] = largest[i].max(v));
    }
    let mut couplings = Vec::new();
    for j in 0..n {
        for (i, v) in column_of(problem.stiffness(), j).filter(|(i, _)| *i > j) {
            let size = (diagonal[i] * diagonal[j]).sqrt();
            couplings.push((i, j, if size > 0.0 { (v.abs() / size).min(1.0) } else { 1.0 }));
        }
        couplings.extend(of_points(j).map(|(i, v)| (n + i, j, v / largest[i])));
    }
    couplings
}
