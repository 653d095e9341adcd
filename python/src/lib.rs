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
mod report;
mod why;
mod work;

use pyo3::prelude::*;

// Arrays are read under the interpreter lock, which a free-threaded interpreter then has, too.
#[pymodule(gil_used = true)]
mod _core {
    #[pymodule_export]
    use super::analysis::analysis;
    #[pymodule_export]
    use super::conform::{conform, probes};
    #[pymodule_export]
    use super::dataset::rank_dataset;
    #[pymodule_export]
    use super::errors::Error;
    #[pymodule_export]
    use super::files::{built_in, read, write};
    #[pymodule_export]
    use super::loss::{loss, rank};
    #[pymodule_export]
    use super::material::{CoreMaterial, distinct_names, render};
    #[pymodule_export]
    use super::model::{conventions, named_scenes, read_scenes, sample_scenes};
    #[pymodule_export]
    use super::page::page;
    #[pymodule_export]
    use super::photo::photo;
    #[pymodule_export]
    use super::report::{escaped, schema};
    #[pymodule_export]
    use super::why::{diagnose, map};

    #[allow(non_upper_case_globals, reason = "the name in Python")]
    #[pymodule_export]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
