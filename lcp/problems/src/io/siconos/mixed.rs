//! Mixed problems of Siconos: `A u + C v + a = 0`, `w = D u + B v + b`, `0 <= v`, `0 <= w`,
//! `v.w = 0`.

use faer::Mat;

use super::matrix;
use crate::io::problem::posed;
use crate::io::tokens::Tokens;
use crate::io::{Position, Problem, ReadError};
use lcp::{Matrix, MixedLcp};

/// Two flags, one for each of two representations that may follow; `n` equalities and `m`
/// complementarities; then the representations.
pub(in crate::io) fn read_mlcp(text: &str) -> Result<Problem, ReadError> {
    let mut tokens = Tokens::new(text);
    let in_one = flag(&mut tokens, "storage type 1: 0 or 1")?;
    let in_four = flag(&mut tokens, "storage type 2: 0 or 1")?;
    let n = tokens.count("the number of equalities")?;
    let m = tokens.count("the number of complementarities")?;
    tokens.room_for(n.checked_add(m), "the vectors")?;
    let at = tokens.position();
    let mixed = match (in_one, in_four) {
        (true, false) => Mixed::one_matrix(&mut tokens, n, m)?,
        (false, true) => Mixed::four_matrices(&mut tokens, n, m)?,
        (true, true) => {
            let mixed = Mixed::one_matrix(&mut tokens, n, m)?;
            let at = tokens.position();
            let again = Mixed::four_matrices(&mut tokens, n, m)?;
            mixed.check_against(&again, at)?;
            mixed
        }
        (false, false) => {
            let (expected, found) = ("one of the two representations", "storage types 0 and 0");
            let remedy = "set one of the storage types to 1";
            return Err(ReadError::unexpected(at, expected, found, remedy));
        }
    };
    // Some files end with the known values of the variables and of w.
    tokens.end_of_numbers(n + 2 * m)?;
    let Mixed { m, q, free } = mixed;
    posed(MixedLcp::new(m, q, free), Problem::Mixed, at)
}

fn flag(tokens: &mut Tokens<'_>, what: &'static str) -> Result<bool, ReadError> {
    Ok(tokens.one_of(&["0", "1"], what)? == 1)
}

/// `w = M z + q`; `z_i` is free and `w_i = 0` if `free[i]`.
struct Mixed {
    m: Matrix,
    q: Vec<f64>,
    free: Vec<bool>,
}

impl Mixed {
    /// The ends of the blocks, which of them are equalities, `M` and `q`.
    fn one_matrix(tokens: &mut Tokens<'_>, n: usize, m: usize) -> Result<Self, ReadError> {
        let order = n + m;
        tokens.fixed("the begin of the first block", 0)?;
        let mut ends = Vec::new();
        let mut end = 0;
        while end < order {
            let expected = format_args!("an end of a block above {end} and up to {order}");
            let remedy = "the blocks together have n + m rows";
            end = tokens.count_if(expected, remedy, |next| next > end && next <= order)?;
            ends.push(end);
        }
        let at = tokens.position();
        let mut free = Vec::with_capacity(order);
        for end in ends {
            let is_complementarity = flag(tokens, "0 (equalities) or 1 (complementarities)")?;
            free.resize(end, !is_complementarity);
        }
        let equalities = free.iter().filter(|&&free| free).count();
        if equalities != n {
            let expected = format_args!("blocks with {n} equalities");
            let remedy = "the kinds of the blocks must agree with n and m";
            return Err(ReadError::unexpected(at, expected, equalities, remedy));
        }
        Ok(Self { m: matrix::read(tokens, order, order)?, q: tokens.numbers(order, "q")?, free })
    }

    /// `A` (n x n), `B` (m x m), `C` (n x m) and `D` (m x n) by rows, `a` and `b`.
    fn four_matrices(tokens: &mut Tokens<'_>, n: usize, m: usize) -> Result<Self, ReadError> {
        let order = n + m;
        let all = order.checked_mul(order).and_then(|square| square.checked_add(order));
        tokens.room_for(all, "the four matrices and two vectors")?;
        let mut matrix = Mat::zeros(order, order);
        let blocks = [
            ("A", 0..n, 0..n),
            ("B", n..order, n..order),
            ("C", 0..n, n..order),
            ("D", n..order, 0..n),
        ];
        for (what, rows, cols) in blocks {
            for row in rows {
                let values = tokens.numbers(cols.len(), what)?;
                cols.clone().zip(values).for_each(|(col, v)| matrix[(row, col)] = v);
            }
        }
        let mut q = tokens.numbers(n, "a")?;
        q.extend(tokens.numbers(m, "b")?);
        let free = (0..order).map(|row| row < n).collect();
        Ok(Self { m: matrix.into(), q, free })
    }

    /// Refuses a file whose two representations are different problems.
    ///
    /// `again` has the equalities first.
    fn check_against(&self, again: &Self, at: Position) -> Result<(), ReadError> {
        let mut place: Vec<usize> = (0..self.q.len()).collect();
        place.sort_by_key(|&row| !self.free[row]);
        let agree = |name: std::fmt::Arguments<'_>, first: f64, second: f64| {
            // The numbers agree up to the six digits that some files have.
            if (first - second).abs() <= 1e-5 * first.abs().max(second.abs()) {
                return Ok(());
            }
            let expected = format_args!("{name} = {first}, as in the first representation");
            let remedy = "the two representations of the problem must agree";
            Err(ReadError::unexpected(at, expected, second, remedy))
        };
        for (i, &row) in place.iter().enumerate() {
            agree(format_args!("q[{row}]"), self.q[row], again.q[i])?;
            for (j, &col) in place.iter().enumerate() {
                agree(format_args!("M[{row}, {col}]"), self.m[(row, col)], again.m[(i, j)])?;
            }
        }
        Ok(())
    }
}
