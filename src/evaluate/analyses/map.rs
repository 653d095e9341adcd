//! The loss of each texel as an analysis.

use serde::Serialize;

use crate::error::Error;
use crate::report::{Analysis, AnalysisInput, Cell, Compared, Field, NoOptions, Reader, Report, Table};
use crate::why;
use svbrdf_core::image::{Image, mean_of_channels};
use svbrdf_core::loss::Comparison;
use svbrdf_core::material::Mask;
use svbrdf_core::progress::Progress;

/// The values of the texels of a mask where these are; NaN elsewhere.
fn spread(image: &Image<f32>, mask: &Mask) -> Image<f32> {
    let [width, height] = mask.size();
    let mut pixels = vec![[f32::NAN; 3]; width * height];
    mask.texels().into_iter().zip(&image.pixels).for_each(|(texel, value)| pixels[texel] = *value);
    Image { width, height, pixels }
}

/// The loss over texels.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MapReport {
    #[serde(flatten)]
    compared: Compared,
    /// The meaning of the numbers.
    shows: String,
    /// One per prediction.
    results: Vec<MapSummary>,
    /// The loss of each texel and channel: one image per prediction; NaN outside of a mask.
    #[serde(skip)]
    images: Vec<Image<f32>>,
}

/// The map of a prediction in a few numbers.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct MapSummary {
    prediction: String,
    /// The loss.
    mean: f64,
    largest: f64,
    /// Where it is largest.
    column: usize,
    row: usize,
}

impl MapSummary {
    fn of(prediction: String, mean: f64, image: &Image<f32>) -> Self {
        let all = image.pixels.iter().map(mean_of_channels).enumerate().filter(|(_, loss)| !loss.is_nan());
        let (at, largest) = all.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default();
        let (column, row) = (at % image.width, at / image.width);
        Self { prediction, mean, largest: largest.into(), column, row }
    }
}

impl Analysis for MapReport {
    const NAME: &'static str = "map";
    const ANSWERS: &'static str = "where on the material the loss comes";
    const EXAMPLES: &'static [&'static str] = &["gt.png a.png -o error.png"];
    const ABOUT: &'static str = "Writes the loss over texels to a file";
    const DETAILS: &'static str = "The mean log difference of each texel over all scenes, whose mean is the loss. Predictions stand side by side.";
    const EXAMPLE: &'static str = "\
        >>> import svbrdf
        >>> ground_truth, blurred, _ = svbrdf.built_in()
        >>> svbrdf.map(ground_truth, blurred, near=4, distant=2).maps[0].shape
        (256, 256, 3)";
    const DOING: &'static str = "rendering";
    const SCENES: &'static [&'static str] = &["near", "distant", "sampler", "seed", "scenes"];
    const PICTURES: bool = true;
    const PAIRED: bool = true;
    type Options = NoOptions;

    fn run(input: &AnalysisInput<'_>, _: &NoOptions, progress: &Progress) -> Result<Self, Error> {
        let AnalysisInput { predictions, convention, request, mask, .. } = input;
        let scenes = request.scenes(convention)?.unwrap_or_default();
        let maps = |comparison: Comparison<'_, f32>| {
            Ok(why::error_maps(&comparison.without_pilot(), &scenes, progress)?)
        };
        let mut images = input.comparing(maps)?;
        let means: Vec<f64> = images.iter().map(why::mean).collect();
        if let Some(mask) = mask {
            images.iter_mut().for_each(|image| *image = spread(image, mask));
        }
        let names = predictions.iter().map(|prediction| prediction.name().to_owned());
        Ok(Self {
            compared: input.compared(),
            shows: format!("mean {} of each texel over {} scenes", convention.norm().of_term(), scenes.len()),
            results: names
                .zip(means)
                .zip(&images)
                .map(|((name, mean), image)| MapSummary::of(name, mean, image))
                .collect(),
            images,
        })
    }
}

/// A prediction, the column and row of a texel, and its loss in each channel.
type TexelRow<'a> = (&'a str, [usize; 2], [f32; 3]);

impl Report for MapReport {
    fn heading(&self) -> String {
        self.compared.heading(&self.shows)
    }

    fn pictures(&self) -> Option<(&[Image<f32>], &str)> {
        Some((&self.images, &self.shows))
    }

    /// For programs a row for each texel of each prediction; for people a summary of each prediction.
    fn table(&self, reader: Reader) -> Table {
        if reader == Reader::Person {
            let fields: [Field<MapSummary>; 5] = [
                ("", "prediction", |summary| summary.prediction.as_str().into()),
                ("", "mean", |summary| summary.mean.into()),
                ("", "largest", |summary| summary.largest.into()),
                ("", "column", |summary| summary.column.into()),
                ("", "row", |summary| summary.row.into()),
            ];
            return Table::fields(&fields, &self.results, reader);
        }
        let fields: [Field<TexelRow<'_>>; 6] = [
            ("prediction", "", |(prediction, ..)| (*prediction).into()),
            ("column", "", |(_, [column, _], _)| (*column).into()),
            ("row", "", |(_, [_, row], _)| (*row).into()),
            ("red", "", |(.., [red, _, _])| Cell::Single(*red)),
            ("green", "", |(.., [_, green, _])| Cell::Single(*green)),
            ("blue", "", |(.., [_, _, blue])| Cell::Single(*blue)),
        ];
        let rows = self.results.iter().zip(&self.images).flat_map(|(summary, image)| {
            let all = image.pixels.iter().enumerate().filter(|(_, pixel)| !pixel[0].is_nan());
            all.map(|(at, pixel)| (summary.prediction.as_str(), [at % image.width, at / image.width], *pixel))
        });
        Table::fields(&fields, rows, reader)
    }
}
