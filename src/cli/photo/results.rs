//! Comparisons of every material with the photograph.

use svbrdf::error::Error;
use svbrdf::files::read::Photograph;
use svbrdf::material::Material;
use svbrdf::model::convention::Convention;
use svbrdf::model::scene::Scene;
use svbrdf::photograph::{Corners, PhotographComparison, Rectified};
use svbrdf::picture::difference::Difference;

use super::args::PhotoArgs;
use crate::cli::output::exit::tell;
use crate::cli::output::watched;

/// A photograph and its scene, with which all materials are compared.
#[derive(Debug)]
pub struct Setting<'a> {
    pub args: &'a PhotoArgs,
    pub photograph: Photograph,
    pub corners: Corners,
    pub scene: Scene,
    pub convention: Convention,
}

/// A material and its comparison.
#[derive(Debug)]
pub struct PhotoResult {
    pub material: Material<f32>,
    pub compared: PhotographComparison,
    /// Number of texels that are left out.
    pub clipped: usize,
}

/// The comparison of each material, the smallest mean log difference first.
///
/// # Errors
/// [`Error::NoExposure`].
pub fn results(setting: &Setting<'_>, materials: Vec<Material<f32>>) -> Result<Vec<PhotoResult>, Error> {
    let mut rectified: Vec<([usize; 2], Rectified)> = Vec::new();
    let mut results = Vec::new();
    for material in materials {
        let size = material.size();
        let place = match rectified.iter().position(|(of, _)| *of == size) {
            Some(place) => place,
            None => {
                note_stretching(setting, size);
                rectified.push((size, rectify(setting, size)?));
                rectified.len() - 1
            }
        };
        let photograph = &rectified[place].1;
        let compared = watched("rendering", |progress| {
            photograph.compare(&material, &setting.scene, &setting.convention, progress)
        })?;
        results.push(PhotoResult { material, compared, clipped: photograph.clipped() });
    }
    let mean = |result: &PhotoResult| {
        result.compared.statistics(Difference::Log).map_or(f64::INFINITY, |statistics| statistics.mean)
    };
    results.sort_by(|a, b| mean(a).total_cmp(&mean(b)));
    Ok(results)
}

fn rectify(setting: &Setting<'_>, size: [usize; 2]) -> Result<Rectified, Error> {
    let rectified = watched("averaging the photograph", |progress| {
        Rectified::new(&setting.photograph, &setting.corners, size, progress)
    })?;
    let falloff = setting.args.reading.falloff;
    Ok(if falloff { rectified.without_falloff(&setting.scene) } else { rectified })
}

/// Notes where the whole photograph has another shape than the material.
fn note_stretching(setting: &Setting<'_>, [width, height]: [usize; 2]) {
    let [w, h] = setting.photograph.size();
    let ratio = (w * height) as f64 / (h * width) as f64;
    if setting.args.reading.is_whole() && !(0.99..=1.01).contains(&ratio) {
        tell(&format!(
            "note: all {w} x {h} pixels of the photograph are taken as the {width} x {height} texels of the material; \
             --corners gives the corners of the material in it"
        ));
    }
}
