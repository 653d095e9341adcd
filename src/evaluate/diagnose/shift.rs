//! Shifts by whole texels: the candidates by correlation of the maps.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};
use rayon::prelude::*;

use svbrdf_core::material::Material;

/// Most texels of a shift in either direction.
pub const MOST_SHIFT: usize = 8;
/// Most runs of texels that maps are correlated on, and texels of each.
const RUNS: usize = 1024;
const LENGTH: usize = 32;

/// The texels of a map of `size` (width, height), as row * width + column, that have a value of their own after a shift.
pub(super) fn interior([width, height]: [usize; 2], [right, down]: [i32; 2]) -> Vec<usize> {
    let range = |by: i32, count: usize| {
        let reach = (by.unsigned_abs() as usize).min(count);
        if by > 0 { reach..count } else { 0..count - reach }
    };
    let columns = range(right, width);
    range(down, height).flat_map(|row| columns.clone().map(move |column| row * width + column)).collect()
}

/// How well the maps of a prediction correlate with those of a ground truth after a displacement (right, down).
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
    pub(super) shift: [i32; 2],
    /// The sum over all planes of the mean product of their values, normalized to mean 0 and standard deviation 1.
    signed: f64,
    /// The sum of its absolute value, which a reading that turns values over does not change.
    pub(super) absolute: f64,
}

/// The fits of all displacements within [`MOST_SHIFT`], on texels that each of them leaves inside: all, or random runs of them that
/// `seed` names, the same for all displacements.
pub(super) fn fits(ground_truth: &Material<f32>, prediction: &Material<f32>, seed: u64) -> Vec<Fit> {
    let size = ground_truth.size();
    let reach = size.map(|side| MOST_SHIFT.min(side / 4));
    let runs = runs(size, reach, seed);
    let span = |by: usize| -(by as i32)..=by as i32;
    let all: Vec<[i32; 2]> =
        span(reach[1]).flat_map(|down| span(reach[0]).map(move |right| [right, down])).collect();
    let pairs: Vec<_> = ground_truth.planes().all().zip(prediction.planes().all()).collect();
    let pairs: Vec<_> = pairs.into_par_iter().filter_map(|(a, b)| normalized(a).zip(normalized(b))).collect();
    let by = |&[right, down]: &[i32; 2]| i64::from(down) * size[0] as i64 + i64::from(right);
    // Plane by plane: one fits into the cache.
    let of_plane = |(a, b): &(Vec<f32>, Vec<f32>)| -> Vec<f64> {
        all.par_iter().map(|shift| correlation(a, b, &runs, by(shift))).collect()
    };
    let of_planes: Vec<_> = pairs.iter().map(of_plane).collect();
    let fit = |(index, &shift)| {
        let fits = || of_planes.iter().map(|plane| plane[index]);
        Fit { shift, signed: fits().sum(), absolute: fits().map(f64::abs).sum() }
    };
    all.iter().enumerate().map(fit).collect()
}

/// The two displacements other than none with the best fits, and the two with the best fits by absolute values.
pub(super) fn candidates(fits: &[Fit]) -> Vec<[i32; 2]> {
    let best = |of: fn(&Fit) -> f64| {
        let mut moved: Vec<&Fit> = fits.iter().filter(|fit| fit.shift != [0, 0]).collect();
        moved.sort_by(|a, b| of(b).total_cmp(&of(a)));
        moved.into_iter().take(2).map(|fit| fit.shift).collect::<Vec<_>>()
    };
    let mut all = [best(|fit| fit.signed), best(|fit| fit.absolute)].concat();
    all.sort_unstable();
    all.dedup();
    all
}

/// Runs of texels, as their first one and the one after their last one, that displacements within `reach` leave inside: whole rows
/// where these are few.
fn runs([width, height]: [usize; 2], reach: [usize; 2], seed: u64) -> Vec<[usize; 2]> {
    let [columns, rows] = [width - 2 * reach[0], height - 2 * reach[1]];
    let run = |column: usize, row: usize, length: usize| {
        let first = (row + reach[1]) * width + reach[0] + column;
        [first, first + length]
    };
    if columns * rows <= RUNS * LENGTH {
        return (0..rows).map(|row| run(0, row, columns)).collect();
    }
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    let length = LENGTH.min(columns);
    let random =
        |_| run(generator.random_range(0..=columns - length), generator.random_range(0..rows), length);
    let mut runs: Vec<_> = (0..RUNS).map(random).collect();
    // In the order of memory.
    runs.sort_unstable();
    runs
}

/// The plane with mean 0 and standard deviation 1; `None` where it is constant.
fn normalized(plane: &[f32]) -> Option<Vec<f32>> {
    let count = plane.len() as f64;
    let mean = plane.iter().map(|&x| f64::from(x)).sum::<f64>() / count;
    let variance = plane.iter().map(|&x| (f64::from(x) - mean).powi(2)).sum::<f64>() / count;
    // Below this, the difference is rounding.
    (variance > 1e-9)
        .then(|| plane.iter().map(|&x| ((f64::from(x) - mean) / variance.sqrt()) as f32).collect())
}

/// The mean over `runs` of the product of `a` with `b` moved back by `by` texels.
fn correlation(a: &[f32], b: &[f32], runs: &[[usize; 2]], by: i64) -> f64 {
    let of_run = |&[first, end]: &[usize; 2]| {
        let moved = (first as i64 + by) as usize;
        f64::from(product(&a[first..end], &b[moved..moved + end - first]))
    };
    let count: usize = runs.iter().map(|[first, end]| end - first).sum();
    runs.iter().map(of_run).sum::<f64>() / count.max(1) as f64
}

/// The scalar product.
fn product(a: &[f32], b: &[f32]) -> f32 {
    let ((a, rest_a), (b, rest_b)) = (a.as_chunks::<8>(), b.as_chunks::<8>());
    let mut lanes = [0.0_f32; 8];
    for (a, b) in a.iter().zip(b) {
        for lane in 0..8 {
            lanes[lane] += a[lane] * b[lane];
        }
    }
    lanes.iter().sum::<f32>() + rest_a.iter().zip(rest_b).map(|(a, b)| a * b).sum::<f32>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interior_has_the_texels_that_did_not_wrap() {
        assert_eq!(interior([3, 2], [1, 0]), [1, 2, 4, 5]);
        assert_eq!(interior([3, 2], [-1, -1]), [0, 1]);
        assert_eq!(interior([2, 2], [0, 0]), [0, 1, 2, 3]);
    }
}
