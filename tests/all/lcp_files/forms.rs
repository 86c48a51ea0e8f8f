//! Forms of a problem that have the same solutions, by classes.

use lcp::faer::Mat;

use super::transform::{Equivalent, extended, permuted, premultiplied, rescaled, scaled, swapped};

/// Makes forms of a problem that have the same solutions.
pub type Forms = fn(&mut Random, &Equivalent) -> Vec<Equivalent>;

pub const CLASSES: [(&str, Forms); 9] = [
    ("as they stand", as_they_stand),
    ("in other units", in_other_units),
    ("with a tiny and with a huge vector", with_a_tiny_and_with_a_huge_vector),
    (
        "with rows and variables in units of their own",
        with_rows_and_variables_in_units_of_their_own,
    ),
    ("in another order", in_another_order),
    ("with pairs swapped", with_pairs_swapped),
    ("with rows premultiplied", with_rows_premultiplied),
    ("with a pair more", with_a_pair_more),
    ("in compositions of these", in_compositions_of_these),
];

fn as_they_stand(_: &mut Random, original: &Equivalent) -> Vec<Equivalent> {
    vec![Equivalent::original(original.problem.clone())]
}

fn in_other_units(_: &mut Random, original: &Equivalent) -> Vec<Equivalent> {
    const FACTORS: [f64; 3] = [1e-8, 1.0, 1e8];
    let forms = FACTORS.iter().flat_map(|&s| FACTORS.iter().map(move |&r| (s, r)));
    forms.map(|(s, r)| scaled(&original.problem, s, r)).collect()
}

fn with_a_tiny_and_with_a_huge_vector(_: &mut Random, original: &Equivalent) -> Vec<Equivalent> {
    [1e-12, 1e12].map(|r| scaled(&original.problem, 1.0, r)).into()
}

fn with_rows_and_variables_in_units_of_their_own(
    random: &mut Random,
    original: &Equivalent,
) -> Vec<Equivalent> {
    let n = original.problem.order();
    let form = |random: &mut Random| {
        let [rows, t, y] = [0; 3].map(|_| random.factors(n));
        rescaled(&original.problem, &rows, t, y)
    };
    (0..10).map(|_| form(random)).collect()
}

fn in_another_order(random: &mut Random, original: &Equivalent) -> Vec<Equivalent> {
    let n = original.problem.order();
    (0..10).map(|_| permuted(&original.problem, random.order(n))).collect()
}

fn with_pairs_swapped(random: &mut Random, original: &Equivalent) -> Vec<Equivalent> {
    let n = original.problem.order();
    (0..10).map(|_| swapped(&original.problem, random.choices(n))).collect()
}

fn with_rows_premultiplied(random: &mut Random, original: &Equivalent) -> Vec<Equivalent> {
    let n = original.problem.order();
    (0..10).map(|_| premultiplied(&original.problem, &random.orthogonal(n))).collect()
}

fn with_a_pair_more(random: &mut Random, original: &Equivalent) -> Vec<Equivalent> {
    let form = |size| extended(&original.problem, size);
    let n = original.problem.order() + 1;
    let mixed = |random: &mut Random, size| {
        let extended = form(size).then(|problem| permuted(problem, random.order(n)));
        extended.then(|problem| swapped(problem, random.choices(n)))
    };
    vec![form(1.0), form(-1.0), mixed(random, 1.0), mixed(random, -1.0)]
}

fn in_compositions_of_these(random: &mut Random, original: &Equivalent) -> Vec<Equivalent> {
    let n = original.problem.order();
    let form = |random: &mut Random| {
        let (s, r) = (random.factor(), random.factor());
        Equivalent::original(original.problem.clone())
            .then(|problem| scaled(problem, s, r))
            .then(|problem| permuted(problem, random.order(n)))
            .then(|problem| swapped(problem, random.choices(n)))
            .then(|problem| premultiplied(problem, &random.orthogonal(n)))
            // Not before: rows of different sizes lose their digits where they are mixed.
            .then(|problem| {
                let [rows, t, y] = [0; 3].map(|_| random.factors(n));
                rescaled(problem, &rows, t, y)
            })
    };
    (0..10).map(|_| form(random)).collect()
}

/// A small generator (`SplitMix64`), so that every run has the same problems.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Uniform between 0 and 1.
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn order(&mut self, n: usize) -> Vec<usize> {
        let mut keyed: Vec<(f64, usize)> = (0..n).map(|i| (self.next(), i)).collect();
        keyed.sort_by(|x, y| x.0.total_cmp(&y.0));
        keyed.into_iter().map(|(_, i)| i).collect()
    }

    fn choices(&mut self, n: usize) -> Vec<bool> {
        (0..n).map(|_| self.next() < 0.5).collect()
    }

    /// Between 1e-6 and 1e6, by its logarithm.
    fn factor(&mut self) -> f64 {
        10_f64.powf(12.0 * self.next() - 6.0)
    }

    fn factors(&mut self, n: usize) -> Vec<f64> {
        (0..n).map(|_| self.factor()).collect()
    }

    /// A product of two reflections.
    fn orthogonal(&mut self, n: usize) -> Mat<f64> {
        self.reflection(n) * self.reflection(n)
    }

    fn reflection(&mut self, n: usize) -> Mat<f64> {
        let v: Vec<f64> = (0..n).map(|_| self.next() - 0.5).collect();
        let square: f64 = v.iter().map(|v| v * v).sum();
        Mat::from_fn(n, n, |i, j| f64::from(u8::from(i == j)) - 2.0 * v[i] * v[j] / square)
    }
}
