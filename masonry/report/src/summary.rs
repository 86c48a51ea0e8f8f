//! Figures that several reports show: extremes, totals, and the reason for which a scene has no solution.

use std::collections::HashMap;

use nalgebra::{Point2, Vector2};

use masonry::analysis::outcome::Outcome;
use masonry::data::state::{FilmStress, State};
use masonry::data::verdict::Evidence;
use masonry::geometry;
use masonry::history::HistoryStep;
use masonry::ids::BlockId;
use masonry::model::{Body, Cause, EdgeLoad, LoadCase, Model, PlacedBlock, PlacedForce};

/// The displacement component of largest absolute value, with its sign and place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LargestDisplacement {
    /// The displacement component with its sign \[m\].
    pub value: f64,
    /// Direction of the component: `x` or `y`.
    pub component: char,
    /// The block of the node.
    pub block: BlockId,
    /// Position of the node before deformation \[m\].
    pub position: Point2<f64>,
}

/// A principal stress and the element in which it occurs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExtremeStress {
    /// The stress \[Pa\], tension positive.
    pub value: f64,
    /// The block of the element.
    pub block: BlockId,
    /// The centre of the element \[m\].
    pub position: Point2<f64>,
}

/// The resultant of forces: their sum, and their moment about the origin, in SI units.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Resultant {
    /// The sum of the forces \[N\].
    pub force: Vector2<f64>,
    /// Moment about the origin, counter-clockwise \[N m\].
    pub moment: f64,
}

impl Resultant {
    fn add(&mut self, force: Vector2<f64>, at: Point2<f64>) {
        self.force += force;
        self.moment += at.x * force.y - at.y * force.x;
    }

    fn add_load(&mut self, load: &PlacedForce) {
        self.add(load.force, load.at);
        self.moment += load.moment;
    }
}

/// Returns the nodes of a block: those of its mesh, or the corners of a rigid block.
pub fn nodes(block: &PlacedBlock) -> &[Point2<f64>] {
    block.mesh.as_ref().map_or(&block.corners, |mesh| &mesh.nodes)
}

/// Finds the displacement component of largest absolute value; `None` without blocks.
pub fn largest_displacement(model: &Model, state: &State) -> Option<LargestDisplacement> {
    let mut largest: Option<LargestDisplacement> = None;
    for (index, (block, moves)) in model.blocks.iter().zip(&state.displacements).enumerate() {
        for (&position, u) in nodes(block).iter().zip(moves) {
            for (component, value) in [('x', u.x), ('y', u.y)] {
                if largest.is_none_or(|it| value.abs() > it.value.abs()) {
                    let block = BlockId::new(index);
                    largest = Some(LargestDisplacement { value, component, block, position });
                }
            }
        }
    }
    largest
}

/// Finds the most compressive and the most tensile principal stress; `None` in the first place if no element is in
/// compression, in the second if none is in tension.
pub fn extreme_stresses(state: &State) -> (Option<ExtremeStress>, Option<ExtremeStress>) {
    let mut compression: Option<ExtremeStress> = None;
    let mut tension: Option<ExtremeStress> = None;
    for stress in &state.stresses {
        let at = |value| ExtremeStress { value, block: stress.block, position: stress.centre };
        let (least, most) = (stress.principal.sigma_2, stress.principal.sigma_1);
        if least < compression.map_or(0.0, |it| it.value) {
            compression = Some(at(least));
        }
        if most > tension.map_or(0.0, |it| it.value) {
            tension = Some(at(most));
        }
    }
    (compression, tension)
}

/// The stresses at three places in the mortar films at which a component is largest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmExtremes {
    /// The stresses at the place of the largest compression perpendicular to the joint.
    pub compression: FilmStress,
    /// The stresses at the place of the shear stress of largest absolute value.
    pub shear: FilmStress,
    /// The stresses at the place of the stress along the film of largest absolute value, compression or tension;
    /// `sigma_x` is `None` if films act only perpendicular to their joints.
    pub along: FilmStress,
}

/// Finds the largest stresses in the mortar films; `None` without films.
pub fn extreme_film_stresses(state: &State) -> Option<FilmExtremes> {
    let first = *state.films.first()?;
    let start = FilmExtremes { compression: first, shear: first, along: first };
    Some(state.films.iter().fold(start, |mut found, film| {
        if film.sigma_y < found.compression.sigma_y {
            found.compression = *film;
        }
        if film.tau.abs() > found.shear.tau.abs() {
            found.shear = *film;
        }
        if film.sigma_x.map(f64::abs) > found.along.sigma_x.map(f64::abs) {
            found.along = *film;
        }
        found
    }))
}

