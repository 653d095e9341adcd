//! Shifts by whole texels.

use svbrdf_core::material::Material;

/// The material moved by (right, down) texels; what leaves on one side enters on the other.
pub fn shifted(material: &Material<f32>, by: [i32; 2]) -> Material<f32> {
    let [width, height] = material.size();
    let texels: Vec<usize> =
        (0..width * height).map(|texel| before_shift(texel, by, [width, height])).collect();
    material.gathered(&texels, [width, height])
}

/// Where the texel was that is at `texel` of a map of `size` after it was moved by (right, down).
pub(super) fn before_shift(texel: usize, [right, down]: [i32; 2], [width, height]: [usize; 2]) -> usize {
    let back =
        |at: usize, by: i32, count: usize| (at as i64 - i64::from(by)).rem_euclid(count as i64) as usize;
    back(texel / width, down, height) * width + back(texel % width, right, width)
}
