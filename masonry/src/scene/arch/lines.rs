//! Computation of the joints of an arch from its shape.

use nalgebra::Point2;

use super::{Arch, JointLine, Shape};
use crate::geometry;
use crate::scene::rules::{One, exactly_one, needed, positive, unwanted, value};
use crate::scene::{ArchError, Fault, KeyPath};

/// Returns the joints from the left springing to the right, each from the intrados to the extrados \[length\].
pub(crate) fn lines(arch: &Arch, at: &KeyPath) -> Result<Vec<JointLine>, Fault> {
    refuse_others(arch, at)?;
    if arch.shape == Shape::Joints {
        return given(arch, at);
    }
    let size = Size::of(arch, at)?;
    match arch.shape {
        Shape::Segmental => {
            let half = half_angle(arch, at, size.span)?;
            let radius = 0.5 * size.span / half.sin();
            let centre = size.place([0.5 * size.span, -radius * half.cos()]);
            size.check_convex(half, at)?;
            Ok(size.fan(centre, radius, [-half, half], size.count))
        }
        Shape::Semicircular => {
            let (centre, half) = (size.place([0.5 * size.span, 0.0]), RIGHT_ANGLE);
            size.check_convex(half, at)?;
            Ok(size.fan(centre, 0.5 * size.span, [-half, half], size.count))
        }
        Shape::Pointed => size.pointed(arch, at),
        Shape::Flat | Shape::Joints => size.flat(arch, at),
    }
}

/// Returns the joints that the scene gives, after a check that they bound convex voussoirs.
fn given(arch: &Arch, at: &KeyPath) -> Result<Vec<JointLine>, Fault> {
    let because = "for `shape = \"joints\"`";
    let remedy = "lines = [[[0.0, 0.0], [0.0, 0.2]], [[0.5, 0.0], [0.5, 0.2]]]";
    let lines = needed(arch.lines.clone(), at, "lines", because, remedy)?;
    let at = at.key("lines");
    let wanted = "give at least two joints, between which there is a voussoir";
    value(at.clone(), lines.len() as f64, lines.len() >= 2, wanted)?;
    for (k, [from, to]) in lines.iter().enumerate() {
        let [x, y] = *from;
        if (x - to[0]).abs().max((y - to[1]).abs()) <= 0.0 {
            return Err(Fault::new(at.item(k), ArchError::NoLength { x, y }));
        }
    }
    for (k, pair) in lines.windows(2).enumerate() {
        let corners = [pair[0][0], pair[1][0], pair[1][1], pair[0][1]];
        if geometry::check_convex(&corners.map(Point2::from)).is_err() {
            return Err(Fault::new(at.item(k + 1), ArchError::NoVoussoir(k + 1)));
        }
    }
    let [x, y] = arch.origin.unwrap_or_default();
    let moved = |[px, py]: [f64; 2]| [x + px, y + py];
    Ok(lines.into_iter().map(|line| line.map(moved)).collect())
}

