//! The chain of standard problems, and of general ones that can be converted to the standard form.

use super::constants::FEW;
use super::facts::largest_block;
use super::method::{Budget, Link, Planned};
use crate::newton::is_z_matrix;
use crate::{HorizontalLcp, Lcp, Matrix, Method, Solver};

/// The chain, which the active set method begins if the class of the matrix allows it.
fn standard_chain(m: &Matrix) -> Vec<Link> {
    let mut steps = common_chain(m);
    if (0..m.ncols()).all(|i| m[(i, i)] > 0.0) {
        let words = if is_z_matrix(m) {
            "no entry off the positive diagonal is positive, as in M-matrices, so that the active set method \
             solves whatever is feasible"
        } else {
            "the diagonal is positive, so that the active set method takes few factorisations, or soon gives up"
        };
        steps.insert(0, Link::new(Method::Newton, words));
    }
    steps
}

/// The methods that need no class of matrices.
pub(super) fn common_chain(m: &Matrix) -> Vec<Link> {
    let order = m.ncols();
    let inside = Link::new(
        Method::Interior,
        "the interior-point method takes tens of factorisations at any order",
    );
    if m.is_sparse() && order > FEW {
        let words = "pivots take long at this order, but need no class of matrices";
        return vec![inside, Link::new(Method::Lemke, words)];
    }
    let words = "pivots need no class of matrices and end with a basis, a proof or a ray";
    let inside = Some(inside).filter(|_| order <= FEW);
    std::iter::once(Link::new(Method::Lemke, words)).chain(inside).collect()
}

/// The order and the storage of the matrix, for the reason of a choice.
pub(super) fn size(m: &Matrix) -> String {
    let order = m.ncols();
    if !m.is_sparse() {
        return format!("order {order}, dense");
    }
    let nonzeros = |j| m.column(j).filter(|(_, v)| *v != 0.0).count();
    format!("order {order}, sparse with {} nonzeros", (0..order).map(nonzeros).sum::<usize>())
}

impl Planned for Lcp {
    fn pairs(&self) -> usize {
        self.order()
    }

    fn choices(&self) -> usize {
        largest_block(self.m(), |_| 1)
    }

    fn subject(&self) -> String {
        size(self.m())
    }

    fn chain(&self) -> Vec<Link> {
        standard_chain(self.m())
    }

    fn solver(&self, method: Method, effort: &Budget<'_>) -> Box<dyn Solver<Self>> {
        match method {
            Method::Newton => Box::new(effort.newton(is_z_matrix(self.m()))),
            _ => effort.common(method),
        }
    }
}

impl Planned for HorizontalLcp {
    fn pairs(&self) -> usize {
        self.order()
    }

    fn choices(&self) -> usize {
        match self.to_standard() {
            Some(standard) => standard.lcp().choices(),
            None => (0..self.order()).filter(|&pair| self.opposite(pair).is_none()).count(),
        }
    }

    fn subject(&self) -> String {
        let storage = if self.is_sparse() { "sparse" } else { "dense" };
        match self.to_standard() {
            Some(standard) => format!("as a standard problem of {}", size(standard.lcp().m())),
            None => format!("order {}, {storage}, not in standard form", self.order()),
        }
    }

    fn chain(&self) -> Vec<Link> {
        match self.to_standard() {
            Some(standard) => standard_chain(standard.lcp().m()),
            None => vec![Link::new(Method::Lemke, "Lemke's method treats the general form")],
        }
    }

    fn solver(&self, method: Method, effort: &Budget<'_>) -> Box<dyn Solver<Self>> {
        match method {
            Method::Newton => {
                let is_sure = self.to_standard().is_some_and(|it| is_z_matrix(it.lcp().m()));
                Box::new(effort.newton(is_sure))
            }
            _ => effort.common(method),
        }
    }
}
