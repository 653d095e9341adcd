//! Every tolerance of the tests, each with the worst case that was measured beside it.

/// GPU and f32 CPU against f64, at single points: the error of every operation on vectors of length about 1, in
/// units of 2^-24, from which `points::error_bound` derives a bound for each point.
///
/// Measured on 800,000 random and extreme points in four conventions, lavapipe and CPU alike: 3.8 needed.
pub const POINT_ULPS: f64 = 8.0;

/// The same for whole renderings on the GPU, where the shader also computes positions and directions.
///
/// Measured: 3.8 needed on lavapipe, whose divisions are correctly rounded. Vulkan allows 2.5 units in the last place.
pub const RENDERING_ULPS: f64 = 16.0;

/// GPU against the golden points: the factor on `max(kappa, 1) 2^-24 |expected|`.
pub const GOLDEN_FACTOR: f64 = 16.0;

/// Golden points of a larger condition number say nothing in f32.
pub const GOLDEN_LARGEST_KAPPA: f64 = 1e5;

/// Levels of 255 that a pixel of the screen may be off: rounding, at most half a level each way.
///
/// Measured: 1.
pub const SCREEN_LEVELS: u8 = 1;
