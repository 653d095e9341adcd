//! Why a loss is what it is: which maps, scenes, directions and texels it comes from.
//!
//! ```
//! use svbrdf::loss::Request;
//! use svbrdf::material::Map;
//! use svbrdf::model::convention::Convention;
//! use svbrdf::progress::Progress;
//! use svbrdf::{samples, why};
//!
//! let built_in = samples::load::<f32>()?;
//! let (truth, rough) = (&built_in.ground_truth.material, &built_in.predictions[1].material);
//! let request = Request::Accuracy { target: 0.05, seed: 0 };
//! let blame = why::attribute(truth, rough, &Convention::default(), &request, &Progress::default())?;
//! // "wrong roughness" differs in its roughness only: all of the loss comes from there.
//! assert!((blame.of(Map::Roughness).shapley.mean / blame.loss.mean - 1.0).abs() < 1e-9);
//! assert_eq!(blame.of(Map::Normal).shapley.mean, 0.0);
//! # Ok::<(), svbrdf::error::Error>(())
//! ```

mod attribution;
mod error_map;
mod hemisphere;
mod scene_losses;
mod worst;

pub use attribution::{Attribution, MapShare, attribute};
pub use error_map::{error_maps, mean};
pub use hemisphere::{Hemisphere, Moved, hemisphere};
pub use scene_losses::{Distribution, RankedScene, worst_first};
pub use worst::{Worst, worst};
