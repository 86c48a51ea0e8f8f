//! The numbers that the interior-point method uses, each with its origin.

/// Residuals above which no crossover and no proof is tried. Chosen: every trial costs factorisations.
pub(super) const TRIAL_RESIDUAL: f64 = 3e-6;
/// The residual must have decreased by this factor before a crossover or a proof is tried again. Chosen: a crossover costs
/// factorisations, a proof a pass in twice the digits.
pub(super) const TRIAL_REDUCTION: f64 = 0.03;
/// Proximal terms that hold unknowns which the states of the contacts leave free, one after the other, once the point
/// has half of its digits. Measured on a settlement of 105 bricks, whose states are found from 7e-10: the free unknowns
/// drift arbitrarily with 1e-12; 1e-10 finds the states.
pub(super) const PROXIMAL_TERMS: [f64; 2] = [1e-10, 1e-8];
/// Attempts of pivots from the end of a path. Chosen: the second has the basis of the first, whose data may be spoilt
/// by rounding.
pub(super) const PIVOTED_ATTEMPTS: usize = 2;
/// Largest number of variables of a problem whose path ends by pivots. Chosen: as many pivots as a larger problem has
/// variables take longer than the path.
pub(super) const PIVOTED_ORDER: usize = 1000;
/// Steps from a point that is solved but whose states are not yet those of the exact answer. Chosen.
pub(super) const MORE_STEPS: usize = 8;

/// Largest change of a gap by the predictor, relative to the mean gap, for which a start is wide enough. Chosen: walls
/// of bricks keep their first start.
pub(super) const WIDE_ENOUGH: f64 = 2.0;
/// A start that is too narrow is opened by this many times its mean gap. Measured on a beam that is lifted at its end:
/// two or three times are enough.
pub(super) const WIDENING: f64 = 100.0;

/// Multiples of the largest gap by which starts are opened, one after the other. Measured on walls of 1000 bricks: easy
/// walls need a third fewer steps from gaps that are not opened; walls near their limit and on open bases, on which all
/// other attempts jam whatever the friction, are solved in 35 to 80 steps from gaps opened by 1e3 or 1e4.
pub(super) const OPENINGS: [f64; 3] = [0.0, 1e4, 1e3];
/// Steps without a reduction of the merit (mean product plus squared defect) by a tenth after which an attempt is left.
/// Measured on settlements: 12 loses an open base that 15 solves; 20 and 30 take 5 to 15 more steps in attempts that
/// jam, and solve no other problem.
pub(super) const PATIENCE: usize = 15;
/// The smallest product of a central pair, relative to the mean; the largest is the inverse of this number. Theory: the
/// box of Gondzio (1996). Measured on walls: with 0.01 and 0.3 some are solved and others not.
pub(super) const CENTRAL: f64 = 0.1;
/// Part of the longest step that is taken. Theory: the point must stay in the interior; the usual value of predictor
/// and corrector.
pub(super) const FRACTION_TO_BOUNDARY: f64 = 0.995;
/// The factor by which a step is shortened that makes a product too small. Chosen.
pub(super) const SHORTER: f64 = 0.7;
/// Largest number of correctors of the centrality of a step. Chosen: each costs a solve (Gondzio 1996).
pub(super) const CORRECTORS: usize = 2;
/// A step of this length needs no corrector. Chosen.
pub(super) const LONG_ENOUGH: f64 = 0.9;
/// The least gain in length of a step by a corrector. Measured on an elastic wall of 105 bricks on an open base: if any
/// gain is accepted, the steps never settle, and the fall of the wall is not detected.
pub(super) const LONGER: f64 = 0.03;
/// Products are not driven below this part of their mean by a corrector. Chosen.
pub(super) const LEAST_AIM: f64 = 0.01;
/// A step below this length is replaced by a mixture of the predictor and of centring; a mixture must reduce the
/// products by as much, except at points that are central already. Chosen.
pub(super) const SHORT: f64 = 0.05;
/// Shares of centring that are tried. Chosen.
pub(super) const MIXTURES: [f64; 12] =
    [0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.98];
/// Products between these multiples of their mean make a point central. Chosen.
pub(super) const IS_CENTRAL: (f64, f64) = (0.3, 3.0);
/// Largest relative changes of a variable by a piece of the path; the first one that leaves a step of length [`LONG`]
/// is taken. Chosen.
pub(super) const ARC_FRACTIONS: [f64; 6] = [1.0, 0.5, 0.25, 0.1, 0.03, 0.0];
/// See [`ARC_FRACTIONS`]. Chosen.
pub(super) const LONG: f64 = 0.7;

/// Least distance of a start of the homogeneous problem from the bounds, relative to the largest pull. Measured on
/// rigid walls of 10 000 bricks: open bases take 26, 39, 41 and 55 steps with a friction of 1, 0.6, 0.59 and 0.58,
/// which is next to the least; with ten times the pull 24, 35, 51 and 72. A wall of 100 000 bricks takes 65, with ten
/// times 70, with 1.5 times 106. No contact of a full floor pulls, and the mean is enough.
pub(super) const START_SHIFT: f64 = 20.0;

/// Largest multiple of the largest load by which the balance of forces is measured. Measured on a tilted wall of 10 050
/// bricks: forces are thousands of loads.
pub(super) const LOADS: f64 = 100.0;
/// Largest number of corrections of forces that nearly balance the loads. Measured on walls of 10 000 bricks: two reach
/// rounding errors; near the limit each only halves the imbalance, since small forces become zero.
pub(super) const BALANCINGS: usize = 6;
