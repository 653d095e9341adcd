//! Counts of finite numbers outside [0, 1].

/// Finite numbers outside [0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OutOfRange {
    pub count: usize,
    /// The least of them, or 0.
    pub low: f64,
    /// The largest of them, or 1.
    pub high: f64,
}

impl Default for OutOfRange {
    fn default() -> Self {
        Self { count: 0, low: 0.0, high: 1.0 }
    }
}

impl OutOfRange {
    /// Counts `value` if it is one of them.
    #[must_use]
    pub(crate) fn and(self, value: f64) -> Self {
        let count = self.count + usize::from(!(0.0..=1.0).contains(&value));
        Self { count, low: self.low.min(value), high: self.high.max(value) }
    }

    #[must_use]
    pub(crate) fn merged(self, other: Self) -> Self {
        Self {
            count: self.count + other.count,
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }
}
