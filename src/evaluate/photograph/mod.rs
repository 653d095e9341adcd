//! Renderings against photographs: a photograph on the texels of a material, at the exposure of its renderings.
//!
//! A photograph shows the plane of the material within four [`Corners`](svbrdf_files::photograph::Corners). [`Rectified`] averages it over the area of each
//! texel; one factor, which [`Rectified::compare`] fits, brings it to the unit of Algorithm 3. Nothing else is calibrated.
//! [`PhotoReport`] compares materials with all photographs of a [`Capture`](svbrdf_files::photograph::Capture), which may be one.
//!
//! ```
//! use svbrdf_files::photograph::Corners;
//! use svbrdf_files::read::{Photograph, Transfer};
//! use svbrdf_core::model::convention::PRINTED;
//! use svbrdf_evaluate::photograph::{PhotographComparison, Rectified, flash};
//! use svbrdf_core::picture::difference::Difference;
//! use svbrdf_core::progress::Progress;
//! use svbrdf_core::render;
//! use svbrdf_files::samples;
//!
//! // A "photograph" of a known exposure: the rendering of the built-in ground truth, at half the brightness.
//! let (built_in, progress) = (samples::load::<f32>()?, Progress::default());
//! let truth = &built_in.ground_truth.material;
//! let scene = flash(45.0)?;
//! let mut image = render::render_f32(truth, &scene, &PRINTED, &progress)?;
//! image.pixels.iter_mut().flatten().for_each(|value| *value *= 0.5);
//! let clipped = vec![false; image.pixels.len()];
//! let photograph =
//!     Photograph { image, clipped, transfer: Transfer::Linear, transfer_from: "as specified", notes: Vec::new() };
//!
//! let corners = Corners::whole(photograph.size());
//! let rectified = Rectified::new(&photograph, &corners, truth.size(), &progress)?;
//! let right = rectified.compare(truth, &scene, &PRINTED, &progress)?;
//! let wrong = rectified.compare(&built_in.predictions[1].material, &scene, &PRINTED, &progress)?;
//! let mean = |compared: &PhotographComparison| {
//!     compared.statistics(Difference::Log).map(|statistics| statistics.mean)
//! };
//! assert!((right.factor - 2.0).abs() < 1e-6 && mean(&right) < Some(1e-6) && mean(&wrong) > Some(0.01));
//! # Ok::<(), svbrdf_evaluate::Error>(())
//! ```

mod comparison;
mod exposure;
mod measured;
mod outliers;
mod rectified;
mod report;
mod setting;

pub use comparison::PhotographComparison;
pub use measured::{PhotoMeans, PhotoMeasure, PhotoResult, PhotoStatistics, ReadPhotograph};
pub use outliers::PhotoOutlier;
pub use rectified::Rectified;
pub use report::PhotoReport;
pub use setting::{CaptureExposure, PhotoSetting};

pub use svbrdf_core::model::named_scenes::flash;
