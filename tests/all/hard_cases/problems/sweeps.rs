//! What the methods give along a parameter, from easy to hopeless.

use lcp::Status;
use lcp_problems::families;

use super::case::{Case, End, Tried};
use super::conditioning::{minors, of_minors};
use super::data::{
    degenerate, dominant, exponents, gram, hilbert, ill_conditioned, rescaled, strict,
    with_solution,
};
use super::problem::{Method, Problem};
use super::{friction, pivots, redundant, unsolvable};

/// A family along its parameter.
pub struct Sweep {
    pub name: &'static str,
    pub parameter: &'static str,
    pub values: Vec<f64>,
    /// Whether there are solutions, at all values.
    pub is_solvable: bool,
    /// What every method gave at every value; nothing from methods that do not treat the problem.
    pub methods: Vec<(Method, Vec<Option<Found>>)>,
    /// What is wrong with it.
    pub wrong: Vec<String>,
}

/// What a method gave.
#[derive(Debug, Clone, Copy)]
pub struct Found {
    pub status: Status,
    /// Recomputed in numbers of twice the digits, as is the next.
    pub residual: f64,
    pub backward: f64,
}

/// All sweeps, on coarse grids.
pub fn sweeps() -> Vec<Sweep> {
    let powers: Vec<f64> = (0..=48_u8).step_by(6).map(|bits| f64::from(bits).exp2()).collect();
    let shares: Vec<f64> = (0..=10_u8).step_by(2).map(|tenths| f64::from(tenths) / 10.0).collect();
    let spreads: Vec<f64> = (0..=100_u8).step_by(20).map(|bits| f64::from(bits).exp2()).collect();
    let orders: Vec<f64> = (2..=14_u8).step_by(3).map(f64::from).collect();
    let lacks: Vec<f64> = (2..=30_i32).step_by(4).map(|bits| 2_f64.powi(-bits)).collect();
    let frictions: Vec<f64> = (-12..=12_i32).step_by(4).map(|tens| 10_f64.powi(tens)).collect();
    // At 2^50 factors in `f64` have no digit left, and no answer is measured by its loads as one.
    let stiffnesses: Vec<f64> =
        (0..=40_u8).step_by(10).map(|bits| f64::from(bits).exp2()).collect();
    let supports: Vec<f64> = [2_u8, 5, 12, 30, 80].map(f64::from).into();
    let lengths: Vec<f64> = [2_u8, 8, 14, 20, 26].map(f64::from).into();
    let small: Vec<f64> = (4..=44_u8).step_by(8).map(|bits| (-f64::from(bits)).exp2()).collect();
    let sizes: Vec<f64> = (-10..=10_i32).step_by(5).map(|k| 2_f64.powi(100 * k)).collect();
    let choices: Vec<f64> = [2_u8, 5, 10, 20].map(f64::from).into();
    vec![
        sweep(("ill-conditioned L D L^T, n = 8", "condition number of D"), powers, conditioned),
        sweep(
            (
                "pairs that vanish, C C^T + 1, n = 20",
                "part of the pairs of which both variables are 0",
            ),
            shares,
            vanishing,
        ),
        sweep(
            ("P-matrix in many units, n = 10", "largest factor of rows and of columns / smallest"),
            spreads,
            spread,
        ),
        sweep(("P-matrix of any size, n = 10", "factor of M and q"), sizes, resized),
        sweep(("Hilbert matrices", "order"), orders, hilbert_of),
        sweep(
            ("P-matrix with small minors, n = 6", "smallest minor of a diagonal block"),
            small,
            with_minors,
        ),
        sweep(
            ("two rows that contradict each other", "part by which the rows contradict each other"),
            lacks,
            contradicting,
        ),
        sweep(
            ("rigid body on a floor and a slope", "coefficient of friction"),
            frictions,
            friction::leaning,
        ),
        sweep(
            ("eight bodies between springs", "stiffness of the stiff springs / of the soft ones"),
            stiffnesses,
            springs,
        ),
        sweep(("rigid block on supports", "number of supports"), supports, supported),
        sweep(("groups of ones (families::ties)", "order"), [3.0, 10.0, 30.0, 90.0].into(), tied),
        sweep(("long paths (families::murty)", "order"), lengths.clone(), murty),
        sweep(("long paths (families::fathi)", "order"), lengths, fathi),
        sweep(("games (families::bimatrix)", "choices of either player"), choices, game),
    ]
}

