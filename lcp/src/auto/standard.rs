//! The chain of standard problems, and of general ones that can be converted to the standard form.

use super::constants::{FEW, FEW_DENSE};
use super::facts::{Facts, Symmetry, is_z_matrix};
use super::method::{Effort, Planned, Step};
use crate::{HorizontalLcp, Lcp, Method, Solver};

/// The class of the matrix decides whether the active set method is the first.
pub(super) fn standard_steps(facts: &Facts) -> Vec<Step> {
    let text = facts.describe();
    let newton = |words| Step::new(Method::Newton, format!("{text}, {words}"));
    let is_symmetric = facts.symmetry != Symmetry::None;
    let program = is_symmetric.then(|| {
        format!("{text}: a quadratic program, convex if the matrix is positive semidefinite")
    });
    let mut steps = common_steps(facts, program, facts.has_positive_diagonal);
    if !facts.has_positive_diagonal {
        return steps;
    }
    if facts.is_z_matrix && facts.symmetry == Symmetry::Dominant {
        let words = "with no positive entry off the diagonal (an M-matrix): the active set method \
                     takes few factorisations";
        steps.insert(0, newton(words));
    } else if facts.is_z_matrix {
        let words = "with no positive entry off the positive diagonal: the active set method solves \
                     whatever is feasible";
        steps.insert(0, newton(words));
    } else {
        let words = "with a positive diagonal: the active set method takes few factorisations, or \
                     soon gives up";
        steps.insert(0, newton(words));
    }
    steps
}

/// The methods that need no class of matrices, with the quadratic program where there is a reason for it.
pub(super) fn common_steps(
    facts: &Facts,
    program: Option<String>,
    can_be_swept: bool,
) -> Vec<Step> {
    let text = facts.size();
    let step = |method, words: &str| Step::new(method, format!("{text}: {words}"));
    let is_small = !facts.is_sparse || facts.order <= FEW;
    let (first, last) = if is_small {
        let words = "pivots need no class of matrices and end with a basis, a proof or a ray";
        (Some(step(Method::Lemke, words)), None)
    } else {
        let words = "pivots take long at this order, but need no class of matrices";
        (None, Some(step(Method::Lemke, words)))
    };
    let inside = step(
        Method::Interior,
        "the interior-point method takes tens of factorisations at any order",
    );
    let sweeps = step(Method::GaussSeidel, "sweeps are cheap, and promise little");
    let inside = (facts.is_sparse || facts.order <= FEW_DENSE).then_some(inside);
    let mut steps: Vec<Step> = first.into_iter().chain(inside).collect();
    steps.extend(program_step(program));
    steps.extend(can_be_swept.then_some(sweeps));
    steps.extend(last);
    steps
}

#[cfg(feature = "clarabel")]
pub(super) fn program_step(reason: Option<String>) -> Option<Step> {
    reason.map(|reason| Step::new(Method::QuadraticProgram, reason))
}

/// Quadratic programs are not compiled in.
#[cfg(not(feature = "clarabel"))]
pub(super) fn program_step(_: Option<String>) -> Option<Step> {
    None
}

impl Planned for Lcp {
    fn pairs(&self) -> usize {
        self.order()
    }

    fn is_sparse(&self) -> bool {
        self.m().is_sparse()
    }

    fn steps(&self) -> Vec<Step> {
        standard_steps(&Facts::of(self.m()))
    }

    fn solver(&self, method: Method, effort: &Effort<'_>) -> Option<Box<dyn Solver<Self>>> {
        match method {
            Method::Newton => Some(Box::new(effort.newton(is_z_matrix(self.m())))),
            #[cfg(feature = "clarabel")]
            Method::QuadraticProgram => Some(Box::new(effort.quadratic_program())),
            Method::GaussSeidel => Some(Box::new(effort.sweeps())),
            _ => effort.common(method),
        }
    }
}

impl Planned for HorizontalLcp {
    fn pairs(&self) -> usize {
        self.order()
    }

    fn is_sparse(&self) -> bool {
        self.is_sparse()
    }

    fn steps(&self) -> Vec<Step> {
        if let Some(standard) = self.to_standard() {
            let mut steps = standard_steps(&Facts::of(standard.lcp().m()));
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
        vec![Step::new(Method::Lemke, reason)]
    }

    fn solver(&self, method: Method, effort: &Effort<'_>) -> Option<Box<dyn Solver<Self>>> {
        match method {
            Method::Newton => {
                let is_sure = self.to_standard().is_some_and(|it| is_z_matrix(it.lcp().m()));
                Some(Box::new(effort.newton(is_sure)))
            }
            #[cfg(feature = "clarabel")]
            Method::QuadraticProgram => Some(Box::new(effort.quadratic_program())),
            Method::GaussSeidel => Some(Box::new(effort.sweeps())),
            _ => effort.common(method),
        }
    }
}
