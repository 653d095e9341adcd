//! The structural similarity of Wang et al. 2004, in two windows.

/// (K1 L)^2 and (K2 L)^2 for a range L of 1.
const C1: f64 = 0.01 * 0.01;
const C2: f64 = 0.03 * 0.03;

/// The weights of a separable window.
struct Window {
    /// Along either axis; their sum is 1.
    weights: Vec<f64>,
    /// What variances and covariances of the population are multiplied with.
    correction: f64,
}

/// The mean SSIM of planes of `size` (width, height), one after another, whose values range over 1; `None` for fewer than 11 x 11
/// texels.
///
/// The window is Gaussian (11 x 11, sigma 1.5), variances are those of the population, and the mean is over the windows that
/// lie inside, and over the planes: `skimage.metrics.structural_similarity` with `gaussian_weights=True, sigma=1.5,
/// use_sample_covariance=False, data_range=1`.
pub(super) fn ssim11(pairs: &[[f64; 2]], size: [usize; 2]) -> Option<f64> {
    ssim(&gaussian(), pairs, size)
}

/// [`ssim11`] over the windows without NaN; `None` where there is none.
pub(super) fn ssim11_without_nan(pairs: &[[f64; 2]], [width, height]: [usize; 2]) -> Option<f64> {
    let window = gaussian();
    if width.min(height) < window.weights.len() {
        return None;
    }
    let planes = pairs.chunks_exact(width * height);
    let known = planes.flat_map(|plane| window.similarities(plane, width)).filter(|value| !value.is_nan());
    let (sum, count) = known.fold((0.0, 0_usize), |(sum, count), value| (sum + value, count + 1));
    (count > 0).then(|| sum / count as f64)
}

fn gaussian() -> Window {
    const RADIUS: f64 = 5.0;
    const SIGMA: f64 = 1.5;
    let weights: Vec<f64> =
        (0..11).map(|k| (-0.5 * ((f64::from(k) - RADIUS) / SIGMA).powi(2)).exp()).collect();
    let sum: f64 = weights.iter().sum();
    Window { weights: weights.into_iter().map(|weight| weight / sum).collect(), correction: 1.0 }
}

/// As [`ssim11`] in a flat window of 7 x 7 texels with the variances of a sample: `structural_similarity` with its defaults and
/// `data_range=1`. `None` for fewer than 7 x 7 texels.
pub(super) fn ssim7(pairs: &[[f64; 2]], size: [usize; 2]) -> Option<f64> {
    const COUNT: f64 = 49.0;
    ssim(&Window { weights: vec![1.0 / 7.0; 7], correction: COUNT / (COUNT - 1.0) }, pairs, size)
}

fn ssim(window: &Window, pairs: &[[f64; 2]], [width, height]: [usize; 2]) -> Option<f64> {
    let side = window.weights.len();
    if width < side || height < side {
        return None;
    }
    let planes = pairs.chunks_exact(width * height);
    let count = planes.len() * (width - side + 1) * (height - side + 1);
    let sum = |plane| window.similarities(plane, width).iter().sum::<f64>();
    Some(planes.map(sum).sum::<f64>() / count as f64)
}

impl Window {
    /// The similarity of each window that lies inside a plane.
    fn similarities(&self, pairs: &[[f64; 2]], width: usize) -> Vec<f64> {
        let weighted =
            |value: fn(&[f64; 2]) -> f64| self.averaged(&pairs.iter().map(value).collect::<Vec<_>>(), width);
        let (a, b) = (weighted(|[a, _]| *a), weighted(|[_, b]| *b));
        let (aa, bb, ab) = (weighted(|[a, _]| a * a), weighted(|[_, b]| b * b), weighted(|[a, b]| a * b));
        let similarity = |i: usize| {
            let [mean_a, mean_b] = [a[i], b[i]];
            let [of_a, of_b] =
                [aa[i] - mean_a * mean_a, bb[i] - mean_b * mean_b].map(|variance| self.correction * variance);
            let of_both = self.correction * (ab[i] - mean_a * mean_b);
            (2.0 * mean_a * mean_b + C1) * (2.0 * of_both + C2)
                / ((mean_a * mean_a + mean_b * mean_b + C1) * (of_a + of_b + C2))
        };
        (0..a.len()).map(similarity).collect()
    }

    /// The weighted means of the windows that lie inside a plane.
    fn averaged(&self, values: &[f64], width: usize) -> Vec<f64> {
        let side = self.weights.len();
        let inside = width - side + 1;
        let mut rows = vec![0.0; values.len() / width * inside];
        for (row, values) in rows.chunks_exact_mut(inside).zip(values.chunks_exact(width)) {
            for (k, weight) in self.weights.iter().enumerate() {
                row.iter_mut().zip(&values[k..]).for_each(|(sum, value)| *sum += weight * value);
            }
        }
        let mut windows = vec![0.0; rows.len() - (side - 1) * inside];
        for (y, row) in windows.chunks_exact_mut(inside).enumerate() {
            for (k, weight) in self.weights.iter().enumerate() {
                row.iter_mut().zip(&rows[(y + k) * inside..]).for_each(|(sum, value)| *sum += weight * value);
            }
        }
        windows
    }
}
