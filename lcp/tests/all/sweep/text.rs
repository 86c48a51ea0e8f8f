//! Problems as the text of a file that the library reads.

use lcp::faer::sparse::SparseColMat;
use lcp::{HorizontalLcp, Matrix};

use super::problems::{Case, Problem};

impl Case {
    pub(crate) fn text(&self) -> String {
        match &self.problem {
            Problem::General(it) => format!(
                r#"{{"kind": "horizontal", "a": {}, "b": {}, "c": {:?}}}"#,
                rows(it.a()),
                rows(it.b()),
                it.c()
            ),
            Problem::Standard(it) => {
                format!(r#"{{"kind": "lcp", "m": {}, "q": {:?}}}"#, rows(it.m()), it.q())
            }
            Problem::Mixed(it) => format!(
                r#"{{"kind": "mixed", "m": {}, "q": {:?}, "free": {:?}}}"#,
                rows(it.m()),
                it.q(),
                it.free()
            ),
            Problem::Boxed(it) => format!(
                r#"{{"kind": "boxed", "m": {}, "q": {:?}, "lower": {:?}, "upper": {:?}}}"#,
                rows(it.m()),
                it.q(),
                it.lower(),
                it.upper()
            ),
            Problem::Friction(it) => format!(
                r#"{{"kind": "friction", "w": {}, "q": {:?}, "mu": {:?}}}"#,
                rows(it.w()),
                it.q(),
                it.mu()
            ),
            Problem::Contact(it) => format!(
                "contact: K = {}, f = {:?}, C_n = {}, C_t = {}, x_0 = {:?}, s_0 = {:?}, mu = {:?}",
                sparse_rows(it.stiffness()),
                it.loads(),
                sparse_rows(it.normal()),
                sparse_rows(it.tangent()),
                it.initial_gaps(),
                it.initial_slips(),
                it.mu()
            ),
        }
    }

    /// Smaller for problems that are easier to follow: the order first, then the entries.
    pub(crate) fn size(&self) -> usize {
        let general: &HorizontalLcp = &self.general;
        let n = general.order();
        let entries =
            [general.a(), general.b()].into_iter().flat_map(|m| (0..n).map(move |j| (m, j)));
        let count: usize =
            entries.map(|(m, j)| m.column(j).filter(|(_, v)| *v != 0.0).count()).sum();
        1000 * n + 10 * count + general.c().iter().filter(|c| **c != 0.0).count()
    }
}

fn rows(m: &Matrix) -> String {
    let row = |i| (0..m.ncols()).map(|j| m[(i, j)]).collect::<Vec<f64>>();
    format!("{:?}", (0..m.nrows()).map(row).collect::<Vec<_>>())
}

fn sparse_rows(m: &SparseColMat<usize, f64>) -> String {
    rows(&m.clone().into())
}
