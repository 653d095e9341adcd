//! The colour map of differences: for legends, and the twin of `shaders/colour_map.wgsl`.

/// Coefficients of rising powers: the polynomial fit of matplotlib's `inferno` that Matt Zucker placed under CC0.
const COEFFICIENTS: [[f32; 3]; 7] = [
    [0.000_218_940_37, 0.001_651_004_6, -0.019_480_899],
    [0.106_513_42, 0.563_956_44, 3.932_712_4],
    [11.602_493, -3.972_854, -15.942_394],
    [-41.703_995, 17.436_4, 44.354_145],
    [77.162_93, -33.402_36, -81.807_31],
    [-71.319_43, 32.626_064, 73.209_52],
    [25.131_126, -12.242_669, -23.070_325],
];

/// The colour, encoded for the screen, of an amount from 0 (black) to 1 (light yellow); what lies beyond is clamped.
pub fn heat(amount: f32) -> [f32; 3] {
    let t = amount.clamp(0.0, 1.0);
    let polynomial = |c: usize| COEFFICIENTS.iter().rev().fold(0.0, |sum, row| sum * t + row[c]);
    [0, 1, 2].map(|c| polynomial(c).clamp(0.0, 1.0))
}
