//! The data of a gallery that is relit: small maps of its pictures, and the renderer.

use std::sync::atomic::{AtomicUsize, Ordering};

use serde::Serialize;

use svbrdf_core::material::{Material, Planes};
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_files::Error;

use super::data::{Renderer, failed};
use super::encode::EncodedMaterial;

/// Light and view of pictures and figures.
pub(super) const SCENE: Scene = Scene { kind: Kind::Near, view: [0.0, 0.0, 2.5], light: [0.4, 0.5, 1.2] };
/// Longest side of the maps.
pub(super) const SIDE: usize = 160;
/// Most bytes of the maps of a page.
pub(super) const MOST_BYTES: usize = 20_000_000;

/// The maps of a picture, and how it is rendered.
#[derive(Debug, Serialize)]
pub(super) struct Relit {
    material: EncodedMaterial,
    /// In stops.
    exposure: f32,
}

/// The room for maps in a page, which several threads fill.
#[derive(Debug, Default)]
pub(super) struct Room(AtomicUsize);

impl Room {
    /// The maps of a picture; `None` where there is no more room.
    ///
    /// # Errors
    /// As [`EncodedMaterial::new`].
    pub(super) fn take(&self, material: &Material<f32>, exposure: f32) -> Result<Option<Relit>, Error> {
        if self.is_full() {
            return Ok(None);
        }
        let material = EncodedMaterial::new(&sparse(material, SIDE)?)?;
        self.0.fetch_add(material.bytes(), Ordering::Relaxed);
        Ok(Some(Relit { material, exposure }))
    }

    /// Whether all maps together take too much.
    pub(super) fn is_full(&self) -> bool {
        self.0.load(Ordering::Relaxed) > MOST_BYTES
    }
}

/// Every n-th texel of every n-th row, so that no side has more than `most`: values as they are stored, which a mean of normals and
/// roughness would change.
fn sparse(material: &Material<f32>, most: usize) -> Result<Material<f32>, Error> {
    let size = material.size();
    let every = size.into_iter().max().unwrap_or(1).div_ceil(most).max(1);
    let of = |plane: &Vec<f32>| -> Vec<f32> {
        let rows = plane.chunks(material.width()).step_by(every);
        rows.flat_map(|row| row.iter().step_by(every)).copied().collect()
    };
    let planes = material.planes();
    let three = |planes: &[Vec<f32>; 3]| planes.each_ref().map(of);
    let planes = Planes {
        normal: three(&planes.normal),
        diffuse: three(&planes.diffuse),
        specular: three(&planes.specular),
        roughness: of(&planes.roughness),
    };
    let [width, height] = size.map(|side| side.div_ceil(every));
    Ok(Material::new(material.name(), width, height, planes)?)
}

#[derive(Serialize)]
struct Data<'a> {
    pictures: &'a [&'a Option<Relit>],
    scene: Scene,
    #[serde(flatten)]
    renderer: Renderer,
}

/// The JSON of the script of the gallery.
///
/// # Errors
/// [`Error::Internal`], which these values never give.
pub(super) fn json(pictures: &[&Option<Relit>], convention: &Convention) -> Result<String, Error> {
    let data = Data { pictures, scene: SCENE, renderer: Renderer::new(convention)? };
    serde_json::to_string(&data).map_err(failed)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn material(width: usize, height: usize) -> Material<f32> {
        let count = width * height;
        let ramp: Vec<f32> = (0..count).map(|i| i as f32 / count as f32).collect();
        let normal = [vec![0.0; count], vec![0.0; count], vec![1.0; count]];
        let colours = || [ramp.clone(), ramp.clone(), ramp.clone()];
        let planes = Planes { normal, diffuse: colours(), specular: colours(), roughness: ramp.clone() };
        Material::new("ramp", width, height, planes).unwrap()
    }

    #[test]
    fn maps_are_small_and_have_the_values_of_their_texels() {
        let small = sparse(&material(321, 5), SIDE).unwrap();
        assert_eq!(small.size(), [107, 2]);
        let roughness = &small.planes().roughness;
        let all = 321.0 * 5.0;
        assert_eq!([roughness[1], roughness[107]], [3.0 / all, 3.0 * 321.0 / all]);
        assert_eq!(sparse(&material(160, 9), SIDE).unwrap(), material(160, 9));
    }

    #[test]
    fn a_full_page_takes_no_more_maps() {
        let room = Room::default();
        assert!(room.take(&material(8, 8), 0.0).unwrap().is_some());
        room.0.fetch_add(MOST_BYTES, Ordering::Relaxed);
        assert!(room.is_full() && room.take(&material(8, 8), 0.0).unwrap().is_none());
    }
}
