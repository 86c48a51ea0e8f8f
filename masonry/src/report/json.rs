//! The result of a scene as one JSON object.

mod history;

use nalgebra::Vector2;
use serde::{Serialize, Serializer};

use super::format::{InUnits, block_name};
use super::summary::{
    self, CornerSum, LoadGroup, Resultant, corner_sums, extreme_film_stresses, extreme_stresses,
    largest_displacement, load_groups, reason, weight,
};
use crate::analysis::outcome::Outcome;
use crate::data::info::Iteration;
use crate::data::info::{RouteEnd, SoftReport};
use crate::data::state::Reaction;
use crate::data::verdict::{Evidence, Verdict};
use crate::model;
use crate::plan::Plan;
use crate::scene::Route;

/// The object of `result.json` and of `masonry solve --json`, pretty-printed.
///
/// `verdict`, `evidence`, `sentence` and `warnings` come first, as in [`Judgement`](crate::data::verdict::Judgement).
///
/// Physical quantities are in the units of the scene, which `units` names one by one. Without a
/// solution `residuals`, `balance`, `reactions`, `contacts`, `strain_energy`, `max_displacement` and the stresses
/// are null, and `reason` says why; `mechanism` gives displacement rates of the corners of every
/// block, the largest component one, where one is known. `films`, the extremes of the stresses in
/// mortar films, is there with films only, and `history`, one record a step, with a load history only: where a step failed, the state
/// is that after the step before. `springs`, `proved` and `soft` are those of
/// [`SolveInfo`](crate::analysis::outcome::SolveInfo). Numbers that are not finite become null.
///
/// # Errors
/// None that this data can cause; the signature is that of the serialiser.
pub fn result(outcome: &Outcome, files: &[String]) -> Result<String, serde_json::Error> {
    let mut text = serde_json::to_string_pretty(&Report::of(outcome, files))?;
    text.push('\n');
    Ok(text)
}

#[derive(Serialize)]
struct Report<'a> {
    verdict: Verdict,
    evidence: Evidence,
    sentence: &'a str,
    warnings: &'a [String],
    status: lcp::Status,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    title: &'a str,
    units: UnitNames,
    plan: &'a Plan,
    route: Route,
    why: &'a str,
    routes: &'a [RouteEnd],
    form: &'a str,
    order: usize,
    attempts: &'a [String],
    pivots: usize,
    iterations: usize,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    convergence: &'a [Iteration],
    factorisations: usize,
    memory_bytes: usize,
    residuals: Option<lcp::Residuals>,
    coulomb_residuals: Option<lcp::Residuals>,
    balance: Option<Balance>,
    reactions: Option<ByName<'a, Force>>,
    /// Sums of reactions of which only the sum is unique.
    corners: Option<Vec<Corner>>,
    weight: Force,
    loads: Force,
    load_groups: ByName<'a, Group<'a>>,
    contacts: Option<Contacts>,
    strain_energy: Option<f64>,
    max_displacement: Option<Displacement<'a>>,
    max_compression: Option<Stress<'a>>,
    max_tension: Option<Stress<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    films: Option<Films>,
    proved: bool,
    soft: Option<SoftReport>,
    #[serde(skip_serializing_if = "Option::is_none")]
    history: Option<history::Report<'a>>,
    mechanism: Option<ByName<'a, Vec<[f64; 2]>>>,
    time_s: ByName<'a, f64>,
    files: &'a [String],
}

/// The unit of every physical quantity in the object; `1` marks what has none.
#[derive(Serialize)]
struct UnitNames {
    length: &'static str,
    force: &'static str,
    stress: String,
    moment: String,
    energy: String,
    time: &'static str,
    residuals: &'static str,
    balance: &'static str,
    reactions: ForceUnits,
    strain_energy: String,
    max_displacement: &'static str,
    max_compression: String,
    max_tension: String,
    films: String,
    positions: &'static str,
    time_s: &'static str,
}

#[derive(Serialize)]
struct ForceUnits {
    fx: &'static str,
    fy: &'static str,
    m: String,
}

#[derive(Serialize)]
struct Balance {
    force: f64,
    moment: f64,
    uncarried_load: f64,
    nodal: f64,
    cone_violation: f64,
    penetration: f64,
    complementarity: f64,
    energy: f64,
    deformation: f64,
}

/// A reaction: force on the structure, and moment about the origin.
#[derive(Serialize)]
pub(super) struct Force {
    fx: f64,
    fy: f64,
    m: f64,
}

/// Supports that meet in a corner.
#[derive(Serialize)]
struct Corner {
    supports: Vec<String>,
    #[serde(flatten)]
    sum: Force,
}

impl Force {
    fn of(it: Resultant, units: InUnits) -> Self {
        let Resultant { force, moment } = it;
        let [fx, fy] = [force.x, force.y].map(|it| units.force(it));
        Self { fx, fy, m: units.energy(moment) }
    }
}

/// The loads of a group and their sum.
#[derive(Serialize)]
struct Group<'a> {
    #[serde(flatten)]
    sum: Force,
    loads: ByName<'a, Load>,
}

/// A load: its factor, times that of the step, and its resultant.
#[derive(Serialize)]
struct Load {
    factor: f64,
    #[serde(flatten)]
    resultant: Force,
}

impl<'a> Group<'a> {
    fn of(group: &LoadGroup<'a>, units: InUnits) -> Self {
        let load = |(load, resultant): &(&'a model::Load, Resultant)| {
            let resultant = Force::of(*resultant, units);
            (load.name.as_str(), Load { factor: load.factor, resultant })
        };
        Self {
            sum: Force::of(group.sum, units),
            loads: ByName(group.loads.iter().map(load).collect()),
        }
    }
}

#[derive(Serialize)]
struct Contacts {
    open: usize,
    stick: usize,
    slip: usize,
}

