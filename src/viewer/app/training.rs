//! Training runs in the window: their steps, as they come and as they are asked for.
//!
//! While files are watched, the window goes on to the newest step of a run unless an earlier one was chosen, and opens runs that
//! come into being in a folder of runs.

use std::path::PathBuf;

use svbrdf_files::steps::{RunId, TrainingStep};

use super::parts::Parts;
use crate::jobs::training::{RunLossesKey, RunNews, WantedRun};
use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::request::{ReadRequest, Target};
use crate::model::settings::Tab;
use svbrdf_files::source::{MaterialSource, Place};

/// Follows the folders of the training runs in the window.
pub(super) fn follow(parts: &mut Parts) {
    let all = &parts.model.materials.all;
    let ids: Vec<RunId> = all.iter().filter_map(|one| one.read.source.run.clone()).collect();
    let mut folders: Vec<PathBuf> = ids.iter().map(|id| id.folder.clone()).collect();
    folders.sort();
    folders.dedup();
    if parts.jobs.openings.is_empty() {
        parts.model.training.requested = None;
    }
    let watch = parts.model.settings.watch;
    let news = parts.jobs.training.scan.follow(&parts.jobs.waker, folders, watch);
    for one in &news {
        open_new_runs(parts, &ids, one);
    }
    parts.model.training.known.extend(ids);
    for one in &news {
        show_newest(parts, one);
    }
    follow_step_losses(parts);
}

/// Opens the runs that have come into being in a folder.
fn open_new_runs(parts: &mut Parts, open: &[RunId], news: &RunNews) {
    let runs: Vec<RunId> =
        parts.jobs.training.scan.runs(&news.folder).iter().map(|run| run.id.clone()).collect();
    let is_in_folder =
        |one: &&LoadedMaterial| one.read.source.run.as_ref().is_some_and(|run| run.folder == news.folder);
    let like = parts.model.materials.all.iter().find(is_in_folder).map(|one| one.read.reopened());
    for run in runs {
        let is_new = parts.model.training.known.insert(run.clone()) && !open.contains(&run);
        let opens = is_new && news.before.is_some() && parts.model.settings.watch;
        if let (true, Some(like)) = (opens, &like) {
            let place = Place::Path(run.folder.clone());
            let source = MaterialSource { name: None, place, run: Some(run), chosen: None, ..like.clone() };
            parts.jobs.read(&parts.model, ReadRequest::new(vec![source], Target::Predictions));
        }
    }
}

/// Reads the newest steps of the runs in a folder, where others were the newest and no earlier step was chosen.
fn show_newest(parts: &mut Parts, news: &RunNews) {
    for index in 1..parts.model.materials.all.len() {
        let Some((id, number)) = parts.model.materials.all[index].read.step() else { continue };
        let newest = parts.jobs.training.run(id).and_then(|run| run.steps.last());
        let Some(newest) = newest.filter(|_| id.folder == news.folder).cloned() else { continue };
        if newest.number == number {
            // Of a session, which was saved at the newest step after all. Later, another one may be on its way.
            if news.before.is_none() {
                parts.model.training.pinned.remove(id);
            }
            continue;
        }
        let before = news.before.iter().flatten().find(|run| run.id == *id);
        // A step that is in the window and not listed yet is recent; one that was listed is gone.
        let was_listed = before.is_some_and(|run| run.steps.iter().any(|step| step.number == number));
        if newest.number < number && !was_listed {
            continue;
        }
        let is_known = before.and_then(|run| run.steps.last()) == Some(&newest);
        if !is_known && !parts.model.training.pinned.contains(id) {
            read_step(parts, index, &newest);
        }
    }
}

fn read_step(parts: &mut Parts, index: usize, step: &TrainingStep) {
    let Some(id) = run_at(parts, index) else { return };
    if let Some(request) = parts.model.materials.read_step(index, step.path.clone()) {
        parts.jobs.read(&parts.model, request);
    }
    parts.model.training.requested = Some((id, step.number));
}

/// The training run of the material at this index.
fn run_at(parts: &Parts, index: usize) -> Option<RunId> {
    parts.model.materials.all.get(index).and_then(|one| one.read.source.run.clone())
}

/// Reads a step of the run at this index. At the newest one, the window follows the run again.
pub(super) fn show_step(parts: &mut Parts, index: usize, number: u64) {
    let Some(id) = run_at(parts, index) else { return };
    let Some(run) = parts.jobs.training.run(&id) else { return };
    let Some(step) = run.steps.iter().find(|step| step.number == number).cloned() else { return };
    if run.steps.last().is_some_and(|newest| newest.number == number) {
        parts.model.training.pinned.remove(&id);
    } else {
        parts.model.training.pinned.insert(id);
    }
    read_step(parts, index, &step);
}

/// Goes this many steps on in the run of the chosen prediction, as far as there are any.
pub(super) fn move_step(parts: &mut Parts, by: isize) {
    let index = parts.model.view.display.prediction + 1;
    let requested = parts.model.training.requested.as_ref();
    let views = parts.jobs.training.views(&parts.model.materials.all, requested);
    let Some(view) = views.iter().find(|view| view.index == index) else { return };
    let (now, last) = (view.step_index(), view.run.steps.len() - 1);
    let number = view.run.steps[now.saturating_add_signed(by).min(last)].number;
    if number != view.number {
        show_step(parts, index, number);
    }
}

/// Computes the losses of all steps, where they are displayed.
fn follow_step_losses(parts: &mut Parts) {
    let (model, jobs) = (&parts.model, &mut parts.jobs);
    let is_displayed = model.settings.tab == Tab::Loss && model.side_panel();
    // The losses of what is in the panes come first.
    let wanted = is_displayed && !jobs.loss.is_running() && jobs.openings.is_empty();
    let Some(truth) = model.materials.ground_truth() else { return };
    let of = RunLossesKey {
        id: truth.id(),
        ground_truth: truth.read.clone(),
        query: model.loss_query(),
        rules: model.materials.rules,
    };
    let training = &mut jobs.training;
    let run = |one: &LoadedMaterial| {
        let id = one.read.source.run.as_ref()?;
        let run = training.scan.runs(&id.folder).iter().find(|run| run.id == *id)?;
        Some(WantedRun { run, source: one.read.reopened().of_set() })
    };
    let runs: Vec<_> = model.materials.predictions().iter().filter_map(run).collect();
    training.losses.follow(&jobs.waker, of, &runs, wanted);
}
