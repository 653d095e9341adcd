//! Contents of a picture: a quantity of each material, or its difference from the ground truth.

use serde::{Deserialize, Serialize};

use super::colour_map::difference_to_display;
use super::difference::{Difference, DifferenceParams};
use super::quantity::Quantity;
use super::statistics::Distributions;
use super::tone::to_display;
use crate::error::Error;
use crate::image::Image;
use crate::material::Material;
use crate::model::convention::Convention;
use crate::model::scene::Scene;
use crate::progress::Progress;

/// The colour of a difference that is not a number.
const MID_GRAY: [u8; 3] = [128; 3];

/// The content of a picture: a quantity, or its difference from the ground truth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PictureContent {
    pub quantity: Quantity,
    /// `None` for the value.
    pub difference: Option<ColouredDifference>,
}

/// A difference, and its colours.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ColouredDifference {
    pub kind: Difference,
    /// The difference that has the last colour. `None`: the 99th percentile over the texels of the prediction where it is
    /// largest.
    pub range: Option<f64>,
}

/// Pictures of materials, and how their numbers become colours.
#[derive(Clone, Debug, PartialEq)]
pub struct Pictures {
    /// Linear RGB; of normals (x, y, z); of differences each channel's.
    pub images: Vec<Image<f32>>,
    /// As asked, with the range that was found.
    pub content: PictureContent,
}

impl PictureContent {
    /// The value of every material, or the difference of every material but the first, the ground truth. Values are not exposed;
    /// differences are, where they depend on `exposure_ev`.
    ///
    /// # Errors
    /// Those of [`Quantity::image`].
    pub fn pictures(
        self,
        materials: &[&Material<f32>],
        scene: &Scene,
        convention: &Convention,
        exposure_ev: f32,
        progress: &Progress,
    ) -> Result<Pictures, Error> {
        let image = |material: &&Material<f32>| self.quantity.image(material, scene, convention, progress);
        let values = materials.iter().map(image).collect::<Result<Vec<_>, _>>()?;
        Ok(self.of_values(values, convention, exposure_ev))
    }

    /// As [`PictureContent::pictures`], of values that have been computed.
    pub fn of_values(self, values: Vec<Image<f32>>, convention: &Convention, exposure_ev: f32) -> Pictures {
        let (Some(difference), Some((ground_truth, predictions))) = (self.difference, values.split_first())
        else {
            return Pictures { images: values, content: self };
        };
        let params = DifferenceParams { epsilon: convention.epsilon, exposure_ev };
        let auto = || {
            let of = |prediction| difference.kind.of_images(ground_truth, prediction, params);
            Distributions::of(&predictions.iter().map(of).collect::<Vec<_>>(), difference.kind.is_signed())
                .auto_range
        };
        let range = Some(difference.range.unwrap_or_else(auto));
        let images = predictions.iter().map(|p| difference.kind.picture(ground_truth, p, params)).collect();
        Pictures {
            images,
            content: Self { difference: Some(ColouredDifference { range, ..difference }), ..self },
        }
    }

    /// The 8-bit colours of a number: of a rendering exposed and sRGB-encoded, of an albedo sRGB-encoded, of a normal
    /// (n + 1) / 2, of roughness itself; of a difference those of its colour map, gray where it is NaN. Exposure changes renderings only.
    pub fn colour(&self, rgb: [f32; 3], exposure_ev: f32) -> [u8; 3] {
        if let Some(ColouredDifference { kind, range }) = self.difference {
            let mean = rgb.iter().sum::<f32>() / 3.0;
            if mean.is_nan() {
                return MID_GRAY;
            }
            let range = range.unwrap_or_else(|| kind.default_range());
            return difference_to_display(mean, range as f32, kind.is_signed());
        }
        let byte = |x: f32| (x.clamp(0.0, 1.0) * 255.0 + 0.5).floor() as u8;
        match self.quantity {
            Quantity::Rendering => to_display(rgb, exposure_ev),
            Quantity::Diffuse | Quantity::Specular => to_display(rgb, 0.0),
            Quantity::Normal => rgb.map(|n| byte((n + 1.0) / 2.0)),
            Quantity::Roughness => rgb.map(byte),
        }
    }

    /// What the numbers of a picture are, for its metadata.
    pub fn text(&self, epsilon: f64) -> String {
        let Some(ColouredDifference { kind, range }) = self.difference else {
            return match self.quantity {
                Quantity::Rendering => "radiance".to_owned(),
                quantity => quantity.name().to_owned(),
            };
        };
        let range = range.map(|range| format!(", {range} the last colour")).unwrap_or_default();
        let (p, g) = (format!("(prediction + {epsilon})"), format!("(ground truth + {epsilon})"));
        let formula = match kind {
            Difference::Log => format!("|ln{p} - ln{g}|"),
            Difference::SignedLog => format!("ln{p} - ln{g}"),
            Difference::Absolute => "|prediction - ground truth|".to_owned(),
            Difference::Signed => "prediction - ground truth".to_owned(),
            Difference::Relative => format!("|prediction - ground truth| / {g}"),
            Difference::Angle => "angle in degrees".to_owned(),
            Difference::Flip => "of exposed and clipped sRGB, 67 pixels per degree".to_owned(),
        };
        format!("{} of {}: {formula}{range}", kind.name(), self.quantity.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(value: f32) -> Image<f32> {
        Image { width: 2, height: 1, pixels: vec![[value; 3], [2.0 * value; 3]] }
    }

    fn difference(range: Option<f64>) -> PictureContent {
        let difference = Some(ColouredDifference { kind: Difference::Absolute, range });
        PictureContent { quantity: Quantity::Rendering, difference }
    }

    #[test]
    fn exposure_changes_renderings_and_nothing_else() {
        let rgb = [0.2, 0.3, 0.4];
        let value = |quantity| PictureContent { quantity, difference: None };
        assert_ne!(value(Quantity::Rendering).colour(rgb, 1.0), value(Quantity::Rendering).colour(rgb, 0.0));
        for content in Quantity::ALL[1..].iter().map(|q| value(*q)).chain([difference(Some(1.0))]) {
            assert_eq!(content.colour(rgb, 1.0), content.colour(rgb, 0.0), "{content:?}");
        }
    }

    #[test]
    fn differences_are_those_of_the_predictions_and_share_a_range() {
        let convention = Convention::default();
        let values = vec![image(1.0), image(1.5), image(0.75)];
        let pictures = difference(None).of_values(values.clone(), &convention, 0.0);
        assert_eq!(pictures.images, [image(0.5), image(0.25)]);
        // Interpolated between the two largest of the differences 0.5 and 1.
        assert_eq!(pictures.content.difference.and_then(|d| d.range), Some(0.995));
        let set = difference(Some(0.3)).of_values(values, &convention, 0.0);
        assert_eq!(set.content.difference.and_then(|d| d.range), Some(0.3));
    }

    #[test]
    fn normals_and_roughness_are_displayed_as_they_are_stored() {
        let value = |quantity| PictureContent { quantity, difference: None };
        assert_eq!(value(Quantity::Normal).colour([0.0, -1.0, 1.0], 3.0), [128, 0, 255]);
        assert_eq!(value(Quantity::Roughness).colour([0.5; 3], 3.0), [128; 3]);
        assert_eq!(value(Quantity::Diffuse).colour([0.214_041_14; 3], 3.0), [128; 3]);
    }
}
