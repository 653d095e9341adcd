//! Shifts by whole texels: the candidates by correlation of the maps.

use std::ops::Range;

use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};
use rayon::prelude::*;

use svbrdf_core::error::Error;
use svbrdf_core::material::Material;
use svbrdf_core::parallel;
use svbrdf_core::statistics::sort_by_number;
use svbrdf_files::changes::Symmetry;

/// Most texels of a shift in either direction.
const MOST_SHIFT: usize = 8;
/// Most runs of texels that maps are correlated on, and texels of each.
const RUNS: usize = 1024;
const LENGTH: usize = 32;

/// The texels of a map that have a value of their own after a shift: all that did not leave it on one side and enter on the other.
#[derive(Clone, Debug)]
pub(super) struct Interior {
    columns: Range<usize>,
    rows: Range<usize>,
    /// Of the map.
    width: usize,
}

impl Interior {
    /// Of a map of a size (width, height), after a shift by (right, down).
    pub(super) fn new([width, height]: [usize; 2], [right, down]: [i32; 2]) -> Self {
        let range = |by: i32, count: usize| {
            let reach = (by.unsigned_abs() as usize).min(count);
            if by > 0 { reach..count } else { 0..count - reach }
        };
        Self { columns: range(right, width), rows: range(down, height), width }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.columns.is_empty() || self.rows.is_empty()
    }

    /// Whether it has this texel, given as row * width + column.
    pub(super) fn contains(&self, texel: usize) -> bool {
        self.columns.contains(&(texel % self.width)) && self.rows.contains(&(texel / self.width))
    }

    /// Its texels in order.
    pub(super) fn texels(&self) -> Vec<usize> {
        let of_row = |row: usize| self.columns.clone().map(move |column| row * self.width + column);
        self.rows.clone().flat_map(of_row).collect()
    }
}

/// How well the maps of a prediction correlate with those of a ground truth after a displacement (right, down).
#[derive(Clone, Copy, Debug)]
pub(super) struct ShiftFit {
    pub(super) shift: [i32; 2],
    /// The sum over all planes of the mean product of their values, normalized to mean 0 and standard deviation 1.
    signed: f64,
    /// The sum of its absolute value, which a reading that turns values over does not change.
    pub(super) absolute: f64,
}

/// What displacements of a prediction are fitted on: texels of the ground truth that each displacement within [`MOST_SHIFT`] leaves
/// inside, all or random runs of them, the same for all displacements and symmetries.
#[derive(Debug)]
pub(super) struct Correlations<'a> {
    prediction: &'a Material<f32>,
    reach: [usize; 2],
    /// The texels that are looked at, with as many around each run as displacements reach; `None`: all of the map.
    windows: Option<Vec<usize>>,
    /// Runs of texels of the map or of the windows, as their first one and the one after their last one, and their texels in a row.
    runs: Vec<[usize; 2]>,
    width: usize,
    /// Planes of the ground truth, as [`normalized`] gives them.
    truth: Vec<Option<Vec<f32>>>,
}

impl<'a> Correlations<'a> {
    /// `seed` names the runs.
    pub(super) fn new([ground_truth, prediction]: [&'a Material<f32>; 2], seed: u64) -> Self {
        let size = ground_truth.size();
        let reach = size.map(|side| MOST_SHIFT.min(side / 4));
        let runs = runs(size, reach, seed);
        let length = runs.first().map_or(0, |[first, end]| end - first);
        let window = [length + 2 * reach[0], 1 + 2 * reach[1]];
        let of_run = |&[first, _]: &[usize; 2]| {
            let first = first - reach[1] * size[0] - reach[0];
            (0..window[0] * window[1]).map(move |i| first + i / window[0] * size[0] + i % window[0])
        };
        let is_part = runs.len() * window[0] * window[1] < size[0] * size[1];
        let windows: Option<Vec<usize>> = is_part.then(|| runs.iter().flat_map(of_run).collect());
        let in_window = |run: usize| {
            let first = run * window[0] * window[1] + reach[1] * window[0] + reach[0];
            [first, first + length]
        };
        let (runs, width) = match windows {
            Some(_) => ((0..runs.len()).map(in_window).collect(), window[0]),
            None => (runs, size[0]),
        };
        let truth = windows.as_ref().map(|texels| ground_truth.gathered(texels, [texels.len(), 1]));
        let truth = all_normalized(truth.as_ref().unwrap_or(ground_truth));
        Self { prediction, reach, windows, runs, width, truth }
    }

    /// The fits of all displacements, of the prediction after a symmetry.
    ///
    /// # Errors
    /// Those of [`Material::new`], which values of a material do not give.
    pub(super) fn fits(&self, symmetry: Option<Symmetry>) -> Result<Vec<ShiftFit>, Error> {
        let prediction = self.prediction;
        let size = prediction.size();
        let before = |texel: usize| symmetry.map_or(texel, |symmetry| symmetry.before(texel, size));
        let taken = |texels: &Vec<usize>| {
            let before: Vec<_> = texels.par_iter().map(|&texel| before(texel)).collect();
            let taken = prediction.gathered(&before, [texels.len(), 1]);
            symmetry.map_or_else(|| Ok(taken.clone()), |symmetry| symmetry.turned(&taken))
        };
        let prediction = match (&self.windows, symmetry) {
            (Some(texels), _) => taken(texels)?,
            (None, Some(symmetry)) => symmetry.applied(prediction)?,
            (None, None) => prediction.clone(),
        };
        let planes = self.truth.iter().zip(all_normalized(&prediction));
        let pairs: Vec<_> = planes.filter_map(|(a, b)| a.as_ref().zip(b)).collect();
        let span = |by: usize| -(by as i32)..=by as i32;
        let all: Vec<[i32; 2]> = span(self.reach[1])
            .flat_map(|down| span(self.reach[0]).map(move |right| [right, down]))
            .collect();
        let by = |&[right, down]: &[i32; 2]| i64::from(down) * self.width as i64 + i64::from(right);
        // Plane by plane: one fits into the cache.
        let of_plane = |(a, b): &(&Vec<f32>, Vec<f32>)| -> Vec<f64> {
            parallel::map(all.len(), |index| correlation(a, b, &self.runs, by(&all[index])))
        };
        let of_planes: Vec<_> = pairs.iter().map(of_plane).collect();
        let fit = |(index, &shift)| {
            let fits = || of_planes.iter().map(|plane| plane[index]);
            ShiftFit { shift, signed: fits().sum(), absolute: fits().map(f64::abs).sum() }
        };
        Ok(all.iter().enumerate().map(fit).collect())
    }
}

/// The two displacements other than none with the best fits, and the two with the best fits by absolute values.
pub(super) fn candidates(fits: &[ShiftFit]) -> Vec<[i32; 2]> {
    let best = |of: fn(&ShiftFit) -> f64| {
        let mut moved: Vec<&ShiftFit> = fits.iter().filter(|fit| fit.shift != [0, 0]).collect();
        sort_by_number(&mut moved, |fit| -of(fit));
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

fn all_normalized(material: &Material<f32>) -> Vec<Option<Vec<f32>>> {
    let planes: Vec<_> = material.planes().all().collect();
    parallel::map(planes.len(), |index| normalized(planes[index]))
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
        assert_eq!(Interior::new([3, 2], [1, 0]).texels(), [1, 2, 4, 5]);
        assert_eq!(Interior::new([3, 2], [-1, -1]).texels(), [0, 1]);
        assert_eq!(Interior::new([2, 2], [0, 0]).texels(), [0, 1, 2, 3]);
    }
}
