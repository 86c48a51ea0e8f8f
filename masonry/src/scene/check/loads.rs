//! Checks of loads, and of the names of loads in stages and combinations.

use std::collections::BTreeMap;

use nalgebra::Vector2;

use super::{Check, finite, needed, point, positive, segment, unwanted, value};
use crate::geometry::SAME_PLACE;
use crate::scene::load::Acts;
use crate::scene::rules::{One, exactly_one, plain, unknown};
use crate::scene::{
    Axle, Earth, EdgeStress, Fault, Fill, KeyPath, Load, LoadError, LoadKind, Scene, SceneErrorKind,
};

impl Scene {
    /// Checks that a load is of exactly one kind, and that its numbers are in their ranges.
    pub(super) fn check_load(&self, at: &KeyPath, load: &Load) -> Check {
        if let Some(group) = &load.group {
            if group.trim().is_empty() {
                return Err(Fault::new(at.key("group"), SceneErrorKind::EmptyName));
            }
            plain(at.key("group"), group)?;
        }
        finite(at.key("factor"), load.factor)?;
        self.check_mass(&at.key("mass"), load)?;
        match load.given().as_slice() {
            [(Acts::OnEdges, _)] => check_edge(at, load),
            [(Acts::AtPlace, key)] => check_force(at, load, key),
            [(Acts::OnMass, _)] => self.check_acceleration(at, load),
            [(Acts::AsFill | Acts::AsAxle, _)] => self.check_on_top(at, load),
            [(one, first), (other, second), ..] => {
                let (one, other) = (one.words(), other.words());
                let error = LoadError::TwoKinds { first, one, second, other };
                Err(Fault::new(at.key(second), error))
            }
            [] => Err(Fault::new(at.clone(), LoadError::NoKind(load.name.clone()))),
        }
    }

    /// Checks the body that carries a fill or an axle, and the ranges of the numbers of the fill or axle.
    fn check_on_top(&self, at: &KeyPath, load: &Load) -> Check {
        if let Some(Fill { over, level, gamma }) = &load.fill {
            let at = at.key("fill");
            self.check_body(at.key("over"), over)?;
            finite(at.key("level"), *level)?;
            positive(at.key("gamma"), *gamma)?;
        }
        let Some(Axle { over, x, force, level, angle_deg }) = &load.axle else { return Ok(()) };
        let at = at.key("axle");
        finite(at.key("x"), *x)?;
        positive(at.key("force"), *force)?;
        self.check_on_fill(&at, over, *level, *angle_deg)
    }

    fn check_mass(&self, at: &KeyPath, load: &Load) -> Check {
        let Some(part) = load.mass else { return Ok(()) };
        let wanted = "`mass` is the part of the load that is weight, a number from 0 to 1";
        value(at.clone(), part, (0.0..=1.0).contains(&part), wanted)?;
        let because = if load.acceleration.is_some() {
            "accelerations take none: leave `mass` out"
        } else if load.moment.is_some() {
            "a moment is not a weight: leave `mass` out"
        } else if part > 0.0 && self.gravity.is_none_or(|it| it.iter().all(|it| *it == 0.0)) {
            "no load is a weight if gravity is missing or zero: set `gravity`, or leave `mass` out"
        } else {
            return Ok(());
        };
        let error = LoadError::NoWeight { load: load.name.clone(), because };
        Err(Fault::new(at.clone(), error))
    }

    fn check_acceleration(&self, at: &KeyPath, load: &Load) -> Check {
        let at = at.key("acceleration");
        if let Some(acceleration) = load.acceleration {
            point(&at, acceleration)?;
        }
        let densities = self.used_materials().filter_map(|name| self.materials.get(name)?.density);
        // A load with a factor of zero, such as one of other combinations only, accelerates nothing.
        if load.factor == 0.0 || densities.count() > 0 || self.loads.iter().any(Load::has_mass) {
            return Ok(());
        }
        Err(Fault::new(at, LoadError::NoMass(load.name.clone())))
    }

    /// Checks the factors of a stage or a combination: each name is that of one load or one group, no load is named
    /// twice, and numbers are in their ranges.
    pub(super) fn check_factors(&self, at: &KeyPath, factors: &BTreeMap<String, f64>) -> Check {
        for (name, factor) in factors {
            let at = at.key(name);
            self.check_load_name(&at, name, None)?;
            finite(at, *factor)?;
        }
        for load in &self.loads {
            let mut names = factors.keys().filter(|name| load.is_called(name));
            if let (Some(first), Some(second)) = (names.next(), names.next()) {
                let (load, first) = (load.name.clone(), first.clone());
                let error = LoadError::Twice { load, first, second: second.clone() };
                return Err(Fault::new(at.key(second), error));
            }
        }
        Ok(())
    }

