//! Heights beside normals, whose slopes tell the direction of y.

use std::path::PathBuf;

use crate::read::decode;
use crate::read::options::{NormalY, ReadOptions};
use crate::read::raster::Raster;
use crate::read::raster::measure::{self, Correlation};
use crate::read::record::{Certainty, Subject};
use crate::read::stored::{StoredHeight, StoredMaterial};

/// Least correlation of both slopes that tells a direction: of the sets of libraries that were measured 10 of 11 lie
/// above it, and all of them are right.
const TELLING: f64 = 0.15;
/// Beyond this correlation the curl test contradicts a direction.
const CONTRADICTS: f64 = 0.3;
/// Most cells in each direction whose means are compared.
const MOST: usize = 256;
/// Least cells in each direction from which a correlation is measured.
const LEAST: usize = 32;
/// Samples in each direction of a cell, at most.
const WITHIN: usize = 4;

/// The direction of y that the heights of a material show.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct HeightEvidence {
    pub file: PathBuf,
    /// Correlations of the slopes with x and with y of the normals.
    pub correlations: [f64; 2],
}

impl HeightEvidence {
    pub(super) fn y(&self) -> NormalY {
        let [x, y] = self.correlations;
        if x * y > 0.0 { NormalY::Up } else { NormalY::Down }
    }
}

/// The evidence of the heights of a material that is to be read with `options`.
pub(super) fn evidence(found: &StoredMaterial, options: &ReadOptions) -> Option<HeightEvidence> {
    let (normal, height) = (&found.normal.as_ref()?.raster, found.height.as_ref()?);
    let is_specified = options.normal_y.or(options.preset.and_then(|p| p.options().normal_y)).is_some();
    if is_specified || is_named(found, normal) {
        return None;
    }
    let (raster, file) = match height {
        StoredHeight::File(file) => {
            (decode::one(file, Subject::Picture).ok()?.0.raster, file.path().to_owned())
        }
        StoredHeight::Picture { raster, file } => (raster.clone(), file.clone()),
    };
    let correlations = slope_correlations(normal, &raster)?;
    let is_telling = correlations.iter().all(|one| one.abs() >= TELLING);
    is_telling.then_some(HeightEvidence { file, correlations })
}

/// Whether a name or a specification states the direction, and the normals do not contradict it.
fn is_named(found: &StoredMaterial, normal: &Raster) -> bool {
    let Some((y, _, Certainty::Sure)) = &found.inferred.normal_y else { return false };
    let curl = measure::curl(normal.width, normal.height, |index| normal.rgb(index).map(|c| 2.0 * c - 1.0));
    !curl.is_some_and(|curl| is_contradicted(*y, curl))
}

/// Whether the curl test contradicts the direction `y`.
pub(super) fn is_contradicted(y: NormalY, curl: f64) -> bool {
    if y == NormalY::Up { curl < -CONTRADICTS } else { curl > CONTRADICTS }
}

/// Correlations of the slopes of `heights`, to the right and upwards, with those that x and y of `normals` stand for.
///
/// Both have one sign where y points up, and differ where it points down, also of heights stored as depths. Heights of 8
/// bits have steps that hide gentle slopes, so that slopes are compared in cells of growing size; those of the cells in
/// which both correlations are the clearest are returned. `None` where the shapes differ, or one of the slopes is constant.
fn slope_correlations(normals: &Raster, heights: &Raster) -> Option<[f64; 2]> {
    let ([width, height], [across, down]) = (normals.size(), heights.size());
    if width * down != height * across || normals.channels.len() < 2 {
        return None;
    }
    let is_negative = |i: usize| normals.rgb(i)[..2].iter().any(|c| *c < -0.1);
    let is_signed = normals.is_float() && normals.sampled().any(is_negative);
    let cells = [width.min(across).min(MOST), height.min(down).min(MOST)];
    let slope = |axis: usize| {
        CellMeans::of(normals, cells, |rgb| {
            let [x, y] = [rgb[0], rgb[1]].map(|c| if is_signed { c } else { 2.0 * c - 1.0 });
            -[x, y][axis] / (1.0 - x * x - y * y).max(0.01).sqrt()
        })
    };
    let mut grids = [slope(0), slope(1), CellMeans::of(heights, cells, |rgb| rgb[0])];
    let mut clearest = None;
    while grids[0].size.iter().all(|side| *side >= LEAST) {
        let [x, y, h] = &grids;
        let both = [
            x.correlation(|at| h.at(at, [1, 0]) - h.at(at, [-1, 0])),
            y.correlation(|at| h.at(at, [0, -1]) - h.at(at, [0, 1])),
        ];
        if let [Some(x), Some(y)] = both {
            let clarity = |[x, y]: [f64; 2]| x.abs().min(y.abs());
            clearest = clearest.filter(|best| clarity(*best) >= clarity([x, y])).or(Some([x, y]));
        }
        grids = grids.map(|grid| grid.halved());
    }
    clearest
}

/// Means of a quantity over equal cells of a picture.
struct CellMeans {
    size: [usize; 2],
    means: Vec<f64>,
}

