//! Bodies on their way: rest by smooth friction, and motions against viscosity.

use std::ops::ControlFlow;

use super::constants::{
    AHEAD, FIRST_VISCOSITY, FREE, HURRY, LAST_TRIES, LEAST_VISCOSITY, MOST_VISCOSITY, MOVED,
    REDUCED_START, SETTLING, STEADIER, STEADY, STEADY_MOTIONS, THROUGH, TRIES,
};
use super::evolved::{Evolved, Way};
use super::iterate::{Iterate, Rest};
use super::motion::{Motions, Moved, Viscosity, unresisted};
use super::rest::settled;
use super::settings::EvolutionSettings;
use super::start::{smoothed, start};
use crate::active::{Effort, Search, unplanned};
use crate::lower::judged_point;
use crate::solve::Monitor;
use crate::states::{Condensed, PROXIMAL, Point, Scaled};
use crate::vector::max_abs;
use crate::{
    Certificate, Contact2d, Error, InteriorPoint, InteriorPointSettings, Iteration, Method,
    SoftSprings, Solution, Solver, Status, WarmStart,
};

/// Where bodies rest.
enum Found {
    /// The best point of the search solves the problem itself.
    Law,
    /// Displacements from which slips are measured, and the solution there.
    Rest(Vec<f64>, Box<Solution>),
}

/// Bodies on their way.
pub(super) struct Moving<'a, 'b> {
    problem: &'a Contact2d,
    tolerance: f64,
    /// With slips from where the last motion ended.
    search: Search<'a>,
    monitor: Monitor<'b>,
    /// Where they were at the beginning.
    origin: Vec<f64>,
    /// Where the last motion ended, and its forces by contact point.
    at: Vec<f64>,
    forces: Vec<(f64, f64)>,
    /// What has stopped it.
    limit: Option<Status>,
}

impl<'a, 'b> Moving<'a, 'b> {
    pub(super) fn new(
        problem: &'a Contact2d,
        tolerance: f64,
        search: Search<'a>,
        monitor: Monitor<'b>,
        from: &[f64],
    ) -> Self {
        let at = search.scaled.of_displacements(from);
        let forces = vec![(0.0, 0.0); problem.points()];
        let origin = at.clone();
        Self { problem, tolerance, search, monitor, origin, at, forces, limit: None }
    }

    /// Moves the bodies until they rest or flow; rest without a motion is looked for first if that is wanted.
    pub(super) fn until_rest(mut self, settings: &EvolutionSettings) -> Result<Evolved, Error> {
        let EvolutionSettings { at_once, reductions, slips, .. } = settings;
        let mut path = SoftSprings::default();
        match if *at_once { self.rest_at_once(reductions, slips) } else { None } {
            Some((_, Found::Law)) => return Ok(self.by_law(path)),
            Some((way, Found::Rest(from, solution))) => {
                return Ok(self.concluded((way, from, *solution), path));
            }
            None => {}
        }
        let mut motions =
            Motions::of(&self.search.scaled).map_err(|it| unplanned(Method::Interior, it))?;
        let load = length(&self.search.scaled.f);
        let (mut viscosity, mut tries, mut is_last) = (Viscosity::default(), 0, false);
        // Where the motions with the present viscosity began.
        let mut since = self.at.clone();
        let status = loop {
            if let Some(limit) = self.limit {
                break limit;
            }
            let Some(velocity) = self.motion(&mut motions, (viscosity.value, MOVED)) else {
                viscosity.increase();
                if viscosity.value > MOST_VISCOSITY {
                    break self.limit.unwrap_or(Status::Stalled);
                }
                continue;
            };
            let length = length(&velocity);
            viscosity.follow(length);
            path.stiffness.push(viscosity.value);
            path.shares.push(if load > 0.0 { viscosity.value * length / load } else { length });
            path.motion = self.search.scaled.displacements(&velocity);
            if viscosity.is_steady() {
                let go_on = is_last || viscosity.goes_on();
                let mechanism = || self.mechanism(&mut motions, &viscosity, (&since, go_on));
                if let Some(mechanism) = (!viscosity.creeps()).then(mechanism).flatten() {
                    path.motion = self.search.scaled.displacements(&mechanism);
                    let stopped = self.limit.filter(|it| *it != Status::IterationLimit);
                    break stopped.unwrap_or(Status::NoEquilibrium);
                }
                if is_last {
                    break self.limit.unwrap_or(Status::Stalled);
                }
                viscosity.release();
            }
            if viscosity.may_rest() && tries < TRIES {
                tries += 1;
                let slip = slips.get(tries - 1).or(slips.last());
                let found = slip.and_then(|&slip| self.rest(SETTLING, (slip, false)));
                if let Some(Found::Rest(from, solution)) = found {
                    self.search.condensed.factorisations += motions.factorisations();
                    return Ok(self.concluded((Way::Motion, from, *solution), path));
                }
            }
            if tries == TRIES && !is_last && !path.carry_load() {
                // Motions that nothing but gaps shorten are as long with every viscosity. Whether they end, those show that
                // are short for it.
                (is_last, tries) = (true, TRIES - LAST_TRIES);
                since.clone_from(&self.at);
                viscosity.hold(FIRST_VISCOSITY);
            } else if !viscosity.is_held() {
                if viscosity.value <= LEAST_VISCOSITY || is_last && tries == TRIES {
                    break self.limit.unwrap_or(Status::Stalled);
                }
                since.clone_from(&self.at);
                viscosity.decrease();
            }
        };
        self.search.condensed.factorisations += motions.factorisations();
        self.given_up(path, status)
    }

