//! A problem of any kind, and the methods of `lcp` on it.

use lcp::faer::sparse::{SparseColMat, Triplet};
use lcp::{
    Auto, AutoSettings, BoxedLcp, Contact2d, Error, Friction2d, HorizontalLcp, InteriorPoint,
    InteriorPointSettings, Lcp, Lemke, LemkeSettings, Matrix, MixedLcp, ProjectedGaussSeidel,
    ProjectedGaussSeidelSettings, QuadraticProgram, QuadraticProgramSettings, SemismoothNewton,
    SemismoothNewtonSettings, Solution, Solver,
};

/// The largest residual of an answer, of all methods.
pub const ASKED: f64 = 1e-10;

/// A problem of any kind.
#[derive(Clone)]
pub enum Problem {
    Standard(Lcp),
    General(HorizontalLcp),
    Mixed(MixedLcp),
    Boxed(BoxedLcp),
    Contact(Contact2d),
    Friction(Friction2d),
}

/// A method, of pivots with either way to keep its basis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    LemkeDense,
    LemkeSparse,
    Newton,
    Quadratic,
    Interior,
    Sweeps,
    Auto,
}

impl Method {
    pub const ALL: [Self; 7] = [
        Self::LemkeDense,
        Self::LemkeSparse,
        Self::Newton,
        Self::Quadratic,
        Self::Interior,
        Self::Sweeps,
        Self::Auto,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Self::LemkeDense => "lemke",
            Self::LemkeSparse => "lemke, sparse",
            Self::Newton => "newton",
            Self::Quadratic => "qp",
            Self::Interior => "interior",
            Self::Sweeps => "pgs",
            Self::Auto => "auto",
        }
    }
}

impl Problem {
    /// The general problem whose pairs all answers have.
    pub fn general(&self) -> HorizontalLcp {
        match self {
            Self::Standard(problem) => problem.clone().into(),
            Self::General(problem) => problem.clone(),
            Self::Mixed(problem) => problem.to_general(),
            Self::Boxed(problem) => problem.to_general(),
            Self::Contact(problem) => problem.to_general(),
            Self::Friction(problem) => problem.standard().clone().into(),
        }
    }

    /// What a method gives; `None` where it is none for problems of this kind.
    pub fn by(&self, method: Method, lemke: &LemkeSettings) -> Option<Result<Solution, Error>> {
        let stored = match method {
            Method::LemkeDense => self.stored(false)?,
            Method::LemkeSparse => self.stored(true)?,
            _ => self.clone(),
        };
        Some(match &stored {
            Self::Standard(problem) => in_pairs(&*solver(method, lemke)?, problem),
            Self::General(problem) => in_pairs(&*solver(method, lemke)?, problem),
            Self::Mixed(problem) => in_pairs(&*solver(method, lemke)?, problem),
            Self::Boxed(problem) => in_pairs(&*solver(method, lemke)?, problem),
            Self::Contact(problem) => in_pairs(&*solver(method, lemke)?, problem),
            Self::Friction(problem) => in_pairs(&*solver(method, lemke)?, problem),
        })
    }

    /// With matrices stored in this way; contact problems are always sparse.
    fn stored(&self, sparse: bool) -> Option<Self> {
        let stored = |matrix: &Matrix| stored(matrix, sparse);
        Some(match self {
            Self::Standard(it) => {
                Self::Standard(Lcp::new(stored(it.m()), it.q().to_vec()).unwrap())
            }
            Self::General(it) => Self::General(
                HorizontalLcp::new(stored(it.a()), stored(it.b()), it.c().to_vec()).unwrap(),
            ),
            Self::Mixed(it) => Self::Mixed(
                MixedLcp::new(stored(it.m()), it.q().to_vec(), it.free().to_vec()).unwrap(),
            ),
            Self::Boxed(it) => {
                let [q, lower, upper] = [it.q(), it.lower(), it.upper()].map(<[f64]>::to_vec);
                Self::Boxed(BoxedLcp::new(stored(it.m()), q, lower, upper).unwrap())
            }
            Self::Contact(_) => return sparse.then(|| self.clone()),
            Self::Friction(it) => Self::Friction(
                Friction2d::new(stored(it.w()), it.q().to_vec(), it.mu().to_vec()).unwrap(),
            ),
        })
    }
}

