//! Forms of the contact problem as a linear complementarity problem `A t + B y = c`.
//!
//! Every form has pairs `(t_i, y_i)` of nonnegative, complementary variables: forces on the `t` side and
//! displacements on the `y` side, unless a form says otherwise. All are dimensionless: forces are divided by
//! [`FormScale::force`] and displacements by [`FormScale::length`], so that the coefficients of `A` are of order
//! one whatever the units and moduli. [`DenseForm::rows`] converts back to forces and relative displacements in SI
//! units.
//!
//! The pairs of a problem of `m` points, of which `m_f` have friction, come in groups: first the pairs `(t_n, y_n)` of
//! all points, then, group by group, the pairs of the points with friction.

use faer::Mat;
use lcp::HorizontalLcp;

use crate::data::state::RowState;
use crate::forms::reduction::Reduction;
use crate::law::{Cone, Friction};
use crate::rounding::{cleared, largest};
use crate::system::System;

mod mixed;
mod reduced;

/// The form of the linear complementarity problem, which is a choice of its variables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FormKind {
    /// The paper's form (3.27), of order `m + 2 m_f`, with the pairs `(t_n, y_n)`, `(p+, y+)`, `(p-, y-)`, where
    /// `p+ = mu t_n + t_t`, `p- = mu t_n - t_t` and `y_t = y+ - y-`. The form is not copositive: a solver may end on a
    /// ray although there is a solution.
    Coulomb,
    /// The form of Stewart and Trinkle, of order `m + 3 m_f`, with friction forces split in two: pairs `(t_n, y_n)`,
    /// `(b+, s+)`, `(b-, s-)`, `(lambda, w)` with `t_t = b+ - b-`, `s+ = lambda + y_t`, `s- = lambda - y_t` and
    /// `w = mu t_n - b+ - b-` (a force, while `lambda` is a displacement).
    StewartTrinkle,
    /// The mixed form, of order `m + 3 m_f + 6 r + 2 s` for `r` blocks and `s` bars of mortar strips. It has the
    /// variables of [`StewartTrinkle`](Self::StewartTrinkle), the rigid amplitudes `alpha = alpha+ - alpha-` as
    /// unknowns with equilibrium as complementary rows, and the forces of the bars. It is a standard problem, `B = 1`,
    /// with a copositive `-A`. A ray of this form is a motion of the blocks that no contact stops and on which the
    /// loads do work.
    Mixed,
}

/// The units of the dimensionless variables of a form.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FormScale {
    /// The unit of force \[N\].
    pub force: f64,
    /// The unit of displacement \[m\].
    pub length: f64,
}

/// A complementary basis from which Lemke's method may start.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Start {
    /// The name of the basis in reports.
    pub name: &'static str,
    /// Whether the `t` variable of every pair is basic; otherwise the `y` variable of the pair is basic.
    pub t_basic: Vec<bool>,
}

impl Start {
    /// The name for a basis at which the pivots of a similar problem ended.
    pub const LAST: &'static str = "last basis";

    /// Returns a start basis from the basis at which the pivots of a similar problem ended.
    pub fn last(t_basic: Vec<bool>) -> Self {
        Self { name: Self::LAST, t_basic }
    }
}

/// A contact problem `A t + B y = c`, `t >= 0`, `y >= 0`, `t.y = 0` in dimensionless variables.
#[derive(Debug, Clone)]
pub struct DenseForm {
    /// The form of the problem, which is the choice of its variables.
    pub kind: FormKind,
    /// The matrices `A` and `B` and the vector `c`.
    pub problem: HorizontalLcp,
    /// The units of force and of displacement of the variables.
    pub scale: FormScale,
    /// Start bases for Lemke's method, the most promising first; empty if the basis of all `y` is the natural start.
    /// Each of these bases may be singular for a certain `mu`.
    pub starts: Vec<Start>,
    layout: Layout,
}

/// The equations of a form while they are assembled.
struct Equations {
    a: Mat<f64>,
    b: Mat<f64>,
    c: Vec<f64>,
    scale: FormScale,
    layout: Layout,
}

