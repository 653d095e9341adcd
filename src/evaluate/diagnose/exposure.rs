//! The exposure of a prediction: the factor on its radiance under which its loss is least.

use rayon::prelude::*;

use super::samples::Radiances;

/// Most stops of an exposure.
const MOST_STOPS: f64 = 16.0;
/// Bisections; the last interval is shorter than 1e-10 stops.
const BISECTIONS: usize = 40;

/// The stops t within +-16 at which the mean of `|ln(2^t p + epsilon) - ln(g + epsilon)|` over `pairs` (g, p) of radiances has a
/// minimum.
///
/// The derivative of a term is `ln 2 * sign(2^t p - g) 2^t p / (2^t p + epsilon)`, and the sum is bisected for its sign.
fn best_stops(pairs: &[[f32; 2]], epsilon: f64) -> f64 {
    let slope = |stops: f64| {
        let (factor, epsilon) = (stops.exp2() as f32, epsilon as f32);
        let of_pair = |[g, p]: [f32; 2]| {
            let p = factor * p;
            let sign = f32::from(i8::from(p > g) - i8::from(p < g));
            sign * p / (p + epsilon)
        };
        let of_chunk = |chunk: &[[f32; 2]]| {
            let (eights, rest) = chunk.as_chunks::<8>();
            let mut lanes = [0.0_f32; 8];
            for pairs in eights {
                for lane in 0..8 {
                    lanes[lane] += of_pair(pairs[lane]);
                }
            }
            f64::from(lanes.iter().sum::<f32>() + rest.iter().map(|pair| of_pair(*pair)).sum::<f32>())
        };
        let of_part = |part: &[[f32; 2]]| part.chunks(256).map(of_chunk).sum::<f64>();
        // Summed in their order, so that the result is the same every time.
        let parts: Vec<f64> = pairs.par_chunks(1 << 14).map(of_part).collect();
        parts.iter().sum::<f64>()
    };
    let [mut low, mut high] = [-MOST_STOPS, MOST_STOPS];
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        let slope = slope(middle);
        if slope == 0.0 {
            return middle;
        }
        if slope < 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// The best stops of all scenes, of each channel or of all together.
pub(super) fn best_exposure(scenes: &[Vec<Radiances>], epsilon: f64, per_channel: bool) -> [f64; 3] {
    let of = |channels: &[usize]| {
        let values = |&[g, p]: &Radiances| channels.iter().map(move |&c| [g[c], p[c]]);
        let pairs: Vec<_> = scenes.iter().flatten().flat_map(values).collect();
        best_stops(&pairs, epsilon)
    };
    if per_channel { [of(&[0]), of(&[1]), of(&[2])] } else { [of(&[0, 1, 2]); 3] }
}

/// The mean of `|ln(2^t p + epsilon) - ln(g + epsilon)|` in one scene, at the `stops` of each channel.
pub(super) fn loss(pairs: &[Radiances], stops: [f64; 3], epsilon: f64) -> f64 {
    let factors = stops.map(|stops| stops.exp2() as f32);
    let epsilon = epsilon as f32;
    let of_pair = |[g, p]: &Radiances| {
        (0..3).map(|c| f64::from(((factors[c] * p[c] + epsilon) / (g[c] + epsilon)).ln().abs())).sum::<f64>()
    };
    pairs.iter().map(of_pair).sum::<f64>() / (3 * pairs.len().max(1)) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_planted_exposure_is_found_and_the_optimum_of_noise_is_that_of_a_fine_grid() {
        let radiance = |i: usize| 1e-3 * 1.013_f32.powi((i * 37 % 613) as i32);
        let planted: Vec<_> = (0..600).map(|i| [radiance(i), 0.7 * radiance(i)]).collect();
        assert!((best_stops(&planted, 0.01) + 0.7_f64.log2()).abs() < 1e-5);
        let noise = |i: usize| 0.4 + 1.3 * (i * 71 % 97) as f32 / 97.0;
        let noisy: Vec<Radiances> =
            (0..600).map(|i| [[radiance(i); 3], [noise(i) * radiance(i); 3]]).collect();
        let found = best_exposure(std::slice::from_ref(&noisy), 0.01, false)[0];
        let grid = (0..4000).map(|i| f64::from(i) / 1000.0 - 2.0);
        let least =
            grid.min_by(|&a, &b| loss(&noisy, [a; 3], 0.01).total_cmp(&loss(&noisy, [b; 3], 0.01))).unwrap();
        assert!((found - least).abs() < 0.005, "{found} {least}");
        assert_eq!(best_stops(&[[0.5, 0.5], [0.1, 0.1]], 0.01), 0.0);
        assert_eq!(best_stops(&[], 0.01), 0.0);
    }
}
