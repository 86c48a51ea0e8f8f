//! Contact with friction in the plane, reduced to the contacts, or with the velocities of the bodies as unknowns:
//! `M v = q + H r`, `u = H^T v + b`, with the forces `r` and the velocities `u` of the contacts.

use super::matrix;
use crate::io::problem::posed;
use crate::io::tokens::Tokens;
use crate::io::{Problem, ReadError};
use crate::sparse;
use lcp::{Contact2d, Friction2d, Matrix};

/// `2`, `nc`, matrix `W`, `q`, `mu`; some files end with a flag that marks them as complete.
pub(in crate::io) fn read_friction(text: &str) -> Result<Problem, ReadError> {
    let mut tokens = Tokens::new(text);
    tokens.fixed("the dimension", 2)?;
    let contacts = tokens.count("the number of contacts")?;
    tokens.room_for(contacts.checked_mul(3), "q and mu")?;
    let at = tokens.position();
    let w = matrix::read(&mut tokens, 2 * contacts, 2 * contacts)?;
    let q = tokens.numbers(2 * contacts, "q")?;
    let mu = frictions(&mut tokens, contacts)?;
    let mut ahead = tokens.clone();
    if ahead.next().is_some_and(|token| matches!(token.text, "0" | "1")) {
        tokens = ahead;
    }
    tokens.end("correct the sizes, or remove the rest")?;
    posed(Friction2d::new(w, q, mu), Problem::Friction, at)
}

/// `2`, `nc`, matrix `M` of any order `n`, matrix `H` (n x 2 nc), `q`, `b`, `mu`.
pub(in crate::io) fn read_global(text: &str) -> Result<Problem, ReadError> {
    let mut tokens = Tokens::new(text);
    tokens.fixed("the dimension", 2)?;
    let contacts = tokens.count("the number of contacts")?;
    let of_contacts = contacts.checked_mul(3);
    tokens.room_for(of_contacts, "b and mu")?;
    let at = tokens.position();
    let n = matrix::rows_ahead(&tokens)?;
    tokens
        .room_for(of_contacts.and_then(|of_contacts| n.checked_add(of_contacts)), "q, b and mu")?;
    let m = matrix::read(&mut tokens, n, n)?;
    let h = matrix::read(&mut tokens, n, 2 * contacts)?;
    let q = tokens.numbers(n, "q")?;
    let b = tokens.numbers(2 * contacts, "b")?;
    let mu = frictions(&mut tokens, contacts)?;
    tokens.end("correct the sizes, or remove the rest")?;
    let [c_n, c_t] = [0, 1].map(|part| rows_of(&h, part));
    let of_contacts =
        |part: usize| -> Vec<f64> { b.iter().skip(part).step_by(2).copied().collect() };
    let problem = Contact2d::new(m, q, c_n, c_t, of_contacts(0), of_contacts(1), mu);
    posed(problem, Problem::Contact, at)
}

fn frictions(tokens: &mut Tokens<'_>, contacts: usize) -> Result<Vec<f64>, ReadError> {
    let coefficient = |_| {
        let token = tokens.expect("a coefficient of friction")?;
        let value = token.number("a coefficient of friction")?;
        if value >= 0.0 {
            return Ok(value);
        }
        let expected = "a coefficient of friction of 0 or more";
        Err(token.unexpected(expected, "friction acts against the sliding"))
    };
    (0..contacts).map(coefficient).collect()
}

/// Every second column of `H` as a row, starting with the first (normal) or the second one (tangential).
fn rows_of(h: &Matrix, part: usize) -> Matrix {
    let contacts = h.ncols() / 2;
    let row = |i: usize| h.column(2 * i + part).map(move |(j, v)| (i, j, v));
    let entries = (0..contacts).flat_map(row).filter(|(_, _, v)| *v != 0.0);
    sparse(contacts, h.nrows(), entries)
}
