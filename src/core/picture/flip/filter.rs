//! Spatial filters of FLIP: what an eye resolves, and where it sees edges and points.

use std::f32::consts::PI;

use super::colour::{hunt_lab, rgb_of_ycxcz, ycxcz};
use crate::image::Image;

/// b of exp(-pi^2 x^2 / b) over the visual angle x in degrees: the sensitivity to contrasts of lightness, and of red against green.
const LIGHTNESS: f32 = 0.0047;
const RED_GREEN: f32 = 0.0053;
/// a and b of the two terms a sqrt(pi / b) exp(-pi^2 (x^2 + y^2) / b) of the sensitivity to blue against yellow.
const BLUE_YELLOW: [[f32; 2]; 2] = [[34.1, 0.04], [13.5, 0.025]];
/// Width of the filter that detects features, in degrees.
const FEATURE: f32 = 0.082;

/// Weights of all filters along one axis; every one has its centre in the middle.
#[derive(Debug)]
pub(super) struct Filters {
    lightness: Vec<f32>,
    red_green: Vec<f32>,
    blue_yellow: [Vec<f32>; 2],
    /// A Gaussian, and its first and second derivative.
    feature: [Vec<f32>; 3],
}

/// What is seen of some rows of a picture, by pixel.
#[derive(Debug)]
pub(super) struct Seen {
    /// As [`hunt_lab`].
    pub colours: Vec<[f32; 3]>,
    pub edges: Vec<f32>,
    pub points: Vec<f32>,
}

impl Filters {
    pub fn new(pixels_per_degree: f32) -> Self {
        let widest = BLUE_YELLOW[0][1];
        let radius = (3.0 * (widest / (2.0 * PI * PI)).sqrt() * pixels_per_degree).ceil() as i32;
        let step = 1.0 / pixels_per_degree;
        let sampled = |height: f32, b: f32| -> Vec<f32> {
            let weight = |x: i32| height * (-PI * PI * (x as f32 * step).powi(2) / b).exp();
            (-radius..=radius).map(weight).collect()
        };
        // Of a filter over two axes, each axis has the root of the height.
        let terms = BLUE_YELLOW.map(|[a, b]| sampled((a * (PI / b).sqrt()).sqrt(), b));
        let [sum_1, sum_2] = terms.each_ref().map(|term| term.iter().sum::<f32>());
        let norm = (sum_1 * sum_1 + sum_2 * sum_2).sqrt();
        Self {
            lightness: normalized(sampled(1.0, LIGHTNESS)),
            red_green: normalized(sampled(1.0, RED_GREEN)),
            blue_yellow: terms.map(|term| scaled(term, 1.0 / norm)),
            feature: feature(pixels_per_degree),
        }
    }

    /// What is seen of the rows from `first` to before `end` of a picture of linear radiance, multiplied by `gain` and clipped.
    pub fn seen(&self, image: &Image<f32>, gain: f32, [first, end]: [usize; 2]) -> Seen {
        let margin = self.lightness.len() / 2;
        let opponent = opponent(image, gain, [first, end], margin);
        let width = image.width;
        let filtered =
            |plane: &[f32], weights: &[f32]| down(&across(plane, width, weights), width, weights, margin);
        let [y, cx, cz] = &opponent;
        let (y_seen, cx_seen) = (filtered(y, &self.lightness), filtered(cx, &self.red_green));
        let [cz_1, cz_2] = self.blue_yellow.each_ref().map(|weights| filtered(cz, weights));
        let colour = |i: usize| {
            let rgb = rgb_of_ycxcz([y_seen[i], cx_seen[i], cz_1[i] + cz_2[i]]);
            hunt_lab(rgb.map(|value| value.clamp(0.0, 1.0)))
        };
        let colours = (0..y_seen.len()).map(colour).collect();
        let [edges, points] = self.features(y, width, margin);
        Seen { colours, edges, points }
    }

    /// How much of an edge and of a point each pixel is, of a plane of lightness with `margin` rows above and below.
    fn features(&self, y: &[f32], width: usize, margin: usize) -> [Vec<f32>; 2] {
        let y: Vec<f32> = y.iter().map(|y| y * (1.0 / 116.0) + 16.0 / 116.0).collect();
        let [gaussian, first, second] = &self.feature;
        let [smooth, dx, ddx] = [gaussian, first, second].map(|weights| across(&y, width, weights));
        let magnitude = |derivative: &[f32], weights: &[f32]| -> Vec<f32> {
            let along_x = down(derivative, width, gaussian, margin);
            let along_y = down(&smooth, width, weights, margin);
            along_x.iter().zip(&along_y).map(|(x, y)| (x * x + y * y).sqrt()).collect()
        };
        [magnitude(&dx, first), magnitude(&ddx, second)]
    }
}

