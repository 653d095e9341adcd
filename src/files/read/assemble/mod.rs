//! Assembly: one material out of its linear maps, by their workflow.

mod read;
mod storage;
mod workflow;

use crate::read::interpret::LinearMaterial;
use crate::read::options::ReadOptions;
use crate::read::record::{Note, SpecifiedBy};
pub use read::Read;
use svbrdf_core::material::Planes;
use svbrdf_core::math::real::Real;

/// The planes of the material, taken out of its linear maps; the choices that are made here are recorded in `found`.
pub(super) fn planes<T: Real>(found: &mut LinearMaterial<T>, options: &ReadOptions) -> Planes<T> {
    let (mut diffuse, specular) = workflow::separated(found, options);
    let energy = found.energy.take();
    workflow::unscale_diffuse(&mut diffuse, &specular, energy, options, &mut found.assumptions);
    let (normal, roughness) = (std::mem::take(&mut found.normal), std::mem::take(&mut found.roughness));
    let mut planes = Planes { normal, diffuse, specular, roughness };
    if options.flip_v == Some(true) {
        mirror(&mut planes, found.size[0]);
        found.notes.push(Note::RowsFlipped { by: SpecifiedBy::Caller });
    }
    planes
}

/// Top and bottom exchanged, and the normals with them.
fn mirror<T: Real>(planes: &mut Planes<T>, width: usize) {
    let Planes { normal, diffuse, specular, roughness } = planes;
    normal[1].iter_mut().for_each(|y| *y = -*y);
    for plane in normal.iter_mut().chain(diffuse).chain(specular).chain([roughness]) {
        let height = plane.len() / width;
        for row in 0..height / 2 {
            let (above, below) = plane.split_at_mut((height - 1 - row) * width);
            above[row * width..(row + 1) * width].swap_with_slice(&mut below[..width]);
        }
    }
}
