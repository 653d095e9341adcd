//! The maps of a material on the adapter. Of a large material a draft is there first: it is seen while the rest is sent.

use std::sync::OnceLock;

use super::shaded::BAND;
use crate::gpu::{Gpu, MaterialTextures};
use crate::material::Material;

/// Every n-th texel of a material along both axes.
#[derive(Debug)]
pub(super) struct DraftTextures {
    pub stride: usize,
    pub textures: MaterialTextures,
}

/// The maps of a material on the adapter.
#[derive(Debug, Default)]
pub(super) struct Uploaded {
    draft: Option<DraftTextures>,
    /// A text for the pane where the adapter cannot hold them.
    whole: OnceLock<Result<MaterialTextures, String>>,
}

impl Uploaded {
    /// Sends all of `material`.
    pub(super) fn all(gpu: &Gpu, material: &Material<f32>) -> Self {
        let uploaded = Self::default();
        uploaded.complete(gpu, material);
        uploaded
    }

    /// Sends a draft where `material` is large and the adapter computes on the CPU: the rest, which takes a while there, is for
    /// [`Uploaded::complete`]. Otherwise sends all of it.
    pub(super) fn start(gpu: &Gpu, material: &Material<f32>) -> Self {
        let [width, height] = material.size();
        let stride = ((width * height) as f64 / BAND as f64).sqrt().ceil() as usize;
        if !gpu.report.software || stride <= 1 {
            return Self::all(gpu, material);
        }
        match MaterialTextures::upload_reduced(gpu, material, stride) {
            Ok(textures) => Self { draft: Some(DraftTextures { stride, textures }), whole: OnceLock::new() },
            Err(error) => Self { draft: None, whole: OnceLock::from(Err(error.to_string())) },
        }
    }

    /// Sends what is missing. Where another thread does so, waits for it.
    pub(super) fn complete(&self, gpu: &Gpu, material: &Material<f32>) {
        self.whole.get_or_init(|| MaterialTextures::upload(gpu, material).map_err(|error| error.to_string()));
    }

    /// All of it, or why the adapter cannot hold it; `None` until it is there.
    pub(super) fn whole(&self) -> Option<&Result<MaterialTextures, String>> {
        self.whole.get()
    }

    /// What is there before.
    pub(super) fn draft(&self) -> Option<&DraftTextures> {
        self.draft.as_ref()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples;

    #[test]
    #[cfg_attr(not(has_adapter), ignore = "no graphics adapter")]
    fn only_of_a_large_material_and_only_on_the_cpu_a_draft_is_there_first() {
        let gpu = Gpu::headless().unwrap();
        let small: Material<f32> = samples::load().unwrap().ground_truth.material;
        let large = small.clone().resized([1024, 515]).unwrap();
        let uploaded = Uploaded::start(&gpu, &small);
        assert!(uploaded.draft().is_none() && uploaded.whole().is_some_and(Result::is_ok));
        let uploaded = Uploaded::start(&gpu, &large);
        assert_eq!(uploaded.whole().is_none(), gpu.report.software);
        assert_eq!(uploaded.draft().map(|draft| draft.stride), gpu.report.software.then_some(2));
        uploaded.complete(&gpu, &large);
        assert!(uploaded.whole().is_some_and(Result::is_ok));
        assert!(Uploaded::all(&gpu, &large).draft().is_none());
    }
}
