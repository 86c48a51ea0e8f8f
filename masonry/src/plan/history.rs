//! Whether the way to the last state matters, and so whether there is a load history.

use super::effect::Effect;
use super::effects::RIGHT_HAND_SIDE;
use crate::history::moving_supports;
use crate::model::Model;
use crate::scene::Scene;

/// The steps that are solved: one, unless the answer depends on the way.
pub(super) fn steps(scene: &Scene, model: &Model) -> usize {
    if model.depends_on_way(scene) { scene.steps() } else { 1 }
}

/// The effects that only a load history calls for.
pub(super) fn effects(scene: &Scene, model: &Model) -> [Effect; 3] {
    let (stages, asked, steps) = (scene.stages.len(), scene.steps(), steps(scene, model));
    let off = |name, because: &str| Effect::off(name, because.to_owned());
    let on = |name, because: String, cost: &str| Effect::on(name, because, cost.to_owned());

    let history = match (stages, asked) {
        (0, _) => off("load history", "the scene has no stages: all loads act at once"),
        (_, 1) => off("load history", "one stage of one step: the law of one step"),
        _ if steps == 1 => {
            off("load history", "mu = 0 in all joints: the last state does not depend on the way")
        }
        _ => {
            let stages = format!("{stages} stage{}", if stages == 1 { "" } else { "s" });
            let because =
                format!("{stages} of {asked} steps in all, and friction: slip is carried over");
            on("load history", because, &format!("{steps} solves instead of one"))
        }
    };

    let moving = moving_supports(scene);
    let movements = if moving.is_empty() {
        off("support movements", "no stage moves a support")
    } else {
        let because = format!("stages move {}: gaps and slips are shifted", moving.join(", "));
        on("support movements", because, RIGHT_HAND_SIDE)
    };

    let dissipation = if history.on {
        let because = "friction and a load history".to_owned();
        on("dissipation", because, "a sum over contact points in every step")
    } else {
        off("dissipation", "there is no load history")
    };
    [history, movements, dissipation]
}
