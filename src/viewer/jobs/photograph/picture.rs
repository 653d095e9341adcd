//! Picture of the photograph as it was taken.

use svbrdf_core::image::Image;
use svbrdf_core::picture::tone::to_display;
use svbrdf_core::statistics::quantile;
use svbrdf_files::read::Photograph;

use crate::jobs::work::picture::Picture;

/// Longest side of the texture; larger photographs are reduced.
const LONGEST: usize = 4096;

/// The photograph at the exposure at which its brightest 1% clips.
pub fn picture(photograph: &Photograph, longest: usize) -> Picture {
    let reduced = reduced(&photograph.image, longest.clamp(1, LONGEST));
    let ev = exposure(&reduced);
    let colour = |pixel: &[f32; 3]| Picture::opaque(to_display(*pixel, ev));
    let pixels = reduced.pixels.iter().map(colour).collect();
    Picture { size: [reduced.width, reduced.height], pixels }
}

/// Averages square blocks of pixels, so that no side is longer than `longest`. Blocks at the right and the lower border may be cut.
fn reduced(image: &Image<f32>, longest: usize) -> Image<f32> {
    let block = image.width.max(image.height).div_ceil(longest);
    let [width, height] = [image.width, image.height].map(|side| side.div_ceil(block));
    let mean = |index: usize| {
        let [left, top] = [index % width * block, index / width * block];
        let (right, bottom) = ((left + block).min(image.width), (top + block).min(image.height));
        let mut sum = [0.0; 3];
        for row in top..bottom {
            for pixel in &image.pixels[row * image.width + left..row * image.width + right] {
                (0..3).for_each(|c| sum[c] += pixel[c]);
            }
        }
        sum.map(|sum| sum / ((right - left) * (bottom - top)) as f32)
    };
    Image { width, height, pixels: (0..width * height).map(mean).collect() }
}

/// The exposure, in stops, at which the brightest 1% of the pixels clips.
pub(super) fn exposure(image: &Image<f32>) -> f32 {
    let brightest = |pixel: &[f32; 3]| pixel.iter().copied().fold(0.0, f32::max);
    let mut values: Vec<f32> = image.pixels.iter().map(brightest).collect();
    match quantile(&mut values, 0.99) {
        Some(white) if white > 0.0 && white.is_finite() => -(white as f32).log2(),
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reduced_photograph_has_the_means_of_its_blocks() {
        let pixels = (0..15).map(|i| [i as f32, 1.0, 2.0 * i as f32]).collect();
        let image = Image { width: 5, height: 3, pixels };
        assert_eq!(reduced(&image, 5), image);
        let half = reduced(&image, 3);
        assert_eq!((half.width, half.height), (3, 2));
        assert_eq!(half.pixels[0], [3.0, 1.0, 6.0], "the mean of 0, 1, 5 and 6");
        assert_eq!(half.pixels[5], [14.0, 1.0, 28.0], "a block of one pixel");
    }

    #[test]
    fn the_brightest_percent_clips() {
        let of = |pixels: Vec<[f32; 3]>| exposure(&Image { width: pixels.len(), height: 1, pixels });
        let pixels = |bright| [vec![[100.0; 3]; bright], vec![[0.25, 0.1, 0.0]; 101 - bright]].concat();
        assert_eq!([2, 1].map(|bright| of(pixels(bright))), [-(100f32.log2()), 2.0]);
        assert_eq!(of(vec![[0.0; 3]; 4]), 0.0);
    }
}
