//! Shifts by whole texels: the candidates by correlation of the maps.

use rayon::prelude::*;

use crate::error::Error;
use crate::material::{Material, Planes};
use crate::render::simd::tile::planes;

/// Most texels of a shift in either direction.
pub const MOST_SHIFT: usize = 8;
/// Most rows that maps are correlated on.
const ROWS: usize = 64;

/// The material moved by (right, down) texels; what leaves on one side enters on the other.
///
/// # Errors
/// Those of [`Material::new`], which values of a material do not give.
pub fn shifted(material: &Material<f32>, [right, down]: [i32; 2]) -> Result<Material<f32>, Error> {
    let [width, height] = material.size();
    let back =
        |at: usize, by: i32, count: usize| (at as i64 - i64::from(by)).rem_euclid(count as i64) as usize;
    let source = |index: usize| back(index / width, down, height) * width + back(index % width, right, width);
    let moved = |plane: &Vec<f32>| (0..plane.len()).map(|index| plane[source(index)]).collect::<Vec<_>>();
    let Planes { normal, diffuse, specular, roughness } = material.planes();
    let planes = Planes {
        normal: normal.each_ref().map(moved),
        diffuse: diffuse.each_ref().map(moved),
        specular: specular.each_ref().map(moved),
        roughness: moved(roughness),
    };
    Material::new(material.name(), width, height, planes)
}

/// The texels of a map of `size` (width, height), as row * width + column, that have a value of their own after a shift.
pub(super) fn interior([width, height]: [usize; 2], [right, down]: [i32; 2]) -> Vec<usize> {
    let range = |by: i32, count: usize| {
        let reach = (by.unsigned_abs() as usize).min(count);
        if by > 0 { reach..count } else { 0..count - reach }
    };
    let columns = range(right, width);
    range(down, height).flat_map(|row| columns.clone().map(move |column| row * width + column)).collect()
}

/// The `count` displacements (right, down) of `prediction` from `ground_truth`, other than none, under which their maps correlate
/// best: candidates.
///
/// The sum over all planes of Pearson's correlation coefficient on the texels that every shift leaves inside.
pub(super) fn candidates(
    ground_truth: &Material<f32>,
    prediction: &Material<f32>,
    count: usize,
) -> Vec<[i32; 2]> {
    let [width, height] = ground_truth.size();
    let reach = |side: usize| MOST_SHIFT.min(side / 4);
    let [reach_x, reach_y] = [reach(width), reach(height)];
    let inside = height - 2 * reach_y;
    let rows: Vec<usize> = (0..inside.min(ROWS)).map(|i| reach_y + i * inside / inside.min(ROWS)).collect();
    let span = |by: usize| -> Vec<i32> { (-(by as i32)..=by as i32).collect() };
    let all: Vec<[i32; 2]> = span(reach_y)
        .into_iter()
        .flat_map(|down| span(reach_x).into_iter().map(move |right| [right, down]))
        .collect();
    let columns = [reach_x, width - reach_x];
    let pairs: Vec<_> = planes(ground_truth.planes()).zip(planes(prediction.planes())).collect();
    let fit = |&[right, down]: &[i32; 2]| {
        let one = |&(a, b): &(&[f32], &[f32])| correlation(a, b, width, &rows, columns, [right, down]);
        pairs.iter().map(one).sum::<f64>()
    };
    let mut fits: Vec<(f64, [i32; 2])> =
        all.par_iter().filter(|shift| **shift != [0, 0]).map(|shift| (fit(shift), *shift)).collect();
    fits.sort_by(|a, b| b.0.total_cmp(&a.0));
    fits.into_iter().take(count).map(|(_, shift)| shift).collect()
}

/// Pearson's coefficient of `a` with `b` moved back by `shift`; 0 where one of them is constant.
fn correlation(
    a: &[f32],
    b: &[f32],
    width: usize,
    rows: &[usize],
    [first, end]: [usize; 2],
    [right, down]: [i32; 2],
) -> f64 {
    let (mut sums, mut count) = ([0.0_f64; 5], 0.0);
    for &row in rows {
        let moved =
            ((row as i64 + i64::from(down)) * width as i64 + first as i64 + i64::from(right)) as usize;
        let (a, b) = (&a[row * width + first..row * width + end], &b[moved..moved + end - first]);
        let mut of_row = [[0.0_f32; 8]; 5];
        let add = |sums: &mut [[f32; 8]; 5], lane: usize, x: f32, y: f32| {
            for (sum, value) in sums.iter_mut().zip([x, y, x * x, y * y, x * y]) {
                sum[lane] += value;
            }
        };
        for (a, b) in a.chunks(8).zip(b.chunks(8)) {
            for (lane, (&x, &y)) in a.iter().zip(b).enumerate() {
                add(&mut of_row, lane, x, y);
            }
        }
        for (sum, lanes) in sums.iter_mut().zip(of_row) {
            *sum += lanes.iter().map(|&value| f64::from(value)).sum::<f64>();
        }
        count += a.len() as f64;
    }
    let [x, y, xx, yy, xy] = sums.map(|sum| sum / count);
    let variances = (xx - x * x) * (yy - y * y);
    // Below this, the difference is rounding.
    if variances > 1e-14 { (xy - x * y) / variances.sqrt() } else { 0.0 }
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
