//! Numbers and names as the reports print them.

use masonry::ids::BlockId;
use masonry::model::{Body, Model};
use masonry::rounding::largest;
use masonry::units::Units;

/// The quantity of a number, which determines its unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quantity {
    /// A number without a unit.
    Pure,
    Length,
    Area,
    Force,
    Stress,
    /// Energy, or a moment.
    Energy,
    Radians,
    /// A length in millimetres, whatever the unit of length of the scene.
    Millimetres,
    /// A ratio, shown in percent.
    Percent,
}

/// Conversion of SI values into the units of a scene.
#[derive(Debug, Clone, Copy)]
pub(super) struct InUnits(pub(super) Units);

impl InUnits {
    /// Converts an SI value into the unit of its quantity.
    pub(super) fn of(self, quantity: Quantity, value: f64) -> f64 {
        match quantity {
            Quantity::Pure | Quantity::Radians => value,
            Quantity::Length => self.length(value),
            Quantity::Area => value / (self.0.length_to_si() * self.0.length_to_si()),
            Quantity::Force => self.force(value),
            Quantity::Stress => self.stress(value),
            Quantity::Energy => self.energy(value),
            Quantity::Millimetres => 1e3 * value,
            Quantity::Percent => 100.0 * value,
        }
    }

    /// Returns the unit of a quantity; empty for a pure number.
    pub(super) fn unit(self, quantity: Quantity) -> String {
        match quantity {
            Quantity::Stress => return self.0.stress_name(),
            Quantity::Energy => return self.0.energy_name(),
            Quantity::Area => return format!("{}2", self.0.length_name()),
            Quantity::Pure => "",
            Quantity::Length => self.0.length_name(),
            Quantity::Force => self.0.force_name(),
            Quantity::Radians => "rad",
            Quantity::Millimetres => "mm",
            Quantity::Percent => "%",
        }
        .to_owned()
    }

    /// Converts metres into the scene's unit of length.
    pub(super) fn length(self, metres: f64) -> f64 {
        metres / self.0.length_to_si()
    }

    /// Converts newtons into the scene's unit of force.
    pub(super) fn force(self, newtons: f64) -> f64 {
        newtons / self.0.force_to_si()
    }

    /// Converts pascals into the scene's unit of stress.
    pub(super) fn stress(self, pascals: f64) -> f64 {
        pascals / self.0.stress_to_si()
    }

    /// Converts joules or newton metres into the scene's unit of energy and moment.
    pub(super) fn energy(self, joules: f64) -> f64 {
        joules / self.0.energy_to_si()
    }

    /// Writes a length for readers, with its unit after a non-breaking space.
    pub(super) fn length_text(self, metres: f64) -> String {
        format!("{}\u{a0}{}", significant(self.length(metres), 4), self.0.length_name())
    }

    /// Writes a moment for readers, with its unit after a non-breaking space.
    pub(super) fn moment_text(self, newton_metres: f64) -> String {
        let value = significant(self.energy(newton_metres), 4);
        format!("{value}\u{a0}{}", self.0.energy_name())
    }

    /// Writes a force for readers, with its unit after a non-breaking space.
    pub(super) fn force_text(self, newtons: f64) -> String {
        format!("{}\u{a0}{}", significant(self.force(newtons), 4), self.0.force_name())
    }
}

/// Writes a stress \[Pa\] for readers, in `Pa`, `kPa`, `MPa` or `GPa`, with its unit after a non-breaking space.
pub(super) fn stress_text(pascals: f64) -> String {
    let prefixes = [(1e9, "G"), (1e6, "M"), (1e3, "k")];
    // A value that rounds to a thousand of one unit is written in the next larger unit.
    let fits = |(unit, _): &(f64, &str)| pascals.abs() >= unit * (1.0 - 5e-5);
    let (unit, prefix) = prefixes.into_iter().find(fits).unwrap_or((1.0, ""));
    format!("{}\u{a0}{prefix}Pa", significant(pascals / unit, 4))
}

/// Writes an acceleration \[m/s^2\] for readers, with its unit after a non-breaking space.
pub(super) fn acceleration_text(acceleration: f64) -> String {
    format!("{}\u{a0}m/s²", significant(acceleration, 4))
}

/// Returns the shortest decimal text that reads back as the same number.
pub(super) fn shortest(value: f64) -> String {
    // Adding zero turns -0 into 0.
    format!("{:?}", value + 0.0)
}

/// Writes a number with `digits` significant digits without trailing zeros, and with an exponent if that is shorter.
pub(super) fn significant(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return "-".to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let (mantissa, exponent) = decimal(value, digits);
    let digits = i32::try_from(digits).unwrap_or(i32::MAX);
    if !(-4..=digits + 1).contains(&exponent) {
        return format!("{}e{exponent}", trim_zeros(&mantissa));
    }
    let decimals = usize::try_from(digits - 1 - exponent).unwrap_or(0);
    trim_zeros(&format!("{value:.decimals$}")).to_owned()
}

