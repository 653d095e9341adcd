//! Jobs that follow the model: they compute what is displayed now, and only that.

use svbrdf_evaluate::why::Worst;

use super::Jobs;
use super::dataset::DisplayedCases;
use super::displayed::Displayed;
use super::panes::RangeKey;
use super::why::WhyQuery;
use super::work::context::JobContext;
use crate::error::Error;
use crate::model::Model;
use crate::model::settings::Tab;

/// What the jobs have found since the last frame.
#[derive(Debug, Default)]
pub struct JobFindings {
    pub errors: Vec<Error>,
    /// Why the open photograph cannot be read.
    pub photograph_error: Option<Error>,
    /// The end of the search for the worst scene.
    pub worst: Option<Result<Worst, Error>>,
}

impl Jobs {
    /// Takes over results, and computes what `model` needs now, with `in_sight` of a data set.
    pub fn follow(&mut self, model: &Model, in_sight: &DisplayedCases) -> JobFindings {
        let mut findings = JobFindings::default();
        self.follow_losses(model);
        self.follow_order(model, &mut findings);
        self.follow_replacement(model, &mut findings);
        if let Some(gpu) = &self.gpu {
            self.uploads.send_missing(&self.waker, gpu, &model.materials.all);
        }
        self.follow_why(model, &mut findings);
        self.follow_panes(model, &mut findings);
        let range = Displayed::of(model, self).range();
        let Self { waker, gpu, dataset, .. } = self;
        findings.errors.extend(dataset.follow(waker, gpu.as_ref(), model, in_sight, range));
        let Self { uploads, openings, panes, dataset, .. } = self;
        let is_here = |id| model.materials.all.iter().chain(&panes.displayed).any(|one| one.id() == id);
        uploads.keep_only(|id| is_here(id) || openings.hold(id) || dataset.cases.hold(id));
        findings
    }

    fn follow_losses(&mut self, model: &Model) {
        // A loss of materials that are not all there yet would be computed in vain.
        let auto = model.settings.auto_loss && !self.openings.expect_more();
        let (waker, materials, query) = (&self.waker, &model.materials, model.loss_query());
        self.loss.follow(waker, materials, &query, auto);
        self.loss.poll(waker);
    }

    /// Whether the order of the predictions survives, where that is in sight.
    fn follow_order(&mut self, model: &Model, findings: &mut JobFindings) {
        let is_open = model.asks_order && model.tab() == Tab::Loss && model.side_panel();
        let (materials, view, loss) = (&model.materials.all[..], &model.view, &model.settings.loss);
        let work = JobContext { waker: &self.waker, gpu: None, materials, view };
        let question = (loss.target_percent, loss.seed);
        findings.errors.extend(self.order.follow_predictions(&work, is_open, question));
    }

    fn follow_replacement(&mut self, model: &Model, findings: &mut JobFindings) {
        let Self { waker, gpu, uploads, panes, .. } = self;
        let (materials, view) = (&model.materials.all[..], &model.view);
        let work = JobContext { waker, gpu: gpu.as_ref(), materials, view };
        findings.errors.extend(panes.replacement.follow(&work, uploads));
        panes.displayed = panes.replacement.displayed(materials, view);
    }

    /// The jobs of the tab *Why*, where it is open. The search for the worst scene goes on in other tabs, too.
    fn follow_why(&mut self, model: &Model, findings: &mut JobFindings) {
        let is_open = model.tab() == Tab::Why && model.side_panel();
        let loss = &model.settings.loss;
        let query = WhyQuery {
            sections: model.settings.sections.clone(),
            scenes: loss.listed_scenes(),
            seed: loss.seed,
        };
        // Materials that arrive one by one would be looked at in vain.
        let is_complete = !self.openings.expect_more();
        let Self { waker, gpu, why, scene_loss, .. } = self;
        let (materials, view) = (&model.materials.all[..], &model.view);
        let work = JobContext { waker, gpu: gpu.as_ref(), materials, view };
        findings.errors.extend(why.follow(&work, is_open && is_complete, query));
        findings.errors.extend(scene_loss.follow(&work, is_open));
        findings.worst = why.poll_search(&work);
    }

    fn follow_panes(&mut self, model: &Model, findings: &mut JobFindings) {
        let (view, settings) = (&model.view, &model.settings);
        let has_photograph = Displayed::of(model, self).photograph().is_some();
        let differences = view.display.difference;
        let averages = differences && view.is_error_map();
        let Self { waker, gpu, panes, photograph, .. } = self;
        let work = JobContext { waker, gpu: gpu.as_ref(), materials: &panes.displayed, view };
        let [unreadable, error] = photograph.follow(&work, &model.photograph);
        findings.photograph_error = unreadable;
        let of_ground_truth = differences && !averages && !has_photograph;
        let errors = [
            error,
            panes.difference.follow(&work, of_ground_truth),
            panes.error_map.follow(&work, averages, settings.loss.listed_scenes()),
        ];
        findings.errors.extend(errors.into_iter().flatten());
        if !view.display.is_replaced()
            && let Some((distributions, _)) = Displayed::of(model, self).distributions()
        {
            self.panes.auto_range = Some((RangeKey::of(model), distributions.auto_range));
        }
    }
}
