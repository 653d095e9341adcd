//! FLIP: the difference that a person sees who alternates between two pictures (Andersson et al. 2020, FLIP: A Difference
//! Evaluator for Alternating Images), for pictures of limited range (LDR-FLIP).
//!
//! In f32, with the sums in the order of the authors' program: where pictures are flat, the power of nearly equal features
//! magnifies rounding, and a more precise computation gives other means in the fifth decimal.

mod colour;
mod filter;

use rayon::prelude::*;

use crate::image::Image;
use colour::ColourScale;
use filter::Filters;

/// Pixels per degree of visual angle: 3840 pixels over 0.7 m, seen from 0.7 m, about 67. The default of the authors' program.
pub const PIXELS_PER_DEGREE: f32 = 0.7 * (3840.0 / 0.7) * (std::f32::consts::PI / 180.0);

/// Rows that are computed at a time, so that memory does not grow with the picture.
const BAND: usize = 64;

/// FLIP of every pixel, in [0, 1], of two pictures of one size: linear radiance, multiplied by 2^`exposure_ev` and clipped to [0, 1].
/// NaN spreads to its neighbourhood.
pub fn flip(ground_truth: &Image<f32>, prediction: &Image<f32>, exposure_ev: f32) -> Vec<f32> {
    let (filters, scale) = (Filters::new(PIXELS_PER_DEGREE), ColourScale::new());
    let Image { width, height, .. } = *ground_truth;
    let gain = exposure_ev.exp2();
    let mut map = vec![0.0; width * height];
    map.par_chunks_mut(BAND * width).enumerate().for_each(|(number, band)| {
        let rows = [number * BAND, number * BAND + band.len() / width];
        let [truth, predicted] = [ground_truth, prediction].map(|image| filters.seen(image, gain, rows));
        for (index, value) in band.iter_mut().enumerate() {
            let colour = scale.difference(truth.colours[index], predicted.colours[index]);
            let edges = (truth.edges[index] - predicted.edges[index]).abs();
            let points = (truth.points[index] - predicted.points[index]).abs();
            *value = combined(colour, if edges > points { edges } else { points });
        }
    });
    map
}

/// The mean of [`flip`] over all pixels.
pub fn mean_flip(ground_truth: &Image<f32>, prediction: &Image<f32>, exposure_ev: f32) -> f64 {
    let map = flip(ground_truth, prediction, exposure_ev);
    map.iter().map(|&value| f64::from(value)).sum::<f64>() / map.len() as f64
}

/// The difference of colours, amplified where edges or points differ.
fn combined(colour: f32, feature: f32) -> f32 {
    const EXPONENT: f32 = 0.5;
    let feature = (1.0 / 2.0_f32.sqrt() * feature).powf(EXPONENT);
    colour.powf(1.0 - feature)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(width: usize, height: usize, of: impl Fn(usize, usize) -> [f32; 3]) -> Image<f32> {
        let pixels = (0..width * height).map(|i| of(i % width, i / width)).collect();
        Image { width, height, pixels }
    }

    #[test]
    fn a_picture_does_not_differ_from_itself_and_black_from_white_the_most() {
        let checks = image(70, 150, |x, y| [((x / 3 + y / 5) % 2) as f32, 0.5, 0.1]);
        assert_eq!(mean_flip(&checks, &checks, 0.0), 0.0);
        let [black, white] = [0.0, 1.0].map(|value| image(30, 70, |_, _| [value; 3]));
        let all = flip(&black, &white, 0.0);
        // |L| differs by 100, of at most 41.28^0.7 after the powers: in the upper part of the scale.
        assert!(all.iter().all(|&value| value > 0.95 && value <= 1.0), "{all:?}");
        let bright = image(30, 70, |_, _| [7.0; 3]);
        assert_eq!(flip(&bright, &white, 0.0), vec![0.0; 30 * 70], "what is clipped is equal");
        assert!(flip(&bright, &white, -4.0).iter().all(|&value| value > 0.1), "what is not, differs");
    }

    #[test]
    fn one_pixel_is_seen_in_its_neighbourhood_in_every_band() {
        let flat = image(40, 200, |_, _| [0.2; 3]);
        for row in [0_usize, 63, 64, 130, 199] {
            let spot = image(40, 200, |x, y| if (x, y) == (20, row) { [0.9; 3] } else { [0.2; 3] });
            let map = flip(&flat, &spot, 0.0);
            let at = |x: usize, y: usize| map[y * 40 + x];
            assert!(at(20, row) > 0.1 && at(20, row) > at(23, row) && at(23, row) > 0.0, "{row}");
            let far =
                (0..200_usize).filter(|y| y.abs_diff(row) > 10).flat_map(|y| (0..40).map(move |x| at(x, y)));
            assert_eq!(far.fold(0.0, f32::max), 0.0, "{row}");
            if let (Some(above), true) = (row.checked_sub(2), row < 198) {
                assert!((at(20, above) - at(20, row + 2)).abs() < 1e-5, "{row}");
            }
        }
    }

    #[test]
    fn values_that_are_no_numbers_stay_such() {
        let flat = image(30, 30, |_, _| [0.2; 3]);
        let hole = image(30, 30, |x, y| if (x, y) == (15, 15) { [f32::NAN; 3] } else { [0.2; 3] });
        let map = flip(&flat, &hole, 0.0);
        assert!(map[15 * 30 + 15].is_nan() && map[0] == 0.0);
    }
}
