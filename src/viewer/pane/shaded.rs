//! Shaded texels of one material, and how much of them is shaded in a frame.

use svbrdf_files::Error;
use svbrdf_files::disk::memory::Reserved;
use svbrdf_gpu::{Gpu, MaterialTextures, ShadeParams, Shaded, Shading};

use crate::model::inspection::Region;
use crate::model::material::textures::reserve_for;

/// Bytes of a shaded texel.
const TARGET_BYTES: u64 = 16;

/// How much of a material is shaded before it is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ShadedPart {
    Whole,
    /// Every n-th texel along both axes.
    EveryNth(usize),
    /// The texels that are visible.
    Visible(Region),
}

/// What is wanted of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadingRequest {
    pub params: ShadeParams,
    pub part: ShadedPart,
    /// Whether the rest is shaded in bands, one in a frame.
    pub sharpens: bool,
    /// Whether the rest waits: reading materials comes first, and they are shaded together.
    pub waits: bool,
    /// Whether a draft will not do.
    pub exact: bool,
}

/// Where and with what texels are shaded.
#[derive(Debug)]
pub struct ShadingDevice<'a> {
    pub gpu: &'a Gpu,
    pub shading: &'a Shading,
    pub textures: &'a MaterialTextures,
    /// Whether the textures are reduced to what is shaded.
    pub are_reduced: bool,
    /// Texels of a material that are sharpened in a frame.
    pub band: usize,
    /// The number of the latest version of any texels.
    pub versions: &'a mut u64,
}

/// Shaded texels and what they were shaded with.
#[derive(Debug)]
pub struct ShadedTexels {
    pub shaded: Shaded,
    _reserved: Option<Reserved>,
    /// The maps at these texels alone, where they are not all of the material.
    reduced: Option<MaterialTextures>,
    /// With a region, only its texels.
    drawn: Option<(ShadeParams, Option<Region>)>,
    /// Changes whenever the texels that are versions do.
    pub version: u64,
}

/// All texels of a material, and every n-th one while something moves on a slow adapter.
#[derive(Debug, Default)]
pub struct ShadedMaterial {
    full: Option<ShadedTexels>,
    quick: Option<ShadedTexels>,
    shows_quick: bool,
    /// The rows of `full` that are shaded so far, and with what.
    sharpened: Option<(ShadeParams, usize)>,
}

impl ShadedMaterial {
    /// The texels to show.
    pub fn displayed(&self) -> Option<&ShadedTexels> {
        if self.shows_quick { self.quick.as_ref() } else { self.full.as_ref() }
    }

    /// Whether no picture of all texels has been shown yet.
    pub fn is_new(&self) -> bool {
        self.full.as_ref().is_none_or(|full| full.version == 0)
    }

    /// Whether all texels are shaded with these parameters.
    pub fn is_whole(&self, params: ShadeParams) -> bool {
        self.full.as_ref().is_some_and(|full| full.drawn == Some((params, None)))
    }

    /// Shades what is wanted for and not there yet.
    ///
    /// # Errors
    /// Where the adapter cannot hold the texels.
    pub fn shade(
        &mut self,
        device: &mut ShadingDevice<'_>,
        size: [usize; 2],
        ShadingRequest { params, part, sharpens, .. }: ShadingRequest,
    ) -> Result<(), Error> {
        let is_whole = self.is_whole(params);
        self.shows_quick = matches!(part, ShadedPart::EveryNth(_));
        match part {
            ShadedPart::EveryNth(stride) => {
                with_stride(&mut self.quick, device, size, stride)?.draw(device, params, None);
            }
            ShadedPart::Visible(region) if !is_whole => {
                let full = with_stride(&mut self.full, device, size, 1)?;
                if !full.has(params, region) {
                    full.draw(device, params, Some(region));
                }
            }
            ShadedPart::Whole if !is_whole => {
                with_stride(&mut self.full, device, size, 1)?.draw(device, params, None);
                return Ok(());
            }
            _ => {}
        }
        if sharpens && !is_whole { self.sharpen(device, size, params) } else { Ok(()) }
    }

    /// Shades the next band of all texels.
    fn sharpen(
        &mut self,
        device: &mut ShadingDevice<'_>,
        size: [usize; 2],
        params: ShadeParams,
    ) -> Result<(), Error> {
        let [width, height] = size;
        let top = self.sharpened.filter(|(of, _)| *of == params).map_or(0, |(_, rows)| rows);
        let full = with_stride(&mut self.full, device, size, 1)?;
        if self.shows_quick {
            // Its texels are a mixture from now on.
            full.drawn = None;
        }
        let rows = (device.band / width).max(1).min(height - top);
        let band = [0, top, width, rows].map(|side| side as u32);
        device.shading.draw_part(device.gpu, device.textures, &params, &full.shaded, Some(band));
        self.sharpened = Some((params, top + rows));
        if top + rows == height {
            (full.drawn, full.version) = (Some((params, None)), next(device.versions));
            self.sharpened = None;
        }
        Ok(())
    }
}

impl ShadedTexels {
    /// Whether the texels of a region are there.
    fn has(&self, params: ShadeParams, region: Region) -> bool {
        let holds = |drawn: &Region| {
            (0..2)
                .all(|axis| drawn.first[axis] <= region.first[axis] && region.last[axis] <= drawn.last[axis])
        };
        matches!(&self.drawn, Some((of, Some(drawn))) if *of == params && holds(drawn))
    }

