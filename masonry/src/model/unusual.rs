//! Warnings about magnitudes that no wall has, which are mostly mistakes of units.

use std::ops::RangeInclusive;

use nalgebra::Vector2;

use super::bending::Bending;
use super::{Acceleration, BlockLoad, Healed, LoadCase, Model};
use crate::geometry::Extent;
use crate::material::constitutive;

/// Usual elastic moduli, of stone, brick, and fresh to hard mortar \[Pa\].
const YOUNG: RangeInclusive<f64> = 1e6..=1e12;
/// Usual stiffnesses of joints, from rubber pads to polished stone \[Pa/m\].
const STIFFNESS: RangeInclusive<f64> = 1e6..=1e14;
/// Usual densities, from light concrete to lead \[kg/m^3\].
const DENSITY: RangeInclusive<f64> = 100.0..=20_000.0;
/// Usual gravity, up to several times that of the earth \[m/s^2\].
const GRAVITY: RangeInclusive<f64> = 0.1..=100.0;
/// A total load below `LITTLE` \[N\] is unusual on a structure larger than `LARGE` \[m\].
const LITTLE: f64 = 10.0;
const LARGE: f64 = 0.5;

/// Slenderness (length divided by height) from which blocks bend like beams \[-\]. Chosen: bricks are shorter, and
/// rest on the whole length of their bed.
const BEAM: f64 = 4.0;
/// Largest stiffness of a mesh in bending divided by that of its block \[-\]. Chosen: moduli of masonry are not known
/// better.
const STIFF: f64 = 1.2;

impl Model {
    /// Lists the unusual magnitudes of a scene in sentences; empty if there are none.
    pub fn unusual(&self) -> Vec<String> {
        let lists = [
            self.elasticities(),
            self.stiffnesses(),
            self.weights(),
            self.totals(),
            self.stiff_meshes(),
            self.massless(),
            self.idle(),
            self.moved_corners(),
        ];
        lists.concat()
    }

    /// Describes the changes of a drawing, and the corners that were moved so that blocks touch.
    fn moved_corners(&self) -> Vec<String> {
        let in_scene = |metres: f64| format!("{:.1e}", metres / self.units.length_to_si());
        let sentence = |it: &Healed| {
            let corners = if it.corners == 1 { "corner" } else { "corners" };
            let (most, unit) = (in_scene(it.largest), self.units.length_name());
            format!(
                "{} {corners} of single blocks moved by up to {most} {unit}, onto supports and onto corners and edges of others \
                 that are nearer than {} {unit} (`contact.tolerance`).",
                it.corners,
                in_scene(it.tolerance)
            )
        };
        let Some(healed) = &self.healed else { return Vec::new() };
        let moved = Some(healed).filter(|it| it.corners > 0).map(sentence);
        healed.drawing.iter().cloned().chain(moved).collect()
    }

    /// Lists loads that press down while an acceleration acts, but have no `mass`.
    fn massless(&self) -> Vec<String> {
        let aside = |it: &&Acceleration| it.value.perp(&self.gravity).abs() > 0.0;
        let Some(quake) = self.accelerations.iter().find(aside) else { return Vec::new() };
        let mut forces = vec![Vector2::zeros(); self.loads.len()];
        for block in &self.blocks {
            for load in &block.loads {
                forces[load.load().index()] += load.resultant(&block.corners, self.thickness).force;
            }
        }
        // Forces of an acceleration act on given masses.
        self.accelerations.iter().for_each(|it| forces[it.load.index()].fill(0.0));
        let is_massless = |(k, load): &(usize, &LoadCase)| {
            load.mass.is_none() && forces[*k].dot(&self.gravity) > 0.0
        };
        let sentence = |(_, load): (usize, &LoadCase)| {
            format!(
                "\"{}\" does not act on load \"{}\", which presses down. Set the `mass` of that load: `true` if all of it is the \
                 weight of a mass, 0.3 if three tenths of it are, `false` if none is or if another load is its inertia.",
                self.loads[quake.load.index()].name,
                load.name
            )
        };
        self.loads.iter().enumerate().filter(is_massless).map(sentence).collect()
    }

    /// Lists axles that stand beside their bridges.
    fn idle(&self) -> Vec<String> {
        let mut acts = vec![false; self.loads.len()];
        let on_blocks = self.blocks.iter().flat_map(|block| &block.loads).map(BlockLoad::load);
        let ids = on_blocks.chain(self.accelerations.iter().map(|it| it.load));
        ids.for_each(|id| acts[id.index()] = true);
        let idle = self.loads.iter().zip(acts).filter(|(_, acts)| !acts);
        idle.map(|(load, _)| {
            format!("Axle \"{}\" stands beside its bridge and acts on nothing.", load.name)
        })
        .collect()
    }

