//! Tables of forces, loads, joints and contact points, which several reports show.

use nalgebra::Vector2;

use super::Digits::{Aligned, Power, Significant};
use super::{Columns, Table, Value, members};
use crate::format::Quantity::{Area, Energy, Force, Length, Millimetres, Percent, Pure, Stress};
use crate::format::{InUnits, block_name, body_name};
use crate::hinges::{YieldingJoint, yielding};
use crate::joints::{self, JointForce, JointOpening};
use crate::summary::{LoadGroup, Resultant};
use masonry::data::state::{FilmStress, PointState, PointStatus, Reaction, State};
use masonry::model::{Body, JointPoint, Model, PlacedJoint};

/// Returns the table of named forces with their moments.
pub(crate) fn forces<'a>(
    units: InUnits,
    list: impl IntoIterator<Item = (&'a str, Resultant)>,
) -> Table {
    Columns::<(&str, Resultant)>::new()
        .words("support", |it| it.0)
        .number("fx", Force, Aligned(6), |it| it.1.force.x)
        .number("fy", Force, Aligned(6), |it| it.1.force.y)
        .number("m", Energy, Aligned(6), |it| it.1.moment)
        .table(units, list)
}

/// Returns the table of the reactions of supports.
pub(crate) fn reactions(units: InUnits, list: &[Reaction]) -> Table {
    let of = |it: &Reaction| Resultant { force: Vector2::new(it.fx, it.fy), moment: it.m };
    forces(units, list.iter().map(|it| (it.support.as_str(), of(it))))
}

/// A row of the table of loads: a load, or the sum of a group.
struct LoadRow<'a> {
    names: [&'a str; 2],
    factor: Option<f64>,
    sum: Resultant,
}

/// Returns the table of the loads of groups. The table for readers (`with_sums`) has sums, and the name of each group
/// once.
pub(crate) fn loads(units: InUnits, groups: &[LoadGroup<'_>], with_sums: bool) -> Table {
    let mut rows = Vec::new();
    for LoadGroup { name, loads, sum } in groups {
        for (k, (load, sum)) in loads.iter().enumerate() {
            let group = if with_sums && k > 0 { "" } else { name };
            rows.push(LoadRow { names: [&load.name, group], factor: Some(load.factor), sum: *sum });
        }
        if with_sums && loads.len() > 1 {
            rows.push(LoadRow { names: ["sum", ""], factor: None, sum: *sum });
        }
    }
    Columns::<LoadRow<'_>>::new()
        .words("load", |it| it.names[0])
        .words("group", |it| it.names[1])
        .number("factor", Pure, Significant(6), |it| it.factor.map_or("".into(), Value::from))
        .number("fx", Force, Aligned(6), |it| it.sum.force.x)
        .number("fy", Force, Aligned(6), |it| it.sum.force.y)
        .number("m", Energy, Aligned(6), |it| it.sum.moment)
        .table(units, rows)
}

/// Returns the displacement rates of the corners of every block by the name of the block.
pub(crate) fn rates_by_name(model: &Model, rates: &[Vec<Vector2<f64>>]) -> Value {
    let rate = |it: &Vector2<f64>| Value::List(vec![it.x.into(), it.y.into()]);
    let of_block = |rates: &Vec<Vector2<f64>>| Value::List(rates.iter().map(rate).collect());
    let names = model.blocks.iter().map(|block| block.name.clone());
    Value::Object(names.zip(rates.iter().map(of_block)).collect())
}

/// Returns the names of the bodies behind and in front of a joint.
pub(crate) fn sides<'a>(model: &'a Model, joint: &PlacedJoint) -> [&'a str; 2] {
    [joint.a, Body::Block(joint.b)].map(|body| body_name(model, body))
}

fn class<'a>(model: &'a Model, joint: &PlacedJoint) -> &'a str {
    model.joint_classes.get(joint.class).map_or("", |class| &class.name)
}

/// A joint that carries a force or has opened, in the table of joints.
struct JointRow<'a> {
    index: usize,
    joint: &'a PlacedJoint,
    carried: Option<&'a JointForce>,
    opened: Option<&'a JointOpening>,
}

