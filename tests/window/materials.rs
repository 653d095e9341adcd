//! The built-in materials in memory and as files, and what the core gives for them.

use std::path::{Path, PathBuf};

use image::RgbImage;

use svbrdf_core::loss::{Comparison, Loss, Request};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::{Convention, PRINTED};
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;
use svbrdf_files::samples;

/// The built-in materials, the ground truth first.
pub fn materials() -> Vec<Material<f32>> {
    let samples = samples::load::<f32>().unwrap();
    [samples.ground_truth].into_iter().chain(samples.predictions).map(|read| read.material).collect()
}

/// The losses of the built-in predictions.
pub fn losses(request: &Request) -> Vec<Loss> {
    losses_in(request, PRINTED)
}

/// The same in a convention.
pub fn losses_in(request: &Request, convention: Convention) -> Vec<Loss> {
    let materials = materials();
    let predictions: Vec<_> = materials[1..].iter().collect();
    let comparison = Comparison::new(&materials[0], &predictions, convention).unwrap();
    comparison.run(request, &Progress::default()).unwrap().losses
}

/// The loss of a built-in prediction, counted from 1, in one scene.
pub fn loss_in(scene: Scene, prediction: usize) -> f64 {
    losses(&Request::Listed(vec![scene]))[prediction - 1].estimate.mean
}

/// Width and height of the tiles of [`strip`].
pub const SIDE: u32 = 256;

/// The built-in material of this number as a strip of normals, diffuse, roughness and specular.
pub fn sample(number: usize) -> RgbImage {
    let name = ["worn_tiles", "blurred_normals", "wrong_roughness"][number];
    let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/samples");
    image::open(samples.join(name).with_extension("png")).unwrap().into_rgb8()
}

/// The built-in ground truth as a strip of normals, diffuse, roughness and specular.
pub fn strip() -> RgbImage {
    sample(0)
}

/// Writes that strip under these names.
pub fn strips<const N: usize>(folder: &Path, names: [&str; N]) -> [PathBuf; N] {
    names.map(|name| {
        let path = folder.join(name);
        strip().save(&path).unwrap();
        path
    })
}

/// Writes a packed material of `side` x `side` texels: normal, diffuse, roughness, specular.
pub fn write_packed(path: &Path, side: u32, value: impl Fn(u32, u32, u32) -> [u8; 3]) {
    let pixel = |x, y| image::Rgb(value(x / side, x % side, y));
    RgbImage::from_fn(4 * side, side, pixel).save(path).unwrap();
}