    fn elasticities(&self) -> Vec<String> {
        let of_blocks = self.blocks.iter().filter_map(|block| block.elasticity);
        let of_mortar = self.joint_classes.iter().filter_map(|class| class.mortar);
        let all = of_blocks.chain(of_mortar.map(|mortar| mortar.material.elasticity));
        let odd = outside(&YOUNG, all.map(|it| it.young));
        let units = self.units;
        let sentence = |young: f64| {
            format!(
                "E = {:e} {}/{}2 is {young:.0e} Pa, which is unusual: E of masonry is 1e8 to 1e11 Pa. Is E given in \
                 the units of the scene?",
                young / units.stress_to_si(),
                units.force_name(),
                units.length_name()
            )
        };
        odd.into_iter().map(sentence).collect()
    }

    /// Lists slender blocks whose meshes are too stiff in bending, with the name of the worst block.
    fn stiff_meshes(&self) -> Vec<String> {
        let stiff = self.blocks.iter().filter_map(|block| {
            let d = constitutive(block.elasticity?, self.plane);
            let bending = Bending::of(block.mesh.as_ref()?, &d)?;
            let is_stiff = bending.slenderness >= BEAM && bending.stiffness > STIFF;
            is_stiff.then_some((bending, &block.name))
        });
        let mut stiff: Vec<(Bending, &String)> = stiff.collect();
        stiff.sort_by(|(a, _), (b, _)| b.stiffness.total_cmp(&a.stiffness));
        let Some((Bending { slenderness, stiffness }, name)) = stiff.first() else {
            return Vec::new();
        };
        let others = match stiff.len() - 1 {
            0 => String::new(),
            count => format!(" (and {count} more)"),
        };
        // The error falls with the square of the number; lateral strains in one row need less than half of what is
        // allowed.
        let times = (2.0 * (stiffness - 1.0) / (STIFF - 1.0)).sqrt().ceil();
        vec![format!(
            "Block \"{name}\"{others} is {slenderness:.0} times as long as high, and its mesh may be up to {stiffness:.1} times as stiff in \
             bending as the block: set a `mesh` with {times} times as many elements along it."
        )]
    }

    fn stiffnesses(&self) -> Vec<String> {
        let all = self.joint_classes.iter().filter_map(|class| class.law.stiffness);
        let odd = outside(&STIFFNESS, all.flatten());
        let units = self.units;
        let sentence = |k: f64| {
            format!(
                "The stiffness {:e} {}/{}3 of a joint is {k:.0e} Pa/m, which is unusual: dry joints have 1e9 to 1e10 Pa/m. \
                 Is it given in the units of the scene?",
                k / units.stiffness_to_si(),
                units.force_name(),
                units.length_name()
            )
        };
        odd.into_iter().map(sentence).collect()
    }

    fn weights(&self) -> Vec<String> {
        let mut list = Vec::new();
        let gravity = self.gravity.norm();
        let densities = || self.blocks.iter().filter_map(|block| block.density);
        if gravity > 0.0 && !GRAVITY.contains(&gravity) {
            list.push(format!(
                "Gravity is {gravity:e} m/s2, which is unusual: its unit is m/s2 for all units of the scene."
            ));
        }
        if gravity > 0.0 && densities().next().is_none() {
            list.push("Gravity acts on nothing: no block has a density.".to_owned());
        }
        if gravity <= 0.0 && densities().next().is_some() {
            list.push("Blocks have a density and no weight: the scene has no gravity.".to_owned());
        }
        let odd = densities().find(|density| !DENSITY.contains(density));
        list.extend(odd.map(|density| {
            format!(
                "A density of {density:e} kg/m3 is unusual: its unit is kg/m3 for all units of the scene."
            )
        }));
        list
    }

    fn totals(&self) -> Vec<String> {
        let loads = self.blocks.iter().flat_map(|block| self.forces_on(block));
        let total: f64 = loads.map(|it| it.force.norm()).sum();
        let extent = Extent::of(self.blocks.iter().flat_map(|block| &block.corners)).longer_side();
        if total > 0.0 && total < LITTLE && extent > LARGE {
            return vec![format!(
                "All loads together are {total:.2e} N on a structure of {extent:.2} m: are the units right?"
            )];
        }
        Vec::new()
    }
}

/// Lists the values outside of a range, each once, in increasing order.
fn outside(usual: &RangeInclusive<f64>, values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut odd: Vec<f64> = values.filter(|value| !usual.contains(value)).collect();
    odd.sort_by(f64::total_cmp);
    odd.dedup();
    odd
}
