//! Upload: the maps of a material on the adapter. Of a large material a draft is there first, while the rest is sent.

use std::collections::HashMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};
use std::thread;
use std::time::{Duration, Instant};

use svbrdf_core::material::Material;
use svbrdf_files::Error;
use svbrdf_files::disk::memory::{self, Reserved};
use svbrdf_gpu::{Gpu, MaterialTextures};

use crate::model::material::read::MaterialId;

/// Texels that a slow adapter sends and shades within a frame.
pub const BAND: usize = 1 << 19;

/// Strides that are tried in turn where the adapter cannot hold all texels.
const REDUCTIONS: [usize; 5] = [2, 4, 8, 16, 32];
/// The most bytes of a texel in the textures of a material.
const TEXEL_BYTES: u64 = 48;

/// Every n-th texel of a material along both axes.
#[derive(Debug)]
pub struct DraftTextures {
    pub stride: usize,
    pub textures: MaterialTextures,
    /// Textures of an adapter that computes on the CPU are in the memory of the machine.
    _reserved: Option<Reserved>,
}

/// The maps of a material on the adapter.
#[derive(Debug)]
pub struct Uploaded {
    draft: Option<DraftTextures>,
    /// All texels, or why the adapter cannot hold them.
    whole: OnceLock<Result<DraftTextures, String>>,
    /// As many texels as the adapter can hold, where it cannot hold all.
    reduced: OnceLock<DraftTextures>,
    /// Frames that were drawn of the draft.
    frames: AtomicUsize,
}

impl Uploaded {
    /// Sends all of `material`.
    pub fn all(gpu: &Gpu, material: &Material<f32>) -> Self {
        let uploaded = Self::new(None);
        uploaded.complete(gpu, material);
        uploaded
    }

    fn new(draft: Option<DraftTextures>) -> Self {
        Self { draft, whole: OnceLock::new(), reduced: OnceLock::new(), frames: AtomicUsize::new(0) }
    }

    /// Sends a draft where `material` is large and the adapter computes on the CPU: the rest, which takes a while there, is for
    /// [`Uploaded::complete`]. Otherwise sends all of it.
    pub fn start(gpu: &Gpu, material: &Material<f32>) -> Self {
        let [width, height] = material.size();
        let stride = ((width * height) as f64 / BAND as f64).sqrt().ceil() as usize;
        if !gpu.report.software || stride <= 1 {
            return Self::all(gpu, material);
        }
        Self::new(send(gpu, material, stride).ok())
    }

    /// Waits until the draft is on the screen: an adapter that computes on the CPU would draw it after what is sent. No longer than a
    /// moment, since a window may be hidden.
    pub fn wait_for_picture(&self) {
        const MOMENT: Duration = Duration::from_millis(300);
        // In the second frame the first one has been handed over.
        let (start, is_drawn) = (Instant::now(), || self.frames.load(Ordering::Relaxed) > 1);
        while self.draft.is_some() && !is_drawn() && start.elapsed() < MOMENT {
            thread::sleep(Duration::from_millis(5));
        }
    }

    /// Takes note of a frame that is drawn of the draft.
    pub fn note_frame(&self) {
        self.frames.fetch_add(1, Ordering::Relaxed);
    }

    /// Sends what is missing. Where another thread does so, waits for it.
    pub fn complete(&self, gpu: &Gpu, material: &Material<f32>) {
        self.complete_by(|stride| send(gpu, material, stride));
    }

    /// As [`Uploaded::complete`] on an adapter that has no room for all texels.
    pub fn too_large(gpu: &Gpu, material: &Material<f32>) -> Self {
        let uploaded = Self::new(None);
        uploaded.complete_by(|stride| match stride {
            1 => Err(Error::Internal("no room".to_owned())),
            stride => send(gpu, material, stride),
        });
        uploaded
    }

    fn complete_by(&self, send: impl Fn(usize) -> Result<DraftTextures, Error>) {
        self.whole.get_or_init(|| {
            send(1).map_err(|error| {
                let reduced = REDUCTIONS.into_iter().find_map(|stride| send(stride).ok());
                reduced.into_iter().for_each(|reduced| drop(self.reduced.set(reduced)));
                error.to_string()
            })
        });
    }

