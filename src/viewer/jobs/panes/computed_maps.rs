//! Computed maps: differences that no shader computes, as numbers and on the adapter.

use std::sync::Arc;

use svbrdf_core::error::Error;
use svbrdf_core::image::{Image, mean_of_channels};
use svbrdf_core::picture::statistics::Distributions;
use svbrdf_gpu::{Gpu, Shaded};

/// An unsigned difference of each prediction.
#[derive(Debug)]
pub struct ComputedMaps {
    /// Of each prediction.
    pub images: Vec<Image<f32>>,
    /// Where there is an adapter.
    shaded: Vec<Arc<Shaded>>,
    pub distributions: Distributions,
}

impl ComputedMaps {
    /// The maps `images`, on the adapter where there is one.
    ///
    /// # Errors
    /// [`Error::Gpu`].
    pub fn new(images: Vec<Image<f32>>, gpu: Option<&Gpu>) -> Result<Self, Error> {
        let means = |image: &Image<f32>| image.pixels.iter().map(mean_of_channels).collect();
        let values: Vec<Vec<f32>> = images.iter().map(means).collect();
        let distributions = Distributions::of(&values, false);
        let upload = |gpu: &Gpu| {
            let one = |image| Shaded::of_image(gpu, image).map(Arc::new);
            images.iter().map(one).collect::<Result<Vec<_>, Error>>()
        };
        let shaded = gpu.map(upload).transpose()?.unwrap_or_default();
        Ok(Self { images, shaded, distributions })
    }

    /// The map of the material at this index on the adapter.
    pub fn shaded(&self, index: usize) -> Option<&Arc<Shaded>> {
        self.shaded.get(index.checked_sub(1)?)
    }

    /// The value of the map of the material at this index at the texel (column, row): the mean over RGB.
    pub fn at(&self, index: usize, [column, row]: [usize; 2]) -> f64 {
        let image = index.checked_sub(1).and_then(|index| self.images.get(index));
        image.map_or(f64::NAN, |image| f64::from(mean_of_channels(&image.pixels[row * image.width + column])))
    }
}