/// Returns a function that writes the numbers of one column with equally many decimals, so that the largest number has
/// `digits` significant digits; with exponents if decimals would take too many zeros.
pub(super) fn aligned(values: &[f64], digits: usize) -> impl Fn(f64) -> String + use<> {
    let largest = largest(values);
    let exponent = if largest > 0.0 { decimal(largest, digits).1 } else { 0 };
    let decimals = i32::try_from(digits).unwrap_or(i32::MAX) - (exponent + 1);
    let decimals = usize::try_from(decimals).unwrap_or(0);
    move |value| {
        if !value.is_finite() {
            return "-".to_owned();
        }
        if !(-3..=9).contains(&exponent) {
            return format!("{:.*e}", digits - 1, value + 0.0);
        }
        let text = format!("{value:.decimals$}");
        // A number that is rounded to zero has no minus sign.
        let zero = text.bytes().all(|byte| matches!(byte, b'-' | b'.' | b'0'));
        if zero { text.trim_start_matches('-').to_owned() } else { text }
    }
}

/// Returns the largest of 1, 2, 5 times a power of ten that does not exceed a positive finite `value`.
pub(super) fn round_down(value: f64) -> f64 {
    let text = format!("{value:e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let first = match mantissa.as_bytes().first() {
        Some(b'5'..=b'9') => 5,
        Some(b'2'..=b'4') => 2,
        _ => 1,
    };
    // The text is parsed, not computed, so that 0.002 is the double nearest to 0.002.
    format!("{first}e{exponent}").parse().unwrap_or(value)
}

/// Returns the name of the block or support on one side of a joint.
pub(super) fn body_name(model: &Model, body: Body) -> &str {
    match body {
        Body::Block(id) => block_name(model, id),
        Body::Support(id) => &model.supports[id.index()].name,
    }
}

/// Returns the name of a block.
pub(super) fn block_name(model: &Model, id: BlockId) -> &str {
    &model.blocks[id.index()].name
}

fn decimal(value: f64, digits: usize) -> (String, i32) {
    let text = format!("{value:.*e}", digits.saturating_sub(1));
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    (mantissa.to_owned(), exponent.parse().unwrap_or(0))
}

/// Removes the zeros at the end of a decimal number.
pub(super) fn trim_zeros(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn significant_digits_are_kept_and_zeros_dropped() {
        let cases = [
            (0.0, "0"),
            (-0.0, "0"),
            (7.327_68, "7.328"),
            (-10.0, "-10"),
            (12_345.6, "12346"),
            (1.0e-3, "0.001"),
            (2.014_71e-5, "2.015e-5"),
            (9.999_96, "10"),
            (3.0e7, "3e7"),
            (f64::NAN, "-"),
        ];
        for (value, text) in cases {
            assert_eq!(significant(value, 4), text);
        }
    }

    #[test]
    fn stresses_have_the_prefix_that_reads_best() {
        let cases = [
            (0.0, "0 Pa"),
            (-730.0, "-730 Pa"),
            (999.99, "1 kPa"),
            (258_400.0, "258.4 kPa"),
            (1.2e6, "1.2 MPa"),
            (5e9, "5 GPa"),
        ];
        for (value, text) in cases {
            assert_eq!(stress_text(value).replace('\u{a0}', " "), text);
        }
    }

    #[test]
    fn a_column_has_one_count_of_decimals() {
        let written = |values: &[f64], digits| {
            let text = aligned(values, digits);
            values.iter().map(|it| text(*it)).collect::<Vec<_>>()
        };
        assert_eq!(written(&[7.327_68, -0.5, -1e-9], 5), ["7.3277", "-0.5000", "0.0000"]);
        assert_eq!(written(&[0.0, 0.0], 3), ["0.00", "0.00"]);
        assert_eq!(written(&[2e12, f64::NAN], 3), ["2.00e12", "-"]);
    }

    #[test]
    fn round_numbers_are_exact_doubles() {
        let cases = [(0.002, 0.002), (4.99, 2.0), (5.0, 5.0), (1234.0, 1000.0), (9.9e-7, 5e-7)];
        for (value, round) in cases {
            assert_eq!(round_down(value).to_bits(), f64::to_bits(round));
        }
    }

    #[test]
    fn shortest_text_reads_back() {
        for value in [0.1 + 0.2, -1.0 / 3.0, 1e-300, 5e-324, 1.797e308] {
            assert_eq!(shortest(value).parse::<f64>().unwrap().to_bits(), value.to_bits());
        }
        assert_eq!(shortest(-0.0), "0.0");
    }
}
