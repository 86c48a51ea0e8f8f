//! What a path needs of the linear algebra, dense or sparse.

/// A variable of a path: `w_k` is `k`, `z_k` is `n + k`, the artificial one `2 n`.
pub(super) type Var = usize;

/// The other variable of the pair, of `n` pairs.
pub(super) fn complement(var: Var, n: usize) -> Var {
    if var < n { var + n } else { var - n }
}

/// The columns of `w + T z - d z0 = q` in terms of the present basis.
///
/// Start coordinates are those in which the data are held: for the dense kernel the basic variables
/// of the start basis, for the sparse one the equilibrated rows of the problem.
pub(super) trait Kernel {
    /// `q` in start coordinates.
    fn right_hand_side(&self) -> &[f64];

    /// Adds the column of a variable, times a factor, in start coordinates.
    fn add_start_column(&self, var: Var, factor: f64, out: &mut [f64]);

    /// The column of a nonbasic variable in the present basis.
    fn column(&mut self, var: Var, out: &mut [f64]);

    /// The variable `entering` takes the place of `leaving` in `row`; `column` is its column, the last one asked for.
    fn exchange(&mut self, row: usize, entering: Var, leaving: Var, column: &[f64]);

    /// A row of the inverse of the basis, as factors that [`entry`](Self::entry) understands.
    fn row(&self, row: usize) -> Vec<f64>;

    /// The entry of a row with these factors in the column of a nonbasic variable.
    fn entry(&self, row: usize, factors: &[f64], var: Var) -> f64;

    /// A vector that breaks ties as a small multiple of it on the right-hand side would, in terms of the
    /// present basis and constant in start coordinates; only if rows cost much.
    fn parting(&self) -> Option<Vec<f64>>;

    /// Whether the exchanges held back should be dealt with.
    fn is_due(&self) -> bool;

    /// Deals with the exchanges held back. `false` when that takes a new start.
    fn apply(&mut self) -> bool;

    /// Starts anew from the start data with the given basis, whose values it computes. `false`, and
    /// nothing changed, when the basis is singular.
    fn rebuild(&mut self, basic: &[Var], values: &mut [f64]) -> bool;

    /// Deals with what is due, if anything is. `false` when the basis is singular.
    fn tidy(&mut self, basic: &[Var], values: &mut [f64]) -> bool {
        !self.is_due() || self.apply() || self.rebuild(basic, values)
    }
}
