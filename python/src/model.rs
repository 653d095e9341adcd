//! Conventions and scenes.

use std::path::PathBuf;

use pyo3::prelude::*;
use svbrdf_core::loss::{Sampling, Texels};
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::grammar::Description;
use svbrdf_core::model::grammar::words::{Maps, Shadowing, Transfer, Weight};
use svbrdf_core::model::named_conventions as named;
use svbrdf_core::model::named_scenes::NamedScenes;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_files::scene_file;

use crate::errors::{Error, exception};

/// A convention as a dictionary.
#[derive(Debug, IntoPyObject)]
pub struct ConventionItems {
    name: &'static str,
    intensity: f64,
    roughness_floor: f64,
    light_z_floor: f64,
    clamp_n_dot_h: bool,
    d_floor: f64,
    g_floor: f64,
    epsilon: f64,
    light_distance_sigma: f64,
    u1_max: f64,
    shift_z: f64,
    norm: &'static str,
    smith: Option<SmithItems>,
}

/// A renderer that is not Algorithm 3.
#[derive(Debug, IntoPyObject)]
pub struct SmithItems {
    cosine_floor: f64,
    intensity_distant: f64,
    specular: Option<f64>,
    is_weighted: bool,
}

impl ConventionItems {
    /// Of a named convention; `None` where `svbrdf.torch` does not have its renderer.
    fn of(described: &Description) -> Option<Self> {
        let c = Convention::try_from(described).ok()?;
        let (material, specular, light) =
            (&described.terms.material, &described.terms.specular, &described.terms.light);
        let is_smith = specular.g == Shadowing::Smith;
        let is_algorithm_3 = specular.g == Shadowing::Schlick && light.lz.is_some();
        if described.terms.output.transfer != Transfer::Linear || !(is_smith || is_algorithm_3) {
            return None;
        }
        let smith = is_smith.then(|| SmithItems {
            cosine_floor: specular.nl_min,
            intensity_distant: light.factor * light.intensity_distant.unwrap_or(light.intensity)[0],
            specular: (material.material == Maps::Dielectric).then_some(material.f0),
            is_weighted: described.terms.diffuse.diffuse == Weight::Fresnel,
        });
        Some(Self {
            name: c.name,
            intensity: light.factor * light.intensity[0],
            roughness_floor: material.r_min,
            light_z_floor: light.lz.unwrap_or(0.0),
            clamp_n_dot_h: !is_smith && specular.nh_clamped,
            d_floor: specular.d_den_min,
            g_floor: specular.g_den_min,
            epsilon: c.epsilon,
            light_distance_sigma: c.light_distance_sigma,
            u1_max: c.u1_max,
            shift_z: c.shift_z,
            norm: c.norm().name(),
            smith,
        })
    }
}

/// The conventions that `svbrdf.torch` has, the default first.
#[pyfunction]
pub fn conventions() -> Vec<ConventionItems> {
    named::all().iter().filter_map(ConventionItems::of).collect()
}

/// Kind, view and light.
#[derive(Clone, Debug, FromPyObject, IntoPyObject)]
pub struct SceneTuple(String, [f64; 3], [f64; 3]);

impl SceneTuple {
    /// The scene.
    ///
    /// # Errors
    /// [`Error`] where the kind is unknown.
    pub fn scene(&self) -> PyResult<Scene> {
        let Self(kind, view, light) = self;
        let kind = match kind.as_str() {
            "near" => Kind::Near,
            "distant" => Kind::Distant,
            _ => {
                return Err(Error::new_err(format!(
                    "unknown kind of scene `{kind}`; use one of: near, distant"
                )));
            }
        };
        Ok(Scene { kind, view: *view, light: *light })
    }
}

impl From<&Scene> for SceneTuple {
    fn from(scene: &Scene) -> Self {
        Self(scene.kind.to_string(), scene.view, scene.light)
    }
}

/// The scenes of a seed.
#[pyfunction]
pub fn sample_scenes(
    near: usize,
    distant: usize,
    seed: u64,
    sampler: &str,
    convention: &str,
) -> PyResult<Vec<SceneTuple>> {
    let convention = svbrdf_files::convention::of_loss(convention).map_err(exception)?;
    let sampler = sampler.parse().map_err(exception)?;
    let sampling = Sampling { near, distant, seed, sampler, texels: Texels::All };
    let scenes = sampling.scenes(&convention).map_err(exception)?;
    Ok(scenes.iter().map(SceneTuple::from).collect())
}

/// The scenes of a set with a name; `fov` is the field of view of `flash` in degrees.
#[pyfunction]
pub fn named_scenes(name: &str, fov: Option<f64>) -> PyResult<Vec<SceneTuple>> {
    let named = NamedScenes::named(name, fov.unwrap_or(NamedScenes::FOV_DEGREES)).map_err(exception)?;
    let scenes = named.scenes().map_err(exception)?;
    Ok(scenes.iter().map(SceneTuple::from).collect())
}

/// The scenes of a scene file.
#[pyfunction]
pub fn read_scenes(path: PathBuf) -> PyResult<Vec<SceneTuple>> {
    let scenes = scene_file::read(&path).map_err(exception)?;
    Ok(scenes.iter().map(SceneTuple::from).collect())
}