    /// All of it, or why the adapter cannot hold it; `None` until it is there.
    pub fn whole(&self) -> Option<Result<&MaterialTextures, &str>> {
        self.whole.get().map(|whole| whole.as_ref().map(|all| &all.textures).map_err(String::as_str))
    }

    /// What is there before, or instead.
    pub fn draft(&self) -> Option<&DraftTextures> {
        self.reduced.get().or(self.draft.as_ref())
    }
}

/// Sends every `stride`-th texel.
fn send(gpu: &Gpu, material: &Material<f32>, stride: usize) -> Result<DraftTextures, Error> {
    let texels: usize = material.size().into_iter().map(|side| side.div_ceil(stride)).product();
    let reserved = reserve_for(gpu, texels, TEXEL_BYTES)?;
    let textures = match stride {
        1 => MaterialTextures::upload(gpu, material)?,
        stride => MaterialTextures::upload_reduced(gpu, material, stride)?,
    };
    // Most files have codes, which take less.
    drop(reserved);
    let _reserved = reserve_for(gpu, texels, textures.texel_bytes() as u64)?;
    Ok(DraftTextures { stride, textures, _reserved })
}

/// Puts memory aside for textures of this many texels, where the adapter takes that of the machine.
///
/// # Errors
/// [`Error::Memory`].
pub fn reserve_for(gpu: &Gpu, texels: usize, bytes: u64) -> Result<Option<Reserved>, Error> {
    let what = || format!("drawing {texels} texels");
    gpu.report.software.then(|| memory::reserve(bytes * texels as u64, what)).transpose()
}

/// The maps on the adapter of all materials in the window.
#[derive(Debug, Default)]
pub struct Uploads {
    all: HashMap<MaterialId, Arc<Uploaded>>,
}

impl Uploads {
    /// Adds those of a material; `None` without an adapter.
    pub fn add(&mut self, id: MaterialId, uploaded: Option<Arc<Uploaded>>) {
        self.all.extend(uploaded.map(|uploaded| (id, uploaded)));
    }

    /// Those of a material.
    pub fn get(&self, id: MaterialId) -> Option<&Arc<Uploaded>> {
        self.all.get(&id)
    }

    /// Frees those of all other materials.
    pub fn keep_only(&mut self, is_wanted: impl Fn(MaterialId) -> bool) {
        self.all.retain(|id, _| is_wanted(*id));
    }
}

#[cfg(test)]
mod tests {
    use svbrdf_needs::needs;

    use super::*;
    use svbrdf_files::samples;

    #[needs(adapter)]
    fn only_of_a_large_material_and_only_on_the_cpu_a_draft_is_there_first() {
        let gpu = Gpu::headless().unwrap();
        let small: Material<f32> = samples::load().unwrap().ground_truth.material;
        let large = small.clone().resized([1024, 515]).unwrap();
        let uploaded = Uploaded::start(&gpu, &small);
        assert!(uploaded.draft().is_none() && uploaded.whole().is_some_and(|whole| whole.is_ok()));
        let uploaded = Uploaded::start(&gpu, &large);
        assert_eq!(uploaded.whole().is_none(), gpu.report.software);
        assert_eq!(uploaded.draft().map(|draft| draft.stride), gpu.report.software.then_some(2));
        uploaded.complete(&gpu, &large);
        assert!(uploaded.whole().is_some_and(|whole| whole.is_ok()));
        assert!(Uploaded::all(&gpu, &large).draft().is_none());
    }

    #[needs(adapter)]
    fn where_all_texels_do_not_fit_as_many_as_fit_are_there() {
        let gpu = Gpu::headless().unwrap();
        let material: Material<f32> = samples::load().unwrap().ground_truth.material;
        for fitting in [1, 2, 4, 32, 33] {
            let uploaded = Uploaded::new(None);
            uploaded.complete_by(|stride| match stride {
                small if small < fitting => Err(Error::Internal("planted".to_owned())),
                stride => send(&gpu, &material, stride),
            });
            let is_whole = uploaded.whole().unwrap().is_ok();
            let stride = uploaded.draft().map(|draft| draft.stride);
            let expected = (fitting == 1, [2, 4, 32].contains(&fitting).then_some(fitting));
            assert_eq!((is_whole, stride), expected, "{fitting}");
        }
    }
}
