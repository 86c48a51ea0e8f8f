//! The numbers that the interior-point method goes by, each with where it comes from.
//! What is "chosen" is so by judgement: no measurement is kept.

/// Residuals above which no crossover is tried. Chosen: every trial costs factorisations.
pub(super) const NEAR: f64 = 3e-6;
/// The residual must have decreased by this factor before it is tried again. Chosen.
pub(super) const NEARER: f64 = 0.03;
/// Natural residual below which what the states of the contacts leave free is held where it is. Measured on a settlement
/// of 105 bricks, whose states are found from 7e-10.
pub(super) const SURE: f64 = 1e-8;
/// Proximal terms that hold it, one after the other. Measured there: 1e-12 lets it go anywhere, 1e-10 finds the states.
pub(super) const HELD: [f64; 2] = [1e-10, 1e-8];
/// Steps without a reduction of the products by a tenth after which the iteration has jammed. Measured on walls: one
/// that was stuck for some 40 steps was better left; where the path turns back products grow for a while.
pub(super) const PATIENCE: usize = 30;
/// Steps from a point that is solved but whose states are not yet those of the exact answer. Chosen.
pub(super) const MORE: usize = 8;
/// Steps shorter than this are none. Chosen.
pub(super) const NO_STEP: f64 = 1e-7;

/// Largest change of a gap by the predictor, relative to the mean gap, that a start is wide enough for. Chosen: walls
/// of bricks keep their first start.
pub(super) const WIDE: f64 = 2.0;
/// A start that is not is opened by this many times its mean gap. Measured on a beam that is lifted at its end: two or
/// three times are enough.
pub(super) const OPENED: f64 = 100.0;
/// That must bring the change down by this. Chosen.
pub(super) const HALF: f64 = 0.5;
/// No start is opened more often. Chosen.
pub(super) const OPENINGS: usize = 8;

/// By which multiple of the largest gap starts are opened, one after the other. Measured on walls of 1000 bricks: where gaps
/// are not opened, those that are easy take a third less steps; where they are, by 1e3 or 1e4, walls near their limit and on
/// open bases are solved in 35 to 80 steps, on which all other attempts jam, whatever the friction.
pub(super) const STARTS: [f64; 3] = [0.0, 1e4, 1e3];
/// The same for steps of bodies with mass. Measured on settlements of 105 and 410 bricks, elastic and rigid: of some 120 tries 19
/// fail; with 0, 1e3 and 1e4 in its place it is 33 of 148, 24 of 131 and 50 of 174.
pub(super) const OPENING_OF_STEP: f64 = 1.0;
/// The same where friction is reduced. Measured there: of ten walls that stand, and on which the path has jammed, this
/// solves all but one; with 1e2 in its place it is two, and with no opening three.
pub(super) const REDUCED_START: f64 = 1e4;
/// Steps without a reduction after which an attempt is left. Measured there: with 12 an open base is lost that the path solves
/// with 15; with 20 and 30 those that jam take 5 to 15 more, and no other is solved.
pub(super) const PATIENCE_OF_START: usize = 15;
/// Least product of a pair, relative to the mean. Measured on walls: with 0.01 and 0.3 some are solved and others not.
pub(super) const WIDTH: f64 = 0.1;
/// Part of the longest step that is taken. Theory: it must stay inside; the usual value of predictor and corrector.
pub(super) const BACK: f64 = 0.995;
/// A step that makes a product smaller than it may be is shortened by this. Chosen.
pub(super) const SHORTER: f64 = 0.7;
/// No step is made shorter than this for it. Chosen.
pub(super) const SHORTEST: f64 = 1e-4;
/// Correctors of the centrality of a step, at most. Chosen: each costs a solve (Gondzio 1996).
pub(super) const CORRECTORS: usize = 2;
/// A step of this length needs none. Chosen.
pub(super) const LONG_ENOUGH: f64 = 0.9;
/// A corrector has to make the step longer by this. Chosen.
pub(super) const LONGER: f64 = 0.03;
/// Products of the pairs, relative to what they should be, that correctors leave alone. Theory: the box of Gondzio
/// (1996).
pub(super) const CENTRAL: (f64, f64) = (0.1, 10.0);
/// Products are not driven below this part of their mean by a corrector. Chosen.
pub(super) const LEAST_AIM: f64 = 0.01;
/// Below this length a step is replaced by a mixture of the predictor and of centring. Chosen.
pub(super) const SHORT: f64 = 0.05;
/// Shares of centring that are tried. Chosen.
pub(super) const MIXTURES: [f64; 12] =
    [0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.98];
