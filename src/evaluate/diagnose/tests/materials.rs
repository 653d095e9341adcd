//! Generated materials, and errors that are planted in them.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

use svbrdf_core::material::{Material, Planes};

/// A smooth random field in [0, 1]: waves of a few texels and more, clipped.
pub(crate) fn field(generator: &mut ChaCha8Rng, side: usize, contrast: f32) -> Vec<f32> {
    let mut random = || generator.random::<f32>();
    let waves: Vec<[f32; 4]> = (0..24)
        .map(|_| {
            let period = 4.0 + 28.0 * random() * random();
            let angle = std::f32::consts::TAU * random();
            let frequency = std::f32::consts::TAU / period;
            [frequency * angle.cos(), frequency * angle.sin(), std::f32::consts::TAU * random(), random()]
        })
        .collect();
    let value = |index: usize| {
        let (x, y) = ((index % side) as f32, (index / side) as f32);
        let sum: f32 =
            waves.iter().map(|[fx, fy, phase, amplitude]| amplitude * (fx * x + fy * y + phase).sin()).sum();
        (0.5 + contrast * 0.2 * sum).clamp(0.0, 1.0)
    };
    (0..side * side).map(value).collect()
}

fn between(low: f32, high: f32, plane: &[f32]) -> Vec<f32> {
    plane.iter().map(|x| low + (high - low) * x).collect()
}

/// Normals of a height field with slopes of about `strength`.
pub(crate) fn normals(heights: &[f32], side: usize, strength: f32) -> [Vec<f32>; 3] {
    let at = |column: usize, row: usize| heights[(row % side) * side + column % side];
    let slope = |index: usize| {
        let (column, row) = (index % side, index / side);
        let x = at(column + 1, row) - at(column + side - 1, row);
        let y = at(column, row + side - 1) - at(column, row + 1);
        [-strength * x, -strength * y]
    };
    let slopes: Vec<[f32; 2]> = (0..side * side).map(slope).collect();
    [slopes.iter().map(|s| s[0]).collect(), slopes.iter().map(|s| s[1]).collect(), vec![1.0; side * side]]
}

/// Material number `seed`: of a kind (a plastic, a metal, a stone) and with details that depend on it.
pub(crate) fn generated(seed: u64, side: usize) -> Material<f32> {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    let generator = &mut generator;
    let heights = field(generator, side, 1.0);
    let colour = field(generator, side, 1.0);
    let grain = field(generator, side, 1.5);
    // Least and largest diffuse (RGB), specular (RGB) and roughness, and the strength of slopes.
    let (diffuse, specular, roughness, strength) = match seed % 3 {
        0 => (
            [[0.25, 0.7], [0.08, 0.4], [0.05, 0.2]],
            [[0.03, 0.06], [0.03, 0.05], [0.02, 0.05]],
            [0.25, 0.55],
            0.8,
        ),
        1 => (
            [[0.02, 0.1], [0.02, 0.08], [0.01, 0.05]],
            [[0.5, 0.9], [0.35, 0.6], [0.15, 0.3]],
            [0.2, 0.45],
            0.5,
        ),
        _ => (
            [[0.15, 0.5], [0.12, 0.45], [0.2, 0.6]],
            [[0.03, 0.08], [0.04, 0.08], [0.05, 0.1]],
            [0.5, 0.85],
            1.2,
        ),
    };
    let planes = Planes {
        normal: normals(&heights, side, strength),
        diffuse: diffuse.map(|[low, high]| between(low, high, &colour)),
        specular: specular.map(|[low, high]| between(low, high, &grain)),
        roughness: between(roughness[0], roughness[1], &grain),
    };
    Material::new(format!("generated {seed}"), side, side, planes).unwrap()
}

/// The material with changed planes.
pub(crate) fn with(material: &Material<f32>, change: impl FnOnce(&mut Planes<f32>)) -> Material<f32> {
    let mut planes = material.planes().clone();
    change(&mut planes);
    Material::new("changed", material.width(), material.height(), planes).unwrap()
}

/// A prediction whose errors are none of the hypotheses: noise, a local edit, or other details in one or more maps.
pub(crate) fn unexplained(truth: &Material<f32>, seed: u64) -> Material<f32> {
    let mut generator = ChaCha8Rng::seed_from_u64(seed ^ 0xabcd);
    let side = truth.width();
    let noise = |generator: &mut ChaCha8Rng, plane: &mut [f32], reach: f32| {
        plane
            .iter_mut()
            .for_each(|x| *x = (*x + reach * (2.0 * generator.random::<f32>() - 1.0)).clamp(0.0, 1.0));
    };
    match seed % 4 {
        0 => with(truth, |planes| {
            planes.normal[..2].iter_mut().for_each(|plane| {
                plane.iter_mut().for_each(|x| *x += 0.3 * (2.0 * generator.random::<f32>() - 1.0));
            });
            noise(&mut generator, &mut planes.roughness, 0.1);
        }),
        1 => with(truth, |planes| {
            planes.diffuse.iter_mut().for_each(|plane| noise(&mut generator, plane, 0.05));
            planes.specular.iter_mut().for_each(|plane| noise(&mut generator, plane, 0.02));
            noise(&mut generator, &mut planes.roughness, 0.1);
        }),
        // A local edit: a disk of other values.
        2 => with(truth, |planes| {
            let centre = [0, 1].map(|_| generator.random::<f32>() * side as f32);
            let factor = [0, 1].map(|_| 0.5 + generator.random::<f32>());
            for index in 0..side * side {
                let [dx, dy] = [(index % side) as f32 - centre[0], (index / side) as f32 - centre[1]];
                if dx.hypot(dy) < side as f32 / 6.0 {
                    planes
                        .diffuse
                        .iter_mut()
                        .for_each(|plane| plane[index] = (plane[index] * factor[0]).min(1.0));
                    planes.roughness[index] = (planes.roughness[index] * factor[1]).min(1.0);
                }
            }
        }),
        // Other details of the same kind.
        _ => {
            let other = generated(truth.name().len() as u64 * 3000 + 3 * seed + seed % 3, side);
            with(truth, |planes| {
                let strength = planes.normal[0].iter().map(|x| x.abs()).sum::<f32>();
                let of_other = other.planes().normal[0].iter().map(|x| x.abs()).sum::<f32>();
                planes.normal = other.planes().normal.clone();
                planes.normal[..2].iter_mut().for_each(|plane| {
                    plane.iter_mut().for_each(|x| *x *= strength / of_other);
                });
            })
        }
    }
}
