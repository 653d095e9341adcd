//! Occasion of the last automatic exposure.

use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;

use svbrdf_files::source::Place;

/// What the exposure was last computed for.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Exposed {
    /// It is to be computed as soon as there is a ground truth.
    #[default]
    Pending,
    /// It was saved with a session or a moment of the history, and holds for the materials of that.
    Restored,
    For {
        ground_truth: Place,
        scene: Scene,
        convention: Convention,
    },
}
