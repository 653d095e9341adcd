//! Every tolerance of the tests, each with the worst case that was measured beside it.

/// Relative error of losses, per-scene losses and mean renderings in f64 against the golden numbers.
pub const GOLDEN_LOSS_F64: f64 = 1e-9; // measured: 6.7e-13
/// As [`GOLDEN_LOSS_F64`], in f32.
pub const GOLDEN_LOSS_F32: f64 = 2e-5; // measured: 4.2e-6
/// Relative error of single rendered texels in f64 against the golden numbers.
pub const GOLDEN_PROBE_F64: f64 = 1e-9; // measured: 1.5e-14
/// As [`GOLDEN_PROBE_F64`], in f32.
pub const GOLDEN_PROBE_F32: f64 = 2e-5; // measured: 1.8e-6
