//! Shifts by whole texels.

use svbrdf_core::error::Error;
use svbrdf_core::material::{Material, Planes};

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
