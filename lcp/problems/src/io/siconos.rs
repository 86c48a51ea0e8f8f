//! The `.dat` files of Siconos: linear complementarity problems, mixed ones, relays, and contact with
//! friction in the plane.
//!
//! White space separates the words. Text for readers may follow the last number, except in contact problems.

mod contact;
mod matrix;
mod mixed;

use super::problem::posed;
use super::tokens::Tokens;
use super::{Position, Problem, ReadError};
use lcp::{BoxedLcp, Lcp, Matrix};

pub(super) use contact::{read_friction, read_global};
pub(super) use mixed::read_mlcp;

/// `n`, matrix `M`, `q`.
pub(super) fn read_lcp(text: &str) -> Result<Problem, ReadError> {
    let mut tokens = Tokens::new(text);
    let (at, m, q) = standard(&mut tokens)?;
    tokens.end_of_numbers(0)?;
    posed(Lcp::new(m, q), Problem::Lcp, at)
}

/// A relay: `n`, matrix `M`, `q`, the bounds `lb` and `ub` of `z`, and `-w` in their normal cone.
pub(super) fn read_relay(text: &str) -> Result<Problem, ReadError> {
    let mut tokens = Tokens::new(text);
    let (at, m, q) = standard(&mut tokens)?;
    let [lower, upper] = ["a lower bound", "an upper bound"].map(|what| {
        q.iter().map(|_| tokens.expect(what)?.bound(what)).collect::<Result<Vec<f64>, _>>()
    });
    let (lower, upper) = (lower?, upper?);
    tokens.end_of_numbers(0)?;
    posed(BoxedLcp::new(m, q, lower, upper), Problem::Boxed, at)
}

fn standard(tokens: &mut Tokens<'_>) -> Result<(Position, Matrix, Vec<f64>), ReadError> {
    let n = tokens.count("the order n")?;
    tokens.room_for(Some(n), "q")?;
    Ok((tokens.position(), matrix::read(tokens, n, n)?, tokens.numbers(n, "q")?))
}