/// Refuses keys that belong to shapes other than that of the arch.
fn refuse_others(arch: &Arch, at: &KeyPath) -> Result<(), Fault> {
    use Shape::{Flat, Joints, Pointed, Segmental, Semicircular};
    let circles = [Segmental, Semicircular, Pointed, Flat];
    let keys: [(&'static str, bool, &[Shape]); 7] = [
        ("span", arch.span.is_some(), &circles),
        ("thickness", arch.thickness.is_some(), &circles),
        ("voussoirs", arch.voussoirs.is_some(), &circles),
        ("rise", arch.rise.is_some(), &[Segmental, Pointed, Flat]),
        ("embrace_deg", arch.embrace_deg.is_some(), &[Segmental]),
        ("skew_deg", arch.skew_deg.is_some(), &[Flat]),
        ("lines", arch.lines.is_some(), &[Joints]),
    ];
    let because = "follows from the shape or has no meaning for it";
    keys.iter().try_for_each(|(key, given, shapes)| {
        let is_foreign = *given && !shapes.contains(&arch.shape);
        unwanted(is_foreign, at, key, because, ", or choose another `shape`")
    })
}

/// The data of an arch that all shapes have except given joints.
struct Size {
    origin: [f64; 2],
    span: f64,
    thickness: f64,
    count: u32,
}

/// Largest number of voussoirs of one arch, and of blocks of one of its piers.
pub(super) const MOST: u32 = 10_000;
/// The largest angle of the springings of a flat arch from the vertical \[degrees\]. Chosen: far more than masons
/// build.
const STEEPEST: f64 = 80.0;
const RIGHT_ANGLE: f64 = 0.5 * std::f64::consts::PI;

impl Size {
    fn of(arch: &Arch, at: &KeyPath) -> Result<Self, Fault> {
        let because = "for this shape";
        let span = needed(arch.span, at, "span", because, "span = 2.0")?;
        positive(at.key("span"), span)?;
        let thickness = needed(arch.thickness, at, "thickness", because, "thickness = 0.3")?;
        positive(at.key("thickness"), thickness)?;
        let count = needed(arch.voussoirs, at, "voussoirs", because, "voussoirs = 11")?;
        let wanted = "an arch has between 1 and 10000 voussoirs";
        value(at.key("voussoirs"), f64::from(count), (1..=MOST).contains(&count), wanted)?;
        Ok(Self { origin: arch.origin.unwrap_or_default(), span, thickness, count })
    }

    /// Checks the number of voussoirs: half a circle needs at least two.
    fn check_convex(&self, half: f64, at: &KeyPath) -> Result<(), Fault> {
        let is_convex = self.count > 1 || half < RIGHT_ANGLE * (1.0 - 1e-9);
        let wanted = "a single voussoir of half a circle is not convex: give at least 2";
        value(at.key("voussoirs"), f64::from(self.count), is_convex, wanted)
    }

    fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.origin[0] + x, self.origin[1] + y]
    }

    /// Returns joints that point towards a centre, at equal angles from each other.
    fn fan(
        &self,
        [x, y]: [f64; 2],
        radius: f64,
        [from, to]: [f64; 2],
        count: u32,
    ) -> Vec<JointLine> {
        let at = |radius: f64, angle: f64| [x + radius * angle.sin(), y + radius * angle.cos()];
        let angle = |k: u32| from + (to - from) * f64::from(k) / f64::from(count);
        (0..=count).map(|k| [radius, radius + self.thickness].map(|r| at(r, angle(k)))).collect()
    }

    /// Returns the joints of two arcs, whose centres are at the height of the springings, and a vertical joint at the
    /// crown.
    fn pointed(&self, arch: &Arch, at: &KeyPath) -> Result<Vec<JointLine>, Fault> {
        let rise = needed(arch.rise, at, "rise", "for a pointed arch", "rise = 2.0")?;
        positive(at.key("rise"), rise)?;
        let (half, count) = (0.5 * self.span, self.count);
        if rise <= half {
            return Err(Fault::new(at.key("rise"), ArchError::TooLow { rise, least: half }));
        }
        if !count.is_multiple_of(2) {
            let error = ArchError::Odd { count, even: count + 1 };
            return Err(Fault::new(at.key("voussoirs"), error));
        }
        let radius = (half * half + rise * rise) / self.span;
        let outer = radius + self.thickness;
        // Angles are measured about the centre of the left arc, which lies to the right of the left springing, up to
        // the crown.
        let across = radius - half;
        let crown = [rise, (outer * outer - across * across).sqrt()].map(|y| self.place([half, y]));
        let angle = -(across / radius).asin();
        let mut lines =
            self.fan(self.place([radius, 0.0]), radius, [-RIGHT_ANGLE, angle], count / 2);
        lines.pop();
        let mirrored = |[x, y]: [f64; 2]| [2.0 * self.origin[0] + self.span - x, y];
        let right: Vec<JointLine> = lines.iter().rev().map(|line| line.map(mirrored)).collect();
        lines.push(crown);
        lines.extend(right);
        Ok(lines)
    }

    /// Returns the joints of a flat arch, from the intrados to the level top.
    fn flat(&self, arch: &Arch, at: &KeyPath) -> Result<Vec<JointLine>, Fault> {
        match exactly_one(at, "skew_deg", arch.skew_deg, "rise", arch.rise)? {
            One::First(skew_deg) => self.straight(skew_deg, at),
            One::Second(rise) => self.level(rise, at),
        }
    }

    /// Returns the joints of a flat arch whose intrados is an arc; they point towards its centre at equal angles.
    fn level(&self, rise: f64, at: &KeyPath) -> Result<Vec<JointLine>, Fault> {
        let at = at.key("rise");
        positive(at.clone(), rise)?;
        let wanted = "the crown of the intrados lies below the level top";
        value(at.clone(), rise, rise < self.thickness, wanted)?;
        let half = geometry::half_angle(rise, self.span);
        let wanted = "the springings of a flat arch lean by at most 80 degrees, so that it rises by at most 0.42 of its span";
        value(at, rise, half <= STEEPEST.to_radians(), wanted)?;
        let radius = 0.5 * self.span / half.sin();
        let [middle, depth] = [0.5 * self.span, radius * half.cos()];
        let joint = |k: u32| {
            let angle = half * (2.0 * f64::from(k) / f64::from(self.count) - 1.0);
            let below = [middle + radius * angle.sin(), radius * angle.cos() - depth];
            let above = [middle + (self.thickness + depth) * angle.tan(), self.thickness];
            [below, above].map(|place| self.place(place))
        };
        Ok((0..=self.count).map(joint).collect())
    }

    /// Returns the joints of a flat arch with a straight intrados, at equal distances along it; they point towards one
    /// point below its middle.
    fn straight(&self, skew: f64, at: &KeyPath) -> Result<Vec<JointLine>, Fault> {
        let wanted = "the springings of a flat arch lean by at least 0 and at most 80 degrees";
        value(at.key("skew_deg"), skew, (0.0..=STEEPEST).contains(&skew), wanted)?;
        let widened = self.thickness * skew.to_radians().tan();
        let joint = |k: u32| {
            let part = f64::from(k) / f64::from(self.count);
            let outwards = widened * (2.0 * part - 1.0);
            [[part * self.span, 0.0], [part * self.span + outwards, self.thickness]]
                .map(|place| self.place(place))
        };
        Ok((0..=self.count).map(joint).collect())
    }
}

/// Returns half the angle of a segmental arch, seen from the centre of its circle \[rad\].
fn half_angle(arch: &Arch, at: &KeyPath, span: f64) -> Result<f64, Fault> {
    match exactly_one(at, "rise", arch.rise, "embrace_deg", arch.embrace_deg)? {
        One::First(rise) => {
            positive(at.key("rise"), rise)?;
            let largest = 0.5 * span;
            if rise > largest {
                let error = ArchError::TooHigh { rise, largest };
                return Err(Fault::new(at.key("rise"), error));
            }
            Ok(geometry::half_angle(rise, span))
        }
        One::Second(embrace) => {
            let wanted = "an arc of a circle embraces more than 0 and at most 180 degrees";
            value(at.key("embrace_deg"), embrace, embrace > 0.0 && embrace <= 180.0, wanted)?;
            Ok(0.5 * embrace.to_radians())
        }
    }
}