fn sweep(
    (name, parameter): (&'static str, &'static str),
    values: Vec<f64>,
    case: impl Fn(f64) -> Case,
) -> Sweep {
    let tried: Vec<Tried> = values.iter().map(|value| case(*value).tried()).collect();
    let found = |end: &End| match end {
        End::Refused => None,
        End::Ended { solution, measure } => Some(Found {
            status: solution.status,
            residual: measure.residual,
            backward: measure.backward,
        }),
    };
    let of_method = |k: usize| tried.iter().map(|it| found(&it.ends[k])).collect();
    let methods = Method::ALL.into_iter().enumerate().map(|(k, it)| (it, of_method(k))).collect();
    let is_solvable = tried.iter().all(|it| it.case.is_solvable());
    let wrong = tried.iter().flat_map(Tried::wrong).collect();
    Sweep { name, parameter, values, is_solvable, methods, wrong }
}

fn conditioned(condition: f64) -> Case {
    let bits = whole(condition.log2());
    // Zero and one: with larger numbers `q` would be rounded.
    let at = |even: f64| (0..8).map(|i| if i % 2 == 0 { even } else { 1.0 - even }).collect();
    let point = (at(1.0), at(0.0));
    Case::new(
        &format!("condition {condition:e}"),
        "",
        with_solution(ill_conditioned(8, bits.into()), &point),
    )
    .unique(point, 1e2 * condition)
}

fn vanishing(share: f64) -> Case {
    let point = degenerate(20, whole(10.0 * share).into());
    let problem = with_solution(gram(20), &point);
    Case::new(&format!("share {share}"), "", problem).unique(point, 1e4)
}

fn spread(spread: f64) -> Case {
    let n = 10;
    let rows = exponents(n, 0.5 * spread.log2());
    let columns: Vec<f64> = rows.iter().rev().copied().collect();
    let (problem, point) = rescaled(&dominant(n), &strict(n), (&rows, &columns));
    let units =
        |exponents: &[f64], sign: f64| exponents.iter().map(|e| (sign * e).exp2()).collect();
    Case::new(&format!("spread {spread:e}"), "", problem).unique_in(
        point,
        1e3,
        (units(&columns, -1.0), units(&rows, 1.0)),
    )
}

fn hilbert_of(order: f64) -> Case {
    let n = whole(order).into();
    let point = strict(n);
    Case::new(&format!("order {n}"), "", with_solution(hilbert(n), &point))
        .unique(point, (3.5 * order).exp())
}

/// Shared by both rows, what is lacking is half of it, and the residual of a point near the origin half of that.
fn contradicting(lack: f64) -> Case {
    Case::new(&format!("without a solution by {lack:e}"), "", unsolvable::two(-lack)).enumerated()
}

fn springs(ratio: f64) -> Case {
    friction::chain(whole(ratio.log2()).into())
}

fn supported(number: f64) -> Case {
    let block = redundant::on_supports(whole(number));
    Case::new(&format!("{number} supports"), "", Problem::Contact(block)).solvable("")
}

fn with_minors(minor: f64) -> Case {
    let bits = whole(-minor.log2());
    let point = of_minors();
    let problem = with_solution(minors(bits.into()), &point);
    // Blocks near singular ones, by turns above one another: the condition number is that of their product.
    Case::new(&format!("minors of {minor:e}"), "", problem).unique(point, 1e8 / minor)
}

fn resized(factor: f64) -> Case {
    let n = 10;
    let (rows, columns) = (vec![factor.log2(); n], vec![0.0; n]);
    let (problem, point) = rescaled(&dominant(n), &strict(n), (&rows, &columns));
    let units = (vec![1.0; n], vec![factor; n]);
    Case::new(&format!("factor {factor:e}"), "", problem).unique_in(point, 1e3, units)
}

fn tied(order: f64) -> Case {
    let instance = families::ties(whole(order).into(), 1);
    Case::of(&format!("order {order}"), "", instance, (Problem::Standard, 1.0))
}

fn game(choices: f64) -> Case {
    let choices = whole(choices).into();
    let instance = families::bimatrix(choices, choices, 1);
    Case::of(&format!("{choices} choices"), "", instance, (Problem::Standard, 1.0))
}

fn fathi(order: f64) -> Case {
    let instance = families::fathi(whole(order).into());
    pivots::family(&format!("order {order}"), "", instance)
}

fn murty(order: f64) -> Case {
    let instance = families::murty(whole(order).into());
    pivots::family(&format!("order {order}"), "", instance)
}

/// A small number that is whole.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most a hundred")]
fn whole(number: f64) -> u8 {
    number.round() as u8
}
