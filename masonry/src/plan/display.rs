//! The plan as a block of text.

use std::fmt;

use super::Plan;

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{:<14}{:<5}{:>9}  because", "effect", "", "unknowns")?;
        for effect in &self.effects {
            let (name, on) = (effect.name, if effect.on { "on" } else { "off" });
            writeln!(f, "{name:<14}{on:<5}{:>9}  {}", effect.unknowns, effect.because)?;
        }
        writeln!(f)?;
        for (what, number, note) in [
            ("blocks", self.blocks, String::new()),
            ("nodes", self.nodes, String::new()),
            ("joints", self.joints, String::new()),
            (
                "contact points",
                self.contact_points,
                format!("{} with friction", self.frictional_points),
            ),
            ("rigid modes", self.rigid_modes, "3 per block, as many isostatic rows".to_owned()),
            ("order", self.order, "of the complementarity problem".to_owned()),
        ] {
            writeln!(f, "{}", format!("{what:<18}{number:>10}  {note}").trim_end())?;
        }
        writeln!(f, "{:<18}{:>10}  dense A, B and basis", "memory", bytes(self.dense_bytes))?;
        writeln!(f, "{:<18}{}", "solver", self.solver)?;
        write!(f, "{:<18}{}", "because", self.because)
    }
}

fn bytes(bytes: usize) -> String {
    let mut size = bytes as f64;
    for unit in ["B", "kB", "MB", "GB"] {
        if size < 1000.0 {
            return format!("{size:.0} {unit}");
        }
        size /= 1000.0;
    }
    format!("{size:.0} TB")
}
