//! Upload: the maps of a material on the adapter, or as many of their texels as it can hold.

use svbrdf_core::material::Material;
use svbrdf_files::Error;
use svbrdf_files::disk::memory::{self, Reserved};
use svbrdf_gpu::{Gpu, MaterialTextures};

/// Strides that are tried in turn where the adapter cannot hold all texels.
const REDUCTIONS: [usize; 5] = [2, 4, 8, 16, 32];
/// The most bytes of a texel in the textures of a material.
const TEXEL_BYTES: u64 = 48;

/// Every n-th texel of a material along both axes on the adapter.
#[derive(Debug)]
pub struct SentTextures {
    pub stride: usize,
    pub textures: MaterialTextures,
    /// Textures of an adapter that computes on the CPU are in the memory of the machine.
    _reserved: Option<Reserved>,
}

/// The maps of a material on the adapter.
#[derive(Debug)]
pub struct Uploaded {
    /// As many texels as the adapter can hold.
    pub sent: Option<SentTextures>,
    /// Why it cannot hold all.
    pub problem: Option<String>,
}

impl Uploaded {
    /// Sends `material`.
    pub fn new(gpu: &Gpu, material: &Material<f32>) -> Self {
        Self::by(|stride| send(gpu, material, stride))
    }

    /// As [`Uploaded::new`] on an adapter that has no room for all texels.
    pub fn too_large(gpu: &Gpu, material: &Material<f32>) -> Self {
        Self::by(|stride| match stride {
            1 => Err(Error::Internal("no room".to_owned())),
            stride => send(gpu, material, stride),
        })
    }

    fn by(send: impl Fn(usize) -> Result<SentTextures, Error>) -> Self {
        match send(1) {
            Ok(sent) => Self { sent: Some(sent), problem: None },
            Err(error) => Self {
                sent: REDUCTIONS.into_iter().find_map(|stride| send(stride).ok()),
                problem: Some(error.to_string()),
            },
        }
    }
}

/// Sends every `stride`-th texel.
fn send(gpu: &Gpu, material: &Material<f32>, stride: usize) -> Result<SentTextures, Error> {
    let texels: usize = material.size().into_iter().map(|side| side.div_ceil(stride)).product();
    let reserved = reserve_for(gpu, texels, TEXEL_BYTES)?;
    let textures = match stride {
        1 => MaterialTextures::upload(gpu, material)?,
        stride => MaterialTextures::upload_reduced(gpu, material, stride)?,
    };
    // Most files have codes, which take less.
    drop(reserved);
    let _reserved = reserve_for(gpu, texels, textures.texel_bytes() as u64)?;
    Ok(SentTextures { stride, textures, _reserved })
}

/// Puts memory aside for textures of this many texels, where the adapter takes that of the machine.
///
/// # Errors
/// [`Error::Memory`].
pub fn reserve_for(gpu: &Gpu, texels: usize, bytes: u64) -> Result<Option<Reserved>, Error> {
    let what = || format!("drawing {texels} texels");
    gpu.report.software.then(|| memory::reserve(bytes * texels as u64, what)).transpose()
}

#[cfg(test)]
mod tests {
    use svbrdf_needs::needs;

    use super::*;
    use svbrdf_files::samples;

    #[needs(adapter)]
    fn where_all_texels_do_not_fit_as_many_as_fit_are_there() {
        let gpu = Gpu::headless().unwrap();
        let material: Material<f32> = samples::load().unwrap().ground_truth.material;
        for fitting in [1, 2, 4, 32, 33] {
            let uploaded = Uploaded::by(|stride| match stride {
                small if small < fitting => Err(Error::Internal("planted".to_owned())),
                stride => send(&gpu, &material, stride),
            });
            let stride = uploaded.sent.map(|sent| sent.stride);
            let expected = (fitting == 1, (fitting < 33).then_some(fitting));
            assert_eq!((uploaded.problem.is_none(), stride), expected, "{fitting}");
        }
    }
}