/// A mixture must reduce the products by this part, except at points that are central already. Chosen.
pub(super) const PROGRESS: f64 = 0.05;
/// Products between these multiples of their mean make a point central. Chosen.
pub(super) const IS_CENTRAL: (f64, f64) = (0.3, 3.0);
/// Compliance of a contact, relative to that of the bodies, below which a step does not go. Rounding: forces are
/// differences of gaps times a stiffness, and lose their digits when that is too large. A step is a proximal one then,
/// which changes nothing where the iteration ends.
pub(super) const COMPLIANCE: f64 = 1e-8;
/// Largest relative change of a variable by a piece of the path; the first that leaves a step of length [`LONG`] is
/// taken. Chosen.
pub(super) const PIECES: [f64; 6] = [1.0, 0.5, 0.25, 0.1, 0.03, 0.0];
/// See [`PIECES`]. Chosen.
pub(super) const LONG: f64 = 0.7;

/// The first springs, relative to the stiffness. Chosen.
pub(super) const FIRST_SPRING: f64 = 0.1;
/// The last springs. Chosen.
pub(super) const LAST_SPRING: f64 = 1e-9;
/// Factor from one spring to the next. Chosen.
pub(super) const SOFTER: f64 = 0.1;
/// Where one spring ends the pairs are too near the boundary for the next: they are lifted by this part of the largest
/// force and gap. Chosen.
pub(super) const LIFT: f64 = 0.1;
/// Steps for one spring. Chosen.
pub(super) const STEPS: usize = 60;
/// The natural residual up to which the problem with springs is solved, relative to the largest force. Chosen: only
/// shares are wanted.
pub(super) const ACCURACY: f64 = 1e-5;
/// Springs that carry less than this share of the load have nothing to say any more. Chosen.
pub(super) const NOTHING: f64 = 1e-7;
/// Where a tenth of the spring still carries this part of what the spring carried, several times in sequence, the
/// share does not tend to zero. Theory: the part tends to a tenth where there is an equilibrium, else to one.
pub(super) const CONSTANT: f64 = 0.8;
/// How many times. Chosen.
pub(super) const IN_SEQUENCE: usize = 4;
/// Stiffer springs than this do not tell bodies that nothing holds from those that something soft does. Chosen.
pub(super) const SOFT: f64 = 2e-6;
/// Resistance of a motion, relative to that of springs of the square, which is an error of the solution: its accuracy
/// enters by the square as well. Chosen.
pub(super) const RESISTANCE: f64 = 1e-6;
/// Resistance of a body, relative to the terms that it is the sum of, which is a rounding error. Rounding: errors of
/// short sums.
pub(super) const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Shorter steps to a point with springs are none. Chosen.
pub(super) const LEAST_STEP: f64 = 1e-6;

