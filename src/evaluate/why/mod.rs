//! Origins of a loss: maps, scenes and texels.
//!
//! ```
//! use svbrdf_core::loss::Request;
//! use svbrdf_core::material::{Map, Material};
//! use svbrdf_core::model::brdf::Texel;
//! use svbrdf_core::model::convention::Convention;
//! use svbrdf_core::progress::Progress;
//! use svbrdf_evaluate::why;
//!
//! let texel = |diffuse: f32, roughness: f32| Texel { normal: glam::Vec3::Z, diffuse: [diffuse; 3], specular: [0.04; 3], roughness };
//! let truth = Material::uniform("truth", 64, 64, &texel(0.5, 0.6))?;
//! let prediction = Material::uniform("too dark and too rough", 64, 64, &texel(0.45, 0.9))?;
//! let request = Request::Accuracy { target: 0.05, seed: 0 };
//! let blame = why::attribute(&truth, &prediction, &Convention::default(), &request, &Progress::default())?;
//! let share = |map| blame.of(map).shapley.mean / blame.loss.mean;
//! assert!(share(Map::Roughness) > 0.0 && share(Map::Diffuse) > 0.0 && share(Map::Normal) == 0.0);
//! assert!((Map::ALL.map(share).iter().sum::<f64>() - 1.0).abs() < 1e-9);
//! # Ok::<(), svbrdf_evaluate::Error>(())
//! ```

mod attribution;
mod cloud;
mod error_map;
mod scene_losses;
mod worst;

pub use attribution::{Attribution, MOST_SCENES, MapShare, attribute};
pub use error_map::{error_maps, mean};
pub use scene_losses::{Distribution, RankedScene, worst_first, worst_on_all_texels};
pub use worst::{TAIL, Worst, worst};
