//! Starts of the settings, from which the polish is tried before anything else.

use std::ops::Range;

use super::form::Point;
use super::program::{Assemble, Best};
use super::reduced::{Law, Place};
use super::scale::Scaled;
use crate::problem::max_abs;
use crate::{Contact2d, Side, StandardForm, WarmStart};

/// The pairs of the general problem that decide on the place of a row.
#[derive(Debug, Clone, Copy)]
enum Row {
    /// Inside where this variable of the pair does not vanish.
    Pair(usize, Side),
    /// The pairs of the distances of a friction force to its two bounds.
    Cone { plus: usize, minus: usize },
}

/// What every row of a form is in the general problem.
#[derive(Debug)]
pub(super) struct Rows(Vec<Row>);

impl Rows {
    /// Rows that are pairs `(z, w)`.
    pub(super) fn of_pairs(pairs: impl Iterator<Item = usize>) -> Self {
        Self(pairs.map(|pair| Row::Pair(pair, Side::T)).collect())
    }

    /// Rows of a standard problem in disguise.
    pub(super) fn of_standard(standard: &StandardForm) -> Self {
        let n = standard.lcp().order();
        let (t_is_z, _) = standard.to_pairs(&vec![1.0; n], &vec![0.0; n]);
        let side = |t: &f64| if *t > 0.0 { Side::T } else { Side::Y };
        Self(t_is_z.iter().enumerate().map(|(pair, t)| Row::Pair(pair, side(t))).collect())
    }

    /// Rows of gaps, then of slips with friction.
    pub(super) fn of_contact(contact: &Contact2d) -> Self {
        let count = contact.frictional().len();
        let gaps: Range<usize> =
            contact.displacements()..contact.displacements() + contact.points();
        let first = gaps.end;
        let slips = (0..count).map(|k| Row::Cone { plus: first + k, minus: first + count + k });
        Self(gaps.map(|pair| Row::Pair(pair, Side::T)).chain(slips).collect())
    }

    /// Offers what the polish makes of the start.
    pub(super) fn try_start(
        &self,
        start: &WarmStart,
        scaled: &Scaled,
        assemble: &Assemble<'_>,
        best: &mut Best,
    ) {
        let Some(sides) = sides(start) else { return };
        let place = |row: &Row| match *row {
            Row::Pair(pair, side) if sides[pair] == side => Place::Inside,
            Row::Pair(..) => Place::Lower,
            Row::Cone { plus, minus } => match (sides[plus], sides[minus]) {
                (Side::Y, _) => Place::Lower,
                (_, Side::Y) => Place::Upper,
                (Side::T, Side::T) => Place::Inside,
            },
        };
        let places = self.0.iter().map(place).collect();
        let zero = Point::zero(&scaled.form);
        best.polish_from(scaled, Law::Coulomb, (places, &zero), assemble);
    }
}

/// The variable of every pair that does not vanish.
fn sides(start: &WarmStart) -> Option<Vec<Side>> {
    match start {
        WarmStart::None => None,
        WarmStart::Basis(basis) => Some(basis.sides().to_vec()),
        WarmStart::Point { t, y } => {
            let (t_max, y_max) = (max_abs(t), max_abs(y));
            let relative = |v: f64, max: f64| if max > 0.0 { v / max } else { 0.0 };
            let side = |(t, y): (&f64, &f64)| {
                if relative(*t, t_max) > relative(*y, y_max) { Side::T } else { Side::Y }
            };
            Some(t.iter().zip(y).map(side).collect())
        }
    }
}
