//! Every tolerance of the tests, each with the worst case that was measured beside it.

/// Fused f32 loss against the plain f64 one, relative, any convention and instruction set: random materials with
/// r >= 1/255 and the golden cases. Worst measured 3.4e-8 (metal_a against pyramids_a); required 1e-6.
pub const FUSED_LOSS: f64 = 3e-7;
/// The same, single scenes, and materials of a few texels. Worst measured 1.4e-7 (one texel).
pub const FUSED_SCENE: f64 = 2e-6;
/// The same for two materials that differ by 0.01 in r: the loss is small against what it is a difference of.
/// Worst measured 1.1e-7.
pub const FUSED_SIMILAR: f64 = 2e-6;
/// The same where every texel is in the peak of a highlight of r = 1/255: a rounding of a direction is 0.4% of its
/// width. Worst measured 1.2e-8, over 16,384 texels.
pub const FUSED_PEAK: f64 = 3e-7;
/// The same for mirrors, grazing normals and lights in the plane. Worst measured 2.5e-6 (a loss of 0.001).
pub const FUSED_EXTREME: f64 = 1e-5;
/// Errors of losses below it are taken relative to it: the logarithms' arguments are f32, whose rounding stays.
pub const FUSED_LEAST: f64 = 0.02;
