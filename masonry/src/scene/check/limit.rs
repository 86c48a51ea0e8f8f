//! Checks of the settings of limit loads.

use super::{Check, at_least_one, at_most, finite, needed, positive, unwanted, value};
use crate::scene::groups::WEIGHT;
use crate::scene::limit::is_of_train;
use crate::scene::rules::{each, unknown};
use crate::scene::{Fault, KeyPath, Load, LoadError, Scene, SceneErrorKind, Seismic, Train, fill};

impl Scene {
    pub(super) fn check_limit(&self) -> Check {
        let at = KeyPath::of("limit");
        self.check_growing(&at.key("group"))?;
        self.limit.seismic.as_ref().map_or(Ok(()), |it| check_seismic(&at.key("seismic"), it))?;
        self.limit.train.as_ref().map_or(Ok(()), |it| self.check_train(&at.key("train"), it))
    }

    /// Checks that the growing load is a load, a group of loads, or the weight; a support is refused.
    fn check_growing(&self, at: &KeyPath) -> Check {
        let Some(name) = &self.limit.group else { return Ok(()) };
        if self.is_weight(name) {
            return Ok(());
        }
        if self.all_supports().iter().any(|support| support.name == *name)
            && !self.loads.iter().any(|load| load.is_called(name))
        {
            return Err(Fault::new(at.clone(), LoadError::Support(name.clone())));
        }
        self.check_load_name(at, name, self.gravity.map(|_| WEIGHT))
    }
}

/// Largest number of positions of a train. Chosen: far more than a curve shows.
const MOST_POSITIONS: u32 = 100_000;
/// Largest number of axles of a train. Chosen: more than the longest trains have on a bridge.
const MOST_AXLES: u32 = 1000;

impl Scene {
    fn check_train(&self, at: &KeyPath, train: &Train) -> Check {
        let axles = at.key("axles");
        if train.axles.is_empty() {
            let remedy = "give at least one axle, such as [[0.0, 100.0]]";
            return Err(Fault::new(axles, SceneErrorKind::EmptyList(remedy)));
        }
        at_most(axles.clone(), "axles of a train", train.axles.len() as f64, MOST_AXLES)?;
        for (k, [offset, force]) in train.axles.iter().enumerate() {
            finite(axles.item(k).item(0), *offset)?;
            positive(axles.item(k).item(1), *force)?;
        }
        finite(at.key("from"), train.from)?;
        finite(at.key("to"), train.to)?;
        let positions = at.key("positions");
        at_least_one(positions.clone(), train.positions, "a train has at least one position")?;
        at_most(positions, "positions of a train", f64::from(train.positions), MOST_POSITIONS)?;
        each("loads", &self.loads, check_beside_train)?;
        self.check_on_fill(at, &train.over, train.level, train.angle_deg)
    }

    /// Checks the body that carries an axle, and the angle at which the fill spreads its force.
    pub(super) fn check_on_fill(
        &self,
        at: &KeyPath,
        over: &str,
        level: Option<f64>,
        angle: f64,
    ) -> Check {
        self.check_body(at.key("over"), over)?;
        finite(at.key("level"), level.unwrap_or(0.0))?;
        let has_no_fill = level.is_none() && !fill::is_spread(&angle);
        let because = "is for an axle on fill, which spreads its force";
        unwanted(has_no_fill, at, "angle_deg", because, ", or give the `level` of the fill")?;
        let wanted = "an angle of spread is above 0 and at most 80 degrees";
        value(at.key("angle_deg"), angle, angle > 0.0 && angle <= 80.0, wanted)
    }

    /// Checks that an arch, a wall or a block has the name `name`.
    pub(super) fn check_body(&self, at: KeyPath, name: &str) -> Check {
        let names = || {
            let laid = self.arches.iter().map(|it| &it.name);
            let laid = laid.chain(self.walls.iter().map(|it| &it.name));
            laid.chain(self.blocks.iter().map(|it| &it.name))
        };
        if names().any(|it| it == name) {
            return Ok(());
        }
        let missing = "it under [[arches]]".to_owned();
        Err(unknown(at, "arch, wall or block", name, names().cloned().collect(), missing))
    }
}

/// Refuses a load with the name of the axles of a train. The load would grow with the axles, or be taken for one of
/// them.
fn check_beside_train(at: &KeyPath, load: &Load) -> Check {
    let names = [("name", Some(&load.name)), ("group", load.group.as_ref())];
    let taken =
        names.into_iter().find_map(|(key, name)| Some((key, name.filter(|it| is_of_train(it))?)));
    let Some((key, name)) = taken else { return Ok(()) };
    Err(Fault::new(at.key(key), LoadError::OfTrain(name.clone())))
}

fn check_seismic(at: &KeyPath, seismic: &Seismic) -> Check {
    let Seismic { ground, soil, behaviour, confidence } = *seismic;
    if ground.is_some() || soil.is_some() {
        let ground = needed(ground, at, "a_g", "with `S`", "a_g = 0.15")?;
        positive(at.key("a_g"), ground)?;
        let soil = needed(soil, at, "S", "with `a_g`", "S = 1.0")?;
        positive(at.key("S"), soil)?;
    }
    let wanted = "a behaviour factor is at least 1";
    value(at.key("q"), behaviour, behaviour >= 1.0 && behaviour.is_finite(), wanted)?;
    let wanted = "a confidence factor is at least 1";
    value(at.key("FC"), confidence, confidence >= 1.0 && confidence.is_finite(), wanted)
}
