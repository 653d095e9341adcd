//! Materials texel by texel, for lists of texels.

use rayon::prelude::*;

use crate::material::{Material, Planes};
use crate::render::simd::TEXELS;

/// Values of a texel of a material.
const VALUES: usize = 10;
/// Most memory of the rows of a comparison.
const MOST_BYTES: usize = 256 << 20;

/// The values of each texel side by side, of one material after the other, in the order of [`Planes::all`]. A texel of a list is in a few
/// neighbouring lines of the cache, where planes have each of its values in another line and page.
#[derive(Debug)]
pub(super) struct TexelRows {
    values: Vec<f32>,
    /// Values of a texel of all materials.
    length: usize,
}

impl TexelRows {
    /// The rows of `materials`, from which `listed` texels will be taken. `None` where these are too few to be worth it, or the rows take
    /// too much memory.
    pub(super) fn of(materials: &[&Material<f32>], listed: usize) -> Option<Self> {
        let texels = materials.first().map_or(0, |material| material.width() * material.height());
        let length = VALUES * materials.len();
        if listed < texels || texels * length * size_of::<f32>() > MOST_BYTES {
            return None;
        }
        let planes: Vec<&[f32]> = materials.iter().flat_map(|material| material.planes().all()).collect();
        let mut values = vec![0.0; texels * length];
        values.par_chunks_mut(TEXELS * length).enumerate().for_each(|(chunk, rows)| {
            for (value, plane) in planes.iter().enumerate() {
                let from = &plane[chunk * TEXELS..];
                rows.iter_mut().skip(value).step_by(length).zip(from).for_each(|(to, from)| *to = *from);
            }
        });
        Some(Self { values, length })
    }
}

/// The values of a few texels, at most [`TEXELS`].
#[derive(Debug)]
pub(super) struct Gathered {
    rows: Vec<f32>,
    length: usize,
    planes: Planes<f32>,
}

impl Gathered {
    pub(super) fn new() -> Self {
        let plane = || vec![0.0; TEXELS];
        let three = || [plane(), plane(), plane()];
        let planes = Planes { normal: three(), diffuse: three(), specular: three(), roughness: plane() };
        Self { rows: Vec::new(), length: 0, planes }
    }

    /// Takes the rows of `texels`.
    pub(super) fn gather(&mut self, rows: &TexelRows, texels: &[usize]) {
        self.length = rows.length;
        self.rows.clear();
        for texel in texels {
            self.rows.extend_from_slice(&rows.values[texel * rows.length..][..rows.length]);
        }
    }

    /// The planes of material number `index`, whose texels 0, 1, and so on are those that were gathered.
    #[inline(always)]
    pub(super) fn planes(&mut self, index: usize) -> &Planes<f32> {
        let Planes { normal: [x, y, z], diffuse, specular, roughness } = &mut self.planes;
        let ([d0, d1, d2], [s0, s1, s2]) = (diffuse, specular);
        let mut planes = [x, y, z, s0, s1, s2, d0, d1, d2, roughness].map(|plane| plane.as_mut_slice());
        for (at, row) in self.rows.chunks_exact(self.length).enumerate() {
            let row = &row[index * VALUES..][..VALUES];
            for (plane, value) in planes.iter_mut().zip(row) {
                plane[at] = *value;
            }
        }
        &self.planes
    }
}

#[cfg(test)]
mod tests {
    use crate::loss::{Comparison, Compute as _};
    use crate::material::{Material, Planes};
    use crate::model::convention::PRINTED;
    use crate::model::sampler::Sampler;
    use crate::progress::Progress;

    #[test]
    fn rows_give_the_losses_of_planes_bit_for_bit() {
        let [width, height] = [37, 23];
        let random = |seed: usize| {
            let value = |i: usize| ((i * 7919 + seed * 104_729) % 1009) as f32 / 1009.0;
            let plane = |of: usize| (0..width * height).map(|i| value(i + 31 * of)).collect::<Vec<_>>();
            let planes = Planes {
                normal: [plane(0), plane(1), plane(2).iter().map(|z| z + 0.5).collect()],
                diffuse: [plane(3), plane(4), plane(5)],
                specular: [plane(6), plane(7), plane(8)],
                roughness: plane(9),
            };
            Material::<f32>::new(seed.to_string(), width, height, planes).unwrap()
        };
        let all = [0, 1, 2].map(random);
        let comparison = Comparison::new(&all[0], &[&all[1], &all[2]], PRINTED).unwrap();
        let scenes = Sampler::Sobol.scenes(5, 6, 4, &PRINTED);
        let texels = |scene: usize| (0..150 + scene).map(|i| (i * 613 + scene) % (width * height)).collect();
        let progress = Progress::default();
        let own = f32::cpu().losses_on_own_texels(&comparison, &scenes, &texels, &progress).unwrap();
        assert!(scenes.len() * texels(0).len() >= width * height, "no rows are made");
        for (index, scene) in scenes.iter().enumerate() {
            let (scene, texels) = (std::slice::from_ref(scene), texels(index));
            let listed = f32::cpu().scene_losses(&comparison, scene, Some(&texels), &progress).unwrap();
            assert!(own[0][index] != own[1][index]);
            assert_eq!([own[0][index], own[1][index]], [listed[0][0], listed[1][0]]);
        }
    }
}
