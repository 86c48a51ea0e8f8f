//! The report as text.

mod history;

use super::figures::{Columns, Said, Table, on_text, solved, tables};
use super::format::{InUnits, significant};
use super::moving::moving_part;
use super::summary::{
    self, Resultant, applied_load, corner_sums, load_groups, reason, total_reaction, weight,
};
use super::svg::counted;
use super::text::{self, heads, pairs, paragraph, section, underlined};
use masonry::analysis::outcome::Outcome;
use masonry::data::info::SoftReport;
use masonry::data::verdict::Evidence;
use masonry::model::Model;
use masonry::plan::{Effect, Plan, PlannedRoute};
use masonry::scene::Route;
use masonry::units::Units;

/// Returns the whole report as text: verdict, reactions, state, history and loads; then the method, the model, and
/// times. Without a solution, the report states the reason.
pub fn report(outcome: &Outcome) -> String {
    let title = if outcome.title.is_empty() { "Untitled scene" } else { &outcome.title };
    let judgement = &outcome.judgement;
    let verdict = heads(&judgement.sentence, &judgement.warnings);
    let mut text = format!("{verdict}\n{}", underlined(title, "="));
    if let Some(reason) = reason(outcome) {
        text += &section("No equilibrium found");
        text += &paragraph(&reason);
    }
    if let Some(rates) = &outcome.mechanism {
        text += &section("Mechanism");
        let is_proof = judgement.evidence == Evidence::NoAdmissibleForces;
        let what = if is_proof { "moves in the proof" } else { "moves" };
        text += &pairs(&[(what, moving_part(&outcome.model, rates))]);
    }
    if outcome.state.is_some() {
        text += &section("Reactions on the structure");
        text += &reactions(outcome);
        text += &section("State");
        text += &pairs(&on_text(&[solved::checks(outcome), solved::state(outcome)].concat()));
    }
    if let Some(history) = &outcome.history {
        text += &section("Load history");
        text += &history::history(&outcome.model, history);
    }
    if !outcome.model.loads.is_empty() {
        text += &section("Loads");
        text += &loads(&outcome.model);
    }
    text += &section("Solution");
    text += &pairs(&solution(outcome));
    text += &section("Plan");
    text += &built(&outcome.plan);
    text += &section("Time");
    text += &pairs(&times(outcome));
    text
}

/// Returns a plan as text: effects with their reasons, sizes, and the solver.
pub fn plan(plan: &Plan) -> String {
    format!("{}\n{}", text::table(&effects(plan)), pairs(&figures(plan)))
}

/// Returns the plan of a solve as text; the unused effects are in one line.
fn built(plan: &Plan) -> String {
    let mut on = effects(plan).without("is_on");
    on.retain(|k| plan.effects[k].on);
    let off: Vec<&str> =
        plan.effects.iter().filter(|effect| !effect.on).map(|effect| effect.name).collect();
    let mut lines = figures(plan);
    lines.insert(0, ("not used", off.join(", ")));
    format!("{}\n{}", text::table(&on), pairs(&lines))
}

fn effects(plan: &Plan) -> Table {
    Columns::<&Effect>::new()
        .words("effect", |it| it.name)
        .words("is_on", |it| if it.on { "on" } else { "off" })
        .named("")
        .count("unknowns", |it| it.unknowns)
        .words("because", |it| &it.because)
        .words("expected cost", |it| &it.cost)
        .table(InUnits(Units::SI), &plan.effects)
}

fn figures(plan: &Plan) -> Vec<Said> {
    let sizes = format!(
        "{}, {}, {}, {} ({} with friction), {}",
        counted(plan.blocks, "block"),
        counted(plan.nodes, "node"),
        counted(plan.joints, "joint"),
        counted(plan.contact_points, "contact point"),
        plan.frictional_points,
        counted(plan.rigid_modes, "rigid amplitude")
    );
    let mut lines = vec![
        ("sizes", sizes),
        ("order", plan.order.to_string()),
        ("memory", memory(&plan.routes)),
        ("solver", format!("{}: {}", plan.solver, plan.because)),
    ];
    lines.extend(plan.refused.iter().map(|why| ("refused", why.clone())));
    for (index, choice) in plan.routes.iter().enumerate() {
        let head = if index == 0 { "route" } else { "" };
        lines.push((head, format!("{}: {}", choice.route.name(), choice.because)));
    }
    lines
}

