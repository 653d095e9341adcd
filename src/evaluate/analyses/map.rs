//! The loss over texels, or over directions of the light or the view, as an analysis.

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::report::{Analysis, AnalysisInput, AnalysisOption, Compared, OptionValue, position};
use crate::why::{self, Hemisphere};
use svbrdf_core::error::Error as CoreError;
use svbrdf_core::image::{Image, mean_of_channels};
use svbrdf_core::loss::{Comparison, LossOptions};
use svbrdf_core::model::scene::Endpoint;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;

/// The loss over texels, or over the directions of the light or the view.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MapReport {
    #[serde(flatten)]
    pub(super) compared: Compared,
    /// The meaning of the numbers.
    pub(super) shows: String,
    /// One per prediction.
    pub(super) results: Vec<MapSummary>,
    /// The loss of each texel and channel, or of each direction in all channels: one image per prediction.
    #[serde(skip)]
    pub(super) images: Vec<Image<f32>>,
    /// The map over directions and what moves; `None` for a map over texels.
    #[serde(skip)]
    pub(super) directions: Option<(Endpoint, Hemisphere)>,
}

/// The map of a prediction in a few numbers.
#[derive(Clone, Debug, Default, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(super) struct MapSummary {
    pub prediction: String,
    /// The loss.
    pub mean: f64,
    pub largest: f64,
    /// Where a map over texels is largest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub column: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub row: Option<usize>,
    /// The root mean square of the standard errors of a map over directions.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub standard_error: Option<f64>,
    /// Where a map over directions is largest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction: Option<[f64; 3]>,
}

impl MapReport {
    /// The mean over `scenes` of the log difference of each texel, or what else the norm takes the mean of.
    ///
    /// # Errors
    /// As [`why::error_maps`].
    fn over_texels(
        comparison: &Comparison<'_, f32>,
        scenes: &[Scene],
        progress: &Progress,
    ) -> Result<Self, CoreError> {
        let images = why::error_maps(comparison, scenes, progress)?;
        let entry = |(name, image): (String, &Image<f32>)| {
            let all = image.pixels.iter().map(mean_of_channels).enumerate();
            let (at, largest) = all.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default();
            let (column, row) = (Some(at % image.width), Some(at / image.width));
            let (mean, largest) = (why::mean(image), f64::from(largest));
            MapSummary { prediction: name, mean, largest, column, row, ..MapSummary::default() }
        };
        Ok(Self {
            compared: Compared::new(comparison.ground_truth(), comparison.convention()),
            shows: format!(
                "mean {} of each texel over {} scenes",
                comparison.convention().norm().of_term(),
                scenes.len()
            ),
            results: names(comparison).zip(&images).map(entry).collect(),
            images,
            directions: None,
        })
    }

    /// The loss in distant scenes over the directions of what is `moved`, on a grid of `side` columns; `fixed` is the direction of
    /// the other.
    ///
    /// # Errors
    /// As [`why::hemisphere`].
    fn over_directions(
        comparison: &Comparison<'_, f32>,
        moved: Endpoint,
        fixed: [f64; 3],
        side: usize,
        progress: &Progress,
    ) -> Result<Self, CoreError> {
        let map = why::hemisphere(comparison, moved, fixed, side, progress)?;
        let entry = |(index, name): (usize, String)| {
            let (direction, largest) = map.worst(index)?;
            let (standard_error, direction) = (Some(map.standard_error(index)), Some(direction));
            let mean = map.mean(index);
            let found = MapSummary { prediction: name, mean, largest, ..MapSummary::default() };
            Some(MapSummary { standard_error, direction, ..found })
        };
        let image = |losses: &Vec<f64>| Image {
            width: side,
            height: side,
            pixels: losses.iter().map(|&loss| [loss as f32; 3]).collect(),
        };
        let [what, other] = roles(moved);
        Ok(Self {
            compared: Compared::new(comparison.ground_truth(), comparison.convention()),
            shows: format!("loss over distant {what} directions, {other} {}", position(fixed)),
            results: names(comparison).enumerate().filter_map(entry).collect(),
            images: map.losses.iter().map(image).collect(),
            directions: Some((moved, map)),
        })
    }
}

