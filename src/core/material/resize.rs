//! Planes of another size: the mean over areas on the way down, bilinear on the way up.

use std::borrow::Cow;

use rayon::prelude::*;

use crate::math::real::Real;

/// In which measure values are averaged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filter {
    /// As they are.
    Value,
    /// Roughness r: on the way down as alpha^2 = r^4, since the variance of the slopes of an area adds up; on the way up as r, since
    /// between two texels lies none that is rougher than what is interpolated.
    Roughness,
}

/// How the samples of a line are weighed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kernel {
    /// The mean over areas on the way down, bilinear on the way up.
    #[default]
    Area,
    /// Four samples by a cubic with a = -0.75, whatever the size: `INTER_CUBIC` of OpenCV.
    Cubic,
}

/// `plane` of size `from` (width, height) in the size `to`.
pub fn plane<'a, T: Real>(
    plane: impl Into<Cow<'a, [T]>>,
    from: [usize; 2],
    to: [usize; 2],
    filter: Filter,
) -> Vec<T> {
    let plane = plane.into();
    if from == to { plane.into_owned() } else { weighed(&plane, from, to, filter, weights) }
}

/// `plane` of size `from` (width, height) in the size `to`, each value by four of every line, cut to `range`.
pub(super) fn cubic<T: Real>(plane: &[T], from: [usize; 2], to: [usize; 2], [low, high]: [f64; 2]) -> Vec<T> {
    let mut resized = weighed(plane, from, to, Filter::Value, cubic_weights);
    resized.iter_mut().for_each(|value| *value = T::of(value.f64().clamp(low, high)));
    resized
}

fn weighed<T: Real>(
    plane: &[T],
    from: [usize; 2],
    to: [usize; 2],
    filter: Filter,
    weights: fn(usize, usize, usize) -> Vec<(usize, f64)>,
) -> Vec<T> {
    // Along either axis.
    let measures =
        [0, 1].map(|axis| Measure { of_slopes: filter == Filter::Roughness && to[axis] < from[axis] });
    let [across, down] = measures;
    let columns: Vec<_> = (0..to[0]).map(|i| weights(i, from[0], to[0])).collect();
    let rows: Vec<_> = (0..to[1]).map(|i| weights(i, from[1], to[1])).collect();
    // A row of the original, of the new width.
    let narrow = |row: usize, out: &mut [f64]| {
        let row = &plane[row * from[0]..(row + 1) * from[0]];
        let value =
            |taps: &Vec<(usize, f64)>| taps.iter().map(|&(i, w)| w * across.into(row[i].f64())).sum::<f64>();
        out.iter_mut().zip(&columns).for_each(|(out, taps)| *out = across.to(down, value(taps)));
    };
    let mut narrowed = vec![0.0; to[0] * from[1]];
    narrowed.par_chunks_exact_mut(to[0]).enumerate().for_each(|(row, out)| narrow(row, out));
    let mut resized = vec![T::zero(); to[0] * to[1]];
    resized.par_chunks_exact_mut(to[0]).zip(&rows).for_each(|(out, taps)| {
        let value = |column: usize| taps.iter().map(|&(i, w)| w * narrowed[i * to[0] + column]).sum::<f64>();
        out.iter_mut().enumerate().for_each(|(column, out)| *out = T::of(down.back(value(column))));
    });
    resized
}

/// What is averaged along an axis: a value, or the variance of slopes.
#[derive(Clone, Copy, PartialEq)]
struct Measure {
    of_slopes: bool,
}

impl Measure {
    fn into(self, value: f64) -> f64 {
        if self.of_slopes { value.powi(4) } else { value }
    }

    fn back(self, mean: f64) -> f64 {
        if self.of_slopes { mean.max(0.0).powf(0.25) } else { mean }
    }

    /// A mean in another measure.
    fn to(self, other: Self, mean: f64) -> f64 {
        if self == other { mean } else { other.into(self.back(mean)) }
    }
}

