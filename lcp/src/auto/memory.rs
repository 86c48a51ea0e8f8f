//! Whether the memory suffices for pivots on dense matrices.

use super::constants::MATRICES;
use crate::{Error, Method};

/// Refuses orders of dense problems for which the system has not the memory that Lemke's method takes, before
/// it takes it.
pub(crate) fn check(is_sparse: bool, order: usize) -> Result<(), Error> {
    if is_sparse {
        return Ok(());
    }
    let entries = order.checked_mul(order).and_then(|square| square.checked_mul(MATRICES));
    let mut trial: Vec<f64> = Vec::new();
    match trial.try_reserve_exact(std::hint::black_box(entries.unwrap_or(usize::MAX))) {
        Ok(()) => Ok(()),
        Err(_) => Err(Error::NotTreated {
            method: Method::Lemke,
            reason: format!(
                "order {order} takes about {:.0} GB, which the system does not have: the method works \
                 with {MATRICES} dense matrices of this order",
                (MATRICES * size_of::<f64>()) as f64 * (order as f64).powi(2) / 1e9
            ),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three million unknowns: five dense matrices of them are more than any memory.
    #[test]
    fn an_order_beyond_the_memory_is_refused() {
        let message = check(false, 3_000_000).map_err(|error| error.to_string());
        let expected = "order 3000000 takes about 360000 GB, which the system does not have";
        assert!(message.is_err_and(|message| message.contains(expected)));
        assert!(check(false, 10).is_ok() && check(true, 3_000_000).is_ok());
    }
}
