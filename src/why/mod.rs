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
//! let share = |map| blame.of(map).shapley.mean / blame.loss.mean;
//! // "wrong roughness" is wrong in more than its roughness; its normals are those of the ground truth.
//! assert!(share(Map::Roughness) > 0.5 && share(Map::Diffuse) > 0.3 && share(Map::Normal) == 0.0);
//! assert!((Map::ALL.map(share).iter().sum::<f64>() - 1.0).abs() < 1e-9);
//! # Ok::<(), svbrdf::error::Error>(())
//! ```

mod attribution;
mod error_map;
mod hemisphere;
mod scene_losses;
mod worst;

pub use attribution::{Attribution, MOST_SCENES, MapShare, attribute};
pub use error_map::{error_maps, mean};
pub use hemisphere::{Hemisphere, Moved, hemisphere};
pub use scene_losses::{Distribution, RankedScene, worst_first};
pub use worst::{Worst, worst};