impl Equations {
    /// Completes the form. Coefficients and right-hand sides that are only rounding errors become zero, because a
    /// solver would treat them as couplings and loads.
    fn into_form(self, kind: FormKind, starts: Vec<Start>) -> Result<DenseForm, lcp::Error> {
        let Self { mut a, mut b, mut c, scale, layout } = self;
        let rows: Vec<f64> =
            (0..c.len()).map(|i| largest(a.row(i).iter().chain(b.row(i).iter()))).collect();
        for matrix in [&mut a, &mut b] {
            for column in matrix.as_mut().col_iter_mut() {
                let of_column = largest(column.as_ref().iter());
                let entries = column.iter_mut().zip(&rows);
                entries.for_each(|(v, of_row)| *v = cleared(*v, of_column.min(*of_row)));
            }
        }
        let load = largest(&c);
        for v in &mut c {
            *v = cleared(*v, load);
        }
        Ok(DenseForm { kind, problem: HorizontalLcp::new(a, b, c)?, scale, starts, layout })
    }
}

impl DenseForm {
    /// Sets up the problem in the variables of the form `kind`.
    ///
    /// # Errors
    /// [`lcp::Error::NotFinite`] when the data of the scene overflow.
    pub fn new(kind: FormKind, system: &System, reduction: &Reduction) -> Result<Self, lcp::Error> {
        match kind {
            FormKind::Coulomb | FormKind::StewartTrinkle => reduced::build(kind, system, reduction),
            FormKind::Mixed => mixed::build(system, reduction),
        }
    }

    /// Returns the number of complementary pairs.
    pub fn order(&self) -> usize {
        self.problem.order()
    }

    /// Returns the number of contact points: of the pairs `(t_n, y_n)`, which come first.
    pub fn points(&self) -> usize {
        self.layout.points
    }

    /// Returns the rigid amplitudes \[m\], three per block, which are among the variables `t` of the mixed form; `None`
    /// for the other forms, whose variables do not include amplitudes.
    pub fn amplitudes(&self, t: &[f64]) -> Option<Vec<f64>> {
        if self.kind != FormKind::Mixed {
            return None;
        }
        let end = t.len() - 2 * self.layout.bars;
        let alpha = &t[self.layout.points + 3 * self.layout.friction.len()..end];
        let (plus, minus) = alpha.split_at(alpha.len() / 2);
        Some(
            plus.iter()
                .zip(minus)
                .map(|(plus, minus)| (plus - minus) * self.scale.length)
                .collect(),
        )
    }

    /// Converts the dimensionless variables to forces and relative displacements of all rows in SI units.
    ///
    /// # Panics
    /// If `t` or `y` is shorter than [`DenseForm::order`].
    pub fn rows(&self, t: &[f64], y: &[f64]) -> RowState {
        let (t_weight, y_weight) = self.kind.tangential_weights();
        let FormScale { force, length } = self.scale;
        RowState {
            t: self.layout.row_values(t, t_weight * force, force),
            y: self.layout.row_values(y, y_weight * length, length),
        }
    }

    /// Converts forces and relative displacements of all rows to the dimensionless variables `(t, y)`. The matching
    /// rigid amplitudes \[m\] and forces of bars \[N\] are used by the mixed form only.
    ///
    /// # Panics
    /// If there are fewer values than rows.
    pub fn pairs(&self, rows: &RowState, amplitudes: &[f64], bars: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let Layout { points, friction, .. } = &self.layout;
        let (force, length) = (self.scale.force, self.scale.length);
        let t_n = rows.t[..*points].iter().map(|t| t / force);
        let y_n = rows.y[..*points].iter().map(|y| y / length);
        let (mut t, mut y): (Vec<f64>, Vec<f64>) = (t_n.collect(), y_n.collect());
        let tangential = |k: usize| (rows.t[points + k] / force, rows.y[points + k] / length);
        for (side, sign) in [1.0, -1.0].into_iter().enumerate() {
            for (k, friction) in friction.iter().enumerate() {
                let (t_t, y_t) = tangential(k);
                if self.kind == FormKind::Coulomb {
                    t.push(friction.cone.distances(t[friction.contact.index()], t_t)[side]);
                    y.push((sign * y_t).max(0.0));
                } else {
                    t.push((sign * t_t).max(0.0));
                    y.push(y_t.abs() + sign * y_t);
                }
            }
        }
        if self.kind != FormKind::Coulomb {
            for (k, friction) in friction.iter().enumerate() {
                let (t_t, y_t) = tangential(k);
                t.push(y_t.abs());
                let [_, nearer] = friction.cone.distances(t[friction.contact.index()], t_t.abs());
                y.push(nearer);
            }
        }
        if self.kind == FormKind::Mixed {
            for (free, unit) in [(amplitudes, length), (bars, force)] {
                for sign in [1.0, -1.0] {
                    t.extend(free.iter().map(|value| (sign * value / unit).max(0.0)));
                    y.extend(free.iter().map(|_| 0.0));
                }
            }
        }
        (t, y)
    }
}

