//! Filtered roughness: the roughness of a material seen from so far that a block of texels is a point.

use rayon::prelude::*;

use svbrdf_core::material::{Material, Planes};

/// Least n_z of a slope.
const LEAST_Z: f64 = 0.01;

/// The means of alpha^2, of b = n_xy / n_z, and of the squares of b, over a block of texels.
type Moments = [f64; 5];

/// The roughness of blocks of 1 x 1, 2 x 2, 4 x 4 texels and so on, up to the largest that fit: the fourth root of the mean over blocks of
/// `<alpha^2> + trace of the covariance of n_xy / n_z` (Olano and Baker 2010, LEAN mapping), with alpha = r^2. Detail that moves
/// between normals and roughness hardly changes it.
///
/// n_z counts as 0.01 at least. Rows and columns that do not fill a block do not count.
pub fn filtered_roughness(material: &Material<f32>) -> Vec<f64> {
    let mut size = material.size();
    let Planes { normal: [x, y, z], roughness, .. } = material.planes();
    let of_texel = |index: usize| {
        let depth = f64::from(z[index]).max(LEAST_Z);
        let [bx, by] = [f64::from(x[index]) / depth, f64::from(y[index]) / depth];
        [f64::from(roughness[index]).powi(4), bx, by, bx * bx, by * by]
    };
    let rows = roughness.par_chunks(size[0]);
    let sum: f64 = rows
        .map(|row| row.iter().map(|r| f64::from(*r).powi(4)).sum::<f64>())
        .collect::<Vec<_>>()
        .iter()
        .sum();
    let mut all = vec![(sum / roughness.len() as f64).powf(0.25)];
    let mut blocks = halved(of_texel, &mut size);
    while !blocks.is_empty() {
        let variance =
            |[alpha, bx, by, bxx, byy]: &Moments| alpha + (bxx - bx * bx).max(0.0) + (byy - by * by).max(0.0);
        all.push((blocks.iter().map(variance).sum::<f64>() / blocks.len() as f64).powf(0.25));
        blocks = halved(|index| blocks[index], &mut size);
    }
    all
}

/// The means over blocks of 2 x 2 of what is at each index of a map of `size` (width, height), which becomes that of the blocks.
fn halved(at: impl Fn(usize) -> Moments + Sync, size: &mut [usize; 2]) -> Vec<Moments> {
    let width = size[0];
    *size = size.map(|count| count / 2);
    let [columns, rows] = *size;
    let of_row = |row: usize| {
        let of_block = |column: usize| {
            let first = 2 * row * width + 2 * column;
            let four = [first, first + 1, first + width, first + width + 1].map(&at);
            [0, 1, 2, 3, 4].map(|i| 0.25 * four.iter().map(|moments| moments[i]).sum::<f64>())
        };
        (0..columns).map(of_block).collect::<Vec<_>>()
    };
    (0..rows).into_par_iter().map(of_row).collect::<Vec<_>>().concat()
}