fn residuals(it: &lcp::Residuals) -> String {
    solved::listed(&[
        ("equation", it.equation),
        ("feasibility", it.feasibility),
        ("complementarity", it.complementarity),
        ("natural", it.natural),
        ("loads", it.loads),
    ])
}

/// Returns the memory of the first route, and that of the route that needs the most if it is run, as text in units of
/// 10^6 bytes.
fn memory(routes: &[PlannedRoute]) -> String {
    let megabytes =
        |it: &PlannedRoute| format!("{} MB", significant(it.memory_bytes as f64 / 1e6, 2));
    let most = routes.iter().max_by_key(|it| it.memory_bytes);
    let first = routes.first().map_or_else(String::new, megabytes);
    match most.filter(|most| routes[0].memory_bytes < most.memory_bytes) {
        Some(most) => {
            format!("about {first}; {} if {} is asked", megabytes(most), most.route.name())
        }
        None => format!("about {first}"),
    }
}

fn solution(outcome: &Outcome) -> Vec<Said> {
    let solve = &outcome.solve;
    let mut rows = vec![
        ("status", format!("{:?}", solve.status)),
        ("route", format!("{}: {}", solve.route.name(), solve.because)),
        ("form", format!("{}, order {}", solve.form, solve.order)),
    ];
    if solve.route == Route::Lemke {
        rows.push(("pivots", solve.pivots.to_string()));
    } else {
        rows.push(("iterations", solve.iterations.to_string()));
    }
    rows.push(("factorisations", solve.factorisations.to_string()));
    for (index, attempt) in solve.attempts.iter().enumerate() {
        rows.push((if index == 0 { "attempts" } else { "" }, attempt.to_string()));
    }
    if let Some(soft) = &solve.soft {
        rows.push(("soft springs", bias(soft)));
    }
    if outcome.state.is_some() {
        rows.push(("residuals", residuals(&solve.residuals)));
    }
    if let Some(paper) = &solve.coulomb_residuals {
        rows.push(("(3.27)", format!("{}, of the same solution in this form", residuals(paper))));
    }
    rows
}

fn bias(soft: &SoftReport) -> String {
    let share = significant(soft.share, 3);
    let error = soft.displacement_error.map_or_else(String::new, |error| {
        format!(" and changed the displacements by a fraction of {}", significant(error, 3))
    });
    format!(
        "of stiffness {:.0e}, re-centred {} times; at first they carried {share} of the load{error}",
        soft.stiffness, soft.rounds
    )
}

fn reactions(outcome: &Outcome) -> String {
    let (units, model) = (InUnits(outcome.model.units), &outcome.model);
    let (sum, load) = (total_reaction(outcome), applied_load(model));
    let rest = Resultant { force: sum.force + load.force, moment: sum.moment + load.moment };
    let mut totals = vec![("sum of reactions", sum)];
    let (weight, loads) = (weight(model), summary::loads(model));
    if weight != Resultant::default() && loads != Resultant::default() {
        totals.extend([("self weight", weight), ("loads", loads)]);
    }
    totals.extend([("applied load", load), ("unbalanced", rest)]);
    let corners = corner_sums(outcome);
    let names: Vec<String> = corners.iter().map(|it| it.supports.join(" + ")).collect();
    let corners = names.iter().map(String::as_str).zip(corners.iter().map(|it| it.sum));
    let mut table = tables::reactions(units, &outcome.reactions);
    table.rows.push(Vec::new());
    table.rows.extend(tables::forces(units, corners.chain(totals)).rows);
    let mut text = text::table(&table) + " Moments are about the origin.\n";
    if !names.is_empty() {
        text += " Only the sum (+) of supports that meet in a corner is unique.\n";
    }
    text
}

/// Returns the table of all loads with factor and resultant; groups of several loads have an additional row with their
/// sum.
fn loads(model: &Model) -> String {
    let table = tables::loads(InUnits(model.units), &load_groups(model), true);
    text::table(&table.only("group load factor fx fy m"))
}

fn times(outcome: &Outcome) -> Vec<(&str, String)> {
    let seconds = |value: f64| format!("{:>9.3} ms", 1e3 * value);
    let mut rows: Vec<(&str, String)> = Vec::new();
    for time in &outcome.times {
        rows.push((&time.phase, seconds(time.seconds)));
    }
    rows.push(("total", seconds(outcome.times.iter().map(|time| time.seconds).sum())));
    rows
}