    /// Shades a region, or all texels, unless that is what is there.
    fn draw(&mut self, device: &mut ShadingDevice<'_>, params: ShadeParams, region: Option<Region>) {
        let wanted = Some((params, region));
        if self.drawn == wanted {
            return;
        }
        let ShadingDevice { gpu, shading, textures, versions, .. } = device;
        let textures = self.reduced.as_ref().unwrap_or(textures);
        shading.draw_part(gpu, textures, &params, &self.shaded, region.map(Region::rectangle));
        (self.drawn, self.version) = (wanted, next(versions));
    }
}

fn next(versions: &mut u64) -> u64 {
    *versions += 1;
    *versions
}

/// The texels in `place`, which are made where there are none of this stride.
fn with_stride<'a>(
    place: &'a mut Option<ShadedTexels>,
    device: &ShadingDevice<'_>,
    size: [usize; 2],
    stride: usize,
) -> Result<&'a mut ShadedTexels, Error> {
    let last = place.take().filter(|texels| texels.shaded.stride() == stride);
    let texels = match last {
        Some(texels) => texels,
        None => {
            let ShadingDevice { gpu, shading, textures, .. } = device;
            let texels = size.map(|side| side.div_ceil(stride)).into_iter().product();
            let _reserved = reserve_for(gpu, texels, TARGET_BYTES)?;
            let shaded = shading.reduced_target(gpu, size, stride)?;
            let reduce = || shading.reduced_textures(gpu, textures, size, stride);
            let reduced = (stride > 1 && !device.are_reduced).then(reduce).transpose()?;
            ShadedTexels { shaded, _reserved, reduced, drawn: None, version: 0 }
        }
    };
    Ok(place.insert(texels))
}

#[cfg(test)]
mod tests {
    use svbrdf_needs::needs;

    use super::*;
    use crate::model::view::ViewState;
    use svbrdf_core::material::Material;
    use svbrdf_core::model::convention::PRINTED;
    use svbrdf_core::picture::quantity::Quantity;
    use svbrdf_files::samples;

    const SIZE: [usize; 2] = [1024, 1030];
    /// Less than half of it.
    const BAND: usize = 1 << 19;

    struct ShadingBench {
        gpu: Gpu,
        shading: Shading,
        textures: MaterialTextures,
        versions: u64,
    }

    impl ShadingBench {
        fn new() -> Self {
            let gpu = Gpu::headless().unwrap();
            let material: Material<f32> =
                samples::load().unwrap().ground_truth.material.resized(SIZE).unwrap();
            let textures = MaterialTextures::upload(&gpu, &material).unwrap();
            Self { shading: Shading::new(&gpu).unwrap(), gpu, textures, versions: 0 }
        }

        /// One frame with the light at `x`; the number of the version that is versions.
        fn frame(&mut self, texels: &mut ShadedMaterial, x: f64, part: ShadedPart) -> u64 {
            let Self { gpu, shading, textures, versions } = self;
            let mut device =
                ShadingDevice { gpu, shading, textures, are_reduced: false, band: BAND, versions };
            let sharpens = part != ShadedPart::Whole;
            let wanted = ShadingRequest { params: params(x), part, sharpens, waits: false, exact: false };
            texels.shade(&mut device, SIZE, wanted).unwrap();
            texels.displayed().unwrap().version
        }

        fn pixels(&self, texels: &ShadedMaterial) -> Vec<[f32; 3]> {
            texels.displayed().unwrap().shaded.read_back(&self.gpu).unwrap().pixels
        }
    }

    fn params(x: f64) -> ShadeParams {
        let mut scene = ViewState::default().scene;
        scene.light[0] = x;
        ShadeParams { scene, convention: PRINTED, quantity: Quantity::Rendering }
    }

    #[needs(adapter)]
    fn what_sharpens_in_bands_is_what_is_shaded_at_once_also_where_the_light_moves_in_between() {
        let mut bench = ShadingBench::new();
        let mut at_once = ShadedMaterial::default();
        bench.frame(&mut at_once, 0.5, ShadedPart::Whole);
        let expected = bench.pixels(&at_once);
        let mut texels = ShadedMaterial::default();
        // The first two bands are of another light.
        let draft = ShadedPart::EveryNth(2);
        bench.frame(&mut texels, -0.5, draft);
        let of_other_light = bench.frame(&mut texels, -0.5, draft);
        let mut versions = Vec::new();
        while !texels.is_whole(params(0.5)) {
            versions.push(bench.frame(&mut texels, 0.5, draft));
            assert!(versions.len() <= 3, "a band of {BAND} texels a frame");
        }
        assert!(
            versions.len() == 3 && versions.iter().all(|version| *version > of_other_light),
            "{versions:?}"
        );
        assert!(bench.pixels(&texels).len() < expected.len(), "a draft is seen until all is there");
        let draft_version = versions[2];
        assert_ne!(bench.frame(&mut texels, 0.5, ShadedPart::Whole), draft_version);
        assert_eq!(bench.pixels(&texels), expected);
        // What the frame after would show if bands were not begun anew.
        bench.frame(&mut at_once, -0.5, ShadedPart::Whole);
        assert_ne!(bench.pixels(&at_once), expected, "the light makes a difference");
    }
}