/// The slips over which friction turns, relative to the largest displacement of the start, one after the other. Measured on
/// settlements of walls of 1000 bricks: with 1e-5 they take twice the steps; most come to rest with 1e-3 where `mu` is below
/// one, and all others with 1, in 20 to 40 steps each; with a fixed slip some do not end. With 1e-2 in between an arch whose
/// supports close has three quarters of its thrust.
pub(super) const SMOOTH: [f64; 2] = [1e-3, 1.0];
/// A slip longer than this multiple of the shortest of them, for the displacements at hand, is too long: then what friction
/// yields by is more than a tenth of them. Measured on settlements of rigid walls of 1000 bricks: with a hundredth in its
/// place they take three times the steps.
pub(super) const BLUNT: f64 = 100.0;
/// The residual at which that is seen. Measured on settlements of rigid walls of 1000 bricks: with 1e-3 they take the
/// fewest steps; at 1e-2 displacements are five times too large yet.
pub(super) const SHARPENED: f64 = 1e-3;
/// How often the slip is renewed at most. Chosen.
pub(super) const SHARPER: usize = 3;
/// No more of friction acts at the start. Chosen: away from the boundary.
pub(super) const MOST_FRICTION: f64 = 0.99;
/// Least product of a pair, relative to what it should be, where friction is smooth. Measured there: with 0.1 steps are
/// shortened by a third for nothing.
pub(super) const SMOOTH_WIDTH: f64 = 0.01;
/// Springs that hold bodies during a step there, relative to their stiffness. Rounding: the stiffness of the stiffest
/// contact, the inverse of [`COMPLIANCE`], times the last digit. Measured on walls of 4000 bricks: with less, steps near rest
/// become shorter than any that counts.
pub(super) const HELD_SMOOTH: f64 = 1e-8;
/// Where gaps and forces are complementary to this, relative to the largest force, the equations of the states may do
/// the rest. Measured there: mostly with the first, some with the last.
pub(super) const SETTLED: [f64; 3] = [1e-7, 1e-9, 1e-11];
/// Forces outside their cones and gaps closed by more than this part of the largest are not worth a judge. Chosen.
pub(super) const ADMISSIBLE: f64 = 1e-7;
/// Steps in which the residual has to be halved on the way there. Measured on tilted and settling walls of 1000 bricks: where
/// it was not, it never fell below a hundredth in 45; ways that ended took 10 to 40. With 12 in its place settlements take a tenth
/// more.
pub(super) const SETTLING: usize = 8;
/// Steps down to [`SHARPENED`] at most. Measured on settlements of walls of 1000 bricks: 480 of 483 ways that ended took no more,
/// and the three 22 to 27. Where rest was not found, elastic ones took up to 25, and those of 10 000 bricks up to 34.
pub(super) const MOST_STEPS: usize = 20;
/// Steps in which the residual has to be halved, down to [`SHARPENED`], where reduced friction is still to be tried. Measured on
/// walls of 10 000 bricks on full floors: those that rest by smooth friction in 15 to 30 steps do so in every second one, and
/// reduced friction would take some 80. Other walls of 1000 bricks are left after 3 to 6.
pub(super) const HURRY: usize = 2;
/// Stiffness of closed contacts in these equations, and of springs that hold every displacement, relative to that of the
/// bodies. Rounding: the first times the last digit must be far below the second, or loose bodies fly off. Measured on
/// walls of 4000 bricks.
pub(super) const STIFF_CLOSED: f64 = 1e4;
/// See [`STIFF_CLOSED`].
pub(super) const HELD_CLOSED: f64 = 1e-9;

