//! Contact with friction in the plane with the velocities of the bodies as unknowns:
//! `M v = q + H r`, `u = H^T v + b`, where the contacts have the forces `r` and the velocities `u`.

use super::{frictions, matrix};
use crate::io::tokens::Tokens;
use crate::io::{Problem, ReadError};
use crate::{Contact2d, Matrix};

/// `2`, `nc`, matrix `M` of any order `n`, matrix `H` (n x 2 nc), `q`, `b`, `mu`.
pub(in crate::io) fn read_global(text: &str) -> Result<Problem, ReadError> {
    let mut tokens = Tokens::new(text);
    tokens.fixed("the dimension", 2)?;
    let contacts = tokens.count("the number of contacts")?;
    let of_contacts = contacts.checked_mul(3);
    tokens.room_for(of_contacts, "b and mu")?;
    let at = tokens.position();
    let n = order(&tokens)?;
    tokens
        .room_for(of_contacts.and_then(|of_contacts| n.checked_add(of_contacts)), "q, b and mu")?;
    let m = matrix::read(&mut tokens, n, n)?;
    let h = matrix::read(&mut tokens, n, 2 * contacts)?;
    let q = tokens.numbers(n, "q")?;
    let b = tokens.numbers(2 * contacts, "b")?;
    let mu = frictions(&mut tokens, contacts)?;
    tokens.end("correct the sizes, or take it out")?;
    let [c_n, c_t] = [0, 1].map(|part| rows_of(&h, part));
    let of_contacts =
        |part: usize| -> Vec<f64> { b.iter().skip(part).step_by(2).copied().collect() };
    let problem = Contact2d::new(m, q, c_n, c_t, of_contacts(0), of_contacts(1), mu);
    Problem::contact(problem, None, at)
}

/// The order of the matrix that comes next: its word after the storage type.
fn order(tokens: &Tokens<'_>) -> Result<usize, ReadError> {
    let mut ahead = tokens.clone();
    matrix::storage(&mut ahead)?;
    ahead.count("the number of rows")
}

/// Every second column of `H` as a row, from the first (normal) or the second one (tangential) on.
fn rows_of(h: &Matrix, part: usize) -> Matrix {
    let contacts = h.ncols() / 2;
    let row = |i: usize| h.column(2 * i + part).map(move |(j, v)| (i, j, v));
    let entries = (0..contacts).flat_map(row).filter(|(_, _, v)| *v != 0.0);
    Matrix::from_entries(contacts, h.nrows(), entries)
}
