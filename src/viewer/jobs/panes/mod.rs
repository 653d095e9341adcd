//! What the panes display, and what is asked about it: the replacement of the chosen prediction, and numbers about differences, error maps
//! and the photograph.

pub mod computed_maps;
pub mod difference;
pub mod error_map;
pub mod photograph;
pub mod replacement;

use std::sync::Arc;

use svbrdf_core::picture::quantity::Quantity;

use crate::jobs::answers::Answered;
use crate::jobs::answers::content::Content;
use crate::model::Model;
use crate::model::material::loaded::LoadedMaterial;
use computed_maps::ComputedMaps;
use difference::{ComputedDifference, Differences};
use error_map::ErrorMaps;
use photograph::{ComparePhotograph, Photographs, Samples};

/// What the panes display in this frame. A number is of the question beside it, which may be that of an earlier frame.
#[derive(Debug, Default)]
pub struct Panes {
    /// The materials, with a replacement of the chosen prediction where one is displayed.
    pub displayed: Vec<LoadedMaterial>,
    pub differences: Option<(Differences, Arc<Answered<ComputedDifference>>)>,
    pub error_maps: Option<(ErrorMaps, Arc<Answered<ComputedMaps>>)>,
    /// The share of the texels of error maps that is done, while they are rendered.
    pub error_map_progress: Option<f32>,
    pub photograph: Option<Samples>,
    pub photographs: Option<(ComparePhotograph, Arc<Answered<Photographs>>)>,
    /// The automatic range of the predictions themselves: that of a replacement would change with it.
    pub auto_range: Option<(RangeKey, f64)>,
}

/// What an automatic range holds for: the materials and the difference, under any scene.
#[derive(Clone, Debug, PartialEq)]
pub struct RangeKey {
    materials: Vec<Content>,
    quantity: Quantity,
    difference: &'static str,
}

impl RangeKey {
    pub fn of(model: &Model) -> Self {
        Self {
            materials: Content::all(&model.materials.all),
            quantity: model.view.display.quantity,
            difference: model.view.difference_name(),
        }
    }
}
