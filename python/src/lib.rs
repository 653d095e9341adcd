//! The extension module `svbrdf._core`: the crate `svbrdf` for Python.
//!
//! Functions take and return plain values: arrays as buffers, options as numbers and words, scenes as tuples. The package
//! `svbrdf` beside it is the interface for users. It checks shapes and types and gives results their classes.

mod analysis;
mod arrays;
mod asked;
mod dataset;
mod errors;
mod files;
mod material;
mod model;
mod report;
mod work;

use pyo3::prelude::*;

// Arrays are read under the interpreter lock, which a free-threaded interpreter then has, too.
#[pymodule(gil_used = true)]
mod _core {
    #[pymodule_export]
    use super::{
        analysis::analysis,
        dataset::rank_dataset,
        errors::Error,
        files::{built_in, read, write},
        material::{CoreMaterial, distinct_names, render},
        model::{conventions, named_scenes, read_scenes, sample_scenes},
        report::schema,
    };

    #[allow(non_upper_case_globals, reason = "the name in Python")]
    #[pymodule_export]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
