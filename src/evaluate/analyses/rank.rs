//! A ranking of predictions of one ground truth.

use serde::Serialize;

use crate::diagnose::floor;
use crate::error::Error;
use crate::rank::{self, RankedPrediction, places};
use crate::report::{
    Analysis, AnalysisInput, Cell, Compared, Field, NoOptions, Reader, Repetition, Report, Table, bold,
    comments, digits, escaped, float, floor_line, interval, latex, missed_by_any, number, scenes_line,
    sentences,
};
use svbrdf_core::loss::{Estimate, Outcome, Request};
use svbrdf_core::progress::Progress;

/// The place of a prediction from 0, the prediction, and the requested accuracy.
type Row<'a> = (usize, &'a RankedPrediction, Option<f64>);

fn fields<'a>() -> [Field<Row<'a>>; 12] {
    [
        ("place", "", |(index, ..)| (index + 1).into()),
        ("prediction", "prediction", |(_, place, _)| place.prediction.as_str().into()),
        ("loss", "loss", |(_, place, _)| place.loss.mean.into()),
        ("standard_error", "", |(_, place, _)| place.loss.standard_error.into()),
        ("interval95_low interval95_high", "95% interval", |(_, place, _)| {
            Cell::or(place.loss.interval95, "unknown")
        }),
        ("to_best", "- best", |(_, place, _)| place.to_best.map(|estimate| estimate.mean).into()),
        ("to_best_low to_best_high", "95% interval", |(_, place, _)| {
            place.to_best.map_or(Cell::Missing(""), |estimate| Cell::or(estimate.interval95, "unknown"))
        }),
        ("group", "group", |(_, place, _)| place.group.into()),
        ("target_reached", "", |(_, place, target)| {
            target.map(|target| place.loss.relative_error95() <= target).into()
        }),
        ("resolvable", "", |(_, place, _)| place.resolvable.into()),
        ("to_best_resolvable", "", |(_, place, _)| place.to_best_resolvable.into()),
        ("", "not resolvable", |(_, place, _)| unresolvable(place).into()),
    ]
}

/// Predictions of one ground truth, smallest loss first, with what the data can separate.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RankReport {
    #[serde(flatten)]
    compared: Compared,
    /// The number of scenes.
    scenes: usize,
    seed: Option<u64>,
    /// The requested accuracy of every loss: half of its 95% interval, as a share of it; `None` for given scenes.
    target_error: Option<f64>,
    /// By every prediction.
    target_reached: Option<bool>,
    /// The loss that the ground truth cannot resolve; `None`: the depth of its files is not known here.
    floor: Option<f64>,
    /// How to repeat it; `None` for materials that no command names.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub repetition: Option<Repetition>,
    /// For each material, the ground truth first, what was noticed and assumed in reading it; `None` for materials of no files.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub readings: Vec<MaterialReading>,
    /// Best first.
    pub ranking: Vec<RankedPrediction>,
    /// The lines about the ground truth and the scenes.
    #[serde(skip)]
    heading: String,
}

/// How a material was read.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MaterialReading {
    pub material: String,
    pub remarks: Vec<String>,
}

impl RankReport {
    /// The ranking of the predictions of the `outcome` of `request`.
    fn new(compared: Compared, request: &Request, outcome: &Outcome) -> Self {
        let target_error = request.target();
        let heading = compared.heading("rendering loss")
            + &scenes_line(outcome.sampling.as_ref(), &outcome.scenes, compared.size)
            + &target_error.map_or_else(String::new, |_| most_scenes(outcome));
        Self {
            compared,
            scenes: outcome.scenes.len(),
            seed: outcome.sampling.map(|sampling| sampling.seed),
            target_error,
            target_reached: target_error.map(|target| outcome.relative_error95() <= target),
            floor: None,
            repetition: None,
            readings: Vec::new(),
            ranking: places(outcome),
            heading,
        }
    }

    /// The same report with the loss that the ground truth cannot resolve.
    fn with_floor(mut self, floor: &Estimate) -> Self {
        let is_above = |value: f64| value > floor.mean;
        for place in &mut self.ranking {
            place.resolvable = Some(is_above(place.loss.mean));
            place.to_best_resolvable = place.to_best.map(|difference| is_above(difference.mean.abs()));
        }
        self.heading += &floor_line(floor);
        Self { floor: Some(floor.mean), ..self }
    }

    fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        self.ranking.iter().enumerate().map(|(index, place)| (index, place, self.target_error))
    }

    /// A table for a paper: the first group in bold.
    pub fn latex(&self) -> String {
        let row = |place: &RankedPrediction| {
            let digits_of = |of: &Estimate| digits(of.mean, of.interval95);
            let ends =
                |of: &Estimate| of.interval95.map_or("--".to_owned(), |known| interval(known, digits_of(of)));
            let mean = |of: &Estimate| number(of.mean, digits_of(of));
            let loss = bold(&mean(&place.loss), place.group == 1);
            let to_best = place
                .to_best
                .map_or("--".to_owned(), |to_best| format!("{} {}", mean(&to_best), ends(&to_best)));
            format!("{} & {loss} & {} & {to_best} \\\\\n", escaped(&place.prediction), ends(&place.loss))
        };
        let rows: String = self.ranking.iter().map(row).collect();
        let heading = "Prediction & Loss $\\downarrow$ & 95\\% interval & Difference to best";
        let caption = sentences(&self.heading)
            + "Intervals over scenes, 95%; bold: the best and what cannot be told from it.";
        comments(self.repetition.iter().map(Repetition::to_string))
            + &float(&escaped(&caption), &latex("lrll", heading, &rows))
    }
}

/// A line about the prediction that needed the most scenes, where there are others: all are compared in as many.
fn most_scenes(outcome: &Outcome) -> String {
    let error = |loss: &Estimate| loss.relative_error95();
    let most = outcome.losses.iter().max_by(|a, b| error(&a.estimate).total_cmp(&error(&b.estimate)));
    match most.filter(|_| outcome.losses.len() > 1) {
        Some(most) => format!("as many scenes for all as {} needs\n", most.prediction),
        None => String::new(),
    }
}

/// What is not resolvable: "loss", "difference" or both; empty where both are.
fn unresolvable(place: &RankedPrediction) -> String {
    let parts = [(place.resolvable, "loss"), (place.to_best_resolvable, "difference")];
    let not = parts.into_iter().filter(|(is, _)| *is == Some(false));
    not.map(|(_, name)| name).collect::<Vec<_>>().join(", ")
}

impl Report for RankReport {
    fn heading(&self) -> String {
        self.heading.clone()
    }

    /// With the command that repeats it below the table.
    fn text(&self) -> String {
        let repetition = self.repetition.as_ref().map(|repetition| format!("\n{repetition}\n"));
        let table = self.table(Reader::Person).text();
        format!("{}\n{table}{}", self.heading, repetition.unwrap_or_default())
    }

    fn table(&self, reader: Reader) -> Table {
        let all_resolvable = self.ranking.iter().all(|place| unresolvable(place).is_empty());
        let fields = fields();
        let fields = &fields[..fields.len() - usize::from(all_resolvable)];
        Table::fields(fields, self.rows(), reader)
    }

    fn missed(&self) -> Vec<String> {
        let losses = self.ranking.iter().map(|place| (place.prediction.as_str(), place.loss));
        self.target_error.and_then(|target| missed_by_any(target, losses, self.scenes)).into_iter().collect()
    }
}

impl Analysis for RankReport {
    const NAME: &'static str = "rank";
    const ANSWERS: &'static str = "many predictions, or methods over a data set";
    const GROUP: &'static str = "Compare";
    const PAIRED: bool = true;
    const EXAMPLES: &'static [&'static str] = &[
        "gt.png 'out/*.png'",
        "--dataset gt/ ours/ theirs/ -o table.tex",
        "--dataset gt/ ours/ theirs/ --metrics -o page.html",
    ];
    const ABOUT: &'static str = "Ranks predictions of one ground truth by their rendering loss";
    const DETAILS: &'static str = "All predictions are rendered in the same scenes, at most 786,432 / (predictions + 1). Paired \
        differences tell which are worse than the best; predictions of one group cannot be told from its best.";
    const EXAMPLE: &'static str = "\
        >>> import svbrdf
        >>> ground_truth, *predictions = svbrdf.built_in()
        >>> [(place.prediction, place.group) for place in svbrdf.rank(ground_truth, predictions).ranking]
        [('wrong roughness', 1), ('blurred normals', 2)]";
    const DOING: &'static str = "rendering";
    const SCENES: &'static [&'static str] = &["target_error", "near", "distant", "sampler", "seed", "scenes"];
    type Options = NoOptions;

    fn run(input: &AnalysisInput<'_>, _: &NoOptions, progress: &Progress) -> Result<Self, Error> {
        let AnalysisInput { ground_truth, predictions, storages, convention, request, .. } = input;
        let most = rank::most_scenes(predictions.len());
        let outcome = input.comparing(|comparison| Ok(comparison.at_most(most).run(request, progress)?))?;
        let report = Self::new(input.compared(), request, &outcome);
        match storages.first().filter(|storage| storage.has_steps()) {
            Some(storage) => {
                Ok(report.with_floor(&floor(ground_truth, storage, convention, input.seed(), progress)?))
            }
            None => Ok(report),
        }
    }
}
