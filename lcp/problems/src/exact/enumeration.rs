//! All solutions of a small problem.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use dashu_int::IBig;

use super::cone::is_over;
use super::cone::{Budget, Stop, extreme_rays, product};
use super::integers::{Integers, number};
use super::tableau::{Tableau, eliminate};
use super::{ExactPoint, Feasibility, feasibility};
use lcp::{Error, HorizontalLcp, Side};

/// Limits of [`enumerate`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct EnumerationSettings {
    /// Largest order that is tried: there are `2^n` complementary bases. At most 32.
    pub max_order: usize,
    /// Largest number of vertices and rays, over all faces.
    pub max_generators: usize,
    /// Wall-clock time; `None` sets no limit. The result has the solutions found until then.
    pub time_limit: Option<Duration>,
}

impl EnumerationSettings {
    /// The largest order that [`max_order`](Self::max_order) may be.
    pub const LARGEST_ORDER: usize = 32;
}

impl Default for EnumerationSettings {
    fn default() -> Self {
        Self { max_order: 16, max_generators: 10_000, time_limit: None }
    }
}

/// All solutions of a problem.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExactEnumeration {
    /// The solutions as a union of polyhedra, none of which lies in another; they may touch. Ordered
    /// by the variables that are positive in them.
    pub faces: Vec<Face>,
    /// Whether these are all solutions, because the time sufficed.
    pub is_complete: bool,
    /// Whether some complementary basis is nonsingular, as far as the time sufficed to find one.
    pub has_basis: bool,
    /// Whether the conditions can be met without complementarity.
    pub feasibility: Feasibility,
}

impl ExactEnumeration {
    /// Whether there is a solution.
    pub fn is_solvable(&self) -> bool {
        !self.faces.is_empty()
    }

    /// Whether the linear conditions can be met.
    pub fn is_feasible(&self) -> bool {
        matches!(self.feasibility, Feasibility::Feasible(_))
    }

    /// The only solution, if there is exactly one.
    pub fn unique(&self) -> Option<&ExactPoint> {
        match self.faces.as_slice() {
            [Face { vertices, dimension: 0, .. }] => vertices.first(),
            _ => None,
        }
    }
}

/// A polyhedron of solutions: every convex combination of its vertices plus any nonnegative
/// combination of its rays solves the problem.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Face {
    /// Its vertices, at least one, in ascending order.
    pub vertices: Vec<ExactPoint>,
    /// Its extreme rays, each with 1 as its largest entry, in ascending order.
    pub rays: Vec<ExactPoint>,
    /// Its dimension: 0 for an isolated solution, 1 for a segment or a half-line.
    pub dimension: usize,
}

