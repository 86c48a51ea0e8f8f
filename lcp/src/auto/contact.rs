//! The chains of contact with friction.

use super::constants::FEW;
use super::method::{Budget, Link, Planned};
use super::standard::{common_chain, size};
use crate::definite::is_definite;
use crate::enumerate::MOST_PAIRS;
use crate::{Contact2d, Friction2d, Method, Solver};

impl Planned for Friction2d {
    fn pairs(&self) -> usize {
        self.order()
    }

    fn subject(&self) -> String {
        format!("{} contacts, {}", self.contacts(), size(self.standard().m()))
    }

    fn chain(&self) -> Vec<Link> {
        common_chain(self.standard().m())
    }

    fn solver(&self, method: Method, effort: &Budget<'_>) -> Box<dyn Solver<Self>> {
        effort.common(method)
    }
}

impl Planned for Contact2d {
    fn pairs(&self) -> usize {
        self.order()
    }

    fn subject(&self) -> String {
        let (points, friction) = (self.points(), self.frictional().len());
        format!(
            "{points} contact points, {friction} of them with friction, {} displacements",
            self.displacements()
        )
    }

    fn chain(&self) -> Vec<Link> {
        let inside = Link::new(
            Method::Interior,
            "the interior-point method for contact takes tens of sparse factorisations",
        );
        let pivots = Link::new(
            Method::Lemke,
            if self.points() <= FEW {
                "pivots are fast, need no convergence and may find a proof"
            } else {
                "pivots take long at this number, but need no convergence"
            },
        );
        // Bodies with mass, or held by springs, have a solution, so a search for a proof would be
        // in vain.
        if self.order() <= MOST_PAIRS && !is_definite(self.stiffness()) {
            vec![pivots, inside]
        } else {
            vec![inside, pivots]
        }
    }

    fn solver(&self, method: Method, effort: &Budget<'_>) -> Box<dyn Solver<Self>> {
        effort.common(method)
    }
}
