//! Meanings of the names of layers.

/// The material of blocks on layers without a name.
const MATERIAL: &str = "stone";

/// The kind of contents of a layer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Meaning {
    /// Blocks of a material, which the string names.
    Blocks(String),
    /// Supports whose name is the string.
    Supports(String),
    /// Lines along joints whose class is the string.
    Joints(String),
    /// Contents that are left out.
    Ignored,
}

impl Meaning {
    /// Returns the meaning of a layer: a name that begins with `support` or `joint` gives the kind of contents, other
    /// names are materials.
    pub(crate) fn of(layer: &str, ignored: &[String]) -> Self {
        let is = |name: &str| layer.eq_ignore_ascii_case(name);
        // Layers with the name `defpoints` are not printed, and layers of results are written by `masonry draw`.
        let is_result = layer.to_ascii_lowercase().starts_with("result_");
        if is("defpoints") || is_result || ignored.iter().any(|name| is(name)) {
            return Self::Ignored;
        }
        let name = plain(layer);
        let lower = name.to_ascii_lowercase();
        let after = |word: &str| {
            let rest = lower.strip_prefix(word)?;
            let rest = rest.strip_prefix('s').unwrap_or(rest);
            let ends = rest.is_empty() || rest.starts_with(|c: char| "_-".contains(c));
            ends.then(|| name[name.len() - rest.len()..].trim_matches(['_', '-']).to_owned())
        };
        match (after("support"), after("joint")) {
            (Some(rest), _) if rest.is_empty() => Self::Supports("support".to_owned()),
            (Some(rest), _) => Self::Supports(rest),
            (_, Some(rest)) if rest.is_empty() => Self::Joints("joint".to_owned()),
            (_, Some(rest)) => Self::Joints(rest),
            _ if name.is_empty() || name == "0" => Self::Blocks(MATERIAL.to_owned()),
            _ => Self::Blocks(name),
        }
    }
}

/// Returns a name with `_` for all characters except letters and digits.
fn plain(layer: &str) -> String {
    let kept = |c: char| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' };
    layer.trim().chars().map(kept).collect()
}
