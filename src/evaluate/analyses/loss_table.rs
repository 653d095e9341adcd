//! The loss as an analysis: its words, its rows, one per prediction, its text, and what it misses.

use super::loss::{FewScenes, LossDifference, LossReport, PredictionLoss};
use crate::error::Error;
use crate::report::{
    Analysis, AnalysisInput, Cell, Compared, Field, NoOptions, Reader, Report, Table, in_mask, missed_by_any,
    scenes_line, stored_normals_note,
};
use svbrdf_core::loss::Compute;
use svbrdf_core::progress::Progress;

fn fields<'a>() -> [Field<(&'a LossReport, &'a PredictionLoss)>; 22] {
    [
        ("prediction", "prediction", |(_, result)| result.prediction.as_str().into()),
        ("loss", "loss", |(_, result)| result.loss.into()),
        ("standard_error", "+- std. error", |(_, result)| Cell::or(result.standard_error, "unknown")),
        ("interval95_low interval95_high", "95% interval", |(_, result)| {
            Cell::or(result.interval95, "unknown")
        }),
        ("convention", "", |(report, _)| report.convention.into()),
        ("epsilon", "", |(report, _)| report.epsilon.into()),
        ("width", "", |(report, _)| report.size[0].into()),
        ("height", "", |(report, _)| report.size[1].into()),
        ("near", "", |(report, _)| report.sampled.near.into()),
        ("distant", "", |(report, _)| report.sampled.distant.into()),
        ("seed", "", |(report, _)| report.sampled.seed.into()),
        ("sampler", "", |(report, _)| report.sampled.sampler.map(|sampler| sampler.to_string()).into()),
        ("texels", "", |(report, _)| report.sampled.texels.map_or("all".into(), Cell::from)),
        ("precision", "", |(report, _)| report.precision.into()),
        ("target_error", "", |(report, _)| report.target_error.into()),
        ("target_reached", "", |(report, _)| report.target_reached.into()),
        ("path", "", |(_, result)| result.path.clone().into()),
        ("ground_truth", "", |(report, _)| report.ground_truth.as_str().into()),
        ("ground_truth_path", "", |(report, _)| report.ground_truth_path.clone().into()),
        ("interval95_from", "", |(report, _)| report.interval95_from.to_string().into()),
        ("few_scenes_loss", "", |(_, result)| {
            result.few_scenes.as_ref().map(|few| few.few_scenes_loss).into()
        }),
        ("few_scenes_low few_scenes_high", "", |(_, result)| few_scenes(result).into()),
    ]
}

/// The interval of the loss over few scenes.
fn few_scenes(result: &PredictionLoss) -> Option<[f64; 2]> {
    result.few_scenes.as_ref()?.few_scenes_interval95
}

impl LossReport {
    /// The losses over few scenes: a line per prediction.
    fn few_scenes_lines(&self, FewScenes { sampled, .. }: &FewScenes) -> String {
        let line = |result: &PredictionLoss| {
            let few = result.few_scenes.as_ref()?;
            let interval = few
                .few_scenes_interval95
                .map_or("unknown".to_owned(), |[low, high]| format!("{low:.3} to {high:.3}"));
            Some(format!(
                "{} + {} scenes: {:.3} (95% {interval}), {}\n",
                sampled.near, sampled.distant, few.few_scenes_loss, result.prediction
            ))
        };
        format!("\n{}", self.results.iter().filter_map(line).collect::<String>())
    }

    /// Paired differences: variance that the scenes have in common cancels, so the errors of the losses do not add up.
    fn difference_lines(&self) -> String {
        let line = |difference: &LossDifference| {
            let [mean, error, interval] = difference.estimate().texts();
            let LossDifference { prediction, to, .. } = difference;
            format!("\n{prediction} - {to}, same scenes: {mean} +- {error}, 95% {interval}")
        };
        let text: String = self.differences.iter().map(line).collect();
        if text.is_empty() { text } else { text + "\n" }
    }
}

impl Report for LossReport {
    fn heading(&self) -> String {
        let Self { convention, epsilon, ground_truth, size, precision, outcome, .. } = self;
        let [width, height] = size;
        let masked = in_mask(self.masked);
        format!(
            "rendering loss against {ground_truth}, {width} x {height} texels{masked}, {precision}\n\
             convention {convention}, epsilon {epsilon}\n{}",
            scenes_line(outcome.sampling.as_ref(), &outcome.scenes, *size)
        )
    }

