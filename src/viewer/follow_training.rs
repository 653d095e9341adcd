//! The steps of training runs, as they come and as the person asks for them.

use std::path::PathBuf;

use eframe::egui;

use super::app::App;
use super::settings::Tab;
use super::slot::{Slot, Target};
use super::source::{Origin, Source};
use super::training::{RunLossesKey, RunNews, WantedRun};
use crate::files::steps::{RunId, TrainingStep};

impl App {
    /// Follows the folders of the training runs in the window.
    pub(super) fn follow_training(&mut self, ctx: &egui::Context) {
        let ids: Vec<RunId> = self.slots.slots.iter().filter_map(|slot| slot.loaded.run.clone()).collect();
        let mut folders: Vec<PathBuf> = ids.iter().map(|id| id.folder.clone()).collect();
        folders.sort();
        folders.dedup();
        if self.slots.openings.is_empty() {
            self.training.wanted = None;
        }
        let news = self.training.scan.follow(ctx, folders, self.settings.watch);
        for one in &news {
            self.open_new_runs(ctx, &ids, one);
        }
        self.training.passed.extend(ids);
        for one in &news {
            self.show_newest(ctx, one);
        }
        self.follow_step_losses(ctx);
    }

    /// Opens the runs that have come into being in a folder.
    fn open_new_runs(&mut self, ctx: &egui::Context, open: &[RunId], news: &RunNews) {
        let runs: Vec<RunId> =
            self.training.scan.runs(&news.folder).iter().map(|run| run.id.clone()).collect();
        let is_in_folder =
            |slot: &&Slot| slot.loaded.run.as_ref().is_some_and(|run| run.folder == news.folder);
        let like = self.slots.slots.iter().find(is_in_folder).map(|slot| slot.loaded.source());
        for run in runs {
            let is_new = self.training.passed.insert(run.clone()) && !open.contains(&run);
            let opens = is_new && news.before.is_some() && self.settings.watch;
            if let (true, Some(like)) = (opens, &like) {
                let origin = Origin::Path(run.folder.clone());
                let source = Source { origin, run: Some(run), exactly: None, ..like.clone() };
                let gpu = self.gpu.as_ref().map(|g| &g.gpu);
                self.slots.open(ctx, gpu, vec![source], Target::Predictions);
            }
        }
    }

    /// Shows the newest steps of the runs in a folder, where others were the newest and the person has not gone back.
    fn show_newest(&mut self, ctx: &egui::Context, news: &RunNews) {
        for slot in 1..self.slots.slots.len() {
            let Some((id, number)) = self.slots.slots[slot].loaded.step() else { continue };
            let newest = self.training.run(id).and_then(|run| run.steps.last());
            let Some(newest) = newest.filter(|_| id.folder == news.folder).cloned() else { continue };
            if newest.number == number {
                // Of a session, which shows the newest step after all. Later, another one may be on its way.
                if news.before.is_none() {
                    self.training.held.remove(id);
                }
                continue;
            }
            let before = news.before.iter().flatten().find(|run| run.id == *id);
            // A step that is shown and not listed yet is still young; one that was listed is gone.
            let was_listed = before.is_some_and(|run| run.steps.iter().any(|step| step.number == number));
            if newest.number < number && !was_listed {
                continue;
            }
            let is_known = before.and_then(|run| run.steps.last()) == Some(&newest);
            if !is_known && !self.training.held.contains(id) {
                self.read_step(ctx, slot, &newest);
            }
        }
    }

    fn read_step(&mut self, ctx: &egui::Context, slot: usize, step: &TrainingStep) {
        let Some(id) = self.slots.slots.get(slot).and_then(|slot| slot.loaded.run.clone()) else { return };
        let gpu = self.gpu.as_ref().map(|g| &g.gpu);
        self.slots.show_step(ctx, gpu, slot, step.path.clone());
        self.training.wanted = Some((id, step.number));
    }

    /// Shows a step of the run in a slot. At the newest one, the window follows the run again.
    pub(super) fn go_to_step(&mut self, ctx: &egui::Context, slot: usize, number: u64) {
        let Some(id) = self.slots.slots.get(slot).and_then(|slot| slot.loaded.run.clone()) else { return };
        let Some(run) = self.training.run(&id) else { return };
        let Some(step) = run.steps.iter().find(|step| step.number == number).cloned() else { return };
        if run.steps.last().is_some_and(|newest| newest.number == number) {
            self.training.held.remove(&id);
        } else {
            self.training.held.insert(id);
        }
        self.read_step(ctx, slot, &step);
    }

    /// Goes this many steps on in the run of the chosen prediction, as far as there are any.
    pub(super) fn move_step(&mut self, ctx: &egui::Context, by: isize) {
        let slot = self.state.prediction + 1;
        let views = self.training.views(&self.slots.slots);
        let Some(view) = views.iter().find(|view| view.slot == slot) else { return };
        let (now, last) = (view.index(), view.run.steps.len() - 1);
        let number = view.run.steps[now.saturating_add_signed(by).min(last)].number;
        if number != view.shown {
            self.go_to_step(ctx, slot, number);
        }
    }

    /// Computes the losses of all steps, where they are shown.
    fn follow_step_losses(&mut self, ctx: &egui::Context) {
        let shown = self.settings.tab == Tab::Loss && *self.side_panel(ctx);
        // The losses of what is in the panes come first.
        let wanted = shown && !self.loss.is_running() && self.slots.openings.is_empty();
        let asked = self.asked();
        let Some(truth) = self.slots.ground_truth() else { return };
        let of =
            RunLossesKey { id: truth.id, ground_truth: truth.loaded.clone(), asked, rules: self.slots.rules };
        let training = &mut self.training;
        let run = |slot: &Slot| {
            let id = slot.loaded.run.as_ref()?;
            let run = training.scan.runs(&id.folder).iter().find(|run| run.id == *id)?;
            Some(WantedRun { run, source: slot.loaded.source().of_set() })
        };
        let runs: Vec<_> = self.slots.slots.iter().skip(1).filter_map(run).collect();
        training.losses.follow(ctx, of, &runs, wanted);
    }
}