    /// Rest without a motion, or the solution of the problem itself next to it.
    fn rest_at_once(&mut self, reductions: &[f64], slips: &[f64]) -> Option<(Way, Found)> {
        let slip = slips.first().copied();
        if let Some(slip) = slip.filter(|_| !reductions.is_empty()) {
            let found = self.rest(HURRY, (slip, true));
            if found.is_some() || self.limit.is_some() {
                return found.map(|found| (Way::SmoothFriction, found));
            }
        }
        for part in reductions {
            let found = self.with_reduced_friction(*part);
            if found.is_some() || self.limit.is_some() {
                return found.map(|found| (Way::ReducedFriction, found));
            }
        }
        let found = slip.and_then(|slip| self.rest(SETTLING, (slip, true)));
        found.map(|found| (Way::SmoothFriction, found))
    }

    /// The solution with coefficients of friction that are smaller by this part, whose forces are inside the cones of the
    /// problem; or that of the problem with the same states of contacts.
    fn with_reduced_friction(&mut self, part: f64) -> Option<Found> {
        let Self { problem, tolerance, search, monitor, limit, .. } = self;
        let settings = InteriorPointSettings {
            tolerance: *tolerance,
            max_iterations: usize::MAX,
            openings: vec![REDUCED_START],
            continuation: false,
            ..InteriorPointSettings::default()
        };
        let observer = &mut |at: &Iteration| {
            *limit = monitor.stop(at.residual);
            if limit.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let reduced = problem.with_reduced_friction(part);
        let solution = InteriorPoint::new(settings).solve_observed(&reduced, observer).ok()?;
        search.condensed.factorisations += solution.info.factorisations;
        let state = solution.contact.filter(|_| solution.status == Status::Solved)?;
        if search.try_start(&solution.basis.map_or(WarmStart::None, WarmStart::Basis)) {
            return Some(Found::Law);
        }
        let Search { scaled, condensed, .. } = search;
        let at = scaled.of_state(&state);
        at_rest((problem, *tolerance), (scaled, condensed), at)
    }

    /// The state at rest that friction leads to which turns over this part of the displacements of the start, with slips from
    /// there; or the solution of the problem itself next to it, where that is wanted. The residual has to be halved in
    /// `patience` steps at first.
    fn rest(&mut self, patience: usize, (part, by_law): (f64, bool)) -> Option<Found> {
        let Self { problem, tolerance, search, monitor, limit, origin, .. } = self;
        let go_on = |residual| {
            *limit = monitor.stop(residual);
            limit.is_none()
        };
        let Search { scaled, condensed, .. } = search;
        let begin = start(scaled, condensed, PROXIMAL);
        let size = max_abs(&begin.u);
        let wanted = |u: &[f64]| {
            let size = if part < 1.0 { max_abs(&difference(u, origin)) } else { size };
            part * size
        };
        // Friction that hardly yields is at its bound wherever anything slips at the start, and stays there.
        let begin = match part {
            ..1.0 => Iterate { smooth: part * size, ..begin },
            _ => smoothed(scaled, begin, part * size),
        };
        let (mut states, begin) = (None, (begin, patience));
        let found = settled(scaled, condensed, begin, wanted, go_on, |condensed, at, rest| {
            let found = at_rest((problem, *tolerance), (scaled, condensed), rest)?;
            states = Some((at.u.clone(), at.forces(), at.contacts(scaled)));
            Some(found)
        });
        if let Some((u, forces, contacts)) = states.filter(|_| by_law)
            && search.cross_over((&u, &forces), contacts, &Effort::QUICK)
        {
            return Some(Found::Law);
        }
        found
    }

    /// Takes the bodies to the end of one motion, from which slips are measured then, and gives its displacements; `None`
    /// where it cannot be computed, or a limit is reached.
    fn motion(
        &mut self,
        motions: &mut Motions,
        (viscosity, accuracy): (f64, f64),
    ) -> Option<Vec<f64>> {
        let Self { search, monitor, at, limit, .. } = self;
        let Moved { u, forces } =
            motions.advance(&search.scaled, at, (viscosity, accuracy), |residual| {
                *limit = monitor.stop(residual);
                *limit
            })?;
        let velocity = difference(&u, &self.at);
        let points = &mut self.search.scaled.points;
        for i in 0..forces.len() {
            points.s_0[i] = -points.get(i).moved(&u).1;
        }
        (self.at, self.forces) = (u, forces);
        Some(velocity)
    }

    /// How bodies flow whose motions have been of the same length `since` they were there; `None` where a soft spring or a
    /// stop still resists, so that they may come to rest, or where an exact motion is shorter. What the motions keep apart
    /// is no stop where they `go_on` with less viscosity.
    ///
    /// A mechanism that does not change is followed until it is exact. Blocks that hit each other change it for ever: then
    /// it is the mean of the motions, without what strains bodies and closes contacts.
    fn mechanism(
        &mut self,
        motions: &mut Motions,
        viscosity: &Viscosity,
        (since, go_on): (&[f64], bool),
    ) -> Option<Vec<f64>> {
        let total = difference(&self.at, since);
        let largest = self.forces.iter().fold(0.0_f64, |max, (t_n, _)| max.max(*t_n));
        let closed: Vec<bool> = self.forces.iter().map(|it| it.0 > MOVED * largest).collect();
        let Search { scaled, condensed, .. } = &mut self.search;
        let mean = unresisted(scaled, condensed, (&total, &closed));
        let left: f64 = mean.iter().zip(&total).map(|(v, total)| v * total).sum();
        // Gaps that motions have opened they close again, and no body stops there; but what the motions keep apart without
        // much force does not come together.
        let depth = THROUGH * max_abs(&mean);
        let is_stopped = |(point, is_closed): (Point<'_>, &bool)| {
            let (gap, rate) = (point.gap(&self.at, 0.0), point.moved(&mean).0);
            let is_ahead = !is_closed && point.x_0 > 0.0;
            let comes_nearer = !go_on && rate < point.moved(&total).0 - depth;
            comes_nearer || is_ahead && gap + AHEAD * rate < 0.0
        };
        if left < FREE * square(&total) || scaled.points.iter().zip(&closed).any(is_stopped) {
            return None;
        }
        let mut last = self.motion(motions, (viscosity.value, STEADY))?;
        if !viscosity.is_as_long(length(&last)) {
            return None;
        }
        let mut change = f64::INFINITY;
        for _ in 1..STEADY_MOTIONS {
            let Some(velocity) = self.motion(motions, (viscosity.value, STEADY)) else {
                return Some(mean);
            };
            let changed = max_abs(&difference(&velocity, &last)) / max_abs(&velocity);
            if changed > STEADIER * change {
                return Some(mean);
            }
            (last, change) = (velocity, changed);
            if change <= STEADY {
                break;
            }
        }
        Some(last)
    }

    /// Where the bodies were when the last motion ended.
    fn given_up(self, motions: SoftSprings, status: Status) -> Result<Evolved, Error> {
        let scaled = &self.search.scaled;
        let from = scaled.displacements(&self.at);
        let problem = self.problem.after(&from)?;
        let (t_n, t_t) =
            self.forces.iter().map(|(n, t)| (n * scaled.force(), t * scaled.force())).unzip();
        let pairs = problem.to_pairs(&problem.state(from.clone(), t_n, t_t));
        let mut solution = judged_point(&problem, pairs, self.tolerance, status);
        if solution.status == Status::NoEquilibrium {
            solution.certificate = Some(Certificate::Springs(motions.clone()));
        }
        Ok(self.concluded((Way::Motion, from, solution), motions))
    }

    fn by_law(self, motions: SoftSprings) -> Evolved {
        let solution = self.search.finish(Status::Stalled, self.monitor);
        Evolved { way: Way::Law, from: None, solution, motions }
    }

    fn concluded(
        self,
        (way, from, mut solution): (Way, Vec<f64>, Solution),
        motions: SoftSprings,
    ) -> Evolved {
        solution.info = self.monitor.info(Method::Interior);
        solution.info.factorisations = self.search.condensed.factorisations;
        Evolved { way, from: Some(from), solution, motions }
    }
}

/// A state at rest, if the judge agrees.
fn at_rest(
    (problem, tolerance): (&Contact2d, f64),
    (scaled, condensed): (&Scaled, &mut Condensed),
    (u, forces): Rest,
) -> Option<Found> {
    let from = scaled.displacements(&u);
    let there = problem.after(&from).ok()?;
    let mut search = Search::new(Method::Interior, &there, tolerance).ok()?;
    search.try_point((&u, &forces), Some(&Effort::held(PROXIMAL)));
    condensed.factorisations += search.condensed.factorisations;
    let solution = search.found()?;
    Some(Found::Rest(from, Box::new(solution)))
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

fn length(v: &[f64]) -> f64 {
    v.iter().map(|v| v.abs()).sum()
}

fn square(v: &[f64]) -> f64 {
    v.iter().map(|v| v * v).sum()
}
