//! The two precisions that everything is computed in.

use std::fmt::{Debug, Display};

use num_traits::{Float, FloatConst};

/// A floating-point type that the core computes in: `f32` or `f64`.
///
/// `f64` is the reference; `f32` is what the GPU and the fast paths use.
pub trait Real: Float + FloatConst + Default + Debug + Display + Send + Sync + 'static {
    /// How users call it: `f32` or `f64`.
    const NAME: &'static str;

    /// The nearest value to `x`.
    fn of(x: f64) -> Self;

    /// The value as `f64`, exactly.
    fn f64(self) -> f64;
}

impl Real for f32 {
    const NAME: &'static str = "f32";

    fn of(x: f64) -> Self {
        x as f32
    }

    fn f64(self) -> f64 {
        f64::from(self)
    }
}

impl Real for f64 {
    const NAME: &'static str = "f64";

    fn of(x: f64) -> Self {
        x
    }

    fn f64(self) -> f64 {
        self
    }
}
