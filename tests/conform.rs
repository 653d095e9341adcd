//! `svbrdf conform`: renderers of the grammar are found, and others have no name.

mod outside;
mod peers;
mod pictures;
mod random;

use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

use svbrdf_core::model::grammar::{Description, Point, RendererTerms};
use svbrdf_evaluate::conform::{Answer, Verdict, identify, probes, verdict};
use svbrdf_files::arrays::{Array, Arrays};

/// How radiances are stored.
#[derive(Clone, Copy, Debug)]
pub enum Stored {
    Double,
    /// With the rounding errors of a computation in float32.
    Single,
    Half,
    /// 8 bits of sRGB, with a tenth of the values clipped.
    Srgb,
    /// Relative noise in each channel.
    Noise(f64),
}

/// A number of a standard normal distribution.
pub fn normal(random: &mut ChaCha8Rng) -> f64 {
    let (a, b): (f64, f64) = (random.random(), random.random());
    (-2.0 * (1.0 - a).ln()).sqrt() * (std::f64::consts::TAU * b).cos()
}

impl Stored {
    /// The radiances as they are stored.
    pub fn of(self, exact: &[[f64; 3]], seed: u64) -> Vec<[f64; 3]> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut sorted: Vec<f64> =
            exact.as_flattened().iter().copied().filter(|x| x.is_finite() && *x > 0.0).collect();
        sorted.sort_by(f64::total_cmp);
        let scale = 1.0 / sorted[sorted.len() * 9 / 10];
        let mut stored = |x: f64| match self {
            Self::Double => x,
            Self::Single => f64::from((x * (1.0 + 6e-8 * normal(&mut random))) as f32),
            Self::Half => f64::from(half_float(x as f32)),
            Self::Srgb => {
                let x = (x * scale).clamp(0.0, 1.0);
                let y = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
                (y * 255.0).round() / 255.0
            }
            Self::Noise(relative) => x * (1.0 + relative * normal(&mut random)),
        };
        exact.iter().map(|rgb| rgb.map(&mut stored)).collect()
    }
}

/// The nearest half float; infinite above the largest.
fn half_float(x: f32) -> f32 {
    if !x.is_finite() || x == 0.0 {
        return x;
    }
    let step = (x.abs().log2().floor().max(-14.0) - 10.0).exp2();
    let rounded = (x / step).round_ties_even() * step;
    if rounded.abs() > 65504.0 { f32::INFINITY.copysign(x) } else { rounded }
}

/// The probe points.
pub fn points() -> Vec<Point> {
    let mut arrays = probes().unwrap();
    let count = arrays["normal"].shape[0];
    arrays.insert("radiance".to_owned(), Array::new(&[count, 3], vec![1.0; 3 * count]));
    Answer::new(&arrays, None).unwrap().points
}

/// The arrays of points and radiances.
pub fn arrays(radiance: &[[f64; 3]]) -> Arrays {
    let mut arrays = probes().unwrap();
    arrays.insert("radiance".to_owned(), Array::new(&[radiance.len(), 3], radiance.as_flattened().to_vec()));
    arrays
}

/// The verdict on radiances at points, against the renderer `asked`.
pub fn judged(
    points: &[Point],
    radiance: Vec<[f64; 3]>,
    metallic: Option<bool>,
    asked: &RendererTerms,
) -> Verdict {
    let answer = Answer { points: points.to_vec(), grids: Vec::new(), radiance, metallic, picture: None };
    verdict(&identify(&answer), &Description { terms: *asked, ..Description::default() })
}
