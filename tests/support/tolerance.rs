//! Every tolerance of the tests, each with the worst case that was measured beside it.

/// Relative error of losses, mean renderings and single texels against the golden numbers.
pub const GOLDEN_F64: f64 = 1e-9; // measured: 6.7e-13
pub const GOLDEN_F32: f64 = 2e-5; // measured: 4.2e-6

/// Golden points: |got - expected| in units of max(kappa, 1) u |expected|, with kappa the condition number of the
/// point and u the unit roundoff of the precision. The factor was given together with the points. Worst measured:
///
/// | | printed | guided-2020 | D | G | F |
/// |---|---|---|---|---|---|
/// | f64 | 5.13 | 3.46 | 10.4 | 8.00 | 8.85 |
/// | f32 | 2.19 | 2.10 | 7.8 | 6.28 | 7.55 |
/// | lavapipe | 2.19 | | | | |
/// | f64 | 5.13 | 4.36 | 7.64 | 8.00 | 8.84 |
/// | f32 | 2.19 | 2.10 | 5.02 | 1.07 | 7.55 |
///
/// The terms D, G and F are held to the kappa of the whole, which may be smaller than their own.
pub const GOLDEN_POINTS: f64 = 16.0;

/// Golden points with a larger condition number are not held to a bound in f32, only to being finite and not negative.
pub const GOLDEN_POINTS_F32_KAPPA: f64 = 1e5;

/// |the integral of D(n.h) (n.h) over the hemisphere - 1| for r from 1 to 1e-4, in f64, f32 and by the kernel. The quadrature is
/// within 2e-8.
pub const NORMALIZATION: f64 = 1e-5; // measured: 4.2e-9, 1.1e-7, 1.1e-7

/// Reciprocity: the relative change of the reflectance when light and view are swapped, in units of u. Only v.h and
/// l.h differ, by rounding, which a short l + v magnifies. Worst of 20,000 random points with light and view down to
/// z = 0.01: 68.3 in f64, 32.8 in f32.
pub const RECIPROCITY: f64 = 256.0;

/// Kolmogorov-Smirnov: sqrt(n) D of n values that should be uniform. A right sampler exceeds it once in 1,000
/// draws; the seeds are fixed, so the test either fails always or never. Worst measured: 1.44. Planted faults: a
/// sigma of 0.75 for 0.866 gives 5.4, an upper end of u1 of 0.9 for 0.95 gives 7.9.
pub const KOLMOGOROV: f64 = 1.95;

/// Chi-squared of pairs of coordinates over 8 x 8 cells (63 degrees of freedom), also once in 1,000 draws. Worst of
/// the 21 pairs of one scene: 100.2.
pub const CHI_SQUARED_63: f64 = 103.4;

/// Positions and directions of order 1 in f64, after a handful of operations: absolute.
pub const GEOMETRY_F64: f64 = 1e-14;

/// Golden scenes: relative. They go through sin, cos, exp and the inverse normal distribution, whose last bits may
/// differ between mathematical libraries. Measured on the machine that made them: 0.
pub const GOLDEN_SCENES: f64 = 1e-12;

/// A loss against the sum over its texels written out, in f64: relative, for the order of the sum.
pub const LOSS_SUM_F64: f64 = 1e-14;

/// GPU and f32 CPU against f64, at single points: the error of every operation on vectors of length about 1, in
/// units of 2^-24, from which `points::error_bound` derives a bound for each point.
///
/// Measured on 800,000 random and extreme points in four conventions, lavapipe and CPU alike: 3.8 needed.
pub const POINT_ULPS: f64 = 8.0;

/// The same for whole renderings in f32 and on the GPU, where positions and directions are computed, too.
///
/// Measured: 2.9 needed on lavapipe, whose divisions are correctly rounded; Vulkan allows 2.5 units in the last place.
pub const RENDERING_ULPS: f64 = 16.0;

/// Levels of 255 that a pixel of the screen may be off: rounding, at most half a level each way.
///
/// Measured: 1.
#[cfg(feature = "viewer")]
pub const SCREEN_LEVELS: u8 = 1;
/// Losses in f32 against f64, relative: of the mean, and of single scenes. Random materials with r >= 1/255 and the golden cases, any
/// convention and instruction set. Worst measured: 3.4e-8 and 1.4e-7; required 1e-6.
pub const LOSS_RANDOM: [f64; 2] = [3e-7, 2e-6];
/// The same of materials of a few texels.
pub const LOSS_SMALL: [f64; 2] = [2e-6; 2];
/// The same for two materials that differ by 0.01 in r: the loss is small against what it is a difference of.
/// Worst measured 1.1e-7.
pub const LOSS_SIMILAR: [f64; 2] = [2e-6; 2];
/// The same where every texel is in the peak of a highlight of r = 1/255: a rounding of a direction is 0.4% of its
/// width. Worst measured 1.2e-8, over 16,384 texels.
pub const LOSS_PEAK: [f64; 2] = [3e-7; 2];
/// The same for mirrors, grazing normals and lights in the plane. Worst measured 2.5e-6 (a loss of 0.001).
pub const LOSS_EXTREME: [f64; 2] = [1e-5; 2];
/// Errors of losses below it are taken relative to it: the logarithms' arguments are f32, whose rounding stays.
pub const LOSS_LEAST: f64 = 0.02;
/// Single texels of renderings by the kernel against f64, in the unit of POINT_ULPS: its reciprocal roots are estimates with
/// one Newton step, off by 4 of them. Worst measured: 8.5.
pub const SIMD_ULPS: f64 = 16.0;

