//! Tables of forces, loads, joints and contact points, which several reports show.

use nalgebra::Vector2;

use super::{Column, Digits, Table, Value, members, values};
use crate::model::{Body, Model};
use crate::report::format::{InUnits, Quantity, block_name, body_name};
use crate::report::hinges::yielding;
use crate::report::joints::{self, JointForce, Opening};
use crate::report::summary::{LoadGroup, Resultant};
use crate::state::{ContactState, ContactStatus, FilmStress, Reaction, State};

/// The parts of a force and its moment.
fn parts(digits: usize, on_page: usize) -> [Column; 3] {
    let column =
        |key, quantity| Column::number(key, quantity, Digits::Aligned(digits)).on_page(on_page);
    [column("fx", Quantity::Force), column("fy", Quantity::Force), column("m", Quantity::Energy)]
}

/// Forces with names.
pub(in crate::report) fn forces<'a>(
    units: InUnits,
    list: impl IntoIterator<Item = (&'a str, Resultant)>,
) -> Table {
    let mut columns = vec![Column::words("support")];
    columns.extend(parts(6, 5));
    let mut table = Table::new(units, columns);
    for (name, it) in list {
        table.row(values![name, it.force.x, it.force.y, it.moment]);
    }
    table
}

/// The reactions of supports.
pub(in crate::report) fn reactions(units: InUnits, list: &[Reaction]) -> Table {
    let of = |it: &Reaction| Resultant { force: Vector2::new(it.fx, it.fy), moment: it.m };
    forces(units, list.iter().map(|it| (it.support.as_str(), of(it))))
}

