//! Speed against accuracy: the time and the error of each setting of the loss, for one pair on this machine.
//!
//! ```no_run
//! use svbrdf_core::material::Material;
//! use svbrdf_core::model::brdf::Texel;
//! use svbrdf_core::model::convention::Convention;
//! use svbrdf_core::progress::Progress;
//! use svbrdf_evaluate::study;
//!
//! let texel = |roughness: f32| Texel { normal: glam::Vec3::Z, diffuse: [0.5; 3], specular: [0.04; 3], roughness };
//! let pair = study::Pair {
//!     ground_truth: &Material::uniform("truth", 64, 64, &texel(0.6))?,
//!     prediction: &Material::uniform("too rough", 64, 64, &texel(0.7))?,
//!     convention: Convention::default(),
//! };
//! let study = study::run(&pair, &Progress::default(), |_| ())?;
//! if let Some(point) = study.cheapest(0.01) {
//!     println!("1% takes {:.4} s: svbrdf loss {}", point.seconds, point.choice.options());
//! }
//! # Ok::<(), svbrdf_evaluate::Error>(())
//! ```
//!
//! The error of a setting is the root mean square, over seeds, of its relative difference from a reference over far more
//! scenes, corrected to f64. The time is the median of the runs; it includes the sampling of scenes and excludes the reading
//! of files. Errors are the same in every run of a study. Times are not, so neither is the list of settings that were not
//! measured because they would take too long.

mod choice;
pub mod csv;
mod measure;
mod pair;
pub mod plot;
mod result;
pub mod text;

pub use choice::{Choice, Family};
pub use pair::Pair;
pub use result::{Point, Reference, Study};

use measure::Bench;
use svbrdf_core::progress::Progress;

use crate::error::Error;

/// The reference of `pair`, before anything else is measured.
///
/// # Errors
/// As [`run`].
pub fn reference(pair: &Pair<'_>, progress: &Progress) -> Result<Reference, Error> {
    Bench::new(pair, progress).reference()
}

/// About how long [`measure`] takes, in seconds.
pub fn expected_seconds(pair: &Pair<'_>, reference: &Reference) -> f64 {
    Bench::new(pair, &Progress::default()).expected_seconds(reference)
}

/// Measures every choice for `pair`, except those whose loss would take too long; `update` sees the study after each point.
///
/// # Errors
/// Those of the loss; [`Error::NothingToStudy`] where the two materials look the same, so that no error is relative to
/// anything; [`Cancelled`](Error::is_cancelled).
pub fn run(pair: &Pair<'_>, progress: &Progress, update: impl FnMut(&Study)) -> Result<Study, Error> {
    measure(pair, reference(pair, progress)?, progress, update)
}

/// As [`run`], with a reference that is known.
///
/// # Errors
/// As [`run`].
pub fn measure(
    pair: &Pair<'_>,
    reference: Reference,
    progress: &Progress,
    mut update: impl FnMut(&Study),
) -> Result<Study, Error> {
    let mut bench = Bench::new(pair, progress);
    bench.begin();
    let mut study = Study {
        names: [pair.ground_truth, pair.prediction].map(|material| material.name().to_owned()),
        size: pair.ground_truth.size(),
        convention: pair.convention,
        threads: rayon::current_num_threads(),
        reference,
        points: Vec::new(),
        left_out: Vec::new(),
    };
    update(&study);
    for family in Family::ALL {
        bench.family(family, &mut study, &mut update)?;
    }
    Ok(study)
}
