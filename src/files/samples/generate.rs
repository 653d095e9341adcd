//! Makes the sample materials that are built in. `tests/examples/make_assets.rs` writes them into `assets/samples/`.
//!
//! Uses only operations whose results IEEE 754 fixes, so that every platform makes the same pixels.

use svbrdf_core::material::Planes;

use super::noise::mix;
use super::tiles::{Surface, surface};

/// Width and height of a sample, in texels.
pub const SIDE: usize = 256;
/// The surface is sampled this many times finer in either direction.
const FINE: usize = 2;

/// Worn glazed tiles, inlaid with metal.
pub fn ground_truth() -> Planes<f64> {
    let side = SIDE * FINE;
    let width = 2.0 / side as f64;
    // One sample more on either side, for slopes at the border.
    let line = side + 2;
    let at = |i: usize| (i as f64 - 0.5) * width - 1.0;
    let fine: Vec<Surface> = (0..line * line).map(|i| surface(at(i % line), -at(i / line))).collect();
    let texel = |index: usize| (1 + FINE * (index % SIDE), 1 + FINE * (index / SIDE));
    let mean = |of: &dyn Fn(usize) -> f64| -> Vec<f64> {
        let samples = |(column, row): (usize, usize)| {
            (0..FINE * FINE).map(move |s| (row + s / FINE) * line + column + s % FINE)
        };
        (0..SIDE * SIDE).map(|i| samples(texel(i)).map(of).sum::<f64>() / (FINE * FINE) as f64).collect()
    };
    let slope = |up: f64| up / (2.0 * width);
    let mut planes = Planes {
        normal: [
            mean(&|i| slope(fine[i - 1].height - fine[i + 1].height)),
            mean(&|i| slope(fine[i + line].height - fine[i - line].height)),
            vec![1.0; SIDE * SIDE],
        ],
        diffuse: [0, 1, 2].map(|c| mean(&|i| fine[i].diffuse[c])),
        specular: [0, 1, 2].map(|c| mean(&|i| fine[i].specular[c])),
        roughness: mean(&|i| fine[i].roughness),
    };
    normalize(&mut planes.normal);
    planes
}

/// A prediction of `truth` as networks make them: normals flat and blurred, diffuse smeared.
pub fn blurred_normals(truth: &Planes<f64>) -> Planes<f64> {
    let mut planes = truth.clone();
    for plane in &mut planes.normal[..2] {
        *plane = blur(plane, 4).iter().map(|slope| 0.7 * slope).collect();
    }
    normalize(&mut planes.normal);
    planes.diffuse = planes.diffuse.map(|plane| blur(&plane, 1));
    planes
}

/// A prediction of `truth` with roughness drawn to a constant, and specular that has bled into diffuse.
pub fn wrong_roughness(truth: &Planes<f64>) -> Planes<f64> {
    let mut planes = truth.clone();
    for roughness in &mut planes.roughness {
        *roughness = mix(0.42, *roughness, 0.4) + 0.04;
    }
    for (diffuse, specular) in planes.diffuse.iter_mut().zip(&mut planes.specular) {
        for (d, s) in diffuse.iter_mut().zip(specular) {
            let bled = 0.35 * (*s - 0.04).max(0.0);
            *d = (*d + 0.6 * bled).min(1.0);
            *s -= bled;
        }
    }
    planes
}

/// The pixels, in 8-bit RGB, of the packed strip normal | diffuse | roughness | specular of planes of a sample.
pub fn pack(planes: &Planes<f64>) -> Vec<u8> {
    let normal = planes.normal.each_ref().map(|plane| plane.iter().map(|x| 0.5 * x + 0.5).collect());
    let gray = [0; 3].map(|_| planes.roughness.clone());
    let tiles: [[Vec<f64>; 3]; 4] = [normal, planes.diffuse.clone(), gray, planes.specular.clone()];
    let mut pixels = Vec::with_capacity(3 * tiles.len() * SIDE * SIDE);
    for row in 0..SIDE {
        for tile in &tiles {
            for index in row * SIDE..(row + 1) * SIDE {
                pixels.extend(tile.each_ref().map(|plane| (255.0 * plane[index]).round() as u8));
            }
        }
    }
    pixels
}

fn normalize([xs, ys, zs]: &mut [Vec<f64>; 3]) {
    for ((x, y), z) in xs.iter_mut().zip(ys).zip(zs) {
        let length = (*x * *x + *y * *y + *z * *z).sqrt();
        (*x, *y, *z) = (*x / length, *y / length, *z / length);
    }
}

/// Twice the mean over squares of `2 reach + 1` texels, which is close to a Gaussian; the border is repeated.
fn blur(plane: &[f64], reach: usize) -> Vec<f64> {
    let clamped = |i: usize, by: usize| (i + by).saturating_sub(reach).min(SIDE - 1);
    let mean = |of: &dyn Fn(usize) -> f64| (0..=2 * reach).map(of).sum::<f64>() / (2 * reach + 1) as f64;
    let mut plane = plane.to_vec();
    for _ in 0..2 {
        let rows: Vec<f64> =
            (0..SIDE * SIDE).map(|i| mean(&|by| plane[i / SIDE * SIDE + clamped(i % SIDE, by)])).collect();
        plane = (0..SIDE * SIDE).map(|i| mean(&|by| rows[clamped(i / SIDE, by) * SIDE + i % SIDE])).collect();
    }
    plane
}
