//! One factor that brings a photograph to the exposure of a rendering.

use rayon::prelude::*;

use svbrdf_core::image::Image;

/// Ratios p / g of renderings p and photographs g over texels and channels, each with the weight p / (p + epsilon).
#[derive(Clone, Debug, Default)]
pub struct Ratios(Vec<[f32; 2]>);

impl Ratios {
    /// Those of `photograph` and `rendering`. Texels that are NaN are left out.
    pub fn of(photograph: &Image<f32>, rendering: &Image<f32>, epsilon: f64) -> Self {
        let samples = photograph.pixels.as_flattened().par_iter().zip(rendering.pixels.as_flattened());
        let ratio = |(&g, &p): (&f32, &f32)| {
            let weight = f64::from(p) / (f64::from(p) + epsilon);
            // A dark photograph of something bright asks for a large factor.
            let ratio = f64::from(p) / f64::from(g.max(0.0));
            (g.is_finite() && weight > 0.0).then_some([ratio as f32, weight as f32])
        };
        Self(samples.filter_map(ratio).collect())
    }

    /// Adds those of another photograph.
    pub fn append(&mut self, mut other: Self) {
        self.0.append(&mut other.0);
    }

    /// The factor k that brings the photographs to the exposure of the renderings: the weighted median of p / g. `None` where
    /// nothing is lit in both.
    ///
    /// It minimizes the mean of w |ln (k g) - ln p|, which to first order in the deviations is the mean of the log difference
    /// |ln (k g + epsilon) - ln (p + epsilon)|. As a median it is exact where all ratios agree, and highlights that one of the two
    /// lacks hardly move it.
    pub fn factor(&mut self) -> Option<f64> {
        let Self(ratios) = self;
        ratios.par_sort_by(|[a, _], [b, _]| a.total_cmp(b));
        let half = 0.5 * ratios.iter().map(|[_, weight]| f64::from(*weight)).sum::<f64>();
        let mut sum = 0.0;
        let median = ratios.iter().find(|[_, weight]| {
            sum += f64::from(*weight);
            sum >= half
        });
        median.map(|[ratio, _]| f64::from(*ratio)).filter(|factor| factor.is_finite() && *factor > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn factor(photograph: &Image<f32>, rendering: &Image<f32>, epsilon: f64) -> Option<f64> {
        Ratios::of(photograph, rendering, epsilon).factor()
    }

    fn image(values: &[f32]) -> Image<f32> {
        let pixels = values.iter().map(|&value| [value; 3]).collect();
        Image { width: values.len(), height: 1, pixels }
    }

    #[test]
    fn the_factor_is_exact_where_all_ratios_agree_and_ignores_a_highlight_and_what_is_left_out() {
        let rendering = image(&[0.5, 0.25, 1.0, 0.125, 2.0, 0.0]);
        let photograph = |highlight| image(&[0.125, 0.0625, 0.25, f32::NAN, highlight, 0.3]);
        for highlight in [0.5, 100.0, 0.0] {
            assert_eq!(factor(&photograph(highlight), &rendering, 0.01), Some(4.0), "{highlight}");
        }
    }

    #[test]
    fn dark_texels_count_as_little_as_in_the_log_difference() {
        // Three dark texels against one bright: by number, the dark ones would win.
        let rendering = image(&[1e-4, 1e-4, 1e-4, 1.0]);
        let photograph = image(&[1e-5, 1e-5, 1e-5, 0.5]);
        assert!((factor(&photograph, &rendering, 0.01).unwrap() - 2.0).abs() < 1e-6);
        assert!((factor(&photograph, &rendering, 1e-9).unwrap() - 10.0).abs() < 1e-4, "a planted epsilon");
    }

    #[test]
    fn several_photographs_have_one_factor() {
        let rendering = image(&[0.5, 0.25, 1.0]);
        let mut ratios = Ratios::of(&image(&[0.25, 0.125, 0.5]), &rendering, 0.01);
        ratios.append(Ratios::of(&image(&[0.25, 0.125, 0.5]), &rendering, 0.01));
        ratios.append(Ratios::of(&image(&[0.0625, 0.03125, 0.125]), &rendering, 0.01));
        assert_eq!(ratios.factor(), Some(2.0), "the third has a factor of 8");
    }

    #[test]
    fn without_light_in_both_there_is_no_factor() {
        let dark = image(&[0.0, 0.0]);
        let lit = image(&[1.0, 2.0]);
        for (photograph, rendering) in [(&dark, &lit), (&lit, &dark), (&image(&[f32::NAN; 2]), &lit)] {
            assert_eq!(factor(photograph, rendering, 0.01), None);
        }
    }
}
