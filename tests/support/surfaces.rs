//! Materials that test how glTF and MaterialX are written, and their comparison.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

use svbrdf_core::material::{Material, Planes};

use super::pictures::{SIDE, srgb, texel};

/// Normals, diffuse, specular and roughness of a texel.
type Values = ([f64; 3], [f64; 3], [f64; 3], f64);

/// A material of values by column and row.
fn material(size: [usize; 2], at: impl Fn(usize, usize) -> Values) -> Material<f32> {
    let [width, height] = size;
    let values: Vec<Values> = (0..width * height).map(|i| at(i % width, i / width)).collect();
    let planes = |of: &dyn Fn(&Values) -> [f64; 3]| {
        [0, 1, 2].map(|c| values.iter().map(|texel| of(texel)[c] as f32).collect::<Vec<_>>())
    };
    let planes = Planes {
        normal: planes(&|texel| texel.0),
        diffuse: planes(&|texel| texel.1),
        specular: planes(&|texel| texel.2),
        roughness: values.iter().map(|texel| texel.3 as f32).collect(),
    };
    Material::new("1 brick & \"mortar\"", width, height, planes).unwrap()
}

fn bumpy(x: usize, y: usize) -> ([f64; 3], f64) {
    (texel(0, x % SIDE, y % SIDE), texel(2, x % SIDE, y % SIDE)[0])
}

/// What a base colour and metallic make, metals beside dielectrics.
pub fn metallic() -> Material<f32> {
    material([SIDE, SIDE], |x, y| {
        let (normal, roughness) = bumpy(x, y);
        let base = [0.1 + 0.05 * x as f64, 0.4, 0.03 * y as f64];
        let m = if (4..9).contains(&x) { 1.0 } else { 0.0 };
        (normal, base.map(|b| b * (1.0 - m)), base.map(|b| 0.04 * (1.0 - m) + b * m), roughness)
    })
}

/// Coloured specular on coloured diffuse, up to `most`: no base colour and metallic make it.
pub fn specular(size: [usize; 2], most: f64) -> Material<f32> {
    material(size, |x, y| {
        let (normal, roughness) = bumpy(x, y);
        let (u, v) = (x as f64 / (size[0] - 1) as f64, y as f64 / (size[1] - 1) as f64);
        (normal, [0.3, 0.6 * v, 0.02 + 0.9 * u], [most * u, most * v, most * u * v], roughness)
    })
}

/// Any values, each texel for itself.
fn random(side: usize) -> Material<f32> {
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let values: Vec<Values> = (0..side * side)
        .map(|_| {
            let mut share = || random.random::<f64>();
            let (x, y) = (1.2 * share() - 0.6, 1.2 * share() - 0.6);
            let length = (x * x + y * y + 1.0).sqrt();
            let mut colour = || [share(), share(), share() * share()];
            ([x / length, y / length, 1.0 / length], colour(), colour(), 0.0)
        })
        .map(|(n, d, s, _)| (n, d, s, d[1]))
        .collect();
    material([side, side], |x, y| values[y * side + x])
}

/// All cases, each with its name and the form that it must get.
pub fn cases() -> Vec<(&'static str, Material<f32>, bool)> {
    let dark = material([5, 7], |x, y| {
        let (normal, roughness) = bumpy(x, y);
        (normal, [0.0, 0.0005 * y as f64, 0.001], [0.001 * x as f64, 0.0, 0.0002], roughness)
    });
    let none = material([2, 1], |_, _| ([0.0, 0.0, 1.0], [0.0; 3], [0.0; 3], 0.0));
    vec![
        ("metals and dielectrics", metallic(), true),
        ("coloured specular up to 0.1", specular([SIDE, SIDE], 0.1), false),
        ("coloured specular up to 1", specular([SIDE, SIDE], 1.0), false),
        ("not square", specular([23, 9], 0.3), false),
        ("dark", dark, false),
        ("black", none, true),
        ("random", random(24), false),
    ]
}

/// The largest difference of two materials in steps of 8 bits, as PNG files of this program store them: normals as
/// (n + 1) / 2, colours in sRGB, roughness as it is.
pub fn steps(a: &Material<f32>, b: &Material<f32>) -> f64 {
    assert_eq!(a.size(), b.size());
    let mut worst = 0.0_f64;
    for index in 0..a.width() * a.height() {
        let [a, b] = [a, b].map(|material| material.texel(index));
        let normal = |n: f32| 0.5 * f64::from(n) + 0.5;
        let colour = |c: f32| srgb(f64::from(c));
        let normals = a.normal.to_array().into_iter().zip(b.normal.to_array());
        let colours = a.diffuse.into_iter().zip(b.diffuse).chain(a.specular.into_iter().zip(b.specular));
        let all = normals
            .map(|(a, b)| normal(a) - normal(b))
            .chain(colours.map(|(a, b)| colour(a) - colour(b)))
            .chain([f64::from(a.roughness - b.roughness)]);
        worst = all.map(|difference| 255.0 * difference.abs()).fold(worst, f64::max);
    }
    worst
}