fn names(comparison: &Comparison<'_, f32>) -> impl Iterator<Item = String> {
    comparison.predictions().iter().map(|prediction| prediction.name().to_owned())
}

/// What moves, and what is fixed.
pub(super) fn roles(moved: Endpoint) -> [&'static str; 2] {
    match moved {
        Endpoint::Light => ["light", "view"],
        Endpoint::View => ["view", "light"],
    }
}

svbrdf_core::choices! {
    /// What a map is over.
    #[derive(Default)]
    Over, "axes of a map":
    #[default]
    Texels = "texels",
    Lights = "lights",
    Views = "views",
}

/// The options of a map.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(default)]
pub struct MapOptions {
    over: Over,
    fixed: [f64; 3],
    side: usize,
}

impl Default for MapOptions {
    fn default() -> Self {
        Self { over: Over::Texels, fixed: [0.0, 0.0, 1.0], side: 64 }
    }
}

impl Analysis for MapReport {
    const NAME: &'static str = "map";
    const ANSWERS: &'static str = "where on the material, or from where, the loss comes";
    const EXAMPLES: &'static [&'static str] =
        &["gt.png a.png -o error.png", "gt.png a.png --over lights -o lights.png"];
    const ABOUT: &'static str = "Writes the loss over texels, light directions or view directions to a file";
    const DETAILS: &'static str = "Over texels: the mean log difference of each texel over all scenes, whose mean is the loss. Over lights or \
        views: the loss in distant scenes over the directions that Algorithm 2 samples, seen from above (x to the right, y up), with a \
        standard error. Predictions stand side by side.";
    const EXAMPLE: &'static str = "\
        >>> import svbrdf
        >>> ground_truth, blurred, _ = svbrdf.built_in()
        >>> svbrdf.map(ground_truth, blurred, near=4, distant=2).maps[0].shape
        (256, 256, 3)
        >>> svbrdf.map(ground_truth, blurred, over=\"lights\", side=16).maps[0].shape
        (16, 16)";
    const DOING: &'static str = "rendering";
    const SCENES: &'static [&'static str] = &["near", "distant", "sampler", "seed", "scenes"];
    const PICTURES: bool = true;
    type Options = MapOptions;
    const OPTIONS: &'static [AnalysisOption] = &[
        AnalysisOption {
            name: "over",
            about: "What the map is over",
            value: OptionValue::Choice(&[
                ["texels", "The texels of the material"],
                ["lights", "The directions of the light, with a fixed view"],
                ["views", "The directions of the view, with a fixed light"],
            ]),
        },
        AnalysisOption {
            name: "fixed",
            about: "Direction of the view of a map over lights, or of the light of a map over views",
            value: OptionValue::Direction([0.0, 0.0, 1.0]),
        },
        AnalysisOption {
            name: "side",
            about: "Columns and rows of a map over lights or views",
            value: OptionValue::Count(64, [1, 1024]),
        },
    ];

    fn check(options: &MapOptions, scenes: &LossOptions) -> Result<(), Error> {
        let usual = MapOptions::default();
        let reason = match options.over {
            Over::Texels => "a map over texels has no fixed direction and the size of its material",
            Over::Lights | Over::Views => "a map over directions samples no scenes",
        };
        let unused = match options.over {
            Over::Texels if options.fixed != usual.fixed => Some("fixed"),
            Over::Texels => (options.side != usual.side).then_some("side"),
            Over::Lights | Over::Views => scenes.specified().next(),
        };
        unused.map_or(Ok(()), |option| Err(CoreError::UnusedOption { option, reason }.into()))
    }

    fn run(input: &AnalysisInput<'_>, options: &MapOptions, progress: &Progress) -> Result<Self, Error> {
        let AnalysisInput { ground_truth, predictions, convention, question, .. } = input;
        let comparison = Comparison::new(*ground_truth, predictions, *convention)?.without_pilot();
        let over = |moved| Self::over_directions(&comparison, moved, options.fixed, options.side, progress);
        Ok(match options.over {
            Over::Texels => {
                let scenes = question.request.scenes(convention)?.unwrap_or_default();
                Self::over_texels(&comparison, &scenes, progress)
            }
            Over::Lights => over(Endpoint::Light),
            Over::Views => over(Endpoint::View),
        }?)
    }
}