/// The loads of groups.
pub(in crate::report) fn loads(units: InUnits, groups: &[LoadGroup<'_>]) -> Table {
    let factor = Column::number("factor", Quantity::Pure, Digits::Significant(6)).on_page(4);
    let mut columns = vec![Column::words("load"), Column::words("group"), factor];
    columns.extend(parts(6, 4));
    let mut table = Table::new(units, columns);
    for group in groups {
        for (load, Resultant { force, moment }) in &group.loads {
            let name = load.name.as_str();
            table.row(values![name, group.name, load.factor, force.x, force.y, *moment]);
        }
    }
    table
}

/// By block the rates of its corners.
pub(in crate::report) fn rates_by_name(model: &Model, rates: &[Vec<Vector2<f64>>]) -> Value {
    let numbers = |of: [f64; 2]| Value::List(of.map(Value::Number).to_vec());
    let of_block = |rates: &Vec<Vector2<f64>>| {
        Value::List(rates.iter().map(|rate| numbers([rate.x, rate.y])).collect())
    };
    let names = model.blocks.iter().map(|block| block.name.clone());
    Value::Object(names.zip(rates.iter().map(of_block)).collect())
}

/// The bodies on both sides of a joint.
pub(in crate::report) fn sides(model: &Model, joint: usize) -> [&str; 2] {
    let joint = &model.joints[joint];
    [joint.a, Body::Block(joint.b)].map(|body| body_name(model, body))
}

/// What every joint carries and how far it has opened.
pub(in crate::report) fn joints(model: &Model, contacts: &[ContactState]) -> Table {
    let (forces, openings) = (joints::forces(model, contacts), joints::openings(model, contacts));
    let number =
        |key: &str, quantity, digits| Column::number(key, quantity, Digits::Significant(digits));
    let mut columns = vec![
        Column::count("joint"),
        Column::words("between"),
        Column::words("and"),
        Column::words("class"),
        number("N", Quantity::Force, 4),
        number("T", Quantity::Force, 4),
        number("e / l", Quantity::Pure, 3),
        number("friction used", Quantity::Percent, 3),
    ];
    if !openings.is_empty() {
        columns.push(number("open", Quantity::Millimetres, 3));
        columns.push(number("slip", Quantity::Millimetres, 3));
    }
    let mut table = Table::new(InUnits(model.units), columns);
    for (index, joint) in model.joints.iter().enumerate() {
        let carried = forces.iter().find(|it: &&JointForce| it.joint.index() == index);
        let opened = openings.iter().find(|it: &&Opening| it.joint.index() == index);
        if carried.is_none() && opened.is_none() {
            continue;
        }
        let [behind, front] = sides(model, index);
        table.row(values![
            index + 1,
            behind,
            front,
            model.joint_classes.get(joint.class).map_or("", |it| &it.name),
            carried.map(|it| it.normal),
            carried.map(|it| it.tangential),
            carried.map(|it| it.eccentricity),
            carried.and_then(|it| it.utilisation),
            opened.map(|it| it.widest),
            opened.map(|it| it.slip),
        ]);
    }
    table
}

/// The joints that yield in a mechanism, with the numbers of its picture.
pub(in crate::report) fn hinges(model: &Model, rates: &[Vec<Vector2<f64>>]) -> Table {
    /// Rates below this part of the largest are rounding errors.
    const NO_RATE: f64 = 1e-9;
    let rate = |key| Column::number(key, Quantity::Pure, Digits::Significant(3));
    let words = ["between", "and", "what it does"].map(Column::words);
    let mut columns = vec![Column::count("number")];
    columns.extend(words.into_iter().chain([rate("opens"), rate("slides")]));
    let mut table = Table::new(InUnits(model.units), columns);
    let mut marked = 0;
    for it in yielding(model, rates) {
        marked += usize::from(it.does.is_marked());
        let number = it.does.is_marked().then_some(marked);
        let [behind, front] = sides(model, it.joint.index());
        let [opens, slides] =
            [it.opens, it.slides].map(|rate| if rate > NO_RATE { rate } else { 0.0 });
        table.row(values![number, behind, front, it.does.name(), opens, slides]);
    }
    table
}

/// All contact points, in the order of the model.
pub(in crate::report) fn contacts(model: &Model, state: &State) -> Table {
    let number = |key: &str, quantity| Column::number(key, quantity, Digits::Power);
    let mut columns = vec![Column::count("index"), Column::count("joint")];
    columns.extend(["class", "a", "b"].map(Column::words));
    columns.extend([
        number("x", Quantity::Length),
        number("y", Quantity::Length),
        number("area", Quantity::Area),
        number("t_n", Quantity::Force),
        number("t_t", Quantity::Force),
        number("traction_n", Quantity::Stress),
        number("traction_t", Quantity::Stress),
        number("gap", Quantity::Length),
        number("slip", Quantity::Length),
        number("mu", Quantity::Pure),
        Column::words("status"),
    ]);
    let of_films = film_columns(state);
    columns.extend(of_films.iter().map(|(key, _)| number(key, Quantity::Stress)));
    let mut table = Table::new(InUnits(model.units), columns);
    let mut films = state.films.iter().peekable();
    for (index, (contact, force)) in model.contacts.iter().zip(&state.contacts).enumerate() {
        let joint = &model.joints[contact.joint.index()];
        let traction = |force: f64| if contact.weight > 0.0 { force / contact.weight } else { 0.0 };
        let mut row = values![
            index,
            contact.joint.index(),
            model.joint_classes.get(joint.class).map_or("", |class| &class.name),
            match contact.a {
                Some(anchor) => block_name(model, anchor.block),
                None => body_name(model, joint.a),
            },
            block_name(model, joint.b),
            contact.position.x,
            contact.position.y,
            contact.weight,
            force.t_n,
            force.t_t,
            traction(force.t_n),
            traction(force.t_t),
            force.y_n,
            force.y_t,
            contact.law.mu,
            status_name(force.status),
        ];
        let film = films.next_if(|film| film.contact.index() == index);
        row.extend(of_films.iter().map(|(_, stress)| Value::from(film.and_then(*stress))));
        table.row(row);
    }
    table
}

/// The name of a column and the stress in it.
type FilmColumn = (&'static str, fn(&FilmStress) -> Option<f64>);

const FILM_COLUMNS: [FilmColumn; 3] = [
    ("film_sigma_x", |film| film.sigma_x),
    ("film_sigma_y", |film| Some(film.sigma_y)),
    ("film_tau", |film| Some(film.tau)),
];

/// The columns for which there are values.
fn film_columns(state: &State) -> &'static [FilmColumn] {
    match state.films.first() {
        None => &[],
        Some(film) if film.sigma_x.is_none() => &FILM_COLUMNS[1..],
        Some(_) => &FILM_COLUMNS,
    }
}

fn status_name(status: ContactStatus) -> &'static str {
    match status {
        ContactStatus::Open => "open",
        ContactStatus::Stick => "stick",
        ContactStatus::Slip => "slip",
    }
}

/// The numbers of contact points that are open, stick and slip.
pub(in crate::report) fn counts([open, stick, slip]: [usize; 3]) -> Value {
    Value::Object(members! { "open": open, "stick": stick, "slip": slip })
}
