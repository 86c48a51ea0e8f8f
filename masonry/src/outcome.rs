//! What a solved scene consists of: displacements, contact forces, stresses, checks, times.

use nalgebra::{Point2, Vector2};
use serde::{Deserialize, Serialize};

use crate::check::Checks;
use crate::history::History;
use crate::ids::{BlockId, ContactId, FilmId};
use crate::model::Model;
use crate::plan::Plan;
use crate::routes::alm;
use crate::scene::Route;
use crate::verdict::Judgement;

/// The mechanical state of a model under its loads, in SI units.
#[derive(Debug, Clone)]
pub struct State {
    /// Displacements \[m\] of the nodes of every block, in the order of the block's mesh; of the
    /// four corners for a rigid block.
    pub displacements: Vec<Vec<Vector2<f64>>>,
    /// Force, gap and slip at every contact point.
    pub contacts: Vec<ContactState>,
    /// Stresses at the contact points of the mortar films, in the order of the points; empty without
    /// films, and when no output shows stresses.
    pub films: Vec<FilmStress>,
    /// Stresses at the centre of every element; empty when no output shows them.
    pub stresses: Vec<ElementStress>,
    /// Strain energy of all blocks and films \[J\].
    pub strain_energy: f64,
}

/// What happens at one contact point.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ContactState {
    /// Normal contact force \[N\], compression positive.
    pub t_n: f64,
    /// Tangential contact force \[N\] on side `b` along `t`.
    pub t_t: f64,
    /// Normal gap \[m\]; across a film, beyond its compression.
    pub y_n: f64,
    /// Slip \[m\] of side `b` relative to `a` along `t`; across a film, beyond its shear.
    pub y_t: f64,
    /// Open, stick or slip.
    pub status: ContactStatus,
}

/// The three states of a frictional contact point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ContactStatus {
    /// The gap is positive: no force is carried.
    Open,
    /// Closed without sliding.
    Stick,
    /// Closed, and the sides slide on each other: the force is on the edge of the friction cone.
    Slip,
}

/// Stress at one contact point of a mortar film, in the film's axes: `x` along the tangent of the
/// joint and `y` along its normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmStress {
    /// The film.
    pub film: FilmId,
    /// The contact point.
    pub contact: ContactId,
    /// Stress along the joint \[Pa\], tension positive; `None` where films act across their joints only.
    pub sigma_x: Option<f64>,
    /// Stress across the joint \[Pa\], tension positive: never above zero.
    pub sigma_y: f64,
    /// Shear stress \[Pa\].
    pub tau: f64,
}

/// Stress at the centre of one element.
#[derive(Debug, Clone, Copy)]
pub struct ElementStress {
    /// The block that the element belongs to.
    pub block: BlockId,
    /// The element's position in the block's mesh.
    pub element: usize,
    /// The centre of the element \[m\].
    pub centre: Point2<f64>,
    /// `sigma_x, sigma_y, tau_xy` \[Pa\], tension positive.
    pub sigma: [f64; 3],
    /// The principal stresses and their direction.
    pub principal: Principal,
}

/// Principal stresses of a plane state of stress.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Principal {
    /// The larger (more tensile) principal stress \[Pa\].
    pub sigma_1: f64,
    /// The smaller (more compressive) principal stress \[Pa\].
    pub sigma_2: f64,
    /// Angle of the direction of `sigma_1` from the x axis \[rad\], in `(-pi/2, pi/2]`.
    pub theta: f64,
}

/// The resultant of the contact forces of one support on the structure, in SI units.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Reaction {
    /// Name of the support.
    pub support: String,
    /// Horizontal force on the structure \[N\].
    pub fx: f64,
    /// Vertical force on the structure \[N\].
    pub fy: f64,
    /// Moment about the origin, counter-clockwise \[N m\].
    pub m: f64,
}