/// Y, C_x and C_z of the rows from `first` to before `end` with `margin` rows above and below, where the outermost rows repeat.
fn opponent(image: &Image<f32>, gain: f32, [first, end]: [usize; 2], margin: usize) -> [Vec<f32>; 3] {
    let count = (end - first + 2 * margin) * image.width;
    let mut planes = [(); 3].map(|()| Vec::with_capacity(count));
    for row in first..end + 2 * margin {
        let row = row.saturating_sub(margin).min(image.height - 1);
        for rgb in &image.pixels[row * image.width..][..image.width] {
            let values = ycxcz(rgb.map(|value| (gain * value).clamp(0.0, 1.0)));
            planes.iter_mut().zip(values).for_each(|(plane, value)| plane.push(value));
        }
    }
    planes
}

/// Each row of a plane, filtered; the outermost pixels repeat.
fn across(plane: &[f32], width: usize, weights: &[f32]) -> Vec<f32> {
    let radius = weights.len() / 2;
    let mut filtered = vec![0.0; plane.len()];
    let mut padded = vec![0.0; width + 2 * radius];
    for (row, sums) in plane.chunks_exact(width).zip(filtered.chunks_exact_mut(width)) {
        padded[..radius].fill(row[0]);
        padded[radius..radius + width].copy_from_slice(row);
        padded[radius + width..].fill(row[width - 1]);
        for (k, weight) in weights.iter().enumerate() {
            sums.iter_mut().zip(&padded[k..]).for_each(|(sum, value)| *sum += weight * value);
        }
    }
    filtered
}

/// The rows of a plane but `margin` at either end, filtered across rows.
fn down(plane: &[f32], width: usize, weights: &[f32], margin: usize) -> Vec<f32> {
    let skipped = margin - weights.len() / 2;
    let mut filtered = vec![0.0; plane.len() - 2 * margin * width];
    for (row, sums) in filtered.chunks_exact_mut(width).enumerate() {
        for (k, weight) in weights.iter().enumerate() {
            let values = &plane[(row + skipped + k) * width..];
            sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
        }
    }
    filtered
}

/// A Gaussian whose weights have the sum 1, and its derivatives, whose positive weights have the sum 1 and whose negative ones -1.
fn feature(pixels_per_degree: f32) -> [Vec<f32>; 3] {
    let deviation = 0.5 * FEATURE * pixels_per_degree;
    let radius = (3.0 * deviation).ceil() as i32;
    let sampled =
        |of: &dyn Fn(f32) -> f32| -> Vec<f32> { (-radius..=radius).map(|x| of(x as f32)).collect() };
    let gaussian = |x: f32| (-(x * x) / (2.0 * deviation * deviation)).exp();
    [
        normalized(sampled(&gaussian)),
        balanced(sampled(&|x| -x * gaussian(x))),
        balanced(sampled(&|x| (x * x / (deviation * deviation) - 1.0) * gaussian(x))),
    ]
}

fn normalized(weights: Vec<f32>) -> Vec<f32> {
    let sum: f32 = weights.iter().sum();
    weights.into_iter().map(|weight| weight / sum).collect()
}

fn scaled(weights: Vec<f32>, factor: f32) -> Vec<f32> {
    weights.into_iter().map(|weight| weight * factor).collect()
}

/// Weights whose positive ones have the sum 1, and whose negative ones -1.
fn balanced(weights: Vec<f32>) -> Vec<f32> {
    let positive: f32 = weights.iter().filter(|weight| **weight > 0.0).sum();
    let negative: f32 = -weights.iter().filter(|weight| **weight <= 0.0).sum::<f32>();
    weights.into_iter().map(|weight| weight / if weight > 0.0 { positive } else { negative }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::flip::PIXELS_PER_DEGREE;

    #[test]
    fn filters_keep_a_flat_picture_and_have_the_published_sizes() {
        let filters = Filters::new(PIXELS_PER_DEGREE);
        let sum = |weights: &[f32]| weights.iter().sum::<f32>();
        assert_eq!((filters.lightness.len(), filters.feature[0].len()), (21, 19));
        assert!((sum(&filters.lightness) - 1.0).abs() < 1e-6 && (sum(&filters.red_green) - 1.0).abs() < 1e-6);
        let squares: f32 = filters.blue_yellow.iter().map(|weights| sum(weights).powi(2)).sum();
        assert!((squares - 1.0).abs() < 1e-6, "{squares}");
        assert!(filters.feature[1..].iter().all(|weights| sum(weights).abs() < 1e-6));
    }
}