    /// The table of the losses, then the difference of each further loss from the first, then a line per prediction for the few
    /// scenes of the papers.
    fn text(&self) -> String {
        let table = self.table(Reader::Person).text();
        let few_scenes = self.few_scenes.as_ref().map(|few| self.few_scenes_lines(few)).unwrap_or_default();
        format!("{}\n{table}{}{few_scenes}", self.heading(), self.difference_lines())
    }

    /// A row per prediction.
    fn table(&self, reader: Reader) -> Table {
        Table::fields(&fields(), self.results.iter().map(|result| (self, result)), reader)
    }

    fn missed(&self) -> Vec<String> {
        let losses = self.results.iter().map(|result| (result.prediction.as_str(), result.estimate()));
        let missed = |target| missed_by_any(target, losses, self.outcome.scenes.len());
        self.target_error.and_then(missed).into_iter().collect()
    }
}

impl Analysis for LossReport {
    const NAME: &'static str = "loss";
    const ANSWERS: &'static str = "which prediction is better, and by how much";
    const GROUP: &'static str = "Compare";
    const EXAMPLES: &'static [&'static str] = &[
        "gt.png a.png b.png",
        "gt.png a.png --near 6 --distant 3 --seed 1",
        "gt.png 'out/*.png' --format csv",
    ];
    const ABOUT: &'static str = "Prints the rendering loss of predictions against a ground truth";
    const DETAILS: &'static str = "Ground truth and predictions are rendered in the same sampled scenes (light and view). The loss is the \
        mean over scenes, texels and RGB of |ln(R_gt + epsilon) - ln(R_pred + epsilon)|. The standard error is due to the sampling of \
        scenes and texels; it is unknown with a single scene of a kind. Without a number of scenes: the loss over all scenes to +-1%, and \
        the loss over the 6 + 3 scenes of the papers. With --near or --distant: the loss over exactly these scenes. docs/loss.md defines \
        the loss.";
    const EXAMPLE: &'static str = "\
        >>> import svbrdf
        >>> ground_truth, *predictions = svbrdf.built_in()
        >>> report = svbrdf.loss(ground_truth, predictions)
        >>> [f\"{result.loss:.3f}, over few scenes {result.few_scenes_loss:.3f}\" for result in report.results]
        ['0.322, over few scenes 0.371', '0.205, over few scenes 0.220']
        >>> few = svbrdf.loss(ground_truth, predictions, near=6, distant=3, seed=1)
        >>> [f\"{result.loss:.4f}\" for result in few.results]
        ['0.2900', '0.1994']";
    const DOING: &'static str = "rendering";
    const PAIRED: bool = true;
    const SCENES: &'static [&'static str] = &[
        "near",
        "distant",
        "sampler",
        "seed",
        "scenes",
        "texels",
        "target_error",
        "time_budget",
        "precision",
    ];
    const SCENES_HELP: &'static [(&'static str, &'static str)] = &[
        (
            "near",
            "Number of near-field scenes, random and on all texels [default: as many as +-1% needs; with --distant two for each distant one]",
        ),
        (
            "distant",
            "Number of distant scenes [default: as many as +-1% needs; with --near one for two near-field ones]",
        ),
        ("seed", "Seed of the sampled scenes [default: 0, or as in the session]"),
        (
            "sampler",
            "Sampler of scenes: random, or sobol, which gives less error with as many scenes [default: sobol; with --near or --distant random]",
        ),
        ("target_error", "Samples as many scenes as this relative error needs at 95% confidence, such as 1%"),
    ];
    type Options = NoOptions;

    fn run(input: &AnalysisInput<'_>, _: &NoOptions, progress: &Progress) -> Result<Self, Error> {
        Self::of(input, progress)
    }

    fn run_double(input: &AnalysisInput<'_, f64>, _: &NoOptions, progress: &Progress) -> Result<Self, Error> {
        Self::of(input, progress)
    }
}

impl LossReport {
    fn of<T: Compute>(input: &AnalysisInput<'_, T>, progress: &Progress) -> Result<Self, Error> {
        let AnalysisInput { request, few_scenes, paths, storages, convention, .. } = input;
        let mut report =
            input.comparing(|comparison| Ok(Self::answer(&comparison, request, *few_scenes, progress)?))?;
        let Compared { size, masked, .. } = input.compared();
        (report.size, report.masked) = (size, masked);
        report.note = stored_normals_note(convention, storages.iter().copied());
        Ok(report.read_from(paths))
    }
}
