//! Placement of a prediction on its ground truth by parts of a texel, and in another scale.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use svbrdf_core::error::Error;
use svbrdf_core::material::{Material, Planes};

/// Texel p of the ground truth is at c + (p - c) * scale + by of the prediction, which has the same size and the centre c.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Placement {
    pub scale: f64,
    /// To the right and down, in texels.
    pub by: [f64; 2],
}

/// Texels with weights, whose sum is 1.
pub type Taps = [(usize, f32); 4];

impl Placement {
    /// Both are in one place.
    pub const NONE: Self = Self { scale: 1.0, by: [0.0; 2] };

    /// A displacement in the same scale.
    pub fn moved(by: [i32; 2]) -> Self {
        Self { by: by.map(f64::from), ..Self::NONE }
    }

    /// The ground truth on the prediction.
    #[must_use]
    pub fn inverse(self) -> Self {
        Self { scale: 1.0 / self.scale, by: self.by.map(|by| -by / self.scale) }
    }

    /// Where texel (x, y) of a ground truth of `size` (width, height) is on the prediction.
    pub fn at(self, texel: [f64; 2], size: [usize; 2]) -> [f64; 2] {
        let along = |axis: usize| {
            let centre = 0.5 * (size[axis] as f64 - 1.0);
            centre + (texel[axis] - centre) * self.scale + self.by[axis]
        };
        [along(0), along(1)]
    }

    /// The texels of the prediction around `texel` = row * width + column of the ground truth: bilinear, those at the edge repeated.
    pub fn taps(self, texel: usize, size: [usize; 2]) -> Taps {
        let at = self.at([(texel % size[0]) as f64, (texel / size[0]) as f64], size);
        let along = |axis: usize| {
            let last = size[axis] - 1;
            let at = if at[axis].is_finite() { at[axis].clamp(0.0, last as f64) } else { 0.0 };
            let low = at as usize;
            let part = (at - low as f64) as f32;
            [(low, 1.0 - part), ((low + 1).min(last), part)]
        };
        let [[left, right], [above, below]] = [along(0), along(1)];
        [(left, above), (right, above), (left, below), (right, below)]
            .map(|((x, of_x), (y, of_y))| (y * size[0] + x, of_x * of_y))
    }

    /// The prediction in the place of the ground truth.
    ///
    /// # Errors
    /// As [`interpolated`].
    pub fn applied(self, prediction: &Material<f32>) -> Result<Material<f32>, Error> {
        let size = prediction.size();
        let taps: Vec<_> =
            (0..size[0] * size[1]).into_par_iter().map(|texel| self.taps(texel, size)).collect();
        interpolated(prediction, &taps, size)
    }
}

/// The material of a size (width, height) whose texels are means of those of `material`.
///
/// # Errors
/// As [`Material::new`], as where normals cancel out.
pub fn interpolated(
    material: &Material<f32>,
    taps: &[Taps],
    [width, height]: [usize; 2],
) -> Result<Material<f32>, Error> {
    let sum =
        |plane: &[f32], taps: &Taps| taps.iter().map(|&(texel, weight)| weight * plane[texel]).sum::<f32>();
    let free = |plane: &Vec<f32>| taps.par_iter().map(|taps| sum(plane, taps)).collect::<Vec<_>>();
    let within = |plane: &Vec<f32>| taps.par_iter().map(|taps| sum(plane, taps).clamp(0.0, 1.0)).collect();
    let Planes { normal, diffuse, specular, roughness } = material.planes();
    let planes = Planes {
        normal: normal.each_ref().map(free),
        diffuse: diffuse.each_ref().map(within),
        specular: specular.each_ref().map(within),
        roughness: within(roughness),
    };
    Material::new(material.name(), width, height, planes)
}
