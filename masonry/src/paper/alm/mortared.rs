//! Walls with mortar films as strips: the displacements of the blocks are the only unknowns, as in the paper.
//!
//! The films have no contact points here: they are strips with the [law](crate::paper::film::law) at their Gauss
//! points and are attached to the nodes of both blocks. In every iteration their stiffness is updated to the parts in
//! contact ((3.10) with `K_p`). Dry joints have multipliers as in the parent module.

use std::ops::ControlFlow;

use faer::sparse::{SparseColMat, Triplet};
use lcp::{Contact2d, Matrix};

use super::films::{Segment, attached};
use super::structure::Structure;
use super::{AlmAnswer, AlmError, AlmIteration, AlmSettings, run};
use crate::data::state::{Reaction, State};
use crate::forms::Sparse;
use crate::model::{Body, Model};
use crate::paper::film::pointwise::FilmResponse;
use crate::recover;
use crate::system::System;

/// A wall of blocks, with contacts in the dry joints and mortar films as strips in all other joints.
///
/// The strips start from the gaps and slips of the contact points of the films of the model.
///
/// ```
/// use std::ops::ControlFlow;
/// use masonry::model::joints::PointRule;
/// use masonry::model::{Model, Plane};
/// use masonry::paper::alm::{MortaredWall, AlmSettings};
/// use masonry::scene::{Block, Films, Joint, Load, Material, Scene, Support};
/// use masonry::units::Units;
///
/// // A block of 0.4 m on a bed of 1 cm, pressed by 1 MPa.
/// let corners = [[0.0, 0.01], [0.4, 0.01], [0.4, 0.31], [0.0, 0.31]];
/// let scene = Scene::new("Bed", Units::SI)
///     .plane(Plane::Stress)
///     .thickness(0.2)
///     .material("brick", Material::elastic(5e9, 0.0))
///     .material("mortar", Material::elastic(1e9, 0.0))
///     .joint("bed", Joint::mu(0.6).mortar(0.01, "mortar"))
///     .block(Block::new("block", "brick", corners).mesh([2, 2]))
///     .support(Support::new("ground", [0.0, 0.0], [0.4, 0.0], "bed"))
///     .load(Load::pressure("top", [0.0, 0.31], [0.4, 0.31], 1e6))
///     .contact_points(PointRule::Gauss)
///     .films(Films::Strips);
/// let wall = MortaredWall::new(&Model::from_scene(&scene)?)?;
/// let answer = wall.solve(&AlmSettings::default(), &mut |_| ControlFlow::Continue(()))?;
/// let state = wall.state(&answer);
/// assert!((state.reactions[0].fy - 0.4 * 0.2 * 1e6).abs() < 1e-2);
/// let top = state.state.displacements[0][8];
/// assert!((top.y + 1e6 * (0.01 / 1e9 + 0.3 / 5e9)).abs() < 1e-11);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct MortaredWall {
    /// The model with contact points in dry joints only.
    dry: Model,
    system: System,
    sparse: Sparse,
    films: Vec<Segment>,
}

/// The part `[x_i, x_f]` of every segment that is in contact \[m\], on the axis of the segment; `None` for an open
/// segment.
pub type Parts = Vec<Option<[f64; 2]>>;

/// The state of a wall with strips under its loads.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct MortaredState {
    /// Displacements, states of the dry contact points, stresses in the blocks, and the energy of blocks and films.
    pub state: State,
    /// The response of every film segment, in the axes of the segment.
    pub films: Vec<FilmResponse>,
    /// Strain energy of the films \[J\], included in the energy of `state`.
    pub film_energy: f64,
    /// Energy dissipated by slip in films \[J\].
    pub film_dissipation: f64,
    /// Energy dissipated by slip in dry joints \[J\].
    pub contact_dissipation: f64,
    /// The work `f . u` \[J\]. It is the dissipation plus twice the strain energy for a single step from rest, if
    /// there are no initial gaps and no support moves.
    pub work: f64,
    /// The reactions of all supports.
    pub reactions: Vec<Reaction>,
}

impl MortaredWall {
    /// Builds the wall from a model whose films are strips.
    ///
    /// # Errors
    /// [`AlmError`], for instance if a block is rigid.
    pub fn new(model: &Model) -> Result<Self, AlmError> {
        let mut dry = model.clone();
        dry.contacts.retain(|contact| contact.film.is_none());
        let system = System::without_factors(&dry)?;
        let sparse = Sparse::with_free_faces(&system)?;
        let films = attached(model, sparse.starts())?;
        Ok(Self { dry, system, sparse, films })
    }

