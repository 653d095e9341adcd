//! Materials: from arrays, to arrays and pictures.

use std::path::PathBuf;
use std::str::FromStr;

use numpy::Element;
use pyo3::prelude::*;
use svbrdf_core::loss::Precision;
use svbrdf_core::material::{Material, Planes};
use svbrdf_core::math::real::Real;
use svbrdf_core::render as renderer;
use svbrdf_core::text::of_json;
use svbrdf_evaluate::diagnose::Storage;
use svbrdf_evaluate::report;
use svbrdf_files::convention;
use svbrdf_files::read::ReadOptions;

use crate::arrays;
use crate::errors::exception;
use crate::model::SceneTuple;
use crate::work;

/// A material.
#[pyclass(frozen, module = "svbrdf._core")]
#[derive(Debug)]
pub struct CoreMaterial {
    pub values: Values,
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

impl From<Material<f32>> for Values {
    fn from(material: Material<f32>) -> Self {
        Self::F32(material)
    }
}

impl From<Material<f64>> for Values {
    fn from(material: Material<f64>) -> Self {
        Self::F64(material)
    }
}

/// What `$of` gives of the material in its precision.
macro_rules! of_either {
    ($values:expr, $material:ident => $of:expr) => {
        match $values {
            Values::F32($material) => $of,
            Values::F64($material) => $of,
        }
    };
}

/// The arrays of a material.
#[derive(Debug, FromPyObject)]
#[pyo3(from_item_all)]
pub struct MaterialArrays<'py> {
    name: String,
    size: [usize; 2],
    normal: Bound<'py, PyAny>,
    diffuse: Bound<'py, PyAny>,
    specular: Bound<'py, PyAny>,
    roughness: Bound<'py, PyAny>,
}

impl MaterialArrays<'_> {
    /// The values go from the memory of numpy into the planes of the material without a copy between. The interpreter lock
    /// is held so long, and released for checking and normalizing them.
    fn material<T: Element + Real>(&self, py: Python<'_>) -> PyResult<Material<T>> {
        let planes = Planes {
            normal: arrays::planes(&self.normal)?,
            diffuse: arrays::planes(&self.diffuse)?,
            specular: arrays::planes(&self.specular)?,
            roughness: arrays::plane(&self.roughness)?,
        };
        let (name, [width, height]) = (&self.name, self.size);
        work::at_once(py, || Material::new(name, width, height, planes))
    }
}

#[pymethods]
impl CoreMaterial {
    #[new]
    fn new(py: Python<'_>, arrays: MaterialArrays<'_>, precision: &str) -> PyResult<Self> {
        let values = match Precision::from_str(precision).map_err(exception)? {
            Precision::F32 => arrays.material::<f32>(py)?.into(),
            Precision::F64 => arrays.material::<f64>(py)?.into(),
        };
        Ok(Self { values, storage: Storage::exact() })
    }

    #[getter]
    fn name(&self) -> &str {
        of_either!(&self.values, material => material.name())
    }

    /// (width, height).
    #[getter]
    fn size(&self) -> (usize, usize) {
        of_either!(&self.values, material => material.size().into())
    }

    #[getter]
    fn precision(&self) -> &'static str {
        match &self.values {
            Values::F32(_) => f32::NAME,
            Values::F64(_) => f64::NAME,
        }
    }

    /// A map.
    fn map<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        of_either!(&self.values, material => map(py, material, name))
    }
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

fn map<'py, T: Element + Real>(
    py: Python<'py>,
    material: &Material<T>,
    name: &str,
) -> PyResult<Bound<'py, PyAny>> {
    let (planes, size) = (material.planes(), material.size());
    let colour = match name {
        "normal" => &planes.normal,
        "diffuse" => &planes.diffuse,
        "specular" => &planes.specular,
        _ => return arrays::array(py, planes.roughness.iter().copied(), size, 1),
    };
    let numbers = (0..colour[0].len()).flat_map(|i| [colour[0][i], colour[1][i], colour[2][i]]);
    arrays::array(py, numbers, size, 3)
}

/// The read options of JSON.
///
/// # Errors
/// Where an option has no such value.
pub fn read_options(json: &str) -> PyResult<ReadOptions> {
    serde_json::from_str(json).map_err(|e| crate::errors::Error::new_err(of_json(&e)))
}

/// Renders a material in one scene: the RGB values of all texels.
#[pyfunction]
pub fn render<'py>(
    py: Python<'py>,
    material: &CoreMaterial,
    scene: SceneTuple,
    convention: &str,
) -> PyResult<Bound<'py, PyAny>> {
    let (scene, convention) = (scene.scene()?, convention::of_loss(convention).map_err(exception)?);
    match &material.values {
        Values::F32(material) => {
            let image = work::run(py, None, |p| renderer::render_f32(material, &scene, &convention, p))?;
            arrays::array(py, image.pixels.into_iter().flatten(), material.size(), 3)
        }
        Values::F64(material) => {
            let image = work::run(py, None, |p| renderer::render(material, &scene, &convention, p))?;
            arrays::array(py, image.pixels.into_iter().flatten(), material.size(), 3)
        }
    }
}

/// Names that tell materials apart, of (name, path).
#[pyfunction]
pub fn distinct_names(named: Vec<(String, PathBuf)>) -> Vec<String> {
    let named: Vec<_> = named.iter().map(|(name, path)| (&**name, &**path)).collect();
    report::distinct_names(&named)
}
