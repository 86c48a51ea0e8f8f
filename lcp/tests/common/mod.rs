//! What the property tests share.

use proptest::prelude::ProptestConfig;
use proptest::test_runner::RngSeed;

/// At least so many cases, the same in every run; more by the environment variable `PROPTEST_CASES`,
/// others by `PROPTEST_RNG_SEED`.
pub(crate) fn cases(least: u32) -> ProptestConfig {
    let default = ProptestConfig::default();
    let rng_seed = match default.rng_seed {
        RngSeed::Random => RngSeed::Fixed(19_650_501),
        given @ RngSeed::Fixed(_) => given,
    };
    ProptestConfig { cases: default.cases.max(least), rng_seed, ..default }
}
