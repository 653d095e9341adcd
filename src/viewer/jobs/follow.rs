//! What is asked in every frame, whichever panels are open: the losses, what the panes display, and the data set.

use super::Jobs;
use super::answers::Answer;
use super::answers::content::{Content, Given};
use super::displayed::Displayed;
use super::loss::DrawnLosses;
use super::panes::difference::Differences;
use super::panes::error_map::ErrorMaps;
use super::panes::photograph::{ComparePhotograph, ReadPhotograph};
use super::panes::replacement::Replace;
use super::panes::{Panes, RangeKey};
use crate::error::Error;
use crate::model::Model;

impl Jobs {
    /// Takes over results, and asks for what `model` needs now, with `in_sight` of a data set.
    pub fn follow(&mut self, model: &Model, in_sight: &[usize]) -> Option<Error> {
        // A loss of materials that are not all there yet would be computed in vain; those of a data set are its own.
        let has_own = model.dataset.open.is_some() || self.openings.expect_more();
        self.loss = if has_own { DrawnLosses::default() } else { DrawnLosses::ask(&self.answers, model) };
        self.ask_about_panes(model);
        let Self { waker, answers, gpu, uploads, openings, panes, dataset, .. } = self;
        let error = dataset.follow((waker, answers), gpu.as_ref(), model, in_sight);
        let is_here = |id| model.materials.all.iter().chain(&panes.displayed).any(|one| one.id() == id);
        uploads.retain(|id, _| is_here(*id) || openings.hold(*id) || dataset.hold(*id));
        error
    }

    fn ask_about_panes(&mut self, model: &Model) {
        let Self { answers, uploads, gpu, panes, .. } = self;
        let of = (&model.materials.all[..], &model.view);
        let displayed = Replace::displayed(answers, uploads, gpu.as_ref(), of);
        *panes = Panes { displayed, auto_range: panes.auto_range.take(), ..Panes::default() };
        self.ask_about_photograph(model);
        if model.view.display.difference && self.panes.displayed.len() > 1 {
            self.ask_about_difference(model);
        }
        if !model.view.display.is_replaced()
            && let Some((distributions, _)) = Displayed::of(model, self).distributions()
        {
            self.panes.auto_range = Some((RangeKey::of(model), distributions.auto_range));
        }
    }

    fn ask_about_photograph(&mut self, model: &Model) {
        let read = ReadPhotograph::of(&model.photograph).map(|question| self.answers.get(&question));
        self.panes.photograph_failed = matches!(read, Some(Answer::Failed(_)));
        self.panes.photograph = read.and_then(Answer::ready);
        let is_read = self.panes.photograph.is_some() && !self.panes.displayed.is_empty();
        let now = Displayed::of(model, self).compared_photograph().filter(|_| is_read);
        self.panes.photographs = now.and_then(|now| match self.answers.get(&now) {
            Answer::Ready(found) => Some((now, found)),
            _ => self.answers.latest(|one: &ComparePhotograph| one.is_like(&now)),
        });
    }

    fn ask_about_difference(&mut self, model: &Model) {
        let (answers, displayed) = (&self.answers, &self.panes.displayed);
        if model.view.is_error_map() {
            let answer = answers.get(&ErrorMaps {
                materials: Content::all(displayed),
                scenes: model.settings.loss.listed_scenes(),
                convention: model.view.convention(),
                gpu: Given(self.gpu.clone()),
            });
            self.panes.error_map_progress = answer.busy().map(|(fraction, _)| fraction);
            self.panes.difference = answer.ready().map(|found| (found, true));
        } else if Displayed::of(model, self).photograph().is_none() {
            let now = Differences::of(displayed, &model.view, self.gpu.as_ref());
            let of_now = answers.get(&now).ready().map(|found| (found, true));
            let latest = || answers.latest(|one: &Differences| one.is_like(&now));
            self.panes.difference = of_now.or_else(|| latest().map(|(_, found)| (found, false)));
        }
    }
}
