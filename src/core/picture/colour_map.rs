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

/// The colour of a difference, in 8 bits: the last one at `range`, [`diverging`] where it is signed and [`heat`] where not.
pub fn difference_to_display(difference: f32, range: f32, signed: bool) -> [u8; 3] {
    let amount = difference / range;
    let colour = if signed { diverging(amount) } else { heat(amount) };
    // A float that is cast saturates, and NaN becomes 0.
    colour.map(|c| (c * 255.0 + 0.5).floor() as u8)
}

/// The colour, encoded for the screen, of an amount from 0 (black) to 1 (light yellow); what lies beyond is clamped.
pub fn heat(amount: f32) -> [f32; 3] {
    let t = amount.clamp(0.0, 1.0);
    let polynomial = |c: usize| COEFFICIENTS.iter().rev().fold(0.0, |sum, row| sum * t + row[c]);
    [0, 1, 2].map(|c| polynomial(c).clamp(0.0, 1.0))
}

/// The colour, encoded for the screen, of a signed amount from -1 (light cyan) over 0 (black) to 1 (light yellow); what
/// lies beyond is clamped.
pub fn diverging(amount: f32) -> [f32; 3] {
    let t = amount.abs().min(1.0);
    let [first, second, third] = [2.2 * t, 1.6 * t - 0.5, 3.0 * t - 2.2].map(|c: f32| c.clamp(0.0, 1.0));
    if amount < 0.0 { [third, second, first] } else { [first, second, third] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_grows_brighter_all_the_way() {
        let luminance = |t: f32| {
            let [r, g, b] = heat(t).map(|c| f64::from(c).powf(2.2));
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        let steps: Vec<f64> = (0..=64_u8).map(|i| luminance(f32::from(i) / 64.0)).collect();
        assert!(steps.is_sorted(), "{steps:?}");
        assert!(steps[0] < 0.001 && steps[64] > 0.7);
    }

    #[test]
    fn signs_have_mirrored_colours_that_grow_brighter_with_the_amount() {
        for i in 0..64_u8 {
            let [near, far] = [i, i + 1].map(|i| diverging(f32::from(i) / 64.0));
            assert!((0..3).all(|c| near[c] <= far[c]) && near != far, "{near:?}, {far:?}");
            let [r, g, b] = diverging(-f32::from(i) / 64.0);
            assert_eq!([b, g, r], near);
        }
        assert_eq!(diverging(0.0), [0.0; 3]);
        assert_eq!(diverging(-7.0), diverging(-1.0));
    }
}
