//! Question about error maps: the log difference of each texel, averaged over the scenes of the loss.

use svbrdf_core::loss::{Comparison, Request};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_evaluate::why::error_maps;
use svbrdf_gpu::Gpu;

use super::computed_maps::ComputedMaps;
use super::difference::ComputedDifference;
use crate::error::Error;
use crate::jobs::answers::content::{Content, Given, read_all};
use crate::jobs::answers::{Question, Work};

/// The error map of each prediction. The ground truth is the first of the materials.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorMaps {
    pub materials: Vec<Content>,
    pub scenes: Request,
    pub convention: Convention,
    pub gpu: Given<Option<Gpu>>,
}

impl Question for ErrorMaps {
    type Answer = ComputedDifference;
    const KEPT: usize = 1;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<ComputedDifference, Error> {
        let materials = read_all(&self.materials)?;
        let materials: Vec<&Material<f32>> = materials.iter().map(|loaded| loaded.material()).collect();
        let comparison = Comparison::new(materials[0], &materials[1..], self.convention)?;
        let scenes = self.scenes.scenes(&self.convention)?.unwrap_or_default();
        let images = error_maps(&comparison, &scenes, work.progress())?;
        Ok(ComputedDifference::Maps(ComputedMaps::new(images, self.gpu.0.as_ref())?))
    }
}
