//! The chains of problems with free and with bounded variables.

use super::facts::largest_block;
use super::method::{Choice, Effort, Planned, named};
use super::standard::common_chain;
use crate::{BoxedLcp, Method, MixedLcp, Solver};

impl Planned for MixedLcp {
    fn pairs(&self) -> usize {
        self.order()
    }

    fn choices(&self) -> usize {
        largest_block(self.m(), |i| usize::from(!self.free()[i]))
    }

    fn chain(&self) -> Vec<Choice> {
        let free = self.free().iter().filter(|free| **free).count();
        named(&format!("{free} free variables"), common_chain(self.m()))
    }

    fn solver(&self, method: Method, effort: &Effort<'_>) -> Box<dyn Solver<Self>> {
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

    fn chain(&self) -> Vec<Choice> {
        let steps = common_chain(self.m());
        named(&format!("{} pairs with those of the bounds", self.pairs()), steps)
    }

    fn solver(&self, method: Method, effort: &Effort<'_>) -> Box<dyn Solver<Self>> {
        effort.common(method)
    }
}