    /// Checks that `name` is that of one load or one group; `also` is a name that is accepted in addition.
    pub(super) fn check_load_name(&self, at: &KeyPath, name: &str, also: Option<&str>) -> Check {
        let names = |of: &dyn Fn(&&Load) -> bool| -> Vec<String> {
            self.loads.iter().filter(of).map(|load| load.name.clone()).collect()
        };
        let (loads, groups) = (names(&|_| true), self.groups());
        let single = names(&|load| load.name == name);
        let members = names(&|load| load.group_name() == name);
        if single.is_empty() && members.is_empty() {
            let others = groups.into_iter().filter(|group| !loads.contains(group));
            let others: Vec<String> = others.collect();
            let what = if others.is_empty() { "load" } else { "load or group" };
            let known = loads.iter().cloned().chain(others).chain(also.map(str::to_owned));
            let missing = "it under [[loads]]".to_owned();
            return Err(unknown(at.clone(), what, name, known.collect(), missing));
        }
        // A member with the name of its group does not make the name ambiguous.
        if members.is_empty() || single.iter().all(|load| members.contains(load)) {
            return Ok(());
        }
        let error = LoadError::Ambiguous { name: name.to_owned(), members, loads, groups };
        Err(Fault::new(at.clone(), error))
    }
}

fn check_edge(at: &KeyPath, load: &Load) -> Check {
    let because = "for the segment on which a load acts";
    let from = needed(load.from, at, "from", because, "from = [0.0, 0.0]")?;
    let to = needed(load.to, at, "to", because, "to = [1.0, 0.0]")?;
    segment(at, from, to)?;
    let keys = [
        ("pressure", load.pressure.is_some()),
        ("traction", load.traction.is_some()),
        ("earth", load.earth.is_some()),
    ];
    let mut given = keys.into_iter().filter(|(_, given)| *given).map(|(key, _)| key);
    if let (Some(first), Some(second)) = (given.next(), given.next()) {
        return Err(Fault::new(at.key(second), SceneErrorKind::Both { first, second }));
    }
    let because = "is for a traction: a pressure within a joint could act on either of the blocks that meet there";
    let otherwise = ", or give a `traction`";
    unwanted(load.inside && load.traction.is_none(), at, "inside", because, otherwise)?;
    let Some(LoadKind::Edge { stress, inside, .. }) = load.kind() else {
        return Err(Fault::new(at.clone(), LoadError::NoStress));
    };
    match stress {
        EdgeStress::Pressure(pressure) => {
            let at = at.key("pressure");
            if pressure.is_uniform() {
                return finite(at, pressure.from);
            }
            point(&at, [pressure.from, pressure.to])
        }
        EdgeStress::Traction(traction) => {
            point(&at.key("traction"), traction)?;
            let (force, along) = (Vector2::from(traction), Vector2::from(to) - Vector2::from(from));
            let across = force.perp(&along).abs();
            if inside && across <= SAME_PLACE * force.norm() * along.norm() {
                return Err(Fault::new(at.key("traction"), LoadError::Along));
            }
            Ok(())
        }
        EdgeStress::Earth(earth) => check_earth(&at.key("earth"), earth, from[1].min(to[1])),
    }
}

/// Checks the data of earth beside a segment whose lowest point is at the height `lowest`.
fn check_earth(at: &KeyPath, Earth { gamma, k, level }: Earth, lowest: f64) -> Check {
    positive(at.key("gamma"), gamma)?;
    positive(at.key("K"), k)?;
    finite(at.key("level"), level)?;
    let wanted = "the level of earth or water is above the lower end of the segment";
    value(at.key("level"), level, level > lowest, wanted)
}

/// Checks the keys of a force or a moment; block and place are checked after blocks are laid.
fn check_force(at: &KeyPath, load: &Load, given: &'static str) -> Check {
    let because = match given {
        "block" => "with `block`",
        "at" => "with `at`",
        "moment" => "with `moment`",
        _ => "with `force`",
    };
    needed(load.block.as_ref(), at, "block", because, "block = \"wall/1/1\"")?;
    let place = needed(load.at, at, "at", because, "at = [0.0, 0.0]")?;
    point(&at.key("at"), place)?;
    match exactly_one(at, "force", load.force, "moment", load.moment)? {
        One::First(force) => point(&at.key("force"), force),
        One::Second(moment) => finite(at.key("moment"), moment),
    }
}
