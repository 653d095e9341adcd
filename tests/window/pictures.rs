//! A material as a packed picture.

use image::RgbImage;

/// Side of the maps.
const SIDE: u32 = 16;

/// sRGB of `value`.
pub fn srgb(value: f64) -> f64 {
    if value <= 0.003_130_8 { 12.92 * value } else { 1.055 * value.powf(1.0 / 2.4) - 0.055 }
}

/// Map number `map` of a bumpy material in [0, 1] at a texel: normal, y up, diffuse, roughness as gray, specular, linear.
fn texel(map: u32, x: u32, y: u32) -> [f64; 3] {
    let [u, v] = [x, y].map(|i| f64::from(i) / f64::from(SIDE));
    match map {
        0 => {
            // Height is sin(6 u) sin(5 v); v points down, y up.
            let slope = [0.5 * (6.0 * u).cos() * (5.0 * v).sin(), -0.5 * (6.0 * u).sin() * (5.0 * v).cos()];
            let length = (slope[0] * slope[0] + slope[1] * slope[1] + 1.0).sqrt();
            [-slope[0] / length, -slope[1] / length, 1.0 / length].map(|n| 0.5 * n + 0.5)
        }
        1 => [0.1 + 0.5 * u, 0.3, 0.2 * v],
        2 => [0.2 + 0.6 * v; 3],
        _ => [0.04, 0.04 + 0.1 * u, 0.04],
    }
}

/// A strip N D R S in 8 bits, whose diffuse goes through `diffuse`.
pub fn packed(diffuse: impl Fn(f64) -> f64) -> RgbImage {
    RgbImage::from_fn(4 * SIDE, SIDE, |x, y| {
        let (map, value) = (x / SIDE, texel(x / SIDE, x % SIDE, y));
        let value = if map == 1 { value.map(&diffuse) } else { value };
        value.map(|v| (255.0 * v).round() as u8).into()
    })
}
