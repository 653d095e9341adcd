//! Report of the share of each map in each loss.

use serde::Serialize;

use crate::error::Error;
use crate::report::{
    Analysis, AnalysisInput, Cell, Compared, Field, NoOptions, Reader, Report, Table, missed, scenes_line,
};
use crate::why::{self, MapShare};
use svbrdf_core::loss::{Estimate, Request};
use svbrdf_core::material::Material;
use svbrdf_core::progress::Progress;

/// What a map adds to the loss of a prediction, or all maps do.
struct Part<'a> {
    prediction: &'a str,
    map: &'static str,
    shapley: Estimate,
    /// The losses where only it is wrong, and where only it is right.
    only: Option<[f64; 2]>,
    loss: f64,
    target_error: Option<f64>,
    target_reached: Option<bool>,
}

fn fields<'a>() -> [Field<Part<'a>>; 11] {
    [
        ("prediction", "", |part| part.prediction.into()),
        ("map", "map", |part| part.map.into()),
        ("", "share", |part| match part.loss > 0.0 {
            true => Cell::Share(part.shapley.mean / part.loss),
            false => Cell::Missing("-"),
        }),
        ("shapley", "of the loss", |part| part.shapley.mean.into()),
        ("standard_error", "+- std. error", |part| Cell::or(part.shapley.standard_error, "unknown")),
        ("interval95_low interval95_high", "95% interval", |part| {
            Cell::or(part.shapley.interval95, "unknown")
        }),
        ("only_wrong", "only it wrong", |part| part.only.map(|[wrong, _]| wrong).into()),
        ("only_right", "only it right", |part| part.only.map(|[_, right]| right).into()),
        ("loss", "", |part| part.loss.into()),
        ("target_error", "", |part| part.target_error.into()),
        ("target_reached", "", |part| part.target_reached.into()),
    ]
}

fn part(share: &MapShare, loss: &Estimate) -> Part<'static> {
    let only = Some([share.only_wrong.mean, share.only_right.mean]);
    let (map, shapley, loss) = (share.map.name(), share.shapley, loss.mean);
    Part { prediction: "", map, shapley, only, loss, target_error: None, target_reached: None }
}

/// The attribution of the loss of each prediction to its maps.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct BlameReport {
    #[serde(flatten)]
    compared: Compared,
    /// The requested accuracy of each loss: half of its 95% interval, as a share of it.
    target_error: Option<f64>,
    /// One per prediction.
    attributions: Vec<Attribution>,
}

/// The loss of a prediction and the part of each map.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct Attribution {
    prediction: String,
    /// The number of scenes.
    scenes: usize,
    /// `None` where the scenes were listed.
    seed: Option<u64>,
    /// Whether the loss is known as well as requested; `None` where no accuracy was.
    target_reached: Option<bool>,
    /// The sum of the Shapley values.
    loss: Estimate,
    maps: [MapShare; 4],
    /// The lines about the scenes, and what shares below 0% mean.
    #[serde(skip)]
    lines: [String; 2],
}

impl BlameReport {
    /// The report of the `attributions` that `request` gives.
    pub fn new(compared: Compared, request: &Request, attributions: Vec<why::Attribution>) -> Self {
        let target_error = request.target();
        let attribution = |found: why::Attribution| Attribution {
            scenes: found.scenes.len(),
            seed: found.sampling.map(|sampling| sampling.seed),
            target_reached: target_error.map(|target| found.loss.relative_error95() <= target),
            loss: found.loss,
            maps: found.maps,
            lines: [
                scenes_line(found.sampling.as_ref(), &found.scenes, compared.size),
                found.note().map_or(String::new(), |note| format!("\n{note}\n")),
            ],
            prediction: found.prediction,
        };
        let attributions = attributions.into_iter().map(attribution).collect();
        Self { compared, target_error, attributions }
    }

    fn text_of(&self, attribution: &Attribution) -> String {
        let Attribution { prediction, loss, maps, lines: [scenes, note], .. } = attribution;
        let all = Part { map: "all", shapley: *loss, only: None, ..part(&maps[0], loss) };
        let rows = maps.iter().map(|share| part(share, loss)).chain([all]);
        let heading = self.compared.heading(&format!("blame of {prediction}"));
        format!("{heading}{scenes}\n{}{note}", Table::fields(&fields(), rows, Reader::Person).text())
    }
}

impl Report for BlameReport {
    fn heading(&self) -> String {
        self.compared.heading("blame")
    }

    /// With the lines about its scenes above the table of each prediction.
    fn text(&self) -> String {
        self.attributions.iter().map(|attribution| self.text_of(attribution)).collect::<Vec<_>>().join("\n")
    }

    fn table(&self, reader: Reader) -> Table {
        let rows = self.attributions.iter().flat_map(|one| {
            let Attribution { prediction, target_reached, loss, maps, .. } = one;
            let (target_error, target_reached) = (self.target_error, *target_reached);
            maps.iter().map(move |share| Part {
                prediction,
                target_error,
                target_reached,
                ..part(share, loss)
            })
        });
        Table::fields(&fields(), rows, reader)
    }

    fn missed(&self) -> Vec<String> {
        let Some(target) = self.target_error else { return Vec::new() };
        let of = |a: &Attribution| missed(target, &a.prediction, &a.loss, a.scenes);
        self.attributions.iter().filter_map(of).collect()
    }
}

impl Analysis for BlameReport {
    const NAME: &'static str = "blame";
    const ANSWERS: &'static str = "which map the loss comes from";
    const ABOUT: &'static str = "Prints how much of the rendering loss comes from each map";
    const DETAILS: &'static str = "Renders all 16 mixtures of the maps of the ground truth and of the prediction in the same scenes \
        on the same texels. The Shapley value of a map is the mean of what it adds to the loss over all orders in which the maps can \
        become wrong; the four values add up to the loss. Beside them stands the loss where only this map is wrong, and where only \
        this map is right. A negative share: its error partly cancels the errors of others.";
    const DOING: &'static str = "rendering";
    const SCENES: &'static [&'static str] = &["target_error", "seed", "scenes"];
    const SCENES_HELP: &'static [(&'static str, &'static str)] = &[(
        "target_error",
        "Samples as many scenes as this relative error of the loss needs at 95% confidence, at most 49,152 [default: 1%]",
    )];
    type Options = NoOptions;

    fn run(input: &AnalysisInput<'_>, _: &NoOptions, progress: &Progress) -> Result<Self, Error> {
        let attributions = input.comparing(|comparison| {
            let one = |prediction: &&Material<f32>| {
                Ok(why::attribute_in(&comparison, prediction, &input.request, progress)?)
            };
            comparison.predictions().iter().map(one).collect()
        })?;
        Ok(Self::new(input.compared(), &input.request, attributions))
    }
}
