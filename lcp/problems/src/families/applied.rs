//! Problems of control and of finance.

use super::{Instance, Integers, KnownAnswer, standard};
use crate::sparse;
use lcp::{BoxedLcp, Lcp};

/// Model-predictive control of one state by one bounded input over some steps: states and multipliers are free.
///
/// `min sum x_k^2 + r u_k^2` under `x_{k+1} = a x_k + b u_k` and `|u_k| <= 1`, as the conditions of Karush, Kuhn and
/// Tucker for `(x, u, lambda)`. `a` is between 0.5 and 1.2, so that some systems are unstable; inputs are at their
/// bounds first, and states decay by powers of ten. There is one solution.
pub fn control(steps: usize, seed: u64) -> Instance<BoxedLcp> {
    let mut random = Integers::new(seed);
    let mut between = |low: f64, high: f64| low + (high - low) * random.0.next_f64();
    let (a, b) = (between(0.5, 1.2), between(0.2, 2.0));
    let (start, weight) = (between(-5.0, 5.0), 10.0_f64.powf(between(-2.0, 1.0)));
    let n = steps;
    let mut entries = Vec::new();
    let mut q = vec![0.0; 3 * n];
    for k in 0..n {
        let (state, input, multiplier) = (k, n + k, 2 * n + k);
        entries.extend([(state, state, 1.0), (input, input, weight)]);
        // x_{k+1} - a x_k - b u_k = 0, and its transpose with the other sign.
        let mut condition = vec![(state, 1.0), (input, -b)];
        if k > 0 {
            condition.push((state - 1, -a));
        }
        for (variable, factor) in condition {
            entries.extend([(multiplier, variable, factor), (variable, multiplier, -factor)]);
        }
    }
    if n > 0 {
        q[2 * n] = -a * start;
    }
    let bound = |k: usize| if (n..2 * n).contains(&k) { 1.0 } else { f64::INFINITY };
    let upper: Vec<f64> = (0..3 * n).map(bound).collect();
    let lower: Vec<f64> = upper.iter().map(|upper| -upper).collect();
    let m = sparse(3 * n, 3 * n, entries);
    let problem = BoxedLcp::new(m, q, lower, upper);
    let problem = problem.unwrap_or_else(|e| unreachable!("finite and of one order: {e}"));
    Instance { problem, known: KnownAnswer::Solvable }
}

/// A perpetual American put option with a strike of one, on a grid of `points` in the logarithm of the price: `z` is
/// the value of the option beyond its payoff. `M` is an M-matrix and not symmetric.
///
/// `r V - (r - s^2/2) V' - s^2/2 V'' >= 0` and `V >= 1 - S`, one of them with equality, for the interest `r` and the
/// volatility `s`. The option is exercised at prices up to `S* = g / (1 + g)`, with `g = 2 r / s^2`, and is worth
/// `(1 - S*) (S / S*)^-g` above (Merton 1973). The grid goes from `ln S*  - 1` to `ln S* + 4`, at which `V` is set to
/// this value.
pub fn perpetual_option(points: usize, interest: f64, volatility: f64) -> Instance<Lcp> {
    let variance = volatility * volatility;
    let g = 2.0 * interest / variance;
    let exercise = g / (1.0 + g);
    let step = 5.0 / (points + 1) as f64;
    let price = |i: usize| (exercise.ln() - 1.0 + step * i as f64).exp();
    let payoff = |i: usize| 1.0 - price(i);
    let second = 0.5 * variance / (step * step);
    // The first derivative from the side that keeps the signs of an M-matrix.
    let first = (interest - 0.5 * variance) / step;
    let (down, up) = (-second + first.min(0.0), -second - first.max(0.0));
    let middle = interest - down - up;
    let mut q: Vec<f64> = (1..=points)
        .map(|i| down * payoff(i - 1) + middle * payoff(i) + up * payoff(i + 1))
        .collect();
    if let Some(last) = q.last_mut() {
        let worth = (1.0 - exercise) * (price(points + 1) / exercise).powf(-g);
        *last += up * (worth - payoff(points + 1));
    }
    let entries = (0..points).flat_map(|i| {
        let below = (i > 0).then_some((i, i.wrapping_sub(1), down));
        let above = (i + 1 < points).then_some((i, i + 1, up));
        below.into_iter().chain([(i, i, middle)]).chain(above)
    });
    let problem = standard(sparse(points, points, entries), q);
    Instance { problem, known: KnownAnswer::Solvable }
}