/// Returns the resultant of all loads and self weights.
pub fn applied_load(model: &Model) -> Resultant {
    let (loads, weight) = (loads(model), weight(model));
    Resultant { force: loads.force + weight.force, moment: loads.moment + weight.moment }
}

/// Returns the resultant of all loads, without self weights.
pub fn loads(model: &Model) -> Resultant {
    resultant(model, |cause| cause != Cause::Weight)
}

/// Returns the resultant of all self weights.
pub fn weight(model: &Model) -> Resultant {
    resultant(model, |cause| cause == Cause::Weight)
}

fn resultant(model: &Model, counts: impl Fn(Cause) -> bool) -> Resultant {
    let mut total = Resultant::default();
    for (cause, load) in model.blocks.iter().flat_map(|block| model.causes_on(block)) {
        if counts(cause) {
            total.add_load(&load);
        }
    }
    total
}

/// The loads that share a group name.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadGroup<'a> {
    /// Name of the load group.
    pub name: &'a str,
    /// The loads of the group, in the order of the scene, each with its resultant.
    pub loads: Vec<(&'a LoadCase, Resultant)>,
    /// The resultant of all loads of the group.
    pub sum: Resultant,
}

/// Returns the groups of loads, in the order of their first loads.
pub fn load_groups(model: &Model) -> Vec<LoadGroup<'_>> {
    let mut sums = vec![Resultant::default(); model.loads.len()];
    for (cause, load) in model.blocks.iter().flat_map(|block| model.causes_on(block)) {
        if let Cause::Load(id) = cause
            && let Some(sum) = sums.get_mut(id.index())
        {
            sum.add_load(&load);
        }
    }
    let mut groups: Vec<LoadGroup<'_>> = Vec::new();
    let mut positions = HashMap::new();
    for (load, sum) in model.loads.iter().zip(sums) {
        let name = load.group.as_str();
        let position = *positions.entry(name).or_insert_with(|| {
            groups.push(LoadGroup { name, loads: Vec::new(), sum: Resultant::default() });
            groups.len() - 1
        });
        let group = &mut groups[position];
        group.loads.push((load, sum));
        group.sum.force += sum.force;
        group.sum.moment += sum.moment;
    }
    groups
}

/// Returns the sum of all support reactions.
pub fn total_reaction(outcome: &Outcome) -> Resultant {
    let mut total = Resultant::default();
    for reaction in &outcome.reactions {
        total.force += Vector2::new(reaction.fx, reaction.fy);
        total.moment += reaction.m;
    }
    total
}

/// Supports that hold a block at the same place, and the resultant of their reactions.
#[derive(Debug, Clone, PartialEq)]
pub struct CornerSum {
    /// Names of the supports that hold the block.
    pub supports: Vec<String>,
    /// The resultant of the reactions of these supports.
    pub sum: Resultant,
}

/// Finds supports that hold a block at the same place. Only the sum of their reactions at this place is unique, not the
/// single reactions.
pub fn corner_sums(outcome: &Outcome) -> Vec<CornerSum> {
    let groups = groups_at_corners(&outcome.model);
    let of_group = |group: Vec<usize>| {
        let mut sum = Resultant::default();
        for reaction in group.iter().filter_map(|id| outcome.reactions.get(*id)) {
            sum.force += Vector2::new(reaction.fx, reaction.fy);
            sum.moment += reaction.m;
        }
        let names = group.iter().map(|id| outcome.model.supports[*id].name.clone());
        CornerSum { supports: names.collect(), sum }
    };
    groups.into_iter().filter(|_| !outcome.reactions.is_empty()).map(of_group).collect()
}

fn groups_at_corners(model: &Model) -> Vec<Vec<usize>> {
    /// The largest distance between supports that count as at the same place, divided by the size of a block.
    const SAME_PLACE: f64 = 1e-9;
    let mut held: Vec<Vec<(usize, Point2<f64>)>> = vec![Vec::new(); model.blocks.len()];
    for contact in &model.contacts {
        if let Body::Support(id) = model.joints[contact.joint.index()].a {
            held[contact.b.block.index()].push((id.index(), contact.position));
        }
    }
    let mut group: Vec<usize> = (0..model.supports.len()).collect();
    for (block, held) in model.blocks.iter().zip(&held) {
        let near = SAME_PLACE * geometry::size(&block.corners);
        for (k, (a, place)) in held.iter().enumerate() {
            for (b, other) in &held[k + 1..] {
                if (place - other).norm() <= near {
                    let (from, to) = (group[*a].max(group[*b]), group[*a].min(group[*b]));
                    group.iter_mut().filter(|it| **it == from).for_each(|it| *it = to);
                }
            }
        }
    }
    let members = |head| (0..group.len()).filter(|id| group[*id] == head).collect::<Vec<_>>();
    (0..group.len()).map(members).filter(|members| members.len() > 1).collect()
}

