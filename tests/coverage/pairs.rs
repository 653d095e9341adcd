//! Pairs of materials whose losses are hard to estimate, made here: no file is needed.

use svbrdf_core::material::{Material, Planes};

/// What one texel holds: slope of the surface in x and y, diffuse, specular, roughness.
#[derive(Clone, Copy)]
struct Texel {
    slope: [f64; 2],
    diffuse: [f64; 3],
    specular: [f64; 3],
    roughness: f64,
}

/// Four pairs of `side` x `side` texels, each ground truth with its prediction.
pub fn made(side: usize) -> Vec<[Material<f32>; 2]> {
    let pair = |names: [&str; 2], of: [&dyn Fn(f64, f64) -> Texel; 2]| {
        [material(names[0], side, of[0]), material(names[1], side, of[1])]
    };
    let ground = |x, y| Texel { roughness: 0.7, ..stone(x, y) };
    let one = |x: f64, y: f64| if x.max(y) < 1.0 / side as f64 { constant(0.08) } else { stone(x, y) };
    vec![
        pair(["scratched metal", "rough stone"], [&scratched_metal, &stone]),
        pair(["mirror patch", "diffuse ground"], [&mirror_patch, &ground]),
        pair(["rough stone", "all but one texel"], [&stone, &one]),
        pair(["constant, rough", "constant, smooth"], [&|_, _| constant(0.5), &|_, _| constant(0.1)]),
    ]
}

/// The material of `of` at the middles of its texels, in [0, 1] x [0, 1].
fn material(name: &str, side: usize, of: &dyn Fn(f64, f64) -> Texel) -> Material<f32> {
    let at = |i: usize| (i as f64 + 0.5) / side as f64;
    let texels: Vec<Texel> = (0..side * side).map(|i| of(at(i % side), at(i / side))).collect();
    let plane = |of: &dyn Fn(&Texel) -> f64| texels.iter().map(|t| of(t) as f32).collect();
    let planes = Planes {
        normal: [plane(&|t| -t.slope[0]), plane(&|t| -t.slope[1]), plane(&|_| 1.0)],
        diffuse: [0, 1, 2].map(|c| plane(&|t| t.diffuse[c])),
        specular: [0, 1, 2].map(|c| plane(&|t| t.specular[c])),
        roughness: plane(&|t| t.roughness),
    };
    Material::new(name, side, side, planes).unwrap()
}

/// A number in [0, 1) that looks random, for each texel of 256 x 256.
fn noise(x: f64, y: f64, seed: u64) -> f64 {
    let mut z = ((x * 256.0) as u64) << 32 ^ ((y * 256.0) as u64) << 8 ^ seed;
    for factor in [0xbf58_476d_1ce4_e5b9_u64, 0x94d0_49bb_1331_11eb] {
        z = (z ^ (z >> 30)).wrapping_mul(factor).rotate_left(31);
    }
    (z >> 11) as f64 / (1u64 << 53) as f64
}

/// Rough and dark, with grains that tilt.
fn stone(x: f64, y: f64) -> Texel {
    let shade = 0.25 + 0.2 * noise(x, y, 1);
    Texel {
        slope: [noise(x, y, 2) - 0.5, noise(x, y, 3) - 0.5],
        diffuse: [shade, 0.9 * shade, 0.8 * shade],
        specular: [0.04; 3],
        roughness: 0.7 + 0.25 * noise(x, y, 4),
    }
}

/// Brushed metal; a texel in 16 is a scratch, nearly a mirror.
fn scratched_metal(x: f64, y: f64) -> Texel {
    let scratch = noise(x + 0.125 * y, 0.0, 5) < 1.0 / 16.0;
    Texel {
        slope: if scratch { [0.15 * noise(x, y, 6), 0.05] } else { [0.0; 2] },
        diffuse: [0.0; 3],
        specular: [0.9, 0.7, 0.4],
        roughness: if scratch { 0.04 } else { 0.3 + 0.1 * noise(x, y, 7) },
    }
}

/// [`stone`] with a mirror of a quarter of its width in it.
fn mirror_patch(x: f64, y: f64) -> Texel {
    if x.max(y) < 0.25 {
        Texel { slope: [0.0; 2], diffuse: [0.0; 3], specular: [0.95; 3], roughness: 0.02 }
    } else {
        Texel { roughness: 0.7, ..stone(x, y) }
    }
}

fn constant(roughness: f64) -> Texel {
    Texel { slope: [0.0; 2], diffuse: [0.3, 0.2, 0.1], specular: [0.2; 3], roughness }
}
