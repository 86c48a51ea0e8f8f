//! The variations of the attempts, and their order.

use super::constants::KINDS;
use super::start::Start;
use crate::pivoting::{AttemptCovering, AttemptEnd, AttemptStart};
use crate::random::SplitMix;

/// The start and the covering vector of an attempt.
#[derive(Debug, Clone, Copy)]
pub(super) struct Trial {
    pub(super) start: AttemptStart,
    pub(super) covering: AttemptCovering,
}

impl Trial {
    /// The attempt of this number, from 2, after the given ending of the last one. A basis that is not quite right is
    /// followed by attempts from that basis and, in turn, from the first start with random covering vectors, since
    /// paths from that basis may return to it. A ray is followed by another covering vector, another start basis, a
    /// pair in place of the artificial variable, then more start bases. The pair comes before the others if `is_game`.
    pub(super) fn after(
        last: &Self,
        end: AttemptEnd,
        number: usize,
        first: &Self,
        is_game: bool,
    ) -> Self {
        let seed = number as u64;
        match end {
            AttemptEnd::Complementary if last.start == AttemptStart::LastBasis => {
                let covering = AttemptCovering::Random { seed };
                return Self { covering, ..*first };
            }
            AttemptEnd::Complementary => {
                let covering = other(last.covering, seed);
                return Self { start: AttemptStart::LastBasis, covering };
            }
            // Other covering vectors are tried from a basis that is nearly right: paths from there are short.
            AttemptEnd::Ray if last.start == AttemptStart::LastBasis && number <= KINDS => {
                return Self { covering: AttemptCovering::Random { seed }, ..*last };
            }
            // The path of a pair of a game is too long: paths of other pairs lead to other solutions, or are shorter.
            AttemptEnd::PivotLimit => {
                if let AttemptCovering::Column { pair } = last.covering {
                    return Self { covering: AttemptCovering::Column { pair: pair + 1 }, ..*first };
                }
            }
            _ => {}
        }
        let flipped = AttemptStart::Flipped { seed };
        let pair = Self { covering: AttemptCovering::Column { pair: 0 }, ..*first };
        let more = Self { start: flipped, covering: AttemptCovering::Negative };
        let other_covering = Self { covering: other(first.covering, seed), ..*first };
        let kinds =
            if is_game { [pair, other_covering, more] } else { [other_covering, more, pair] };
        match number {
            2..=4 => kinds[number - 2],
            _ => more,
        }
    }
}

/// The covering vector in the rows of a start basis; zero for free variables. `given` is the vector of the settings, in
/// units of the basic variables.
pub(super) fn covering_vector(kind: AttemptCovering, start: &Start, given: &[f64]) -> Vec<f64> {
    let n = start.q.len();
    let mut covering: Vec<f64> = match kind {
        AttemptCovering::Ones | AttemptCovering::Column { .. } => vec![1.0; n],
        AttemptCovering::Negative => {
            let lowest = start.q.iter().fold(0.0, |lowest: f64, q| lowest.min(*q));
            let part = |q: &f64| if *q < 0.0 { q / lowest } else { 0.0 };
            start.q.iter().map(|q| 1.0 + part(q)).collect()
        }
        AttemptCovering::Random { seed } => {
            let mut random = SplitMix::new(seed);
            (0..n).map(|_| (6.0 * random.next_f64() - 3.0).exp2()).collect()
        }
        AttemptCovering::Given => {
            given.iter().zip(&start.row_factor).map(|(d, row)| d * row).collect()
        }
    };
    (0..n).filter(|&k| start.is_free(k)).for_each(|k| covering[k] = 0.0);
    covering
}

fn other(covering: AttemptCovering, seed: u64) -> AttemptCovering {
    match covering {
        AttemptCovering::Random { .. } => AttemptCovering::Ones,
        _ => AttemptCovering::Random { seed },
    }
}