/// Returns the start and the end of the loaded part of an edge \[m\].
pub fn loaded_part(block: &PlacedBlock, load: &EdgeLoad) -> (Point2<f64>, Point2<f64>) {
    let place = |at| geometry::on_edge(&block.corners, load.edge, at);
    (place(load.from), place(load.to))
}

/// Returns the reason for which the scene is not solved, in a sentence or two; `None` if the scene is solved.
pub fn reason(outcome: &Outcome) -> Option<String> {
    let mut why = why(outcome)?.to_owned();
    if outcome.judgement.evidence == Evidence::NoAdmissibleForces
        && outcome.solve.status != lcp::Status::Infeasible
    {
        why += " But it is proved that no contact forces within friction balance the loads. The proof is a motion, \
             which was checked in the geometry.";
    }
    let history = outcome.history.as_ref().filter(|history| !history.records.is_empty());
    Some(match history.and_then(|history| history.failed.as_ref()) {
        Some(HistoryStep { stage, number, of, .. }) => {
            let is_cancelled = outcome.solve.status == lcp::Status::Cancelled;
            let end = if is_cancelled { "was not finished" } else { "could not be solved" };
            format!(
                "Step {number} of {of} of stage \"{stage}\" {end}. {why} Load history, reactions and state are those of \
                 the step before, which was solved."
            )
        }
        None => why,
    })
}

fn why(outcome: &Outcome) -> Option<&'static str> {
    let has_history = outcome.history.as_ref().is_some_and(|history| !history.records.is_empty());
    let what = match outcome.solve.status {
        lcp::Status::Solved => return None,
        lcp::Status::AlmostSolved if outcome.state.is_some() && !has_history => {
            "The complementarity problem was solved, but the balance of the blocks, recomputed from \
             forces and loads, does not hold. The computed state is kept for inspection only."
        }
        lcp::Status::RayTermination if outcome.mechanism.is_some() => {
            "A collapse mechanism was found, but no equilibrium. The mechanism is a motion of the blocks \
             that the supports do not stop, and on which the loads do work. Friction may stop it, so the \
             mechanism is not a proof of collapse."
        }
        lcp::Status::RayTermination => {
            "No attempt found an equilibrium, and the last form ended on secondary rays. Such \
             rays are not a proof of collapse if there is friction: there may be an equilibrium that Lemke's \
             method does not reach."
        }
        lcp::Status::Infeasible => {
            "There is no equilibrium (proved): no contact forces within their limits and no displacements \
             that fit them balance the loads. The proof, a Farkas vector, was checked in the data."
        }
        lcp::Status::NoEquilibrium => {
            "The blocks do not come to rest within small displacements. This motion is evidence of collapse, not a proof."
        }
        lcp::Status::Stalled => {
            "The residuals stopped decreasing before the tolerance was reached. Whether the structure stands \
             remains open: another route may find an equilibrium."
        }
        lcp::Status::IterationLimit => {
            "The limit on iterations was reached. Whether the structure stands remains open: \
             another route may find an equilibrium."
        }
        lcp::Status::PivotLimit => {
            "The limit on pivots was reached. Whether the structure stands remains open: a \
             larger limit or another start may find an equilibrium."
        }
        lcp::Status::NumericalTrouble => {
            "Rounding errors are too large. Whether the structure stands \
             remains open: look for blocks, stiffnesses or gaps of very different size."
        }
        lcp::Status::AlmostSolved => {
            "The best point found satisfies the conditions only to a looser tolerance, which is \
             not accepted as an equilibrium."
        }
        lcp::Status::Cycling => {
            "The pivots cycled in every attempt. Whether the structure \
             stands remains open: another mesh or another form may find an equilibrium."
        }
        lcp::Status::Cancelled => "The solve was cancelled.",
        _ => "The solver returned no equilibrium.",
    };
    Some(what)
}
