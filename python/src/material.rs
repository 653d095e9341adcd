//! Materials: from arrays, to arrays and pictures.

use std::path::PathBuf;
use std::str::FromStr;

use numpy::Element;
use pyo3::prelude::*;
use pyo3::types::PyByteArray;
use svbrdf_core::image::Image;
use svbrdf_core::loss::Precision;
use svbrdf_core::material::{Material, Planes};
use svbrdf_core::math::real::Real;
use svbrdf_core::render as renderer;
use svbrdf_evaluate::diagnose::Storage;
use svbrdf_evaluate::report;
use svbrdf_files::convention;
use svbrdf_files::read::ReadOptions;

use crate::arrays::{self, Bytes};
use crate::errors::exception;
use crate::model::SceneTuple;
use crate::{pickle, work};

/// A material.
#[pyclass(frozen, module = "svbrdf._core")]
#[derive(Debug)]
pub struct CoreMaterial {
    values: Values,
    /// How its files store it; arrays have no steps.
    pub storage: Storage,
}

/// A material in one of the two precisions.
#[derive(Debug)]
pub enum Values {
    /// For speed.
    F32(Material<f32>),
    /// For reference.
    F64(Material<f64>),
}

/// The arrays of a material; colours and normals are HxWx3, or 3xHxW where `planar` says so.
#[derive(Debug, FromPyObject)]
#[pyo3(from_item_all)]
pub struct Arrays<'py> {
    name: String,
    size: [usize; 2],
    normal: Bound<'py, PyAny>,
    diffuse: Bound<'py, PyAny>,
    specular: Bound<'py, PyAny>,
    roughness: Bound<'py, PyAny>,
    /// Of normal, diffuse and specular.
    planar: [bool; 3],
}

impl Arrays<'_> {
    /// The values go from the memory of numpy into the planes of the material without a copy between. The interpreter lock
    /// is held so long, and released for checking and normalizing them.
    fn material<T: Element + Real>(&self, py: Python<'_>) -> PyResult<Material<T>> {
        let [of_normal, of_diffuse, of_specular] = self.planar;
        let planes = Planes {
            normal: arrays::planes(&self.normal, of_normal)?,
            diffuse: arrays::planes(&self.diffuse, of_diffuse)?,
            specular: arrays::planes(&self.specular, of_specular)?,
            roughness: arrays::plane(&self.roughness)?,
        };
        let (name, [width, height]) = (&self.name, self.size);
        work::at_once(py, || Material::new(name, width, height, planes))
    }
}

#[pymethods]
impl CoreMaterial {
    /// `storage` is that of the material which the arrays were copied from.
    #[staticmethod]
    fn from_arrays(
        py: Python<'_>,
        arrays: Arrays<'_>,
        precision: &str,
        storage: Option<&str>,
    ) -> PyResult<Self> {
        let storage = storage.map_or_else(|| Ok(Storage::exact()), pickle::storage)?;
        match Precision::from_str(precision).map_err(exception)? {
            Precision::F32 => arrays.material(py).map(|material| single(material, storage)),
            Precision::F64 => arrays.material(py).map(|material| double(material, storage)),
        }
    }

    #[getter]
    fn storage(&self) -> PyResult<String> {
        pickle::text(&self.storage)
    }

    #[getter]
    fn name(&self) -> &str {
        match &self.values {
            Values::F32(material) => material.name(),
            Values::F64(material) => material.name(),
        }
    }

    /// (width, height).
    #[getter]
    fn size(&self) -> (usize, usize) {
        match &self.values {
            Values::F32(material) => material.size().into(),
            Values::F64(material) => material.size().into(),
        }
    }

    #[getter]
    fn precision(&self) -> &'static str {
        match &self.values {
            Values::F32(_) => f32::NAME,
            Values::F64(_) => f64::NAME,
        }
    }

    /// A picture of it in small, as the address of an image: a rendering, then its maps.
    fn overview(&self, py: Python<'_>) -> PyResult<String> {
        let material = self.single();
        work::at_once(py, || svbrdf_page::overview(&material))
    }

    /// The values of a map, channels interleaved.
    fn map<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyByteArray>> {
        match &self.values {
            Values::F32(material) => map_bytes(py, material, name),
            Values::F64(material) => map_bytes(py, material, name),
        }
    }
}

/// A material of the core in f32.
pub fn single(material: Material<f32>, storage: Storage) -> CoreMaterial {
    CoreMaterial { values: Values::F32(material), storage }
}

/// A material of the core in f64.
pub fn double(material: Material<f64>, storage: Storage) -> CoreMaterial {
    CoreMaterial { values: Values::F64(material), storage }
}

impl CoreMaterial {
    /// The material in f32: a copy only where it is in f64.
    pub fn single(&self) -> Material<f32> {
        match &self.values {
            Values::F32(material) => material.clone(),
            Values::F64(material) => material.cast(),
        }
    }

    /// The material in f64: a copy only where it is in f32.
    pub fn double(&self) -> Material<f64> {
        match &self.values {
            Values::F32(material) => material.cast(),
            Values::F64(material) => material.clone(),
        }
    }
}

fn map_bytes<'py, T: Real + Bytes>(
    py: Python<'py>,
    material: &Material<T>,
    name: &str,
) -> PyResult<Bound<'py, PyByteArray>> {
    let planes = material.planes();
    let colour = match name {
        "normal" => &planes.normal,
        "diffuse" => &planes.diffuse,
        "specular" => &planes.specular,
        _ => return arrays::bytes(py, planes.roughness.len(), planes.roughness.iter().copied()),
    };
    let numbers = (0..colour[0].len()).flat_map(|i| [colour[0][i], colour[1][i], colour[2][i]]);
    arrays::bytes(py, 3 * colour[0].len(), numbers)
}

/// The read options of a sidecar file's JSON.
///
/// # Errors
/// Where an option has no such value.
pub fn read_options(json: &str) -> PyResult<ReadOptions> {
    serde_json::from_str(json).map_err(|e| crate::errors::Error::new_err(e.to_string()))
}

/// Renders a material in one scene: the RGB values of all texels.
#[pyfunction]
pub fn render<'py>(
    py: Python<'py>,
    material: &CoreMaterial,
    scene: SceneTuple,
    convention: &str,
) -> PyResult<Bound<'py, PyByteArray>> {
    let scene = scene.scene()?;
    let convention = convention::of_loss(convention).map_err(exception)?;
    match &material.values {
        Values::F32(material) => {
            let image = work::run(py, None, |p| renderer::render_f32(material, &scene, &convention, p))?;
            pixels(py, image)
        }
        Values::F64(material) => {
            let image = work::run(py, None, |p| renderer::render(material, &scene, &convention, p))?;
            pixels(py, image)
        }
    }
}

fn pixels<T: Bytes>(py: Python<'_>, image: Image<T>) -> PyResult<Bound<'_, PyByteArray>> {
    arrays::bytes(py, 3 * image.pixels.len(), image.pixels.into_iter().flatten())
}

/// Names that tell materials apart, of (name, path).
#[pyfunction]
pub fn distinct_names(named: Vec<(String, PathBuf)>) -> Vec<String> {
    let named: Vec<_> = named.iter().map(|(name, path)| (&**name, &**path)).collect();
    report::distinct_names(&named)
}
