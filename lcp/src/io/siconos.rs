//! The `.dat` files of Siconos: linear complementarity problems, mixed ones, and contact with
//! friction in the plane.
//!
//! White space separates the words. Words for people may follow the last number, except of contact problems.

mod global;
mod matrix;
mod mixed;

use super::tokens::Tokens;
use super::{Problem, ReadError};

pub(super) use global::read_global;
pub(super) use mixed::read_mlcp;

/// `n`, matrix `M`, `q`.
pub(super) fn read_lcp(text: &str) -> Result<Problem, ReadError> {
    let mut tokens = Tokens::new(text);
    let n = tokens.count("the order n")?;
    tokens.room_for(Some(n), "q")?;
    let at = tokens.position();
    let m = matrix::read(&mut tokens, n, n)?;
    let q = tokens.numbers(n, "q")?;
    tokens.end_of_numbers(0)?;
    Problem::lcp(m, q, at)
}

/// `2`, `nc`, matrix `W`, `q`, `mu`; some files end with a flag, which says that they are complete.
pub(super) fn read_friction(text: &str) -> Result<Problem, ReadError> {
    let mut tokens = Tokens::new(text);
    tokens.fixed("the dimension", 2)?;
    let contacts = tokens.count("the number of contacts")?;
    tokens.room_for(contacts.checked_mul(3), "q and mu")?;
    let at = tokens.position();
    let w = matrix::read(&mut tokens, 2 * contacts, 2 * contacts)?;
    let q = tokens.numbers(2 * contacts, "q")?;
    let mu = frictions(&mut tokens, contacts)?;
    tokens.flag();
    tokens.end("correct the sizes, or take it out")?;
    Problem::friction(w, q, mu, at)
}

/// The coefficients of friction.
fn frictions(tokens: &mut Tokens<'_>, contacts: usize) -> Result<Vec<f64>, ReadError> {
    let mut mu = Vec::with_capacity(contacts);
    for _ in 0..contacts {
        let token = tokens.expect(|| "a coefficient of friction".to_owned())?;
        let value = token.number(|| "a coefficient of friction".to_owned())?;
        if value < 0.0 {
            let expected = "a coefficient of friction of 0 or more".to_owned();
            return Err(token.unexpected(expected, "friction acts against the sliding"));
        }
        mu.push(value);
    }
    Ok(mu)
}
