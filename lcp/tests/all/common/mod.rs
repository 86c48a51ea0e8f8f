//! What the property tests share.

pub(crate) mod bodies;
pub(crate) mod draw;
pub(crate) mod methods;
#[cfg(feature = "clarabel")]
pub(crate) mod quadratic;

use proptest::prelude::ProptestConfig;

/// At least so many cases; more by the environment variable `PROPTEST_CASES`. They are the same in
/// every run, as `.cargo/config.toml` fixes their seed; others by `PROPTEST_RNG_SEED`.
pub(crate) fn cases(least: u32) -> ProptestConfig {
    let default = ProptestConfig::default();
    ProptestConfig { cases: default.cases.max(least), ..default }
}
