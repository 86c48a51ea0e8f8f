//! The chains of problems with free and with bounded variables.

use super::facts::largest_block;
use super::method::{Budget, Link, Planned};
use super::standard::{common_chain, size};
use crate::{BoxedLcp, Method, MixedLcp, Solver};

impl Planned for MixedLcp {
    fn pairs(&self) -> usize {
        self.order()
    }

    fn choices(&self) -> usize {
        largest_block(self.m(), |i| usize::from(!self.free()[i]))
    }

    fn subject(&self) -> String {
        let free = self.free().iter().filter(|free| **free).count();
        format!("{free} free variables, {}", size(self.m()))
    }

    fn chain(&self) -> Vec<Link> {
        common_chain(self.m())
    }

    fn solver(&self, method: Method, effort: &Budget<'_>) -> Box<dyn Solver<Self>> {
        effort.common(method)
    }
}

impl Planned for BoxedLcp {
    fn pairs(&self) -> usize {
        self.pairs()
    }

    fn choices(&self) -> usize {
        let (lower, upper) = (self.lower(), self.upper());
        let has = |bound: f64| usize::from(bound.is_finite());
        let is_fixed = |i: usize| lower[i] >= upper[i];
        let sides = |i: usize| if is_fixed(i) { 0 } else { has(lower[i]) + has(upper[i]) };
        largest_block(self.m(), sides)
    }

    fn subject(&self) -> String {
        format!("{} pairs with those of the bounds, {}", self.pairs(), size(self.m()))
    }

    fn chain(&self) -> Vec<Link> {
        common_chain(self.m())
    }

    fn solver(&self, method: Method, effort: &Budget<'_>) -> Box<dyn Solver<Self>> {
        effort.common(method)
    }
}