fn in_pairs<P>(solver: &dyn Solver<P>, problem: &P) -> Result<Solution, Error> {
    solver.solve(problem).map(Solution::of_pairs)
}

fn stored(matrix: &Matrix, sparse: bool) -> Matrix {
    if !sparse {
        return matrix.to_dense().into();
    }
    let (rows, columns) = (matrix.nrows(), matrix.ncols());
    let entries =
        (0..columns).flat_map(|j| matrix.column(j).map(move |(i, v)| Triplet::new(i, j, v)));
    let entries: Vec<_> = entries.filter(|it| it.val != 0.0).collect();
    SparseColMat::try_new_from_triplets(rows, columns, &entries).unwrap().into()
}

/// A method for problems of one kind, of those that treat some kinds only `None` by default.
trait Kind: Sized {
    fn newton() -> Boxed<Self> {
        None
    }

    fn quadratic() -> Boxed<Self> {
        None
    }

    fn sweeps() -> Boxed<Self> {
        None
    }
}

type Boxed<P> = Option<Box<dyn Solver<P>>>;

fn solver<P: Kind>(method: Method, lemke: &LemkeSettings) -> Boxed<P>
where
    Lemke: Solver<P>,
    InteriorPoint: Solver<P>,
    Auto: Solver<P>,
{
    let tolerance = ASKED;
    match method {
        Method::LemkeDense | Method::LemkeSparse => {
            Some(Box::new(Lemke::new(LemkeSettings { tolerance, ..lemke.clone() })))
        }
        Method::Newton => P::newton(),
        Method::Quadratic => P::quadratic(),
        Method::Interior => {
            let settings = InteriorPointSettings { tolerance, ..Default::default() };
            Some(Box::new(InteriorPoint::new(settings)))
        }
        Method::Sweeps => P::sweeps(),
        Method::Auto => Some(Box::new(Auto::new(AutoSettings { tolerance, ..Default::default() }))),
    }
}

fn newton<P>() -> Box<dyn Solver<P>>
where
    SemismoothNewton: Solver<P>,
{
    let settings = SemismoothNewtonSettings { tolerance: ASKED, ..Default::default() };
    Box::new(SemismoothNewton::new(settings))
}

fn quadratic<P>() -> Box<dyn Solver<P>>
where
    QuadraticProgram: Solver<P>,
{
    let settings = QuadraticProgramSettings { tolerance: ASKED, ..Default::default() };
    Box::new(QuadraticProgram::new(settings))
}

fn sweeps<P>() -> Box<dyn Solver<P>>
where
    ProjectedGaussSeidel: Solver<P>,
{
    let settings = ProjectedGaussSeidelSettings { tolerance: ASKED, ..Default::default() };
    Box::new(ProjectedGaussSeidel::new(settings))
}

impl Kind for Lcp {
    fn newton() -> Boxed<Self> {
        Some(newton())
    }

    fn quadratic() -> Boxed<Self> {
        Some(quadratic())
    }

    fn sweeps() -> Boxed<Self> {
        Some(sweeps())
    }
}

impl Kind for HorizontalLcp {
    fn newton() -> Boxed<Self> {
        Some(newton())
    }

    fn quadratic() -> Boxed<Self> {
        Some(quadratic())
    }

    fn sweeps() -> Boxed<Self> {
        Some(sweeps())
    }
}

impl Kind for MixedLcp {
    fn quadratic() -> Boxed<Self> {
        Some(quadratic())
    }
}

impl Kind for BoxedLcp {
    fn sweeps() -> Boxed<Self> {
        Some(sweeps())
    }
}

impl Kind for Contact2d {
    fn quadratic() -> Boxed<Self> {
        Some(quadratic())
    }

    fn sweeps() -> Boxed<Self> {
        Some(sweeps())
    }
}

impl Kind for Friction2d {
    fn sweeps() -> Boxed<Self> {
        Some(sweeps())
    }
}