#[derive(Serialize)]
struct Films {
    sigma_y_min: f64,
    tau_max: f64,
    /// The largest in size, with its sign.
    #[serde(skip_serializing_if = "Option::is_none")]
    sigma_x: Option<f64>,
}

#[derive(Serialize)]
struct Displacement<'a> {
    value: f64,
    component: char,
    block: &'a str,
    x: f64,
    y: f64,
}

#[derive(Serialize)]
struct Stress<'a> {
    value: f64,
    block: &'a str,
    x: f64,
    y: f64,
}

/// An object with one member per name, in the order of the list.
pub(super) struct ByName<'a, T>(pub(super) Vec<(&'a str, T)>);

impl<T: Serialize> Serialize for ByName<'_, T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

impl<'a> Report<'a> {
    fn of(outcome: &'a Outcome, files: &'a [String]) -> Self {
        let (model, solve, judgement) = (&outcome.model, &outcome.solve, &outcome.judgement);
        let units = InUnits(model.units);
        let checks = outcome.checks.as_ref();
        let state = outcome.state.as_ref();
        let (compression, tension) = state.map_or((None, None), extreme_stresses);
        let stress = |it: summary::ExtremeStress| Stress {
            value: units.stress(it.value),
            block: block_name(model, it.block),
            x: units.length(it.position.x),
            y: units.length(it.position.y),
        };
        Self {
            verdict: judgement.verdict,
            evidence: judgement.evidence,
            sentence: &judgement.sentence,
            warnings: &judgement.warnings,
            status: solve.status,
            reason: reason(outcome),
            title: &outcome.title,
            units: UnitNames::of(units),
            plan: &outcome.plan,
            route: solve.route,
            why: &solve.because,
            routes: &solve.routes,
            form: &solve.form,
            order: solve.order,
            attempts: &solve.attempts,
            pivots: solve.pivots,
            iterations: solve.iterations,
            convergence: &solve.convergence,
            factorisations: solve.factorisations,
            memory_bytes: outcome.plan.memory_bytes(),
            residuals: state.map(|_| solve.residuals),
            coulomb_residuals: solve.coulomb_residuals,
            balance: checks.map(|checks| Balance {
                force: checks.force_balance,
                moment: checks.moment_balance,
                uncarried_load: checks.uncarried,
                nodal: checks.nodal_balance,
                cone_violation: checks.cone_violation,
                penetration: checks.penetration,
                complementarity: checks.complementarity,
                energy: checks.energy,
                deformation: checks.deformation,
            }),
            reactions: state.map(|_| {
                ByName(outcome.reactions.iter().map(|it| named_force(it, units)).collect())
            }),
            corners: state.map(|_| {
                let of =
                    |it: CornerSum| Corner { supports: it.supports, sum: Force::of(it.sum, units) };
                corner_sums(outcome).into_iter().map(of).collect()
            }),
            weight: Force::of(weight(model), units),
            loads: Force::of(summary::loads(model), units),
            load_groups: ByName(
                load_groups(model).iter().map(|it| (it.name, Group::of(it, units))).collect(),
            ),
            contacts: checks.map(|checks| Contacts {
                open: checks.open,
                stick: checks.stick,
                slip: checks.slip,
            }),
            strain_energy: state.map(|state| units.energy(state.strain_energy)),
            max_displacement: state.and_then(|state| largest_displacement(model, state)).map(
                |it| Displacement {
                    value: units.length(it.value),
                    component: it.component,
                    block: block_name(model, it.block),
                    x: units.length(it.position.x),
                    y: units.length(it.position.y),
                },
            ),
            max_compression: compression.map(stress),
            max_tension: tension.map(stress),
            films: state.and_then(extreme_film_stresses).map(|films| Films {
                sigma_y_min: units.stress(films.compression.sigma_y),
                tau_max: units.stress(films.shear.tau.abs()),
                sigma_x: films.along.sigma_x.map(|stress| units.stress(stress)),
            }),
            proved: solve.proved,
            soft: solve.soft,
            history: outcome
                .history
                .as_ref()
                .map(|history| history::Report::of(history, &model.supports, units)),
            mechanism: outcome.mechanism.as_ref().map(|rates| rates_by_name(model, rates)),
            time_s: ByName(
                outcome.times.iter().map(|time| (time.phase.as_str(), time.seconds)).collect(),
            ),
            files,
        }
    }
}

impl UnitNames {
    fn of(units: InUnits) -> Self {
        let units = units.0;
        let (length, force) = (units.length_name(), units.force_name());
        let (stress, energy) = (units.stress_name(), units.energy_name());
        Self {
            length,
            force,
            stress: stress.clone(),
            moment: energy.clone(),
            energy: energy.clone(),
            time: "s",
            residuals: "1",
            balance: "1",
            reactions: ForceUnits { fx: force, fy: force, m: energy.clone() },
            strain_energy: energy,
            max_displacement: length,
            max_compression: stress.clone(),
            max_tension: stress.clone(),
            films: stress,
            positions: length,
            time_s: "s",
        }
    }
}

pub(super) fn rates_by_name<'a>(
    model: &'a model::Model,
    rates: &[Vec<Vector2<f64>>],
) -> ByName<'a, Vec<[f64; 2]>> {
    let names = model.blocks.iter().map(|block| block.name.as_str());
    let rates = rates.iter().map(|corners| corners.iter().map(|rate| (*rate).into()).collect());
    ByName(names.zip(rates).collect())
}

pub(super) fn named_force(reaction: &Reaction, units: InUnits) -> (&str, Force) {
    let force = Force {
        fx: units.force(reaction.fx),
        fy: units.force(reaction.fy),
        m: units.energy(reaction.m),
    };
    (&reaction.support, force)
}
