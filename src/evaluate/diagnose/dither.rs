//! Dithering: a material whose stored values are moved within the steps that its maps are stored in.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

use svbrdf_core::error::Error;
use svbrdf_core::material::{Map, Material, Planes};
use svbrdf_files::read::{Albedo, Roughness, Storage};

/// The material with every stored value moved by up to half a step of its map, uniformly; normals are normalized again. A map without
/// steps stays as it is, to the bit.
///
/// Roughness moves as the value that its map stores: r, 1 - r, r^2 for alpha, r^(1 / 2.2). The two values of an anisotropic map, which
/// are not known any more, count as r^2 each.
///
/// # Errors
/// Those of [`Material::new`], which values of a material do not give.
pub fn dithered(material: &Material<f32>, storage: &Storage, seed: u64) -> Result<Material<f32>, Error> {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    let Planes { normal, diffuse, specular, roughness } = material.planes();
    let [of_normal, of_diffuse, of_specular, of_roughness] = storage.steps;
    let transfer =
        |of: Option<Albedo>| (move |x: f32| Storage::encode(of, x), move |x: f32| Storage::decode(of, x));
    let mut moved = |plane: &[f32], step: f64, (encode, decode): Code<'_>| -> Vec<f32> {
        let step = step as f32;
        let one = |x: &f32| decode((encode(*x) + step * (generator.random::<f32>() - 0.5)).clamp(0.0, 1.0));
        plane.iter().map(one).collect()
    };
    // Components of normals are stored as (n + 1) / 2.
    let normal =
        normal.each_ref().map(|plane| moved(plane, of_normal, (&|n| 0.5 * n + 0.5, &|c| 2.0 * c - 1.0)));
    let (encode, decode) = transfer(storage.colours);
    let diffuse = diffuse.each_ref().map(|plane| moved(plane, of_diffuse, (&encode, &decode)));
    let (encode, decode) = transfer(storage.specular);
    let specular = specular.each_ref().map(|plane| moved(plane, of_specular, (&encode, &decode)));
    let mut roughness_as = |code: Code<'_>| moved(roughness, of_roughness, code);
    let roughness = match storage.roughness {
        Roughness::Alpha => roughness_as((&|r| r * r, &f32::sqrt)),
        Roughness::Anisotropic => {
            let widths = [(); 2].map(|()| roughness_as((&|r| r * r, &|c| c)));
            widths[0].iter().zip(&widths[1]).map(|(x, y)| (x * y).sqrt().sqrt()).collect()
        }
        Roughness::Gamma22 => roughness_as((&|r| r.powf(1.0 / 2.2), &|c| c.powf(2.2))),
        // 1 - r has the same steps as r.
        _ => roughness_as((&|r| r, &|c| c)),
    };
    let planes = Planes { normal, diffuse, specular, roughness };
    let moved = Material::new(material.name(), material.width(), material.height(), planes)?;
    let has_steps = |map| Map::ALL.iter().zip(storage.steps).any(|(of, step)| *of == map && step > 0.0);
    material.with_maps_of(&moved, has_steps)
}

/// The stored value of a value in [0, 1], and the inverse.
type Code<'a> = (&'a dyn Fn(f32) -> f32, &'a dyn Fn(f32) -> f32);

#[cfg(test)]
mod tests {
    use super::super::tests::materials::{generated, with};
    use super::*;

    /// The largest change of a roughness that is stored so.
    fn largest(stored: Roughness, roughness: f32) -> f32 {
        let material = with(&generated(0, 32), |planes| planes.roughness.fill(roughness));
        let storage = Storage { roughness: stored, ..Storage::default() };
        let moved = dithered(&material, &storage, 1).unwrap();
        moved.planes().roughness.iter().map(|r| (r - roughness).abs()).fold(0.0, f32::max)
    }

    #[test]
    fn maps_without_steps_do_not_move() {
        let material = generated(1, 32);
        for roughness in [Roughness::R, Roughness::Alpha, Roughness::Anisotropic, Roughness::Gamma22] {
            let storage = Storage { colours: Some(Albedo::Srgb), roughness, ..Storage::exact() };
            assert_eq!(dithered(&material, &storage, 1).unwrap(), material, "{roughness:?}");
            let storage = Storage { steps: [0.0, 1.0 / 255.0, 0.0, 0.0], ..storage };
            let moved = dithered(&material, &storage, 1).unwrap();
            assert_ne!(moved.planes().diffuse, material.planes().diffuse);
            let only_diffuse = moved.with_maps_of(&material, |map| map == Map::Diffuse).unwrap();
            assert_eq!(only_diffuse, material, "{roughness:?}");
        }
    }

    #[test]
    fn roughness_moves_by_half_a_step_of_what_its_map_stores() {
        // Half a step in c, divided by the slope dc / dr.
        let half = 0.5 / 255.0;
        for (name, roughness, expected) in [
            (Roughness::R, 0.2, half),
            (Roughness::Gloss, 0.2, half),
            (Roughness::Alpha, 0.2, half / 0.4),
            (Roughness::Alpha, 0.8, half / 1.6),
            (Roughness::Gamma22, 0.2, half * 2.2 * 0.2_f32.powf(1.2 / 2.2)),
        ] {
            let found = largest(name, roughness);
            assert!((0.97..1.03).contains(&(found / expected)), "{name:?} {roughness}: {found} {expected}");
        }
        // The mean of two uniform numbers is seldom as large as either.
        let both = largest(Roughness::Anisotropic, 0.2) / (half / 0.4);
        assert!((0.8..1.0).contains(&both), "{both}");
    }
}
