//! Plain text: `n`, then `M` by rows, then `q`.

use faer::Mat;

use super::problem::posed;
use super::tokens::Tokens;
use super::{Problem, ReadError};
use lcp::Lcp;

pub(super) fn read(text: &str) -> Result<Problem, ReadError> {
    let mut tokens = Tokens::new(text);
    let n = tokens.count("the order n")?;
    tokens.room_for(n.checked_mul(n).and_then(|square| square.checked_add(n)), "M and q")?;
    let at = tokens.position();
    let by_rows = tokens.numbers(n * n, "M")?;
    let q = tokens.numbers(n, "q")?;
    tokens.end("there are n numbers of q after the n x n numbers of M, and nothing else")?;
    posed(Lcp::new(Mat::from_fn(n, n, |i, j| by_rows[i * n + j]), q), Problem::Lcp, at)
}
