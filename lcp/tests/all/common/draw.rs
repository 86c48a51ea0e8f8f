//! Small integers from a fixed sequence.

/// A small generator (`SplitMix64`), so that every run has the same problems.
pub(crate) struct Draw(u64);

impl Draw {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// From `low..=high`.
    pub(crate) fn integer(&mut self, low: i32, high: i32) -> i32 {
        let width = u64::from(high.abs_diff(low)) + 1;
        low + i32::try_from(self.next() % width).unwrap_or(0)
    }

    /// From `low..=high`, as a number.
    pub(crate) fn number(&mut self, low: i32, high: i32) -> f64 {
        f64::from(self.integer(low, high))
    }

    /// Below `n`.
    pub(crate) fn index(&mut self, n: usize) -> usize {
        usize::try_from(self.next() % n as u64).unwrap_or(0)
    }

    pub(crate) fn one_of<T: Copy>(&mut self, items: &[T]) -> T {
        items[self.index(items.len())]
    }

    pub(crate) fn is_heads(&mut self) -> bool {
        self.next() >> 63 == 1
    }

    /// `2^k` with `k` from `-most..=most`.
    pub(crate) fn power(&mut self, most: i32) -> f64 {
        f64::from(self.integer(-most, most)).exp2()
    }
}
