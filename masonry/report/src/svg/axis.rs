//! Axes of diagrams: positions of values in pixels, and grid lines with labels.

use std::ops::Range;

use crate::format::round_down;

/// Logarithmic axes with fewer decades than this number have grid lines at 2 and 5 as well.
const FEW: f64 = 3.0;
const MOST_LABELS: f64 = 9.0;
/// Logarithmic axes whose values lie in this range have labels without exponents.
const PLAIN: Range<f64> = 0.9e-4..1.1e4;
/// The largest number of grid lines on a linear axis.
const TICKS: f64 = 7.0;
/// Labels of a linear axis have an exponent if they need more decimals than this number.
const DECIMALS: f64 = 5.0;

/// The kind of an axis: equal lengths stand for equal differences, or for equal ratios.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AxisScale {
    /// Equal lengths stand for equal differences.
    Linear,
    /// Equal lengths stand for equal ratios.
    #[default]
    Logarithmic,
}

/// An axis: values, and their positions in pixels.
#[derive(Debug)]
pub(super) struct Axis {
    scale: AxisScale,
    /// The values at both ends of the axis, or their decimal logarithms on a logarithmic axis.
    ends: [f64; 2],
    pixels: [f64; 2],
    /// Positions of grid lines, and their labels.
    lines: Vec<(f64, String)>,
}

impl Axis {
    /// Returns an axis that includes all values; `None` without values.
    pub(super) fn around(
        scale: AxisScale,
        values: impl Iterator<Item = f64> + Clone,
        pixels: [f64; 2],
    ) -> Option<Self> {
        let is_count = values.clone().all(|value| value.fract() == 0.0);
        let (low, high) = (values.clone().reduce(f64::min)?, values.reduce(f64::max)?);
        let (ends, lines) = match scale {
            AxisScale::Linear => linear([low, high], is_count),
            AxisScale::Logarithmic => logarithmic([low, high].map(f64::log10)),
        };
        Some(Self { scale, ends, pixels, lines })
    }

    /// Returns the position of a value, a whole pixel, so that files with many curves stay small.
    pub(super) fn at(&self, value: f64) -> f64 {
        let value = if self.scale == AxisScale::Logarithmic { value.log10() } else { value };
        let share = (value - self.ends[0]) / (self.ends[1] - self.ends[0]);
        (self.pixels[0] + share * (self.pixels[1] - self.pixels[0])).round()
    }

    /// Returns the positions of grid lines, and their labels.
    pub(super) fn labels(&self) -> impl Iterator<Item = (f64, &str)> {
        self.lines.iter().map(|(value, label)| (self.at(*value), label.as_str()))
    }
}

/// Returns the ends of a linear axis, with room at both, and the grid lines at round values, which are whole numbers if
/// all values are counts.
fn linear([low, high]: [f64; 2], is_count: bool) -> ([f64; 2], Vec<(f64, String)>) {
    // Zero is added to an axis that would begin or end near zero.
    let [low, high] = match [low, high] {
        _ if low > 0.0 && low < 0.7 * high => [0.0, high],
        _ if high < 0.0 && high > 0.7 * low => [low, 0.0],
        both => both,
    };
    let span = high - low;
    let room = if span > 0.0 { 0.04 * span } else { 0.5 * high.abs().max(1.0) };
    let [below, above] = [low, high].map(|it| if it == 0.0 && span > 0.0 { 0.0 } else { room });
    let ends = [low - below, high + above];
    let least = (ends[1] - ends[0]) / TICKS;
    let least = if is_count { least.max(1.0) } else { least };
    // The step is the smallest of 1, 2, 5 times a power of ten that is not smaller than `least`.
    let larger =
        [1.0, 2.0, 2.5, 5.0, 10.0].map(|it| round_down(round_down(least) * it * (1.0 + 1e-9)));
    let step = larger.into_iter().find(|it| *it >= least).unwrap_or(least);
    let first = (ends[0] / step - 1e-9).ceil();
    let values = (0..).map(|k| (first + f64::from(k)) * step);
    let values = values.take_while(|value| *value <= ends[1] + 1e-9 * step);
    (ends, values.map(|value| (value, label(value, step))).collect())
}

/// Returns the number of decimals of a round number.
fn decimals(of: f64) -> f64 {
    (-of.log10() - 1e-9).ceil().max(0.0)
}

fn plain(value: f64, decimals: f64) -> String {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let decimals = decimals as usize;
    format!("{value:.decimals$}")
}

fn label(value: f64, step: f64) -> String {
    let decimals = decimals(step);
    let text = if decimals > DECIMALS { format!("{value:.1e}") } else { plain(value, decimals) };
    let is_zero = text.parse().is_ok_and(|it: f64| it == 0.0);
    if is_zero { "0".to_owned() } else { text }
}

/// Returns the ends of a logarithmic axis, with room at both, and the grid lines at powers of ten and, if these are
/// few, at their multiples by 2 and 5. Either all labels have exponents or none.
fn logarithmic([low, high]: [f64; 2]) -> ([f64; 2], Vec<(f64, String)>) {
    let room = (0.03 * (high - low)).max(0.1);
    let ends = [low - room, high + room];
    let span = ends[1] - ends[0];
    let step = (span / MOST_LABELS).ceil();
    let multiples: &[f64] = if span < FEW { &[1.0, 2.0, 5.0] } else { &[1.0] };
    let decades = (0..).map(|k| (ends[0] / step).floor() * step + step * f64::from(k));
    let decades = decades.take_while(|decade| *decade <= ends[1]);
    let lines = decades.flat_map(|decade| multiples.iter().map(move |it| decade + it.log10()));
    let lines = lines.filter(|it| (ends[0]..=ends[1]).contains(it)).map(|it| 10_f64.powf(it));
    let lines: Vec<f64> = lines.collect();
    let exponents = lines.iter().any(|it| !PLAIN.contains(it));
    let label = |it: f64| if exponents { format!("{it:.0e}") } else { plain(it, decimals(it)) };
    (ends, lines.into_iter().map(|it| (it, label(it))).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_round_few_and_within_the_axis() {
        for ends in
            [[0.0, 11.0], [-3.2e-3, 1.7e-3], [0.0, 0.9], [1.0, 4.0], [120.0, 180.5], [0.0, 7e5]]
        {
            let axis = Axis::around(AxisScale::Linear, ends.into_iter(), [0.0, 100.0]).unwrap();
            let labels: Vec<_> = axis.labels().collect();
            assert!((3..=8).contains(&labels.len()), "{ends:?}: {labels:?}");
            assert!(
                labels.iter().all(|(at, _)| (0.0..=100.0).contains(at)),
                "{ends:?}: {labels:?}"
            );
            let mut texts: Vec<&str> = labels.iter().map(|it| it.1).collect();
            texts.dedup();
            assert_eq!(texts.len(), labels.len(), "{labels:?}");
        }
    }

    #[test]
    fn a_constant_has_an_axis() {
        let axis = Axis::around(AxisScale::Linear, [5.0].into_iter(), [0.0, 100.0]).unwrap();
        assert!(axis.ends[0] < 5.0 && axis.ends[1] > 5.0);
    }
}
