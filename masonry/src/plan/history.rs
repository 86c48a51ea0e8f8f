//! Whether the way to the last state matters, and so whether there is a load history.

use super::Effect;
use crate::history::moving_supports;
use crate::model::Model;
use crate::scene::Scene;

/// The steps that are solved: one, unless the answer depends on the way.
pub(super) fn steps(scene: &Scene, model: &Model) -> usize {
    if has_friction(model) { asked(scene).max(1) } else { 1 }
}

/// The effects that only a load history calls for.
pub(super) fn effects(scene: &Scene, model: &Model) -> [Effect; 3] {
    let (stages, asked, steps) = (scene.stages.len(), asked(scene), steps(scene, model));
    let because = match (stages, asked) {
        (0, _) => "the scene has no stages: all loads act at once".to_owned(),
        (_, 1) => "one stage of one step: the law of one step".to_owned(),
        _ if steps == 1 => {
            "mu = 0 in all joints: the last state does not depend on the way".to_owned()
        }
        _ => format!(
            "{stages} stage{} of {asked} steps in all, and friction: slip is carried over",
            if stages == 1 { "" } else { "s" }
        ),
    };
    let off = |name, because: String| Effect { name, on: false, because, unknowns: 0 };
    let history = Effect { on: steps > 1, ..off("load history", because) };

    let moving = moving_supports(scene);
    let movements = if moving.is_empty() {
        off("support movements", "no stage moves a support".to_owned())
    } else {
        let because = format!("stages move {}: gaps and slips are shifted", moving.join(", "));
        Effect { on: true, ..off("support movements", because) }
    };

    let dissipation = if history.on {
        let because = "friction and a load history".to_owned();
        Effect { on: true, ..off("dissipation", because) }
    } else {
        off("dissipation", "there is no load history".to_owned())
    };
    [history, movements, dissipation]
}

fn has_friction(model: &Model) -> bool {
    model.contacts.iter().any(|point| point.mu > 0.0)
}

/// The steps of all stages.
fn asked(scene: &Scene) -> usize {
    scene.stages.iter().map(|stage| stage.steps as usize).sum()
}
