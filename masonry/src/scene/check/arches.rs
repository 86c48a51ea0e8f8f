//! Checks of arches.

use super::{Check, check_mesh, point, unwanted, value};
use crate::scene::{Arch, Fault, Joint, KeyPath, Scene, arch};

impl Scene {
    /// Checks the names that an arch refers to, and that the arch can be built.
    pub(super) fn check_arch(&self, at: &KeyPath, arch: &Arch) -> Check {
        let material = self.material_of(at, &arch.material)?;
        point(&at.key("origin"), arch.origin.unwrap_or_default())?;
        for (k, line) in arch.lines.iter().flatten().enumerate() {
            point(&at.key("lines").item(k).item(0), line[0])?;
            point(&at.key("lines").item(k).item(1), line[1])?;
        }
        let because = "is for an arch of several rings";
        unwanted(
            arch.ring_joint.is_some() && arch.rings.unwrap_or(1) < 2,
            at,
            "ring_joint",
            because,
            ", or add `rings = 2`",
        )?;
        let classes = [
            ("joint", &arch.joint),
            ("ring_joint", &arch.ring_joint),
            ("springing", &arch.springing),
        ];
        for (key, class) in classes {
            let Some(class) = class else { continue };
            self.check_class(at.key(key), class)?;
            let mortar = self.joints.get(class).map_or(0.0, Joint::mortar_thickness);
            let wanted = "the joints of an arch are dry: name a class whose `thickness` is 0";
            value(at.key(key), mortar, mortar <= 0.0, wanted)?;
        }
        check_mesh(at, arch.mesh, material)?;
        arch::blocks(arch, at)?;
        for support in arch::supports(arch, at)? {
            if let Some(k) = self.supports.iter().position(|it| it.name == support.name) {
                let first = KeyPath::of("supports").item(k);
                return Err(Fault::duplicate(at.key("name"), "support", &support.name, &first));
            }
        }
        Ok(())
    }
}
