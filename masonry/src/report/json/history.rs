//! The load history in the result.

use serde::Serialize;

use super::{ByName, Contacts, Force, named_force};
use crate::data::info::Way;
use crate::history::{History, SecondLoading, Step, StepRecord};
use crate::model::Support;
use crate::report::format::InUnits;
use crate::scene::{Movement, Route};

/// The load history; `failed` is the step that could not be solved.
#[derive(Serialize)]
pub(super) struct Report<'a> {
    steps: usize,
    solved: usize,
    failed: Option<At<'a>>,
    work: f64,
    dissipation: f64,
    second_loading: Option<SecondLoading>,
    records: Vec<Record<'a>>,
}

/// A step within its stage, from 1.
#[derive(Serialize)]
struct At<'a> {
    stage: &'a str,
    step: usize,
    of: usize,
}

#[derive(Serialize)]
struct Record<'a> {
    #[serde(flatten)]
    at: At<'a>,
    gravity: f64,
    loads: ByName<'a, f64>,
    moves: ByName<'a, Movement>,
    route: Route,
    way: Way,
    factorisations: usize,
    residual: f64,
    work: f64,
    dissipation: f64,
    friction_power: Option<f64>,
    energy_created: f64,
    dragged: f64,
    strain_energy: f64,
    /// `W - U - D` from the beginning.
    balance: f64,
    max_displacement: f64,
    contacts: Contacts,
    reactions: ByName<'a, Force>,
}

impl<'a> Report<'a> {
    pub(super) fn of(history: &'a History, supports: &'a [Support], units: InUnits) -> Self {
        let mut spent = 0.0;
        let record = |record: &'a StepRecord| {
            spent += record.work - record.dissipation;
            let balance = spent - record.strain_energy;
            Record::of(record, balance, (&history.loads, supports), units)
        };
        Self {
            steps: history.steps,
            solved: history.records.len(),
            failed: history.failed.as_ref().map(At::of),
            work: units.energy(history.work()),
            dissipation: units.energy(history.dissipation()),
            second_loading: history.second_loading,
            records: history.records.iter().map(record).collect(),
        }
    }
}

impl<'a> At<'a> {
    fn of(step: &'a Step) -> Self {
        At { stage: &step.stage, step: step.number, of: step.of }
    }
}

impl<'a> Record<'a> {
    fn of(
        record: &'a StepRecord,
        balance: f64,
        (loads, supports): (&'a [String], &'a [Support]),
        units: InUnits,
    ) -> Self {
        let actions = &record.step.actions;
        let factors = loads.iter().map(String::as_str).zip(actions.loads.iter().copied());
        let places = actions.movements.iter().map(|it| it.in_lengths(units.length(1.0)));
        let [open, stick, slip] = record.contacts;
        Self {
            at: At::of(&record.step),
            gravity: actions.gravity,
            loads: ByName(factors.collect()),
            moves: ByName(supports.iter().map(|it| it.name.as_str()).zip(places).collect()),
            route: record.route,
            way: record.way,
            factorisations: record.factorisations,
            residual: record.residuals.worst(),
            work: units.energy(record.work),
            dissipation: units.energy(record.dissipation),
            friction_power: record.friction_power,
            energy_created: units.energy(record.energy_created),
            dragged: units.energy(record.dragged),
            strain_energy: units.energy(record.strain_energy),
            balance: units.energy(balance),
            max_displacement: units.length(record.largest_displacement),
            contacts: Contacts { open, stick, slip },
            reactions: ByName(record.reactions.iter().map(|it| named_force(it, units)).collect()),
        }
    }
}
