//! What a document may be.

use serde::Deserialize;

/// The field `kind`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Kind {
    Lcp,
    Horizontal,
    Mixed,
    Boxed,
    Friction,
    Contact,
}

impl std::fmt::Display for Kind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Lcp => "lcp",
            Self::Horizontal => "horizontal",
            Self::Mixed => "mixed",
            Self::Boxed => "boxed",
            Self::Friction => "friction",
            Self::Contact => "contact",
        })
    }
}
