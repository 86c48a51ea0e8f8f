//! Commented scenes with which a user can begin.

use serde::Serialize;

/// A commented scene with which a user can begin.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Beginning {
    /// The name of the scene, in one word.
    pub name: &'static str,
    /// A description of the scene, in a few words.
    pub meaning: &'static str,
    /// The text of the scene, in TOML.
    pub text: &'static str,
}

/// All scenes to begin with.
pub const BEGINNINGS: [Beginning; 7] = [
    Beginning {
        name: "wall",
        meaning: "A wall of rigid bricks with a window, pushed to the side",
        text: include_str!("../scenes/wall.toml"),
    },
    Beginning {
        name: "door",
        meaning: "A wall with a door and a beam above it",
        text: include_str!("../scenes/door.toml"),
    },
    Beginning {
        name: "arch",
        meaning: "A segmental arch on piers with a load on its crown",
        text: include_str!("../scenes/arch.toml"),
    },
    Beginning {
        name: "panel",
        meaning: "An elastic panel between rigid walls",
        text: include_str!("../scenes/panel.toml"),
    },
    Beginning {
        name: "facade",
        meaning: "A facade with floors and a roof that have mass, in an earthquake",
        text: include_str!("../scenes/facade.toml"),
    },
    Beginning {
        name: "bridge",
        meaning: "An arch bridge with earth behind its abutments and a lorry on it",
        text: include_str!("../scenes/bridge.toml"),
    },
    Beginning {
        name: "rubble",
        meaning: "A dry wall of irregular stones",
        text: include_str!("../scenes/rubble.toml"),
    },
];
