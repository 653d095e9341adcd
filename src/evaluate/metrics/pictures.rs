//! Metrics of two pictures of one size.

use super::ssim::ssim11_without_nan;
use svbrdf_core::image::Image;
use svbrdf_core::math::srgb;

/// How far two pictures differ in their sRGB values, of radiance that is clipped to [0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureMetrics {
    /// The root mean square difference over pixels and RGB; `None` where no pixel is known in both.
    pub rmse: Option<f64>,
    /// The SSIM of Wang et al. 2004 (Gaussian window of 11 x 11), the mean over RGB; `None` where no window is known in both.
    pub ssim: Option<f64>,
}

/// Compares two pictures of one size. Pixels that are NaN in one of them are left out, and the windows of SSIM with such a pixel.
pub fn of_pictures(first: &Image<f32>, second: &Image<f32>) -> PictureMetrics {
    let count = first.pixels.len();
    let encoded = |value: f32| srgb::encode(f64::from(value).clamp(0.0, 1.0));
    let mut pairs = vec![[0.0; 2]; 3 * count];
    for (index, (a, b)) in first.pixels.iter().zip(&second.pixels).enumerate() {
        let is_unknown = a.iter().chain(b).any(|value| value.is_nan());
        for c in 0..3 {
            pairs[c * count + index] =
                if is_unknown { [f64::NAN; 2] } else { [encoded(a[c]), encoded(b[c])] };
        }
    }
    let squares = pairs.iter().map(|[a, b]| (a - b).powi(2)).filter(|square| !square.is_nan());
    let (sum, known) = squares.fold((0.0, 0_usize), |(sum, known), square| (sum + square, known + 1));
    PictureMetrics {
        rmse: (known > 0).then(|| (sum / known as f64).sqrt()),
        ssim: ssim11_without_nan(&pairs, [first.width, first.height]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(at: impl Fn(usize, usize) -> f32) -> Image<f32> {
        let pixels = (0..24 * 16).map(|i| [at(i % 24, i / 24); 3]).collect();
        Image { width: 24, height: 16, pixels }
    }

    #[test]
    fn equal_pictures_differ_by_nothing_and_a_step_by_its_height_in_srgb() {
        let bumps = picture(|x, y| 0.3 + 0.2 * (x as f32).sin() * (y as f32).cos());
        let same = of_pictures(&bumps, &bumps);
        assert_eq!(same.rmse, Some(0.0));
        assert!((same.ssim.unwrap() - 1.0).abs() < 1e-12, "{same:?}");
        // 0.2140411 has the sRGB value 0.5, and what is above 1 is clipped.
        let step = of_pictures(&picture(|_, _| 0.214_041_1), &picture(|_, _| 7.0));
        assert!((step.rmse.unwrap() - 0.5).abs() < 1e-6, "{step:?}");
    }

    #[test]
    fn unknown_pixels_and_their_windows_are_left_out() {
        let known = |x: usize, y: usize| 0.3 + 0.02 * x as f32 + 0.01 * y as f32;
        let [a, b] = [picture(known), picture(|x, y| if x < 8 { known(x, y) } else { 0.9 })];
        let nan = picture(|x, y| if x < 13 { known(x, y) } else { f32::NAN });
        // Columns 8 to 12 differ; the windows of columns 0 to 12 are those of pictures of 13 columns.
        let of = |image: &Image<f32>| Image {
            width: 13,
            height: 16,
            pixels: image.pixels.chunks(24).flat_map(|row| &row[..13]).copied().collect(),
        };
        let cut = of_pictures(&of(&a), &of(&b));
        for (first, second) in [(&nan, &b), (&b, &nan)] {
            let metrics = of_pictures(first, second);
            assert!((metrics.rmse.unwrap() - cut.rmse.unwrap()).abs() < 1e-12, "{metrics:?}");
            assert!((metrics.ssim.unwrap() - cut.ssim.unwrap()).abs() < 1e-12, "{metrics:?}");
        }
        assert!(cut.rmse > Some(0.01) && cut.ssim < Some(0.999), "{cut:?}");
        let none = of_pictures(&picture(|_, _| f32::NAN), &a);
        assert_eq!(none, PictureMetrics { rmse: None, ssim: None });
        let few = picture(|x, _| if x % 11 == 5 { f32::NAN } else { 0.5 });
        assert_eq!(of_pictures(&few, &few), PictureMetrics { rmse: Some(0.0), ssim: None });
    }
}
