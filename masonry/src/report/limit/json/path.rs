//! The path of a limit load as a part of its JSON object.

use serde::Serialize;

use crate::analysis::limit::{self, Change, Stand};
use crate::model::{Body, Model};
use crate::report::format::InUnits;
use crate::report::json::{ByName, Force, named_force, rates_by_name};

#[derive(Serialize)]
pub(super) struct Path<'a> {
    load_factor: Option<f64>,
    falls: Option<f64>,
    decided: bool,
    last_stable: Option<LastStable<'a>>,
    mechanism: Option<ByName<'a, Vec<[f64; 2]>>>,
    events: Vec<Event<'a>>,
    curve: Vec<State>,
    dry_joints: usize,
}

#[derive(Serialize)]
struct LastStable<'a> {
    #[serde(flatten)]
    state: State,
    reactions: ByName<'a, Force>,
}

#[derive(Serialize)]
struct State {
    load_factor: f64,
    displacement: f64,
    open: usize,
    stick: usize,
    slip: usize,
}

#[derive(Serialize)]
struct Event<'a> {
    /// The two bodies that meet.
    between: [&'a str; 2],
    /// The middle of the joint.
    at: [f64; 2],
    change: Change,
    after: f64,
    before: f64,
}

impl State {
    fn of(stand: &Stand, units: InUnits) -> Self {
        let [open, stick, slip] = stand.contacts;
        let displacement = units.length(stand.displacement);
        Self { load_factor: stand.load_factor, displacement, open, stick, slip }
    }
}

/// Names of the bodies on both sides of a joint.
pub(in crate::report::limit) fn sides<'a>(model: &'a Model, event: &limit::Event) -> [&'a str; 2] {
    let joint = &model.joints[event.joint.index()];
    let behind = match joint.a {
        Body::Block(id) => &model.blocks[id.index()].name,
        Body::Support(id) => &model.supports[id.index()].name,
    };
    [behind, &model.blocks[joint.b.index()].name]
}

pub(super) fn of(path: &limit::Path, units: InUnits) -> Path<'_> {
    let model = &path.model;
    let reactions = || ByName(path.reactions.iter().map(|it| named_force(it, units)).collect());
    let event = |event: &limit::Event| {
        let joint = &model.joints[event.joint.index()];
        let middle = nalgebra::center(&joint.from, &joint.to);
        Event {
            between: sides(model, event),
            at: [middle.x, middle.y].map(|it| units.length(it)),
            change: event.change,
            after: event.after,
            before: event.before,
        }
    };
    Path {
        load_factor: path.load_factor,
        falls: path.falls,
        decided: path.decided,
        last_stable: path
            .curve
            .last()
            .map(|it| LastStable { state: State::of(it, units), reactions: reactions() }),
        mechanism: path.mechanism.as_ref().map(|rates| rates_by_name(model, rates)),
        events: path.events.iter().map(event).collect(),
        curve: path.curve.iter().map(|it| State::of(it, units)).collect(),
        dry_joints: path.model.dry_joints(),
    }
}
