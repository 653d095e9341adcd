//! The extension module `svbrdf._core`: the crate `svbrdf` for Python.
//!
//! Functions take and return plain values: arrays as buffers, options as numbers and words, scenes as tuples. The package
//! `svbrdf` beside it is the interface for users. It checks shapes and types and gives results their classes.

mod arrays;
mod blame;
mod dataset;
mod errors;
mod loss;
mod material;
mod model;
mod session;
mod work;

use pyo3::prelude::*;

// Arrays are read under the interpreter lock, which a free-threaded interpreter then has, too.
#[pymodule(gil_used = true)]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("Error", module.py().get_type::<errors::Error>())?;
    module.add_class::<material::CoreMaterial>()?;
    module.add_function(wrap_pyfunction!(material::read, module)?)?;
    module.add_function(wrap_pyfunction!(material::write, module)?)?;
    module.add_function(wrap_pyfunction!(material::built_in, module)?)?;
    module.add_function(wrap_pyfunction!(material::render, module)?)?;
    module.add_function(wrap_pyfunction!(material::distinct_names, module)?)?;
    module.add_function(wrap_pyfunction!(model::conventions, module)?)?;
    module.add_function(wrap_pyfunction!(model::sample_scenes, module)?)?;
    module.add_function(wrap_pyfunction!(model::read_scenes, module)?)?;
    module.add_function(wrap_pyfunction!(loss::loss, module)?)?;
    module.add_function(wrap_pyfunction!(blame::blame, module)?)?;
    module.add_function(wrap_pyfunction!(dataset::rank_dataset, module)?)?;
    module.add_function(wrap_pyfunction!(session::session, module)?)?;
    Ok(())
}
