//! The linear algebra that a path needs, dense or sparse.

/// A variable of a path: `w_k` is `k`, `z_k` is `n + k`, the artificial one `2 n`.
pub(super) type Var = usize;

/// The other variable of the pair, for `n` pairs.
pub(super) fn complement(var: Var, n: usize) -> Var {
    if var < n { var + n } else { var - n }
}

/// The columns of `w + T z - d z0 = q` in terms of the present basis.
///
/// Start coordinates are the coordinates of the data: the basic variables of the start basis for the dense kernel,
/// the equilibrated rows of the problem for the sparse one.
pub(super) trait Kernel {
    /// `q` in start coordinates.
    fn right_hand_side(&self) -> &[f64];

    /// Adds the column of a variable, times a factor, in start coordinates.
    fn add_start_column(&self, var: Var, factor: f64, out: &mut [f64]);

    /// The column of a nonbasic variable in the present basis.
    fn column(&mut self, var: Var, out: &mut [f64]);

    /// The variable `entering` takes the place of `leaving` in `row`; `column` is its column, the last one computed.
    fn exchange(&mut self, row: usize, entering: Var, leaving: Var, column: &[f64]);

    /// A row of the inverse of the basis, as factors for [`entry`](Self::entry).
    fn row(&self, row: usize) -> Vec<f64>;

    /// The entry of a row with these factors in the column of a nonbasic variable.
    fn entry(&self, row: usize, factors: &[f64], var: Var) -> f64;

    /// A vector that breaks ties as a small multiple of it on the right-hand side would, in terms of the present
    /// basis and constant in start coordinates; only if rows are expensive.
    fn parting(&self) -> Option<Vec<f64>>;

    /// Whether the exchanges held back should be applied.
    fn is_due(&self) -> bool;

    /// Applies the exchanges held back. `false` if a rebuild is necessary.
    fn apply(&mut self) -> bool;

    /// Rebuilds from the start data with the given basis, whose values it computes. `false`, with nothing changed, if
    /// the basis is singular.
    fn rebuild(&mut self, basic: &[Var], values: &mut [f64]) -> bool;

    /// Applies exchanges if they are due. `false` if the basis is singular.
    fn tidy(&mut self, basic: &[Var], values: &mut [f64]) -> bool {
        !self.is_due() || self.apply() || self.rebuild(basic, values)
    }
}