/// Where smooth friction of rigid bodies has come to this, relative to the largest force, a convex program closes the contacts.
/// Measured on settlements of rigid walls of 1000 bricks: from 1e-3 no state at rest is found, and from 1e-4 to 1e-6 histories
/// take about as many factorisations; smooth friction often creeps below 1e-5.
pub(super) const NEARLY_SETTLED: f64 = 1e-5;
/// Gaps up to this multiple of their normal force are closed, where such programs begin; lengths and forces are those of the
/// scaled problem. Measured on settlements of rigid walls of 2300 bricks: with 1e-5 and 1e-2 all are found.
pub(super) const CLEARLY_CLOSED: f64 = 1e-2;
/// Rounds of these programs, and factorisations until forces balance the loads. Measured on settlements of rigid walls of 1000
/// and 10 000 bricks: one to three, and one or two.
pub(super) const ROUNDS: usize = 4;
/// Steps of such a program. Chosen: they take 10 to 20.
pub(super) const ROUND: usize = 60;
/// Accuracy of gaps and forces in such a program, relative to the largest gap that is left. Measured there: what is left
/// decreases by three to five powers of ten a round.
pub(super) const CLOSED: f64 = 1e-6;
/// Accuracy up to which steps go on that halve the residual. Measured there: with 1000 bricks it is reached, and one round is
/// enough instead of two; with 10 000 steps become slow at 1e-7 or 1e-8.
pub(super) const CLOSED_EXACTLY: f64 = 1e-9;
/// How far forces and gaps are from their bounds where such a program begins, relative to the largest force and the largest gap
/// that is left. Measured there: programs take 10 to 20 steps instead of 15 to 30.
pub(super) const LIFTED: (f64, f64) = (1e-3, 1e-5);
/// Stiffness that keeps bodies where they are in such a program, relative to the forces that close contacts over the gaps
/// that are left. Chosen: the forces win.
pub(super) const KEPT: f64 = 1e-6;
/// Contacts with gaps larger than this multiple of those that are left stay open in such a program. Chosen.
pub(super) const REACH: f64 = 1e4;
/// What may be left of the balance of the loads then, relative to the largest force. Rounding.
pub(super) const UNBALANCED: f64 = 1e-12;
/// Stiffness that keeps bodies where they are while all gaps are closed exactly, relative to the stiffness of contacts.
/// Rounding: errors are multiplied by its inverse.
pub(super) const KEPT_EXACTLY: f64 = 1e-9;
/// Refinements of that. Chosen: each reduces the gaps by several powers of ten.
pub(super) const REFINED: usize = 4;

/// The first viscosity of a motion, relative to the stiffness. Measured on settlements of walls of 100 to 1000 bricks.
pub(super) const FIRST_VISCOSITY: f64 = 1e-4;
/// Factor from one motion to the next. Measured: with 8 to 30 walls come to rest after three to nine motions.
pub(super) const LESS_VISCOUS: f64 = 30.0;
/// Part of the start of a motion that is the solution of the last. Measured there: with 0.99 to 0.9999 motions take three steps
/// less than with nothing, with 0.9 as many, and with 0.99999 one or two less.
pub(super) const WARM: f64 = 0.99;
/// Factor where a motion cannot be computed. Chosen.
pub(super) const MORE_VISCOUS: f64 = 8.0;
/// Viscosities beyond these are not tried. Chosen.
pub(super) const MOST_VISCOSITY: f64 = 1.0;
/// See [`MOST_VISCOSITY`]. Rounding: what is less is lost beside the stiffness.
pub(super) const LEAST_VISCOSITY: f64 = 1e-12;
/// The accuracy of a motion, relative to the largest force and gap, and of its balance relative to the largest load. Measured
/// on settlements of walls of 1000 bricks: motions take 12 to 17 steps. With 1e-2 they take 8 to 11, but bodies that stand
/// elsewhere are said to flow. With the balance relative to the largest force a flow of a wall near its limit is not found.
pub(super) const MOVED: f64 = 1e-3;
/// A motion that is so much longer than the one before, with more viscosity, may be that of bodies that flow. Measured on
/// tilted walls of 1000 bricks: those that stand stay below 1.5, those that fall come to 2.7 and more.
pub(super) const LONGER_MOTION: f64 = 2.0;
/// Part of the longest at the same viscosity to which motions of bodies that come to rest decrease. Chosen.
pub(super) const SLOWER: f64 = 0.5;
/// Where a motion has this part of the length of the one before, several times in sequence, bodies flow. Theory: the
/// part is one then.
pub(super) const SAME_LENGTH: f64 = 0.9;
/// How many times. Chosen.
pub(super) const FLOWING: usize = 4;
/// Where viscosity takes this part at least of the load that it took when it was larger, nothing else resists the bodies.
/// Measured on tilted walls of 1000 bricks: 0.8 and more where they flow freely, a third or less where they do not. An exact
/// motion of bodies that flow has at least this part of the length of the last one; chosen.
pub(super) const AS_FREE: f64 = 0.5;
/// Of such motions this part at least must be left when closed contacts and a stiffness of [`SOFTEST`] resist them. Measured
/// on tilted walls of 1000 bricks that flow: 0.93 and more; a body that moves against a spring or to a stop has next to
/// nothing. Chosen: the middle.
pub(super) const FREE: f64 = 0.5;
/// Bodies that reach a stop when they move on so many times as far do not flow yet. Chosen.
pub(super) const AHEAD: f64 = 4.0;
/// Nor do those that come nearer to others, by this part of the largest displacement, than the motions took them.
/// Measured: more than 0.2 of a body on a spring, less on walls of 36 bricks that flow.
pub(super) const THROUGH: f64 = 0.2;
/// Relative to the stiffness of the bodies. Rounding: springs softer than some hundred eps cannot be told from none.
pub(super) const SOFTEST: f64 = 1e-13;
/// Motions of the same length that are shorter than this part of the longest are none of bodies that flow: gaps that slips
/// open, and that the next motion closes, may keep them up. Measured on walls of 36 and 64 bricks: 0.02 and more where they
/// fall, and 5e-4 of one that has an equilibrium.
pub(super) const CREEPING: f64 = 1e-2;
/// The accuracy of the motions after that, and the relative change of the last one, which is the mechanism. Chosen.
pub(super) const STEADY: f64 = 1e-9;
/// No more of them. Theory: the change decreases by `mu^2 / (1 + mu^2)` in each where a block slides.
pub(super) const STEADY_MOTIONS: usize = 12;
/// Where the change does not decrease by this, the mechanism is the mean of the motions. Measured on walls of 1000
/// bricks: blocks that hit each other change it by a tenth to a half of the largest velocity for ever.
pub(super) const STEADIER: f64 = 0.75;
/// How often rest is tried after motions. Chosen: walls that come to rest do at the first or the second.
pub(super) const TRIES: usize = 4;
/// How many of them are left after the motions that show whether bodies flow. Chosen.
pub(super) const LAST_TRIES: usize = 2;

