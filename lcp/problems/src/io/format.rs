//! The formats by name.

/// A format of files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ProblemFormat {
    /// The JSON of this crate.
    Json,
    /// Plain text: `n`, `M` by rows, `q`.
    Text,
    /// QPS, of convex quadratic programs.
    Qps,
    /// A linear complementarity problem of Siconos.
    SiconosLcp,
    /// A mixed linear complementarity problem of Siconos.
    SiconosMlcp,
    /// A relay of Siconos: variables between bounds.
    SiconosRelay,
    /// A contact problem of Siconos with friction in the plane, reduced to the contacts.
    SiconosFriction,
    /// A contact problem of Siconos with friction in the plane, with the velocities of the bodies.
    SiconosGlobalFriction,
}

impl ProblemFormat {
    /// All formats.
    pub const ALL: [Self; 8] = [
        Self::Json,
        Self::Text,
        Self::Qps,
        Self::SiconosLcp,
        Self::SiconosMlcp,
        Self::SiconosRelay,
        Self::SiconosFriction,
        Self::SiconosGlobalFriction,
    ];

    /// The name, as it is typed.
    pub fn name(self) -> &'static str {
        match self {
            Self::Json => "json",
            Self::Text => "text",
            Self::Qps => "qps",
            Self::SiconosLcp => "siconos-lcp",
            Self::SiconosMlcp => "siconos-mlcp",
            Self::SiconosRelay => "siconos-relay",
            Self::SiconosFriction => "siconos-friction",
            Self::SiconosGlobalFriction => "siconos-global-friction",
        }
    }
}

impl std::fmt::Display for ProblemFormat {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}
