//! The chain of standard problems, and of general ones that can be converted to the standard form.

use super::constants::{FEW, FEW_DENSE};
use super::facts::{Facts, is_z_matrix, largest_block};
use super::method::{Choice, Effort, Planned};
use crate::{HorizontalLcp, Lcp, Method, Solver};

/// The class of the matrix decides whether the active set method is the first.
pub(super) fn standard_chain(facts: &Facts) -> Vec<Choice> {
    let mut steps = common_chain(facts);
    if facts.has_positive_diagonal {
        let words = if facts.is_z_matrix {
            "with no positive entry off the positive diagonal, as M-matrices: the active set method solves \
             whatever is feasible"
        } else {
            "with a positive diagonal: the active set method takes few factorisations, or soon gives up"
        };
        steps.insert(0, Choice::new(Method::Newton, format!("{}, {words}", facts.size())));
    }
    steps
}

/// The methods that need no class of matrices.
pub(super) fn common_chain(facts: &Facts) -> Vec<Choice> {
    let step = |method, words: &str| Choice::new(method, format!("{}: {words}", facts.size()));
    let inside = step(
        Method::Interior,
        "the interior-point method takes tens of factorisations at any order",
    );
    if facts.is_sparse && facts.order > FEW {
        let words = "pivots take long at this order, but need no class of matrices";
        return vec![inside, step(Method::Lemke, words)];
    }
    let words = "pivots need no class of matrices and end with a basis, a proof or a ray";
    let inside = Some(inside).filter(|_| facts.is_sparse || facts.order <= FEW_DENSE);
    std::iter::once(step(Method::Lemke, words)).chain(inside).collect()
}

impl Planned for Lcp {
    fn pairs(&self) -> usize {
        self.order()
    }

    fn choices(&self) -> usize {
        largest_block(self.m(), |_| 1)
    }

    fn chain(&self) -> Vec<Choice> {
        standard_chain(&Facts::of(self.m()))
    }

    fn solver(&self, method: Method, effort: &Effort<'_>) -> Box<dyn Solver<Self>> {
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

    fn chain(&self) -> Vec<Choice> {
        if let Some(standard) = self.to_standard() {
            let mut steps = standard_chain(&Facts::of(standard.lcp().m()));
            for step in &mut steps {
                step.reason.insert_str(0, "as a standard problem of ");
            }
            return steps;
        }
        let storage = if self.is_sparse() { "sparse" } else { "dense" };
        let reason = format!(
            "order {}, {storage}, and no standard problem: Lemke's method treats the general form",
            self.order()
        );
        vec![Choice::new(Method::Lemke, reason)]
    }

    fn solver(&self, method: Method, effort: &Effort<'_>) -> Box<dyn Solver<Self>> {
        match method {
            Method::Newton => {
                let is_sure = self.to_standard().is_some_and(|it| is_z_matrix(it.lcp().m()));
                Box::new(effort.newton(is_sure))
            }
            _ => effort.common(method),
        }
    }
}
