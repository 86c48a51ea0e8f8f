//! The balance of every block in numbers of twice the digits: what the judge's sums lose by rounding, these keep.

use masonry::data::state::State;
use masonry::geometry;
use masonry::model::{Model, PlacedBlock};
use nalgebra::Vector2;

use super::double::Double;

/// The largest force or moment left over on a block, relative to the forces on it.
pub fn left_over(model: &Model, state: &State) -> f64 {
    let mut resultants: Vec<Resultant> =
        model.blocks.iter().map(|block| Resultant::of_loads(model, block)).collect();
    for (contact, it) in model.contacts.iter().zip(&state.contacts) {
        let normal = model.joints[contact.joint.index()].normal;
        for (anchor, sign) in [(Some(contact.b), 1.0), (contact.a, -1.0)] {
            let Some(anchor) = anchor else { continue };
            let block = &model.blocks[anchor.block.index()];
            // Both faces of a film feel its force in the middle between them.
            let place = match contact.film {
                Some(_) => [contact.position.x, contact.position.y].map(Double::from),
                None => on_edge(block, anchor.edge, anchor.at),
            };
            let [n, t] = [sign * it.t_n, sign * it.t_t].map(Double::from);
            let [x, y] = [normal.x, normal.y].map(Double::from);
            let resultant = &mut resultants[anchor.block.index()];
            resultant.add(place, [n * x + t * y, n * y - t * x]);
            resultant.size += contact.law.tension;
        }
    }
    let of_block = |(it, block): (&Resultant, &PlacedBlock)| {
        let [x, y] = it.force.map(Double::rounded);
        let moment = it.moment.rounded().abs() / geometry::size(&block.corners);
        let left = x.hypot(y).max(moment);
        if left > 0.0 { left / it.size } else { 0.0 }
    };
    resultants.iter().zip(&model.blocks).map(of_block).fold(0.0, f64::max)
}

/// Force, moment about the centroid, and how large the forces are.
struct Resultant {
    about: [Double; 2],
    force: [Double; 2],
    moment: Double,
    size: f64,
}

impl Resultant {
    fn of_loads(model: &Model, block: &PlacedBlock) -> Self {
        let zero = Double::from(0.0);
        let centroid = geometry::centroid(&block.corners);
        let about = [centroid.x, centroid.y].map(Double::from);
        let mut all = Self { about, force: [zero; 2], moment: zero, size: 0.0 };
        for load in model.forces_on(block) {
            let numbers = |v: Vector2<f64>| [v.x, v.y].map(Double::from);
            all.add(numbers(load.at.coords), numbers(load.force));
        }
        all
    }

    fn add(&mut self, [x, y]: [Double; 2], [fx, fy]: [Double; 2]) {
        self.force = [self.force[0] + fx, self.force[1] + fy];
        self.moment = self.moment + (x - self.about[0]) * fy - (y - self.about[1]) * fx;
        self.size += fx.rounded().hypot(fy.rounded());
    }
}

fn on_edge(block: &PlacedBlock, edge: usize, at: f64) -> [Double; 2] {
    let [start, end] = geometry::edge(&block.corners, edge);
    let between = |a: f64, b: f64| {
        let [a, b, at] = [a, b, at].map(Double::from);
        a + (b - a) * at
    };
    [between(start.x, end.x), between(start.y, end.y)]
}