/// Returns the table of the forces and openings of all joints.
pub(crate) fn joints(model: &Model, contacts: &[PointState]) -> Table {
    let (forces, openings) = (joints::forces(model, contacts), joints::openings(model, contacts));
    let rows = model.joints.iter().enumerate().map(|(index, joint)| JointRow {
        index,
        joint,
        carried: forces.iter().find(|it| it.joint.index() == index),
        opened: openings.iter().find(|it| it.joint.index() == index),
    });
    let table = Columns::<JointRow<'_>>::new()
        .count("joint", |it| it.index + 1)
        .words("between", |it| sides(model, it.joint)[0])
        .words("and", |it| sides(model, it.joint)[1])
        .words("class", |it| class(model, it.joint))
        .number("N", Force, Significant(4), |it| it.carried.map(|it| it.normal))
        .number("T", Force, Significant(4), |it| it.carried.map(|it| it.tangential))
        .number("e / l", Pure, Significant(3), |it| it.carried.map(|it| it.eccentricity))
        .number("used", Percent, Significant(3), |it| it.carried?.utilisation)
        .named("friction used")
        .number("open", Millimetres, Significant(3), |it| it.opened.map(|it| it.widest))
        .number("slip", Millimetres, Significant(3), |it| it.opened.map(|it| it.slip))
        .table(InUnits(model.units), rows.filter(|it| it.carried.is_some() || it.opened.is_some()));
    if openings.is_empty() { table.without("open slip") } else { table }
}

/// Returns the table of the joints that yield in a mechanism, with the numbers that they have in its picture.
pub(crate) fn hinges(model: &Model, rates: &[Vec<Vector2<f64>>]) -> Table {
    /// Rates below this part of the largest are rounding errors.
    const NO_RATE: f64 = 1e-9;
    let rate = |it: f64| if it > NO_RATE { it } else { 0.0 };
    let joint = |it: &YieldingJoint| &model.joints[it.joint.index()];
    Columns::<YieldingJoint>::new()
        .count("number", |it| it.number)
        .words("between", |it| sides(model, joint(it))[0])
        .words("and", |it| sides(model, joint(it))[1])
        .words("what it does", |it| it.does.name())
        .number("opens", Pure, Significant(3), |it| rate(it.opens))
        .number("slides", Pure, Significant(3), |it| rate(it.slides))
        .table(InUnits(model.units), yielding(model, rates))
}

/// A contact point and its state, in the table of contact points.
struct PointRow<'a> {
    index: usize,
    contact: &'a JointPoint,
    joint: &'a PlacedJoint,
    state: &'a PointState,
    film: Option<&'a FilmStress>,
}

impl PointRow<'_> {
    fn traction(&self, force: f64) -> f64 {
        if self.contact.weight > 0.0 { force / self.contact.weight } else { 0.0 }
    }
}

/// Returns the table of all contact points, in the order of the model.
pub(crate) fn contacts(model: &Model, state: &State) -> Table {
    let mut films = state.films.iter().peekable();
    let points = model.contacts.iter().zip(&state.contacts).enumerate();
    let rows = points.map(|(index, (contact, state))| PointRow {
        index,
        contact,
        joint: &model.joints[contact.joint.index()],
        state,
        film: films.next_if(|film| film.contact.index() == index),
    });
    let table = Columns::<PointRow<'_>>::new()
        .count("index", |it| it.index)
        .count("joint", |it| it.contact.joint.index())
        .words("class", |it| class(model, it.joint))
        .words("a", |it| match it.contact.a {
            Some(anchor) => block_name(model, anchor.block),
            None => body_name(model, it.joint.a),
        })
        .words("b", |it| block_name(model, it.joint.b))
        .number("x", Length, Power, |it| it.contact.position.x)
        .number("y", Length, Power, |it| it.contact.position.y)
        .number("area", Area, Power, |it| it.contact.weight)
        .number("t_n", Force, Power, |it| it.state.t_n)
        .number("t_t", Force, Power, |it| it.state.t_t)
        .number("traction_n", Stress, Power, |it| it.traction(it.state.t_n))
        .number("traction_t", Stress, Power, |it| it.traction(it.state.t_t))
        .number("gap", Length, Power, |it| it.state.y_n)
        .number("slip", Length, Power, |it| it.state.y_t)
        .number("mu", Pure, Power, |it| it.contact.law.mu)
        .words("status", |it| match it.state.status {
            PointStatus::Open => "open",
            PointStatus::Stick => "stick",
            PointStatus::Slip => "slip",
        })
        .number("film_sigma_x", Stress, Power, |it| it.film?.sigma_x)
        .number("film_sigma_y", Stress, Power, |it| Some(it.film?.sigma_y))
        .number("film_tau", Stress, Power, |it| Some(it.film?.tau))
        .table(InUnits(model.units), rows);
    match state.films.first() {
        None => table.without("film_sigma_x film_sigma_y film_tau"),
        Some(film) if film.sigma_x.is_none() => table.without("film_sigma_x"),
        Some(_) => table,
    }
}

/// Returns the numbers of contact points that are open, stick and slip as a value of a table.
pub(crate) fn counts([open, stick, slip]: [usize; 3]) -> Value {
    Value::Object(members! { "open": open, "stick": stick, "slip": slip })
}
