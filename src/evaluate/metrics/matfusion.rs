//! The evaluation of MatFusion (Sartor and Peers 2023): `score.py` and `nprast.py` of its released code.
//!
//! The released script computes in single precision, this module in double. Its renderer is not Algorithm 3: texels lie at pixel
//! centres, R is multiplied by pi and clipped to [0, 1], diffuse is not scaled by (1 - specular), and roughness is at least 0.01.

use std::f64::consts::PI;

use glam::DVec3;
use rayon::prelude::*;

use super::Metric;
use super::maps::{pairs, rmse, stored};
use svbrdf_core::error::Error as CoreError;
use svbrdf_core::image::Image;
use svbrdf_core::material::Planes;
use svbrdf_core::math::real::Real;
use svbrdf_core::model::named_scenes::{MATFUSION_DISTANCE, hemisphere};
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;
use svbrdf_files::Error;

/// Smallest cosine, denominator of D, and k of G; also added to the 4 of the specular term.
const EPS: f64 = 1e-8;
const LEAST_ROUGHNESS: f64 = 0.01;

/// What the script computes without a neural network: `rmse_*_error` and `l1_rerender_error`, under names that begin with
/// `matfusion_`.
///
/// `size` is (width, height). Normals are as stored, of any length: normalized ones give other numbers.
///
/// # Errors
/// [`Cancelled`](Error::is_cancelled).
pub fn of_matfusion<T: Real>(
    ground_truth: &Planes<T>,
    prediction: &Planes<T>,
    size: [usize; 2],
    progress: &Progress,
) -> Result<Vec<Metric>, Error> {
    let normals = stored(&pairs(&ground_truth.normal, &prediction.normal));
    let roughness = [&ground_truth.roughness, &prediction.roughness].map(std::slice::from_ref);
    let flash = DVec3::new(0.0, 0.0, MATFUSION_DISTANCE);
    progress.begin(2);
    let rerendered = |planes| -> Result<Vec<[f64; 3]>, CoreError> {
        let rendering = rendering(planes, size, flash);
        progress.step().map(|()| rendering)
    };
    let [truth, predicted] = [rerendered(ground_truth)?, rerendered(prediction)?];
    let distances = truth.as_flattened().iter().zip(predicted.as_flattened()).map(|(a, b)| (a - b).abs());
    Ok(vec![
        Metric::exact("matfusion_rmse_diffuse", rmse(&pairs(&ground_truth.diffuse, &prediction.diffuse))),
        Metric::exact("matfusion_rmse_specular", rmse(&pairs(&ground_truth.specular, &prediction.specular))),
        Metric::exact("matfusion_rmse_roughness", rmse(&pairs(roughness[0], roughness[1]))),
        Metric::exact("matfusion_rmse_normals", rmse(&normals)),
        Metric::exact("matfusion_l1_rerender", distances.sum::<f64>() / truth.as_flattened().len() as f64),
    ])
}

/// The 128 renderings that the script gives to LPIPS, in its order: the light on the hemisphere, the camera above the centre.
///
/// A rendering is one step of `progress`.
///
/// # Errors
/// [`Cancelled`](Error::is_cancelled).
pub fn matfusion_renderings<T: Real>(
    planes: &Planes<T>,
    size: [usize; 2],
    progress: &Progress,
) -> Result<Vec<Image<f32>>, Error> {
    let scenes = hemisphere();
    progress.begin(scenes.len() as u64);
    let one = |scene: &Scene| -> Result<Image<f32>, Error> {
        let rgb = rendering(planes, size, scene.light.into());
        let pixels = rgb.into_iter().map(|rgb| rgb.map(|x| x as f32)).collect();
        progress.step()?;
        Ok(Image { width: size[0], height: size[1], pixels })
    };
    scenes.par_iter().map(one).collect()
}

/// The renderer of `nprast.py`: values in [0, 1], the camera at (0, 0, [`MATFUSION_DISTANCE`]).
fn rendering<T: Real>(planes: &Planes<T>, [width, height]: [usize; 2], light: DVec3) -> Vec<[f64; 3]> {
    let camera = DVec3::new(0.0, 0.0, MATFUSION_DISTANCE);
    let texel = |index: usize| {
        let (row, column) = (index / width, index % width);
        let x = 2.0 * (column as f64 + 0.5) / height as f64 - 1.0;
        let y = 1.0 - 2.0 * (row as f64 + 0.5) / width as f64;
        let surface = DVec3::new(x, y, 0.0);
        shaded(planes, index, (light - surface).normalize(), (camera - surface).normalize())
    };
    (0..width * height).into_par_iter().map(texel).collect()
}

fn shaded<T: Real>(planes: &Planes<T>, index: usize, to_light: DVec3, to_camera: DVec3) -> [f64; 3] {
    let at = |map: &[Vec<T>; 3]| map.each_ref().map(|plane| plane[index].f64());
    let roughness = planes.roughness[index].f64().clamp(LEAST_ROUGHNESS, 1.0);
    let [diffuse, specular] =
        [&planes.diffuse, &planes.specular].map(|map| at(map).map(|x| x.clamp(0.0, 1.0)));
    let normal = DVec3::from(at(&planes.normal)).normalize();
    // Turned towards the camera; the script asks for the fourth of three components, and gets the last.
    let normal = if normal.z == 0.0 { DVec3::ZERO } else { normal * normal.z.signum() };
    let half = (to_light + to_camera).normalize();
    let [n_dot_h, n_dot_l, n_dot_v] = [half, to_light, to_camera].map(|w| normal.dot(w).max(EPS));
    let v_dot_h = to_camera.dot(half).max(EPS);
    let alpha = roughness * roughness;
    let d = (alpha / (n_dot_h * n_dot_h * (alpha * alpha - 1.0) + 1.0).max(EPS)).powi(2) / PI;
    let k = (0.5 * alpha).max(EPS);
    let g1 = |cosine: f64| 1.0 / (cosine * (1.0 - k) + k);
    let g = g1(n_dot_l) * g1(n_dot_v);
    let fresnel = ((-5.55473 * v_dot_h - 6.98316) * v_dot_h).exp2();
    std::array::from_fn(|c| {
        let f = specular[c] + (1.0 - specular[c]) * fresnel;
        let radiance = d * g * f / (4.0 + EPS) * n_dot_l * PI + diffuse[c] * n_dot_l;
        radiance.clamp(0.0, 1.0)
    })
}
