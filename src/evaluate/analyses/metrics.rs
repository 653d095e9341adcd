//! Metrics of predictions beside their losses.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize, Serializer};

use crate::error::Error;
use crate::metrics::{Kept, Metric, MetricSelection, RenderedScenes, of_masked_maps, of_renderings};
use crate::report::{
    Analysis, AnalysisInput, AnalysisOption, Cell, Compared, OptionValue, Reader, Report, Table, scenes_line,
};
use svbrdf_core::loss::Sampling;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::progress::Progress;

/// Metrics of maps and renderings, each with its convention in its name: docs/metrics.md defines them.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MetricsReport {
    ground_truth: String,
    /// The convention of the renderings.
    convention: &'static str,
    /// The exposure of the renderings in stops.
    exposure_ev: f32,
    /// The lines above the text's table.
    #[serde(skip)]
    heading: String,
    /// One per prediction.
    results: Vec<Metrics>,
}

/// The metrics of one prediction.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct Metrics {
    prediction: String,
    /// By name; `None` for the infinite PSNR of equal maps or renderings.
    #[serde(serialize_with = "by_name")]
    #[cfg_attr(feature = "schema", schemars(with = "BTreeMap<String, Option<f64>>"))]
    metrics: Vec<Metric>,
    /// The 95% intervals of means over sampled scenes by name, where they are known.
    intervals95: BTreeMap<&'static str, [f64; 2]>,
}

impl MetricsReport {
    /// The metrics of maps and of renderings in `rendered`, which are of `sampling` unless they were listed. `results` are the name and
    /// the metrics of each prediction.
    fn new(
        compared: &Compared,
        sampling: Option<&Sampling>,
        rendered: &RenderedScenes<'_>,
        results: Vec<(String, Vec<Metric>)>,
    ) -> Self {
        let mut metrics = results.iter().flat_map(|(_, metrics)| metrics);
        let renderings = match metrics.any(|metric| metric.name.contains("_rendering_")) {
            true => {
                let scenes = scenes_line(sampling, rendered.scenes, compared.size);
                format!("{scenes}renderings at {} EV, clipped to [0, 1]\n", rendered.exposure_ev)
            }
            false => String::new(),
        };
        let entry = |(prediction, metrics): (String, Vec<Metric>)| {
            let known = metrics.iter().filter_map(|metric| Some((metric.name, metric.interval95?)));
            Metrics { prediction, intervals95: known.collect(), metrics }
        };
        Self {
            ground_truth: compared.ground_truth.clone(),
            convention: compared.convention,
            exposure_ev: rendered.exposure_ev,
            heading: compared.heading("metrics") + &renderings,
            results: results.into_iter().map(entry).collect(),
        }
    }
}

impl Report for MetricsReport {
    fn heading(&self) -> String {
        self.heading.clone()
    }

    /// A row for each metric; for each prediction its value, and for means over scenes their interval.
    fn table(&self, reader: Reader) -> Table {
        let names = self.results.first().map(|first| first.metrics.as_slice()).unwrap_or_default();
        let mut table = Table::new(["metric"], names.iter().map(|metric| vec![metric.name.into()]));
        for Metrics { prediction, metrics, .. } in &self.results {
            table.push(prediction.clone(), metrics.iter().map(|metric| metric.value.into()));
            let intervals = || metrics.iter().map(|metric| metric.interval95);
            match reader {
                Reader::Person => table.push("95%".to_owned(), intervals().map(Cell::from)),
                Reader::Program => {
                    table.push(format!("{prediction} interval95_low"), intervals().map(Cell::low));
                    table.push(format!("{prediction} interval95_high"), intervals().map(Cell::high));
                }
            }
        }
        table
    }
}

fn by_name<S: Serializer>(metrics: &[Metric], serializer: S) -> Result<S::Ok, S::Error> {
    let by_name: BTreeMap<_, _> = metrics.iter().map(|metric| (metric.name, metric.value)).collect();
    by_name.serialize(serializer)
}

/// The options of the metrics.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub struct MetricsOptions {
    exposure: f32,
    metrics: MetricSelection,
}

impl Analysis for MetricsReport {
    const NAME: &'static str = "metrics";
    const ANSWERS: &'static str = "RMSE, L1, angles, PSNR, SSIM and FLIP";
    const GROUP: &'static str = "Compare";
    const EXAMPLES: &'static [&'static str] =
        &["gt.png a.png b.png --format csv", "gt.png a.png --metrics psnr,ssim11"];
    const TITLE: &'static str = "Other metrics";
    const ABOUT: &'static str = "Prints metrics of maps and renderings, each with its convention in its name";
    const DETAILS: &'static str = "Root mean square and mean absolute differences, PSNR and SSIM of the four maps and of renderings, \
        the same of base colour and metallic, angles between normals, and FLIP of renderings. docs/metrics.md defines each.";
    const DOING: &'static str = "rendering";
    const PAIRED: bool = true;
    const EXAMPLE: &'static str = "\
        >>> import svbrdf
        >>> ground_truth, blurred, _ = svbrdf.built_in()
        >>> report = svbrdf.metrics(ground_truth, blurred, near=2, distant=1)
        >>> report.results[0].metrics[\"rmse_roughness\"]
        0.0";
    const SCENES: &'static [&'static str] = &["near", "distant", "sampler", "seed", "scenes"];
    type Options = MetricsOptions;
    const OPTIONS: &'static [AnalysisOption] = &[
        AnalysisOption {
            name: "metrics",
            about: "Metrics to compute, by words of their names: psnr, roughness, flip, ... [default: all]",
            value: OptionValue::Words(MetricSelection::words),
        },
        AnalysisOption {
            name: "exposure",
            about: "Exposure of renderings in stops, before they are clipped",
            value: OptionValue::Stops(0.0),
        },
    ];

    fn run(input: &AnalysisInput<'_>, options: &MetricsOptions, progress: &Progress) -> Result<Self, Error> {
        let AnalysisInput { ground_truth, convention, request, .. } = input;
        let (scenes, sampling) = (request.scenes(convention)?.unwrap_or_default(), request.sampling());
        let rendered = RenderedScenes {
            scenes: &scenes,
            sampler: sampling.map_or(Sampler::Random, |sampling| sampling.sampler),
            convention,
            exposure_ev: options.exposure,
        };
        let results = input.each(|prediction| {
            let mut metrics = Vec::new();
            if options.metrics.has_maps() {
                let kept = input.mask.as_ref().map(|mask| Kept { texels: mask.kept(), count_all: false });
                metrics.extend(of_masked_maps(ground_truth, prediction, kept)?);
            }
            if options.metrics.has_renderings() && input.mask.is_none() {
                metrics.extend(of_renderings(ground_truth, prediction, &rendered, progress)?);
            }
            metrics.retain(|metric| options.metrics.has(metric.name));
            Ok((prediction.name().to_owned(), metrics))
        })?;
        Ok(Self::new(&input.compared(), sampling.as_ref(), &rendered, results))
    }
}
