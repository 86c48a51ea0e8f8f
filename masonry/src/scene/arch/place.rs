//! Placement of the blocks and supports of an arch.

use super::lines::MOST;
use super::{Arch, JointLine, Piers, lines};
use crate::geometry::SAME_PLACE;
use crate::rounding::rounded;
use crate::scene::rules::{positive, value};
use crate::scene::{ArchError, Fault, KeyPath, Scene, Support};

/// Largest number of rings of one arch. Chosen: far more than bridges have.
const MOST_RINGS: u32 = 100;

/// A block of an arch with its name.
pub(crate) struct NamedBlock {
    pub(crate) name: String,
    /// The corners of the block \[length\].
    pub(crate) corners: [[f64; 2]; 4],
    /// The ring of a voussoir, counted from the intrados; `None` for blocks of piers.
    pub(crate) ring: Option<u32>,
}

/// Returns the blocks of an arch with their names: first the voussoirs from the left, then the blocks of piers.
pub(crate) fn blocks(arch: &Arch, at: &KeyPath) -> Result<Vec<NamedBlock>, Fault> {
    let lines = lines(arch, at)?;
    let mut blocks = Vec::new();
    let rings = arch.rings.unwrap_or(1);
    let wanted = "an arch has between 1 and 100 rings";
    value(at.key("rings"), f64::from(rings), (1..=MOST_RINGS).contains(&rings), wanted)?;
    for ring in 0..rings {
        let [inner, outer] = [ring, ring + 1].map(|it| f64::from(it) / f64::from(rings));
        for (k, pair) in lines.windows(2).enumerate() {
            let [from, to] = [pair[0], pair[1]];
            let corners = [on(from, inner), on(to, inner), on(to, outer), on(from, outer)];
            let name = match arch.rings {
                Some(_) => format!("{}/{}/{}", arch.name, ring + 1, k + 1),
                None => format!("{}/{}", arch.name, k + 1),
            };
            blocks.push(NamedBlock { name, corners, ring: Some(ring) });
        }
    }
    let Some(piers) = arch.piers else { return Ok(blocks) };
    for (side, sign, line) in ends(&lines) {
        let pier = pier(&piers, &at.key("piers"), side, sign, line)?;
        let named = |(k, corners)| NamedBlock {
            name: format!("{}/{side}/{}", arch.name, k + 1),
            corners,
            ring: None,
        };
        blocks.extend(pier.into_iter().enumerate().map(named));
    }
    Ok(blocks)
}

/// Returns the place at a fraction of a joint from the intrados; exactly the ends of the joint at 0 and 1.
fn on([[x, y], [to_x, to_y]]: JointLine, at: f64) -> [f64; 2] {
    if at >= 1.0 { [to_x, to_y] } else { [x + (to_x - x) * at, y + (to_y - y) * at] }
}

/// Returns the supports below both ends of an arch, along the springings or below the piers; none if `springing` is
/// not given.
pub(crate) fn supports(arch: &Arch, at: &KeyPath) -> Result<Vec<Support>, Fault> {
    let Some(class) = &arch.springing else { return Ok(Vec::new()) };
    let lines = lines(arch, at)?;
    let support = |(side, sign, [inner, outer]): (&str, f64, JointLine)| {
        let (from, to) = match arch.piers {
            Some(Piers { width, height, .. }) => {
                let y = inner[1] - height;
                ([inner[0], y], [inner[0] + sign * width, y])
            }
            None => (inner, outer),
        };
        Support::new(&format!("{}/{side}", arch.name), from, to, class)
    };
    Ok(ends(&lines).map(support).into())
}

impl Scene {
    /// Returns all supports: those of the scene, then those below its arches. An arch that cannot be built has no
    /// supports; [`Scene::check`] refuses it.
    pub fn all_supports(&self) -> Vec<Support> {
        let of_arches = self.arches.iter().enumerate().flat_map(|(k, arch)| {
            supports(arch, &KeyPath::of("arches").item(k)).unwrap_or_default()
        });
        self.supports.iter().cloned().chain(of_arches).collect()
    }

    /// Returns the names of the materials that walls, lintels, arches and blocks use.
    pub(crate) fn used_materials(&self) -> impl Iterator<Item = &str> {
        let of_walls = self.walls.iter().map(|wall| &wall.material);
        let of_arches = self.arches.iter().map(|arch| &arch.material);
        let of_blocks = self.blocks.iter().map(|block| &block.material);
        let openings = self.walls.iter().flat_map(|wall| &wall.openings);
        let of_lintels = openings.filter_map(|it| it.lintel.as_ref()?.material.as_ref());
        of_walls.chain(of_lintels).chain(of_arches).chain(of_blocks).map(String::as_str)
    }
}

/// Returns both springings, each with its name and the direction along x in which its pier lies.
fn ends(lines: &[JointLine]) -> [(&'static str, f64, JointLine); 2] {
    [("left", -1.0, lines[0]), ("right", 1.0, lines[lines.len() - 1])]
}

/// Returns the blocks of a pier from the bottom; the last one has the face of an inclined springing.
fn pier(
    piers: &Piers,
    at: &KeyPath,
    side: &'static str,
    sign: f64,
    [inner, outer]: JointLine,
) -> Result<Vec<[[f64; 2]; 4]>, Fault> {
    let Piers { width, height, courses } = *piers;
    positive(at.key("width"), width)?;
    positive(at.key("height"), height)?;
    let wanted = "a pier has between 1 and 10000 blocks";
    value(at.key("courses"), f64::from(courses), (1..=MOST).contains(&courses), wanted)?;
    let (reach, rises) = (sign * (outer[0] - inner[0]), outer[1] - inner[1]);
    let level = SAME_PLACE * reach.hypot(rises);
    if rises < -level || reach < -level {
        return Err(Fault::new(at.clone(), ArchError::Overhang(side)));
    }
    let is_level = rises <= level;
    if width < reach - level || (!is_level && width <= reach + level) {
        let error = ArchError::NarrowPier { width, least: rounded(reach) };
        return Err(Fault::new(at.key("width"), error));
    }
    let far = inner[0] + sign * width;
    let (left, right) = (far.min(inner[0]), far.max(inner[0]));
    let level_at = |k: u32| inner[1] - height * f64::from(courses - k) / f64::from(courses);
    let mut blocks: Vec<[[f64; 2]; 4]> = (0..courses)
        .map(|k| [level_at(k), level_at(k + 1)])
        .map(|[low, high]| [[left, low], [right, low], [right, high], [left, high]])
        .collect();
    if !is_level {
        blocks.push(if sign < 0.0 {
            [[far, inner[1]], inner, outer, [far, outer[1]]]
        } else {
            [inner, [far, inner[1]], [far, outer[1]], outer]
        });
    }
    Ok(blocks)
}