/// How the complementarity problem was solved.
#[derive(Debug, Clone, Serialize)]
pub struct SolveInfo {
    /// `Solved`, or why not.
    pub status: lcp::Status,
    /// The route that gave the answer.
    pub route: Route,
    /// Why it was its turn.
    pub because: String,
    /// All routes that were tried, in order.
    pub routes: Vec<RouteEnd>,
    /// The form that was solved: `coulomb`, `stewart-trinkle` or `mixed`
    /// ([`FormKind`](crate::forms::FormKind)) of the pivoting route, `contact` of the others.
    pub form: String,
    /// Order of the complementarity problem; of the augmented Lagrangian method, of its linear systems.
    pub order: usize,
    /// One line for each attempt of any route: form, covering vector, start basis, outcome.
    pub attempts: Vec<String>,
    /// Pivots over all attempts.
    pub pivots: usize,
    /// Steps of the interior-point or Newton's method, programs, times that springs were centred, or iterations of
    /// the augmented Lagrangian method.
    pub iterations: usize,
    /// Every iteration of the augmented Lagrangian method; empty on the other routes.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub convergence: Vec<alm::Iteration>,
    /// Matrices factorised.
    pub factorisations: usize,
    /// The evidence, where springs say that there is no equilibrium.
    pub springs: Option<SpringShares>,
    /// Whether the status `Infeasible` is proved, by a vector that was checked in the data.
    pub proved: bool,
    /// What the springs of the scene did.
    pub soft: Option<SoftReport>,
    /// Dimensionless residuals recomputed from the original data.
    pub residuals: lcp::Residuals,
    /// Residuals of the same answer in the paper's form (3.27), where another form found it.
    pub coulomb_residuals: Option<lcp::Residuals>,
}

impl SolveInfo {
    /// Nothing but a status and residuals.
    pub fn new(status: lcp::Status, residuals: lcp::Residuals) -> Self {
        Self {
            status,
            route: Route::Auto,
            because: String::new(),
            routes: Vec::new(),
            form: String::new(),
            order: 0,
            attempts: Vec::new(),
            pivots: 0,
            iterations: 0,
            convergence: Vec::new(),
            factorisations: 0,
            springs: None,
            proved: false,
            soft: None,
            residuals,
            coulomb_residuals: None,
        }
    }
}

/// How a route ended.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RouteEnd {
    /// The route.
    pub route: Route,
    /// Why it was its turn.
    pub because: String,
    /// Its status, and what became of it; or why it refused.
    pub end: String,
    /// Wall-clock time \[s\].
    pub seconds: f64,
}

/// Springs on all displacements that are made softer and softer, and what they carry: a share that does not
/// tend to zero says that nothing else carries it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SpringShares {
    /// The stiffnesses, relative to that of the blocks \[-\].
    pub stiffness: Vec<f64>,
    /// The share of the load that the springs of each stiffness carry \[-\].
    pub shares: Vec<f64>,
}

/// Springs that hold the blocks while a scene is solved, and what they changed before they were
/// centred anew; the answer itself is without them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SoftReport {
    /// The stiffness, relative to that of the blocks \[-\].
    pub stiffness: f64,
    /// How often the springs were centred.
    pub rounds: usize,
    /// The share of the load that they carried at first \[-\].
    pub share: f64,
    /// The error of the displacements that they caused at first, relative to these \[-\]; `None` where it
    /// is not known, as where nothing moves.
    pub displacement_error: Option<f64>,
}

/// Wall-clock time of one phase \[s\].
#[derive(Debug, Clone, Serialize)]
pub struct PhaseTime {
    /// Name of the phase.
    pub phase: String,
    /// Seconds.
    pub seconds: f64,
}

/// Everything known about a scene after an attempt to solve it.
///
/// `state` and `checks` are `None` when no solution was found; all else is kept. Where a step of the load
/// history could not be solved, they are those of the step before, and `solve` tells how the step failed.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// Title of the scene.
    pub title: String,
    /// The model that was solved.
    pub model: Model,
    /// What was built, and why.
    pub plan: Plan,
    /// How the complementarity problem was solved.
    pub solve: SolveInfo,
    /// The mechanical state, when solved.
    pub state: Option<State>,
    /// Balances and the friction cone, recomputed from the state.
    pub checks: Option<Checks>,
    /// The reaction of every support, when solved.
    pub reactions: Vec<Reaction>,
    /// The steps of the load history, where the answer depends on the way.
    pub history: Option<History>,
    /// The mechanism, when there is no solution and the method found one, along a secondary ray, on soft
    /// springs or by a proof: displacement rates of the corners of every block, scaled to a largest component of one.
    pub mechanism: Option<Vec<[Vector2<f64>; 4]>>,
    /// Whether the wall stands.
    pub judgement: Judgement,
    /// Time of every phase.
    pub times: Vec<PhaseTime>,
}
