//! Upload: the maps of a material on the adapter. Of a large material a draft is there first, while the rest is sent.

use std::collections::HashMap;
use std::sync::{Arc, OnceLock};

use svbrdf_core::material::Material;
use svbrdf_gpu::{Gpu, MaterialTextures};

use crate::viewer::model::material::read::MaterialId;

/// Texels that a slow adapter sends or shades within a frame.
pub const BAND: usize = 1 << 19;

/// Every n-th texel of a material along both axes.
#[derive(Debug)]
pub struct DraftTextures {
    pub stride: usize,
    pub textures: MaterialTextures,
}

/// The maps of a material on the adapter.
#[derive(Debug, Default)]
pub struct Uploaded {
    draft: Option<DraftTextures>,
    /// A text for the pane where the adapter cannot hold them.
    whole: OnceLock<Result<MaterialTextures, String>>,
}

impl Uploaded {
    /// Sends all of `material`.
    pub fn all(gpu: &Gpu, material: &Material<f32>) -> Self {
        let uploaded = Self::default();
        uploaded.complete(gpu, material);
        uploaded
    }

    /// Sends a draft where `material` is large and the adapter computes on the CPU: the rest, which takes a while there, is for
    /// [`Uploaded::complete`]. Otherwise sends all of it.
    pub fn start(gpu: &Gpu, material: &Material<f32>) -> Self {
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
    pub fn complete(&self, gpu: &Gpu, material: &Material<f32>) {
        self.whole.get_or_init(|| MaterialTextures::upload(gpu, material).map_err(|error| error.to_string()));
    }

    /// All of it, or why the adapter cannot hold it; `None` until it is there.
    pub fn whole(&self) -> Option<&Result<MaterialTextures, String>> {
        self.whole.get()
    }

    /// What is there before.
    pub fn draft(&self) -> Option<&DraftTextures> {
        self.draft.as_ref()
    }
}

/// The maps on the adapter of all materials in the window.
#[derive(Debug, Default)]
pub struct Uploads(HashMap<MaterialId, Arc<Uploaded>>);

impl Uploads {
    /// Adds those of a material; `None` without an adapter.
    pub fn add(&mut self, id: MaterialId, uploaded: Option<Arc<Uploaded>>) {
        self.0.extend(uploaded.map(|uploaded| (id, uploaded)));
    }

    /// Those of a material.
    pub fn get(&self, id: MaterialId) -> Option<&Arc<Uploaded>> {
        self.0.get(&id)
    }

    /// Frees those of all other materials.
    pub fn keep_only(&mut self, is_wanted: impl Fn(MaterialId) -> bool) {
        self.0.retain(|id, _| is_wanted(*id));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use svbrdf_files::samples;

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
