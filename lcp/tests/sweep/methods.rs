//! The methods that treat a problem, and their answers.

use lcp::{
    Auto, AutoSettings, Error, InteriorPoint, InteriorPointSettings, Lemke, LemkeSettings,
    ProjectedGaussSeidel, ProjectedGaussSeidelSettings, SemismoothNewton, SemismoothNewtonSettings,
    Solution, Solver,
};

use super::problems::{Problem, TOLERANCE};

pub(crate) const AUTO: &str = "auto";

type Named<P> = (&'static str, Box<dyn Solver<P>>);
type Answers = Vec<(&'static str, Result<Solution, Error>)>;

/// The answers of `Auto`, and with `all` those of the other methods too.
pub(crate) fn answers(problem: &Problem, all: bool) -> Answers {
    match problem {
        Problem::General(it) => asked(it, all, [lemke(), newton(), interior()], program()),
        Problem::Standard(it) => {
            asked(it, all, [lemke(), newton(), interior(), sweeps()], program())
        }
        Problem::Mixed(it) => asked(it, all, [lemke(), interior()], program()),
        Problem::Boxed(it) => asked(it, all, [lemke(), interior(), sweeps()], Vec::new()),
        Problem::Friction(it) => asked(it, all, [lemke(), interior(), sweeps()], Vec::new()),
        Problem::Contact(it) => {
            asked(it, all, [lemke(), newton(), interior(), sweeps()], program())
        }
    }
}

fn asked<P>(
    problem: &P,
    all: bool,
    others: impl IntoIterator<Item = Named<P>>,
    program: Vec<Named<P>>,
) -> Answers
where
    Auto: Solver<P>,
{
    let settings = AutoSettings { tolerance: TOLERANCE, ..Default::default() };
    let auto: Named<P> = (AUTO, Box::new(Auto::new(settings)));
    let others = others.into_iter().chain(program).filter(|_| all);
    let methods = [auto].into_iter().chain(others);
    methods.map(|(name, method)| (name, method.solve(problem))).collect()
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
