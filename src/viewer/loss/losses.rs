//! Loss of the predictions: asked for the current materials and settings, and refined until it answers the question.

use std::sync::Arc;
use std::time::Duration;

use eframe::egui::{self, RichText};

use svbrdf_core::loss::{Comparison, Estimate, Loss, Outcome, Request};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_evaluate::analyses::LossReport;
use svbrdf_evaluate::report::{Reader, Report as _, comparing, stored_normals_note};
use svbrdf_evaluate::robust::RobustReport;

use crate::error::Error;
use crate::jobs::Shown;
use crate::jobs::answers::content::{Content, Given, mask_of, read_all, refuse_mask};
use crate::jobs::answers::{Answer, Answered, Question, Work};
use crate::model::Model;
use crate::model::material::loaded::{LoadedMaterial, drawable};
use crate::widgets::{answered, copy_table, report_table};

/// Progress is shown after this time: what takes less would only flicker.
const SOON: Duration = Duration::from_millis(100);

/// The losses of predictions. The ground truth is the first of the materials.
#[derive(Clone, Debug, PartialEq)]
pub struct ComputeLosses {
    materials: Vec<Content>,
    names: Given<Vec<String>>,
    request: Request,
    convention: Convention,
}

/// Losses, complete or so far.
#[derive(Debug)]
pub struct ComputedLosses {
    /// What they answer.
    pub request: Request,
    pub report: LossReport,
    /// `differences[a][b]`: the loss of prediction b minus that of a, on the same scenes.
    pub differences: Vec<Vec<Estimate>>,
}

impl ComputeLosses {
    fn of(model: &Model) -> Self {
        let materials = &model.materials.all;
        let names = materials.iter().map(|one: &LoadedMaterial| one.name().to_owned()).collect();
        Self {
            materials: Content::all(materials),
            names: Given(names),
            request: model.settings.loss.request(),
            convention: model.view.convention(),
        }
    }
}

impl Question for ComputeLosses {
    type Answer = ComputedLosses;
    const KEPT: usize = 8;
    const HAS_MESSAGE: bool = false;

    fn is_like(&self, earlier: &Self) -> bool {
        self.materials == earlier.materials
    }

    /// Tells of the losses on the way.
    fn answer(&self, work: &Work<'_, ComputedLosses>) -> Result<ComputedLosses, Error> {
        let read = read_all(&self.materials)?;
        let note = stored_normals_note(&self.convention, read.iter().map(|one| &one.storage));
        let named = self.names.0.iter().zip(&read);
        let materials: Vec<Material<f32>> =
            named.map(|(name, read)| read.material().clone().renamed(name.clone())).collect();
        let materials: Vec<&Material<f32>> = materials.iter().collect();
        let (size, mask) = (materials[0].size(), mask_of(&read)?);
        comparing(materials[0], &materials[1..], self.convention, mask, |comparison| {
            let report = |outcome: Outcome| {
                let mut report = LossReport::new(&comparison, &self.request, outcome);
                report.note.clone_from(&note);
                (report.size, report.masked) = (size, mask.map(|mask| mask.texels().len()));
                ComputedLosses { request: self.request.clone(), differences: differences(&report), report }
            };
            let mut last = None;
            comparison.stream(&self.request, work.progress(), |outcome: &Outcome| {
                work.tell(report(outcome.clone()));
                last = Some(outcome.clone());
            })?;
            last.map(report).ok_or_else(|| Error::internal("there are no losses"))
        })
    }
}

/// The losses that are drawn.
#[derive(Debug, Default)]
pub struct DrawnLosses {
    /// Those of now, or the latest ones of these materials.
    latest: Option<Arc<Answered<ComputedLosses>>>,
    /// Whether they are those of now.
    pub is_current: bool,
    pub is_cancelled: bool,
    /// Why there are none.
    pub problem: Option<Arc<str>>,
    /// The share of the work that is done, and its time.
    busy: Option<(f32, Duration)>,
}

impl DrawnLosses {
    /// Asks for the losses of the materials in the window, by its settings.
    pub fn ask(Shown { model, jobs }: Shown<'_>) -> Self {
        // A loss of materials that are not all there yet would be computed in vain; those of a data set are its own.
        let has_own = model.dataset.open.is_some() || model.materials.expect_more();
        if has_own || model.materials.predictions().is_empty() {
            return Self::default();
        }
        let wanted = ComputeLosses::of(model);
        let answer = jobs.answers.get(&wanted);
        let (busy, is_cancelled) = (answer.busy(), matches!(answer, Answer::Stopped(_)));
        let (of_now, problem) = match answer {
            Answer::Ready(found) | Answer::Partial(found, ..) => (Some(found), None),
            Answer::Stopped(found) => (found, None),
            Answer::Running(..) => (None, None),
            Answer::Failed(problem) => (None, Some(problem)),
        };
        let is_current = of_now.is_some();
        let latest = of_now.or_else(|| jobs.answers.latest(&wanted));
        Self { latest, is_current, is_cancelled, problem, busy }
    }