impl CellMeans {
    /// The means of `of` the channels of a few texels of each of `size` (columns, rows) cells.
    fn of(raster: &Raster, size: [usize; 2], of: impl Fn([f64; 3]) -> f64) -> Self {
        let places = |axis: usize, cell: usize| {
            let bound = |cell: usize| cell * raster.size()[axis] / size[axis];
            let (from, to) = (bound(cell), bound(cell + 1));
            (from..to).step_by((to - from).div_ceil(WITHIN))
        };
        let mean = |cell: usize| {
            let (mut sum, mut count) = (0.0, 0.0);
            for row in places(1, cell / size[0]) {
                for column in places(0, cell % size[0]) {
                    sum += of(raster.rgb(row * raster.width + column));
                    count += 1.0;
                }
            }
            sum / count
        };
        Self { size, means: (0..size[0] * size[1]).map(mean).collect() }
    }

    /// The mean of the cell that lies `by` columns and rows from cell number `cell`.
    fn at(&self, cell: usize, by: [isize; 2]) -> f64 {
        let place = cell.checked_add_signed(by[0] + by[1] * self.size[0] as isize);
        place.and_then(|place| self.means.get(place)).copied().unwrap_or(f64::NAN)
    }

    /// The correlation of the means with `other` of the number of each cell inside.
    fn correlation(&self, other: impl Fn(usize) -> f64) -> Option<f64> {
        let [columns, rows] = self.size;
        let mut sums = Correlation::default();
        for row in 1..rows - 1 {
            for cell in row * columns + 1..(row + 1) * columns - 1 {
                sums.add(self.means[cell], other(cell));
            }
        }
        sums.value()
    }

    /// Of half as many cells in each direction.
    fn halved(&self) -> Self {
        let size = self.size.map(|side| side / 2);
        let mean = |cell: usize| {
            let first = cell / size[0] * 2 * self.size[0] + cell % size[0] * 2;
            [0, 1, self.size[0], self.size[0] + 1].map(|by| self.means[first + by]).iter().sum::<f64>() / 4.0
        };
        Self { size, means: (0..size[0] * size[1]).map(mean).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read::raster::Samples;

    const SIDE: usize = 64;

    /// A bumpy height at a texel.
    fn bumps(index: usize) -> f64 {
        let [u, v] = [index % SIDE, index / SIDE].map(|i| i as f64 / SIDE as f64);
        0.5 + 0.1 * (9.0 * u).sin() * (7.0 * v).cos() + 0.05 * (5.0 * u + 11.0 * v).sin()
    }

    fn raster(channels: usize, of: impl Fn(usize) -> [f64; 3]) -> Raster {
        let plane = |c: usize| Samples::floats((0..SIDE * SIDE).map(|i| of(i)[c] as f32).collect());
        Raster {
            width: SIDE,
            height: SIDE,
            depth: "float",
            channels: (0..channels).map(plane).collect(),
            alpha: None,
            to_rec709: None,
        }
    }

    /// The normals of the bumps, y up times `y`.
    fn normals(y: f64) -> Raster {
        raster(3, |i| {
            let around = |i: usize| bumps(i.min(SIDE * SIDE - 1));
            let slope = [
                around(i + 1) - around(i.saturating_sub(1)),
                around(i.saturating_sub(SIDE)) - around(i + SIDE),
            ];
            let n = [-8.0 * slope[0], -8.0 * slope[1] * y, 1.0];
            let length = n.iter().map(|c| c * c).sum::<f64>().sqrt();
            n.map(|c| 0.5 * c / length + 0.5)
        })
    }

    #[test]
    fn slopes_of_heights_tell_where_y_points_and_depths_tell_the_same() {
        let signs = |y: f64, sign: f64| {
            slope_correlations(&normals(y), &raster(1, |i| [sign * bumps(i); 3])).unwrap()
        };
        for sign in [1.0, -1.0] {
            let [up, down] = [1.0, -1.0].map(|y| signs(y, sign));
            assert!(up[0] * sign > 0.9 && up[1] * sign > 0.9, "{up:?}");
            assert!(down[0] * sign > 0.9 && down[1] * sign < -0.9, "{down:?}");
        }
    }

    #[test]
    fn slopes_are_found_in_heights_of_few_steps_and_another_size() {
        let coarse = raster(1, |i| [(20.0 * bumps(i)).round() / 20.0; 3]);
        assert!(slope_correlations(&normals(-1.0), &coarse).is_some_and(|[x, y]| x > 0.5 && y < -0.5));
        let small = Raster { width: 32, height: 32, ..raster(1, |_| [0.0; 3]) };
        let quarter = |i: usize| bumps(i % 32 * 2 + i / 32 * 2 * SIDE) as f32;
        let small = Raster { channels: vec![Samples::floats((0..32 * 32).map(quarter).collect())], ..small };
        assert!(slope_correlations(&normals(1.0), &small).is_some_and(|[x, y]| x > 0.8 && y > 0.8));
    }

    #[test]
    fn heights_without_slopes_tell_nothing() {
        assert_eq!(slope_correlations(&normals(1.0), &raster(1, |_| [0.5; 3])), None);
        let flat = raster(3, |_| [0.5, 0.5, 1.0]);
        assert_eq!(slope_correlations(&flat, &raster(1, |i| [bumps(i); 3])), None);
    }
}