    /// Returns the contact problem of blocks and dry joints, without the films.
    pub fn without_films(&self) -> &Contact2d {
        &self.sparse.problem
    }

    /// Returns the segments of the films, which are divided at the nodes of the blocks.
    pub fn films(&self) -> &[Segment] {
        &self.films
    }

    /// Looks for a state of equilibrium. The observer is called in every iteration; the solution is cancelled if it
    /// returns `Break`.
    ///
    /// # Errors
    /// As [`solve`](super::solve).
    pub fn solve(
        &self,
        settings: &AlmSettings,
        observer: &mut dyn FnMut(&AlmIteration) -> ControlFlow<()>,
    ) -> Result<AlmAnswer, AlmError> {
        run::solve(&Structure::new(&self.sparse.problem, &self.films)?, settings, observer)
    }

    /// Returns the parts in contact if all films are in contact over their whole length.
    pub fn bonded(&self) -> Parts {
        self.films().iter().map(|film| Some(film.film.strip().ends())).collect()
    }

    /// Returns the contact problem of blocks and dry joints in which every film is bonded on its part `parts` and open
    /// elsewhere.
    ///
    /// # Errors
    /// [`lcp::Error::NotFinite`] if the data overflow.
    ///
    /// # Panics
    /// If the number of parts differs from the number of segments.
    pub fn with_parts(&self, parts: &Parts) -> Result<Contact2d, lcp::Error> {
        assert_eq!(parts.len(), self.films().len(), "one part for every segment");
        let dry = self.without_films();
        let k = dry.stiffness().triplet_iter();
        let mut entries: Vec<_> = k.map(|e| Triplet::new(e.row, e.col, *e.val)).collect();
        for (film, part) in self.films().iter().zip(parts) {
            let stiffness = film.film.strip().stiffness(part.unwrap_or([0.0; 2]));
            // Rounding errors of the product are not symmetric.
            let symmetric = 0.5 * (stiffness + stiffness.transpose());
            entries.extend(film.entries(&symmetric));
        }
        let n = dry.displacements();
        let k = SparseColMat::try_new_from_triplets(n, n, &entries)
            .unwrap_or_else(|e| unreachable!("entries lie inside the matrix: {e:?}"));
        let [normal, tangent] = [dry.normal(), dry.tangent()].map(|c| Matrix::from(c.clone()));
        let (x_0, s_0) = (dry.initial_gaps().to_vec(), dry.initial_slips().to_vec());
        Contact2d::new(k, dry.loads().to_vec(), normal, tangent, x_0, s_0, dry.mu().to_vec())
    }

    /// Returns the state of the wall that belongs to an answer of [`solve`](Self::solve).
    pub fn state(&self, answer: &AlmAnswer) -> MortaredState {
        let (u, found) = (&answer.state.u, &answer.state);
        let rows = self.sparse.rows(found);
        let Self { dry, system, sparse, .. } = self;
        let mut state = recover::from_displacements(dry, system, sparse, &rows, u, 0.0, true);
        let films: Vec<FilmResponse> = self.films.iter().map(|film| film.respond(u)).collect();
        let film_energy = self.films.iter().map(|film| film.energy(u)).sum();
        state.strain_energy += film_energy;
        let slipped = found.t_t.iter().zip(&found.slip);
        MortaredState {
            reactions: self.reactions(&state, &films),
            state,
            film_energy,
            film_dissipation: films.iter().map(|film| film.dissipation).sum(),
            contact_dissipation: slipped.map(|(t_t, slip)| -t_t * slip).sum(),
            work: u.iter().zip(self.sparse.problem.loads()).map(|(u, f)| u * f).sum(),
            films,
        }
    }

    /// Returns the resultants of the forces of dry joints and of films on every support.
    fn reactions(&self, state: &State, films: &[FilmResponse]) -> Vec<Reaction> {
        let mut list = recover::reactions(&self.dry, &state.contacts);
        for (film, response) in self.films.iter().zip(films) {
            let joint = &self.dry.joints[film.joint];
            let Body::Support(support) = joint.a else { continue };
            // The support holds the lower ends of the film.
            for (place, force) in film.lower_forces(joint, response) {
                let reaction = &mut list[support.index()];
                reaction.fx += force.x;
                reaction.fy += force.y;
                reaction.m += place.x * force.y - place.y * force.x;
            }
        }
        list
    }
}
