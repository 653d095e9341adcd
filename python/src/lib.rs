//! The extension module `svbrdf._core`: the crate `svbrdf` for Python.
//!
//! Functions take and return plain values: arrays as buffers, options as numbers and words, scenes as tuples. The package
//! `svbrdf` beside it is the interface for users. It checks shapes and types and gives results their classes.

mod analysis;
mod arrays;
mod asked;
mod conform;
mod dataset;
mod errors;
mod files;
mod loss;
mod material;
mod model;
mod page;
mod photo;
mod pickle;
mod report;
mod session;
mod why;
mod work;

use pyo3::prelude::*;

// Arrays are read under the interpreter lock, which a free-threaded interpreter then has, too.
#[pymodule(gil_used = true)]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("Error", module.py().get_type::<errors::Error>())?;
    module.add_class::<material::CoreMaterial>()?;
    module.add_function(wrap_pyfunction!(files::read, module)?)?;
    module.add_function(wrap_pyfunction!(files::write, module)?)?;
    module.add_function(wrap_pyfunction!(files::built_in, module)?)?;
    module.add_function(wrap_pyfunction!(material::render, module)?)?;
    module.add_function(wrap_pyfunction!(material::distinct_names, module)?)?;
    module.add_function(wrap_pyfunction!(model::conventions, module)?)?;
    module.add_function(wrap_pyfunction!(model::sample_scenes, module)?)?;
    module.add_function(wrap_pyfunction!(model::named_scenes, module)?)?;
    module.add_function(wrap_pyfunction!(model::read_scenes, module)?)?;
    module.add_function(wrap_pyfunction!(loss::loss, module)?)?;
    module.add_function(wrap_pyfunction!(loss::rank, module)?)?;
    module.add_function(wrap_pyfunction!(analysis::analysis, module)?)?;
    module.add_function(wrap_pyfunction!(why::map, module)?)?;
    module.add_function(wrap_pyfunction!(why::diagnose, module)?)?;
    module.add_function(wrap_pyfunction!(photo::photo, module)?)?;
    module.add_function(wrap_pyfunction!(dataset::rank_dataset, module)?)?;
    module.add_function(wrap_pyfunction!(page::page, module)?)?;
    module.add_function(wrap_pyfunction!(session::session, module)?)?;
    module.add_function(wrap_pyfunction!(conform::probes, module)?)?;
    module.add_function(wrap_pyfunction!(conform::conform, module)?)?;
    Ok(())
}
