//! Filtered roughness: the roughness of a material seen from so far that a block of texels is a point.

use svbrdf_core::material::Material;

/// Least n_z of a slope.
const LEAST_Z: f64 = 0.01;

/// The roughness of blocks of 2^`level` x 2^`level` texels: the fourth root of the mean over blocks of
/// `<alpha^2> + trace of the covariance of n_xy / n_z` (Olano and Baker 2010, LEAN mapping), with alpha = r^2. Detail that moves
/// between normals and roughness hardly changes it.
///
/// n_z counts as 0.01 at least. Rows and columns that do not fill a block do not count; `None` where no block is filled.
pub fn filtered_roughness(material: &Material<f32>, level: u32) -> Option<f64> {
    let side = 1_usize.checked_shl(level)?;
    let blocks = material.size().map(|count| count / side);
    let (width, planes) = (material.width(), material.planes());
    let [x, y, z] = planes.normal.each_ref().map(Vec::as_slice);
    let of_block = |block: usize| {
        let (column, row) = (block % blocks[0] * side, block / blocks[0] * side);
        let mut sums = [0.0; 5];
        for index in (row..row + side).flat_map(|row| (column..column + side).map(move |c| row * width + c)) {
            let depth = f64::from(z[index]).max(LEAST_Z);
            let [bx, by] = [f64::from(x[index]) / depth, f64::from(y[index]) / depth];
            let values = [f64::from(planes.roughness[index]).powi(4), bx, by, bx * bx, by * by];
            sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
        }
        let [alpha, bx, by, bxx, byy] = sums.map(|sum| sum / (side * side) as f64);
        alpha + (bxx - bx * bx).max(0.0) + (byy - by * by).max(0.0)
    };
    let count = blocks[0] * blocks[1];
    (count > 0).then(|| ((0..count).map(of_block).sum::<f64>() / count as f64).powf(0.25))
}
