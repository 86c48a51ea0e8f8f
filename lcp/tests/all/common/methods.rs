//! All methods that treat a class of problems, at the same tolerance.

use lcp::{
    Auto, AutoSettings, BoxedLcp, Contact2d, Error, Friction2d, HorizontalLcp, InteriorPoint,
    InteriorPointSettings, Lcp, Lemke, LemkeSettings, MixedLcp, ProjectedGaussSeidel,
    ProjectedGaussSeidelSettings, SemismoothNewton, SemismoothNewtonSettings, Solution, Solver,
};

/// Asked of every method, so that the answers can be judged alike.
pub(crate) const TOLERANCE: f64 = 1e-10;

pub(crate) const AUTO: &str = "auto";

pub(crate) type Named<P> = (&'static str, Box<dyn Solver<P>>);

/// A class of problems with its methods.
pub(crate) trait Treated: Sized {
    /// `Auto` first.
    fn methods() -> Vec<Named<Self>>;

    /// The answers of all methods.
    fn answers(&self) -> Vec<(&'static str, Result<Solution<Self>, Error>)> {
        Self::methods().into_iter().map(|(name, method)| (name, method.solve(self))).collect()
    }
}

impl Treated for HorizontalLcp {
    fn methods() -> Vec<Named<Self>> {
        [vec![auto(), lemke(), newton(), interior()], program()].into_iter().flatten().collect()
    }
}

impl Treated for Lcp {
    fn methods() -> Vec<Named<Self>> {
        let methods = vec![auto(), lemke(), newton(), interior(), sweeps()];
        [methods, program()].into_iter().flatten().collect()
    }
}

impl Treated for MixedLcp {
    fn methods() -> Vec<Named<Self>> {
        [vec![auto(), lemke(), interior()], program()].into_iter().flatten().collect()
    }
}

impl Treated for BoxedLcp {
    fn methods() -> Vec<Named<Self>> {
        vec![auto(), lemke(), interior(), sweeps()]
    }
}

impl Treated for Friction2d {
    fn methods() -> Vec<Named<Self>> {
        vec![auto(), lemke(), interior(), sweeps()]
    }
}

impl Treated for Contact2d {
    fn methods() -> Vec<Named<Self>> {
        let methods = vec![auto(), lemke(), interior(), sweeps()];
        [methods, program()].into_iter().flatten().collect()
    }
}

fn auto<P>() -> Named<P>
where
    Auto: Solver<P>,
{
    let settings = AutoSettings { tolerance: TOLERANCE, ..Default::default() };
    (AUTO, Box::new(Auto::new(settings)))
}

fn lemke<P>() -> Named<P>
where
    Lemke: Solver<P>,
{
    let settings = LemkeSettings { tolerance: TOLERANCE, ..Default::default() };
    ("lemke", Box::new(Lemke::new(settings)))
}

fn newton<P>() -> Named<P>
where
    SemismoothNewton: Solver<P>,
{
    let settings = SemismoothNewtonSettings { tolerance: TOLERANCE, ..Default::default() };
    ("newton", Box::new(SemismoothNewton::new(settings)))
}

fn interior<P>() -> Named<P>
where
    InteriorPoint: Solver<P>,
{
    let settings = InteriorPointSettings { tolerance: TOLERANCE, ..Default::default() };
    ("interior", Box::new(InteriorPoint::new(settings)))
}

fn sweeps<P>() -> Named<P>
where
    ProjectedGaussSeidel: Solver<P>,
{
    let settings = ProjectedGaussSeidelSettings { tolerance: TOLERANCE, ..Default::default() };
    ("pgs", Box::new(ProjectedGaussSeidel::new(settings)))
}

#[cfg(feature = "clarabel")]
fn program<P>() -> Vec<Named<P>>
where
    lcp::QuadraticProgram: Solver<P>,
{
    let settings = lcp::QuadraticProgramSettings { tolerance: TOLERANCE, ..Default::default() };
    vec![("qp", Box::new(lcp::QuadraticProgram::new(settings)))]
}

#[cfg(not(feature = "clarabel"))]
fn program<P>() -> Vec<Named<P>> {
    Vec::new()
}
