//! Jobs that follow the model: they compute what is displayed now, and only that.

use super::Jobs;
use super::answers::Answer;
use super::displayed::Displayed;
use super::loss::LossJob;
use super::panes::RangeKey;
use super::panes::difference::Differences;
use super::panes::photograph::{ComparePhotograph, ReadPhotograph};
use super::panes::replacement::Replace;
use crate::error::Error;
use crate::model::Model;

/// What the jobs have found since the last frame.
#[derive(Debug, Default)]
pub struct JobFindings {
    pub errors: Vec<Error>,
    /// Whether the open photograph cannot be read.
    pub photograph_failed: bool,
}

impl Jobs {
    /// Takes over results, and computes what `model` needs now, with `in_sight` of a data set.
    pub fn follow(&mut self, model: &Model, in_sight: &[usize]) -> JobFindings {
        let mut findings = JobFindings::default();
        self.follow_losses(model);
        self.ask_about_panes(model, &mut findings);
        let Self { waker, answers, gpu, dataset, .. } = self;
        findings.errors.extend(dataset.follow((waker, answers), gpu.as_ref(), model, in_sight));
        let Self { uploads, openings, panes, dataset, .. } = self;
        let is_here = |id| model.materials.all.iter().chain(&panes.displayed).any(|one| one.id() == id);
        uploads.keep_only(|id| is_here(id) || openings.hold(id) || dataset.hold(id));
        findings
    }

    fn follow_losses(&mut self, model: &Model) {
        // A loss of materials that are not all there yet would be computed in vain.
        if model.dataset.open.is_some() {
            // Its losses are those of the data set.
            self.loss = LossJob::default();
            return;
        }
        let auto = model.settings.auto_loss && !self.openings.expect_more();
        self.loss.follow(&self.answers, &model.materials, &model.loss_query(), auto);
    }

    /// What the panes display, and what is asked about it.
    fn ask_about_panes(&mut self, model: &Model, findings: &mut JobFindings) {
        let Self { answers, uploads, gpu, panes, .. } = self;
        let of = (&model.materials.all[..], &model.view);
        panes.displayed = Replace::displayed(answers, uploads, gpu.as_ref(), of);
        self.ask_about_photograph(model, findings);
        let differences = model.view.display.difference && self.panes.displayed.len() > 1;
        let displayed = Displayed::of(model, self);
        let averages = differences && model.view.is_error_map();
        let error_maps = averages.then(|| displayed.error_maps());
        let compares = differences && !averages && displayed.photograph().is_none();
        let difference = compares.then(|| displayed.differences());
        let Self { answers, panes, .. } = self;
        panes.differences = difference.and_then(|now| match answers.get(&now) {
            Answer::Ready(found) => Some((now, found)),
            _ => answers.latest(|one: &Differences| one.is_like(&now)),
        });
        let asked = error_maps.map(|now| (answers.get(&now), now));
        panes.error_map_progress = asked.as_ref().and_then(|(answer, _)| answer.busy()).map(|busy| busy.0);
        panes.error_maps = asked.and_then(|(answer, now)| Some((now, answer.ready()?)));
        if !model.view.display.is_replaced()
            && let Some((distributions, _)) = Displayed::of(model, self).distributions()
        {
            self.panes.auto_range = Some((RangeKey::of(model), distributions.auto_range));
        }
    }

    fn ask_about_photograph(&mut self, model: &Model, findings: &mut JobFindings) {
        let read = ReadPhotograph::of(&model.photograph).map(|question| self.answers.get(&question));
        findings.photograph_failed = matches!(read, Some(Answer::Failed(_)));
        self.panes.photograph = read.and_then(Answer::ready);
        let is_read = self.panes.photograph.is_some() && !self.panes.displayed.is_empty();
        let now = Displayed::of(model, self).compared_photograph().filter(|_| is_read);
        self.panes.photographs = now.and_then(|now| match self.answers.get(&now) {
            Answer::Ready(found) => Some((now, found)),
            _ => self.answers.latest(|one: &ComparePhotograph| one.is_like(&now)),
        });
    }
}