/// Errors of a study against those of plain f64 losses: relative. Losses in f32 are off by a relative 1e-7, errors of
/// 1e-2 and more by a hundred times as much at most. Another seed for one of 32 moves them by more than 1e-3.
pub const STUDY_ERROR: f64 = 1e-5; // measured: 7.0e-8
/// The reference of a study against a loss over other scenes and all texels, in the measured error of such losses.
pub const STUDY_REFERENCE: f64 = 4.0; // measured: 0.85
/// The largest relative error of an f32 rung at a well-conditioned point, where one ulp (2 u) of a number of the input
/// changes the result by 1e-4 at most: kappa u <= 5e-5, and 16 kappa u, the bound of [`GOLDEN_POINTS`], is 8e-4. Rounded
/// up, since several numbers round.
const RIGHT: f64 = 1e-3;
/// Extremes: the relative error of [f64, f32, SIMD, WGSL] in each region of tests/ladder/truth.rs, three
/// channels of 10^7 random points and of the table. Beside each row the worst measured, the GPU being lavapipe, whose
/// divisions are correctly rounded (Vulkan allows 2.5 units in the last place). No relative bound can hold where the
/// problem is ill-conditioned: all values, these too, are held to `points::error_bound`.
pub const EXTREMES: [[f64; 4]; 12] = [
    [5e-14, 4e-5, 1e-5, 6e-5],    // r >= 0.5: 9.2e-15, 1.3e-5, 2.7e-6, 1.3e-5
    [1e-12, 5e-4, 3e-4, RIGHT],   // 0.1 <= r < 0.5: 8.7e-14, 1.4e-4, 7.4e-5, 1.4e-4
    [1e-12, RIGHT, 5e-4, RIGHT],  // r < 0.1, beside the highlight: 2.2e-13, 2.6e-4, 1.4e-4, 2.6e-4
    [1e-12, RIGHT, 5e-4, RIGHT],  // r < 0.1, in it: 2.2e-13, 2.5e-4, 1.9e-4, 2.5e-4
    [1e-12, RIGHT, RIGHT, RIGHT], // r < 0.01, beside the highlight: 3.1e-13, 3.0e-4, 1.9e-4, 3.0e-4
    [1e-12, RIGHT, RIGHT, RIGHT], // r < 0.01, in it: 1.8e-13, 1.9e-4, 1.3e-4, 1.9e-4
    [1e-12, RIGHT, RIGHT, RIGHT], // grazing: 3.2e-13, 2.2e-4, 2.1e-4, 2.2e-4
    [1e-12, RIGHT, RIGHT, RIGHT], // light nearly opposite the view: 6.8e-14, 2.3e-4, 4.0e-5, GPU not measured again
    [NONE, NONE, NONE, NONE],     // ill-conditioned, in the highlight: 9.9e-8 in f64
    [NONE, NONE, NONE, NONE],     // ill-conditioned, light on the horizon: 9.6e-7 in f64
    [NONE, NONE, NONE, NONE],     // ill-conditioned, light nearly opposite the view
    [0.0, 0.0, 0.0, 0.0],         // no light: 0
];
const NONE: f64 = f64::INFINITY;

/// |the sum of the Shapley values - the loss| over the loss, with losses of scenes in f32, which are added in f64.
pub const SHAPLEY_SUM: f64 = 1e-12; // measured: 4.4e-16, on the built-in materials
/// A value of the error map, which is of the order of 1, against renderings in f32 and logarithms in f64.
pub const ERROR_MAP_TEXEL: f64 = 2e-6; // the test prints what it measures

/// Losses of the fixed requests in f64 against their golden numbers: relative. Mathematical libraries differ in the last bits.
pub const REQUESTS_F64: f64 = 1e-12; // measured: 0 on the machine that made them
/// As [`REQUESTS_F64`], in f32 as it is written and on every instruction set.
pub const REQUESTS_F32: f64 = 1e-6; // measured: 3.7e-7 over scalar, AVX2 and AVX-512

/// Pixels of the report in a browser against `svbrdf render`, in steps of 8 bits.
pub const PAGE_PIXELS: u8 = 1; // measured: 1, in 1,262 of 16,281,600 values
/// Readouts and differences of the report, relative to 1 or the larger number.
pub const PAGE_NUMBERS: f64 = 1e-3; // measured: 2.7e-4
/// Cameras of the report, as [`PAGE_NUMBERS`].
pub const PAGE_CAMERA: f64 = 1e-5; // measured: 2.8e-7