/// Finds all solutions of a small problem.
///
/// Each of the `2^n` complementary bases has a polyhedron of solutions: a point or nothing if it is nonsingular, else
/// perhaps a segment or more. A tree over the pairs shares the elimination between bases and skips a branch as soon
/// as the sign pattern of a row forbids it. Polyhedra that lie in others are omitted.
///
/// The cost grows with `2^n n`: milliseconds for 10 pairs of small integers, tenths of a second for 16, and more if
/// many bases are singular.
///
/// ```
/// use faer::Mat;
/// use lcp_problems::exact::{EnumerationSettings, enumerate};
/// use lcp::{HorizontalLcp, Lcp};
///
/// // w = (z1 + z2 - 1) (1, 1): every z with z1 + z2 = 1, from (0, 1) to (1, 0).
/// let problem = HorizontalLcp::from(Lcp::new(Mat::full(2, 2, 1.0), vec![-1.0, -1.0])?);
/// let all = enumerate(&problem, &EnumerationSettings::default())?;
/// let [segment] = all.faces.as_slice() else { panic!("one face") };
/// assert_eq!(segment.dimension, 1);
/// let ends: Vec<Vec<f64>> = segment.vertices.iter().map(|v| v.rounded().0).collect();
/// assert_eq!(ends, [[0.0, 1.0], [1.0, 0.0]]);
/// # Ok::<(), lcp::Error>(())
/// ```
///
/// # Errors
/// [`Error::Limit`] when the problem or its set of solutions is larger than the settings allow,
/// [`Error::Setting`] for a limit on the order above [`EnumerationSettings::LARGEST_ORDER`].
pub fn enumerate(
    problem: &HorizontalLcp,
    settings: &EnumerationSettings,
) -> Result<ExactEnumeration, Error> {
    let (n, max_order) = (problem.order(), settings.max_order);
    if max_order > EnumerationSettings::LARGEST_ORDER {
        let range = "at most 32";
        return Err(Error::Setting { name: "max_order", value: max_order as f64, range });
    }
    if n > max_order {
        let what = "order of the problem to enumerate";
        return Err(Error::Limit { what, value: n, name: "max_order", limit: max_order });
    }
    let deadline = settings.time_limit.and_then(|limit| Instant::now().checked_add(limit));
    let budget = Budget { deadline, generators: settings.max_generators };
    let root = Node::root(problem);
    let mut faces = Faces { budget, found: BTreeMap::new() };
    let is_complete = match faces.collect(&root) {
        Ok(()) => true,
        Err(Stop::Time) => false,
        Err(Stop::Limit(error)) => return Err(error),
    };
    Ok(ExactEnumeration {
        faces: faces.found.into_values().collect(),
        is_complete,
        has_basis: root.has_basis(deadline),
        feasibility: feasibility(problem),
    })
}

/// A node of the tree: a side chosen for every pair before `pair`.
struct Node {
    /// Columns: the dependent variables, both variables of every pair from `pair` on, and `c`.
    tableau: Tableau,
    /// The variable of every row that has been solved for one.
    basic: Vec<Option<usize>>,
    /// Chosen variables whose columns depend on those of the basic ones.
    dependent: Vec<usize>,
    pair: usize,
}

impl Node {
    fn root(problem: &HorizontalLcp) -> Self {
        let tableau = Tableau::new(Integers::new(problem).rows);
        let basic = vec![None; problem.order()];
        Self { tableau, basic, dependent: Vec::new(), pair: 0 }
    }

    fn is_leaf(&self) -> bool {
        self.pair == self.basic.len()
    }

    /// The node with a side chosen for the next pair.
    fn child(&self, side: Side) -> Self {
        let variable = number(self.pair, side);
        let column = self.dependent.len();
        let mut tableau = self.tableau.without_column(side.of(column + 1, column));
        let mut basic = self.basic.clone();
        let mut dependent = self.dependent.clone();
        match self.free_row(side.of(column, column + 1)) {
            Some(row) => {
                tableau.pivot(row, column);
                tableau.drop_column(column);
                basic[row] = Some(variable);
            }
            None => dependent.push(variable),
        }
        Self { tableau, basic, dependent, pair: self.pair + 1 }
    }

    /// A row without a basic variable in which the column is not zero.
    fn free_row(&self, column: usize) -> Option<usize> {
        let rows = self.basic.iter().zip(&self.tableau.rows);
        rows.into_iter().position(|(basic, row)| basic.is_none() && !row[column].is_zero())
    }

    /// Whether the signs of a row rule out nonnegative values whatever the other pairs choose.
    fn is_hopeless(&self) -> bool {
        self.basic.iter().zip(&self.tableau.rows).any(|(basic, row)| {
            let Some((c, entries)) = row.split_last() else { return false };
            (*c < IBig::ZERO && entries.iter().all(|v| *v >= IBig::ZERO))
                || (basic.is_none() && *c > IBig::ZERO && entries.iter().all(|v| *v <= IBig::ZERO))
        })
    }