/// What a row of `K v` or a contact may miss in a proof, relative to its terms. Rounding: some hundred eps.
pub(super) const ROW_ROUNDING: f64 = 1e-13;
/// Least work of the loads on a proof, relative to the sizes of loads and motion. Chosen: far above rounding.
pub(super) const LEAST_WORK: f64 = 1e-9;
/// Residual of the problem that decides whether any forces balance the loads. Chosen: below all other tolerances.
pub(super) const BALANCE_TOLERANCE: f64 = 1e-12;

/// Distance of a start of the homogeneous problem from the bounds, at least, relative to the largest pull. Measured on rigid
/// walls of 10 000 bricks: open bases take 26, 39, 41 and 55 steps with a friction of 1, 0.6, 0.59 and 0.58, which is next to
/// the least; with ten times the pull 24, 35, 51 and 72. Of 100 000 bricks one takes 65; with ten times 70, with 1.5 times
/// 106. On a full floor nothing pulls, and the mean is enough.
pub(super) const AWAY: f64 = 20.0;

/// Multiple of the largest load by which the balance of forces is measured at most. Measured on a tilted wall of 10 050
/// bricks: forces are thousands of loads.
pub(super) const LOADS: f64 = 100.0;
/// Corrections of forces that balance the loads nearly. Measured on walls of 10 000 bricks: two reach rounding errors; near the
/// limit each leaves half, since small forces become zero.
pub(super) const BALANCINGS: usize = 6;
/// Error of a proof, relative to what it shows, at which it is tried. Chosen.
pub(super) const PROVED: f64 = 1e-6;
/// The error must have decreased by this factor before it is tried again. Chosen: every trial costs a pass in twice the
/// digits.
pub(super) const STRICTER: f64 = 0.03;