/// The samples of a line of `from` that make sample `index` of a line of `to`, with weights whose sum is 1.
fn weights(index: usize, from: usize, to: usize) -> Vec<(usize, f64)> {
    let scale = from as f64 / to as f64;
    if from <= to {
        let at = ((index as f64 + 0.5) * scale - 0.5).clamp(0.0, (from - 1) as f64);
        let low = at.floor() as usize;
        let part = at - low as f64;
        return vec![(low, 1.0 - part), ((low + 1).min(from - 1), part)];
    }
    let (start, end) = (index as f64 * scale, (index + 1) as f64 * scale);
    let overlap = |i: usize| (end.min((i + 1) as f64) - start.max(i as f64)).max(0.0) / scale;
    (start as usize..(end.ceil() as usize).min(from)).map(|i| (i, overlap(i))).collect()
}

/// The four samples that make sample `index`; those beyond an end are the last ones.
fn cubic_weights(index: usize, from: usize, to: usize) -> Vec<(usize, f64)> {
    const A: f64 = -0.75;
    let at = (index as f64 + 0.5) * from as f64 / to as f64 - 0.5;
    let part = at - at.floor();
    let near = |x: f64| ((A + 2.0) * x - (A + 3.0)) * x * x + 1.0;
    let far = |x: f64| ((A * x - 5.0 * A) * x + 8.0 * A) * x - 4.0 * A;
    let samples = [far(part + 1.0), near(part), near(1.0 - part), far(2.0 - part)].into_iter().zip(-1..);
    let place = |offset: i32| (at.floor() + f64::from(offset)).clamp(0.0, (from - 1) as f64) as usize;
    samples.map(|(weight, offset)| (place(offset), weight)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cubic_is_that_of_opencv() {
        // cv2.resize(np.float64([[0, 0, 1, 0, 0, 1, 1, 1]]), (4, 1), interpolation=cv2.INTER_CUBIC) of OpenCV 4.
        let line = [0.0_f64, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0];
        let resized = cubic(&line, [8, 1], [4, 1], [-1.0, 2.0]);
        let expected = [-0.09375, 0.59375, 0.5, 1.0];
        assert!(resized.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{resized:?}");
        assert_eq!(cubic(&line, [8, 1], [4, 1], [0.0, 1.0])[0], 0.0, "cut to the range");
    }

    #[test]
    fn means_survive_on_the_way_down() {
        let line: Vec<f64> = (0..12).map(f64::from).collect();
        assert_eq!(plane(line.clone(), [4, 3], [2, 3], Filter::Value)[..2], [0.5, 2.5]);
        let third = plane(line, [12, 1], [5, 1], Filter::Value);
        assert!((third.iter().sum::<f64>() / 5.0 - 5.5).abs() < 1e-12, "{third:?}");
    }

    #[test]
    fn constants_survive_in_both_directions() {
        for filter in [Filter::Value, Filter::Roughness] {
            for to in [[3, 5], [14, 9]] {
                let resized = plane(vec![0.3; 42], [7, 6], to, filter);
                assert_eq!(resized.len(), to[0] * to[1]);
                assert!(resized.iter().all(|x| (x - 0.3_f64).abs() < 1e-12));
            }
        }
    }

    #[test]
    fn roughness_is_averaged_in_alpha_squared() {
        let resized = plane(vec![0.2_f64, 0.8], [2, 1], [1, 1], Filter::Roughness);
        assert!((resized[0] - ((0.2_f64.powi(4) + 0.8_f64.powi(4)) / 2.0).powf(0.25)).abs() < 1e-12);
    }

    #[test]
    fn roughness_is_interpolated_as_it_is_on_the_way_up_along_either_axis() {
        let mean = ((0.2_f64.powi(4) + 0.8_f64.powi(4)) / 2.0).powf(0.25);
        let up = plane(vec![0.2_f64, 0.8], [2, 1], [4, 1], Filter::Roughness);
        assert!(up.iter().zip([0.2, 0.35, 0.65, 0.8]).all(|(a, b)| (a - b).abs() < 1e-12), "{up:?}");
        // Down across, up along the columns, and the other way round.
        let both = plane(vec![0.2_f64, 0.8, 0.4, 0.4], [2, 2], [1, 4], Filter::Roughness);
        let expected = [mean, 0.75 * mean + 0.1, 0.25 * mean + 0.3, 0.4];
        assert!(both.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{both:?}");
        let turned = plane(vec![0.2_f64, 0.4, 0.8, 0.4], [2, 2], [4, 1], Filter::Roughness);
        assert!((turned[0] - mean).abs() < 1e-12 && (turned[3] - 0.4).abs() < 1e-12, "{turned:?}");
    }
}