impl FormKind {
    /// Returns the name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Coulomb => "coulomb",
            Self::StewartTrinkle => "stewart-trinkle",
            Self::Mixed => "mixed",
        }
    }

    /// Returns the number of unknowns of a point with friction, besides its normal force.
    pub(crate) fn unknowns_per_friction(self) -> usize {
        match self {
            Self::Coulomb => 2,
            Self::StewartTrinkle | Self::Mixed => 3,
        }
    }

    /// Returns the factors in `t_t = factor (t+ - t-)` and `y_t = factor (y+ - y-)`, where `t+` and `y+` are the
    /// variables of the second group of pairs, and `t-` and `y-` those of the third group.
    fn tangential_weights(self) -> (f64, f64) {
        match self {
            Self::Coulomb => (0.5, 1.0),
            Self::StewartTrinkle | Self::Mixed => (1.0, 0.5),
        }
    }
}

/// The positions of the variables of points and rows among the complementary pairs.
#[derive(Debug, Clone)]
struct Layout {
    /// Number of contact points.
    points: usize,
    /// The points that resist sliding; the constant parts of their bounds are in units of force of the form.
    friction: Vec<Friction>,
    /// Number of bars of mortar strips, which are unknowns of the mixed form.
    bars: usize,
}

impl Layout {
    fn of(system: &System, scale: FormScale) -> Self {
        let in_units = |it: &Friction| {
            let cone = Cone { base: it.cone.base / scale.force, ..it.cone };
            Friction { cone, ..*it }
        };
        let friction = system.friction.iter().map(in_units).collect();
        Self { points: system.points(), friction, bars: system.stretches.len() }
    }

    /// Returns the index of the pair of frictional point `k` in a group; group 1 follows the normal pairs.
    fn pair(&self, group: usize, k: usize) -> usize {
        self.points + (group - 1) * self.friction.len() + k
    }

    /// Returns the number of rows of the system.
    fn rows(&self) -> usize {
        self.points + self.friction.len()
    }

    /// Returns the value of a row as a linear combination of pair variables; `weight` is the factor in tangential rows.
    fn terms(&self, row: usize, weight: f64) -> Vec<(usize, f64)> {
        match row.checked_sub(self.points) {
            None => vec![(row, 1.0)],
            Some(k) => vec![(self.pair(1, k), weight), (self.pair(2, k), -weight)],
        }
    }

    fn row_values(&self, pairs: &[f64], tangential: f64, normal: f64) -> Vec<f64> {
        let normals = pairs[..self.points].iter().map(|value| normal * value);
        let tangents = (0..self.friction.len())
            .map(|k| tangential * (pairs[self.pair(1, k)] - pairs[self.pair(2, k)]));
        normals.chain(tangents).collect()
    }
}

impl FormScale {
    /// Returns the units in which the mean of the diagonal of `A` is one and the loads are at most one.
    fn of(reduction: &Reduction) -> Self {
        let or_one = |x: f64| if x > 0.0 { x } else { 1.0 };
        let n = reduction.a.nrows();
        let compliance = (0..n).map(|i| reduction.a[(i, i)]).sum::<f64>() / or_one(n as f64);
        let (force, length) = (largest(&reduction.t0), largest(&reduction.c));
        if compliance > 0.0 {
            let force = or_one(force.max(length / compliance));
            Self { force, length: force * compliance }
        } else {
            Self { force: or_one(force), length: or_one(length) }
        }
    }
}
