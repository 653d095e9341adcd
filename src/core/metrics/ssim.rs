//! The structural similarity of Wang et al. 2004.

/// Texels on either side of the centre of the window.
const RADIUS: usize = 5;
const WINDOW: usize = 2 * RADIUS + 1;
/// Standard deviation of the Gaussian window, in texels.
const SIGMA: f64 = 1.5;
/// (K1 L)^2 and (K2 L)^2 for a range L of 1.
const C1: f64 = 0.01 * 0.01;
const C2: f64 = 0.03 * 0.03;

/// The mean SSIM of planes of `width` texels, one after another, whose values range over 1; `None` for fewer than 11 x 11 texels.
///
/// The window is Gaussian (11 x 11, sigma 1.5), variances are those of the population, and the mean is over the windows that
/// lie inside, and over the planes: `skimage.metrics.structural_similarity` with `gaussian_weights=True, sigma=1.5,
/// use_sample_covariance=False, data_range=1`.
pub(super) fn ssim11(pairs: &[[f64; 2]], [width, height]: [usize; 2]) -> Option<f64> {
    if width < WINDOW || height < WINDOW {
        return None;
    }
    let planes = pairs.chunks_exact(width * height);
    let count = planes.len() * (width - WINDOW + 1) * (height - WINDOW + 1);
    let sum = |plane| similarities(plane, width).iter().sum::<f64>();
    Some(planes.map(sum).sum::<f64>() / count as f64)
}

/// [`ssim11`] over the windows without NaN; `None` where there is none.
pub(super) fn ssim11_without_nan(pairs: &[[f64; 2]], [width, height]: [usize; 2]) -> Option<f64> {
    if width < WINDOW || height < WINDOW {
        return None;
    }
    let planes = pairs.chunks_exact(width * height);
    let known = planes.flat_map(|plane| similarities(plane, width)).filter(|value| !value.is_nan());
    let (sum, count) = known.fold((0.0, 0_usize), |(sum, count), value| (sum + value, count + 1));
    (count > 0).then(|| sum / count as f64)
}

/// The similarity of each window that lies inside a plane.
fn similarities(pairs: &[[f64; 2]], width: usize) -> Vec<f64> {
    let weighted = |value: fn(&[f64; 2]) -> f64| blurred(pairs.iter().map(value).collect(), width);
    let (a, b) = (weighted(|[a, _]| *a), weighted(|[_, b]| *b));
    let (aa, bb, ab) = (weighted(|[a, _]| a * a), weighted(|[_, b]| b * b), weighted(|[a, b]| a * b));
    let similarity = |i: usize| {
        let [mean_a, mean_b] = [a[i], b[i]];
        let [of_a, of_b] = [aa[i] - mean_a * mean_a, bb[i] - mean_b * mean_b];
        let of_both = ab[i] - mean_a * mean_b;
        (2.0 * mean_a * mean_b + C1) * (2.0 * of_both + C2)
            / ((mean_a * mean_a + mean_b * mean_b + C1) * (of_a + of_b + C2))
    };
    (0..a.len()).map(similarity).collect()
}

/// The weighted means of the windows that lie inside a plane.
fn blurred(values: Vec<f64>, width: usize) -> Vec<f64> {
    let weights = weights();
    let inside = width - WINDOW + 1;
    let mut rows = vec![0.0; values.len() / width * inside];
    for (row, values) in rows.chunks_exact_mut(inside).zip(values.chunks_exact(width)) {
        for (k, weight) in weights.iter().enumerate() {
            row.iter_mut().zip(&values[k..]).for_each(|(sum, value)| *sum += weight * value);
        }
    }
    let mut windows = vec![0.0; rows.len() - (WINDOW - 1) * inside];
    for (y, row) in windows.chunks_exact_mut(inside).enumerate() {
        for (k, weight) in weights.iter().enumerate() {
            row.iter_mut().zip(&rows[(y + k) * inside..]).for_each(|(sum, value)| *sum += weight * value);
        }
    }
    windows
}

/// The weights of a Gaussian, whose sum is 1.
fn weights() -> [f64; WINDOW] {
    let weight = |k: usize| (-0.5 * ((k as f64 - RADIUS as f64) / SIGMA).powi(2)).exp();
    let weights: [f64; WINDOW] = std::array::from_fn(weight);
    let sum: f64 = weights.iter().sum();
    weights.map(|weight| weight / sum)
}