    /// Whether the other pairs can choose so that all columns are independent.
    fn has_basis(&self, deadline: Option<Instant>) -> bool {
        let has_support = |(basic, row): (&Option<usize>, &Vec<IBig>)| {
            basic.is_some() || row[..row.len() - 1].iter().any(|v| !v.is_zero())
        };
        if is_over(deadline) {
            return false;
        }
        if self.is_leaf() || !self.basic.iter().zip(&self.tableau.rows).all(has_support) {
            return self.is_leaf();
        }
        [Side::T, Side::Y].into_iter().any(|side| {
            self.free_row(side.of(0, 1)).is_some() && self.child(side).has_basis(deadline)
        })
    }
}

/// The faces found so far that lie in no other, each under the set of variables that are positive in it, as bits: a
/// face lies in another exactly if its set does.
struct Faces {
    budget: Budget,
    found: BTreeMap<u64, Face>,
}

impl Faces {
    fn collect(&mut self, node: &Node) -> Result<(), Stop> {
        self.budget.check(0)?;
        if node.is_hopeless() {
            return Ok(());
        }
        if node.is_leaf() {
            return self.add(node);
        }
        self.collect(&node.child(Side::T))?;
        self.collect(&node.child(Side::Y))
    }

    /// The face of a complementary choice: nonnegative dependent variables for which the basic ones are nonnegative.
    /// The face is a cone if a factor for `c` is added as a variable.
    fn add(&mut self, leaf: &Node) -> Result<(), Stop> {
        let rows = leaf.basic.iter().zip(&leaf.tableau.rows);
        let solved = rows.filter_map(|(basic, row)| basic.map(|variable| (variable, row)));
        let (basic, inequalities): (Vec<usize>, Vec<Vec<IBig>>) =
            solved.map(|(variable, row)| (variable, nonnegativity(row))).unzip();
        let generators = extreme_rays(leaf.dependent.len() + 1, &inequalities, &self.budget)?;
        let determinant = &leaf.tableau.determinant;
        let (mut vertices, mut rays, mut support) = (Vec::new(), Vec::new(), 0);
        for generator in &generators {
            let Some((factor, dependent)) = generator.split_last() else { continue };
            let of_basic = inequalities.iter().map(|row| product(row, generator));
            let values = dependent.iter().map(|v| v * determinant).chain(of_basic);
            let values: Vec<(usize, IBig)> = leaf
                .dependent
                .iter()
                .chain(&basic)
                .copied()
                .zip(values)
                .filter(|(_, value)| !value.is_zero())
                .collect();
            support |= values.iter().fold(0, |bits, (variable, _)| bits | 1 << variable);
            // The largest entry of a ray is one.
            let (points, unit) = if factor.is_zero() {
                (&mut rays, values.iter().map(|(_, v)| v).max().cloned().unwrap_or(IBig::ONE))
            } else {
                (&mut vertices, factor * determinant)
            };
            points.push(ExactPoint::new(leaf.basic.len(), values, &unit));
        }
        let lies_in = |inner: u64, outer: u64| inner & outer == inner;
        if vertices.is_empty() || self.found.keys().any(|&other| lies_in(support, other)) {
            return Ok(());
        }
        vertices.sort();
        rays.sort();
        let dimension = rank(generators) - 1;
        self.found.retain(|&other, _| !lies_in(other, support));
        self.found.insert(support, Face { vertices, rays, dimension });
        let value = self.found.values().map(|face| face.vertices.len() + face.rays.len()).sum();
        self.budget.check(value)
    }
}

/// `determinant times basic variable = c - row . dependent` as a row for `(dependent, factor of c)`.
fn nonnegativity(row: &[IBig]) -> Vec<IBig> {
    let Some((c, entries)) = row.split_last() else { return Vec::new() };
    entries.iter().map(|v| -v).chain([c.clone()]).collect()
}

fn rank(rows: Vec<Vec<IBig>>) -> usize {
    let columns = rows.first().map_or(0, Vec::len);
    eliminate(&mut Tableau::new(rows), columns).into_iter().flatten().count()
}