    /// The losses, and the time that they took.
    pub fn losses(&self) -> Option<(&ComputedLosses, Duration)> {
        self.latest.as_ref().map(|answered| (&answered.answer, answered.elapsed))
    }

    /// Whether the losses are all that is asked for.
    pub fn is_complete(&self) -> bool {
        self.is_current && !self.is_cancelled && self.busy.is_none()
    }

    pub fn complete(&self) -> Option<&[Loss]> {
        let (losses, _) = self.losses().filter(|_| self.is_complete())?;
        Some(losses.report.outcome.losses.as_slice())
    }

    /// Of each prediction, where they are complete.
    pub fn of_predictions(&self) -> Vec<Option<Estimate>> {
        self.complete().unwrap_or_default().iter().map(|loss| Some(loss.estimate)).collect()
    }

    /// Progress of the losses that are computed: its share in [0, 1], its time, and whether it has losses yet. `None` without one,
    /// and for the first moment of one.
    pub fn busy(&self) -> Option<(f32, Duration, bool)> {
        let (fraction, elapsed) = self.busy.filter(|(_, elapsed)| *elapsed > SOON)?;
        let losses = self.losses().filter(|_| self.is_current).map(|(losses, _)| losses);
        let fraction = losses.map_or(fraction, |losses| match &losses.request {
            Request::Time { budget, .. } => elapsed.as_secs_f32() / budget.as_secs_f32(),
            Request::Scenes(s) => losses.report.outcome.scenes.len() as f32 / (s.near + s.distant) as f32,
            _ => fraction,
        });
        Some((fraction.min(1.0), elapsed, losses.is_some()))
    }

    /// Whether the losses of now are asked for, and not there yet.
    pub fn is_starting(&self) -> bool {
        self.busy.is_some() && !self.is_current
    }
}

/// For each prediction the differences of all losses from its own.
fn differences(report: &LossReport) -> Vec<Vec<Estimate>> {
    let outcome = &report.outcome;
    let predictions = 0..outcome.losses.len();
    let from = |other| predictions.clone().map(|index| outcome.difference(index, other)).collect();
    predictions.clone().map(from).collect()
}

/// The fold, which is unfolded where it `asks`, with the answer to `ask`.
pub fn fold(ui: &mut egui::Ui, asks: &mut bool, ask: impl FnOnce() -> Answer<RobustReport>) {
    ui.add_space(4.0);
    let title = RichText::new("Does the order survive?").strong();
    let header = egui::CollapsingHeader::new(title).open(Some(*asks));
    let header = header.show_unindented(ui, |ui| answered(ui, ask(), answer));
    let hover = "The order under other conventions, epsilons and scenes, as `svbrdf rank --robust` prints it";
    *asks ^= header.header_response.on_hover_text(hover).clicked();
}

/// The sentence, the pairs that change sides, and the order under every question.
fn answer(ui: &mut egui::Ui, report: &RobustReport) {
    ui.label(drawable(&report.sentence));
    for change in report.changes() {
        ui.label(RichText::new(drawable(&change)).small().weak());
    }
    copy_table(ui, || report.text());
    report_table(ui, &report.table(Reader::Person));
}

/// Whether the order of the predictions survives. The ground truth is the first of the materials, each with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct PredictionOrder {
    materials: Vec<(Content, String)>,
    convention: Convention,
    /// The losses.
    request: Request,
}

impl PredictionOrder {
    /// Of the materials in the window, the ground truth first.
    pub fn of(model: &Model) -> Self {
        let named = |one: &LoadedMaterial| (Content::of(one), one.name().to_owned());
        let (convention, loss) = (model.view.convention(), &model.settings.loss);
        let request = Request::Accuracy { target: loss.target_percent / 100.0, seed: loss.seed };
        Self { materials: model.materials.all.iter().map(named).collect(), convention, request }
    }
}

impl Question for PredictionOrder {
    type Answer = RobustReport;
    const HAS_MESSAGE: bool = false;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<RobustReport, Error> {
        let named = |(one, name): &(Content, String)| {
            let read = one.read()?;
            refuse_mask(
                std::slice::from_ref(&read),
                "The order is over all texels, and not over those of a mask",
            )?;
            Ok(read.material().clone().renamed(name.clone()))
        };
        let materials = self.materials.iter().map(named).collect::<Result<Vec<_>, Error>>()?;
        let [ground_truth, predictions @ ..] = materials.as_slice() else {
            return Err(Error::internal("there is no ground truth"));
        };
        let predictions: Vec<_> = predictions.iter().collect();
        let comparison = Comparison::new(ground_truth, &predictions, self.convention)?;
        Ok(RobustReport::new(&comparison, &self.request, work.progress())?)
    }
}
