//! Where on the material the loss comes from: the mean log difference of each texel over all scenes.

use std::f32::consts::LN_2;

use rayon::prelude::*;

use crate::error::Error;
use crate::image::Image;
use crate::loss::Comparison;
use crate::model::scene::Scene;
use crate::progress::Progress;
use crate::render;

/// For each prediction the mean over `scenes` of |ln(R_gt + epsilon) - ln(R_pred + epsilon)| of every texel and channel.
///
/// The [`mean`] of a map is the loss of the prediction over the same scenes on all texels, within the rounding of f32. A
/// scene is one step of `progress`.
///
/// # Errors
/// [`Error::UnusableScene`], [`Error::Cancelled`].
pub fn error_maps(
    comparison: &Comparison<'_, f32>,
    scenes: &[Scene],
    progress: &Progress,
) -> Result<Vec<Image<f32>>, Error> {
    let [width, height] = comparison.ground_truth().size();
    let convention = comparison.convention();
    let epsilon = convention.epsilon as f32;
    let mut products = vec![vec![[LogProduct::ONE; 3]; width * height]; comparison.predictions().len()];
    progress.begin(scenes.len() as u64);
    for scene in scenes {
        let render = |material| render::render_f32(material, scene, convention, &progress.part());
        let expected = render(comparison.ground_truth())?;
        for (products, prediction) in products.iter_mut().zip(comparison.predictions()) {
            let predicted = render(prediction)?;
            let pairs = expected.pixels.par_iter().zip(&predicted.pixels);
            products.par_iter_mut().zip(pairs).with_min_len(4096).for_each(|(products, (a, b))| {
                for c in 0..3 {
                    products[c].add(a[c] + epsilon, b[c] + epsilon);
                }
            });
        }
        progress.step()?;
    }
    let count = scenes.len() as f32;
    let image = |products: Vec<[LogProduct; 3]>| {
        let pixels = products.into_par_iter().map(|products| products.map(|p| p.ln() / count)).collect();
        Image { width, height, pixels }
    };
    Ok(products.into_iter().map(image).collect())
}

/// The mean over texels and channels.
pub fn mean(image: &Image<f32>) -> f64 {
    let values = image.pixels.as_flattened();
    values.iter().map(|&value| f64::from(value)).sum::<f64>() / values.len() as f64
}

/// The sum of |ln a - ln b| as the logarithm of a product of ratios: one logarithm instead of two per scene. Each factor rounds
/// twice, so n factors are off by about sqrt(n) 6e-8.
#[derive(Clone, Copy)]
struct LogProduct {
    /// In [1, 2).
    mantissa: f32,
    exponent: i32,
}

impl LogProduct {
    const ONE: Self = Self { mantissa: 1.0, exponent: 0 };

    /// Multiplies by the larger of two positive, normal numbers over the smaller.
    #[inline]
    fn add(&mut self, a: f32, b: f32) {
        let (larger, smaller) = (a.max(b), a.min(b));
        let product = self.mantissa * (mantissa(larger) / mantissa(smaller));
        self.exponent += exponent(larger) - exponent(smaller) + exponent(product) - exponent(1.0);
        self.mantissa = mantissa(product);
    }

    fn ln(self) -> f32 {
        self.exponent as f32 * LN_2 + self.mantissa.ln()
    }
}

/// The number in [1, 2) with the mantissa of a positive, normal number.
#[inline]
fn mantissa(x: f32) -> f32 {
    f32::from_bits((x.to_bits() & 0x007f_ffff) | 0x3f80_0000)
}

/// The biased exponent of a positive number.
#[inline]
fn exponent(x: f32) -> i32 {
    (x.to_bits() >> 23).cast_signed()
}
