//! Opening of a data set: matched on a worker, and shown material by material.

use std::path::PathBuf;

use svbrdf_core::loss::Request;
use svbrdf_core::material::Grid;
use svbrdf_evaluate::dataset::{DatasetReading, Source, decided};
use svbrdf_files::session::dataset::SessionDataset;
use svbrdf_files::session::window::Framing;

use crate::dataset::cases::{self, ReadCase};
use crate::jobs::work::Job;
use crate::jobs::{Edit, Jobs, Shown};
use crate::model::Model;
use crate::model::dataset::{DatasetState, OpenDataset};
use crate::model::material::loaded::LoadedMaterial;

/// Matches the materials of these folders, or of one table.
pub fn open(jobs: &mut Jobs, paths: Vec<PathBuf>) {
    let job = Job::start(&jobs.waker, move |progress| {
        let mut paths = paths.into_iter();
        let first = paths.next().unwrap_or_default();
        let methods: Vec<_> = paths.map(|path| (None, path)).collect();
        let source = if methods.is_empty() { Source::Table(first) } else { Source::folders(first, methods) };
        let mut open =
            OpenDataset::new(source, DatasetReading::default(), Request::over_all_scenes(0), None)?;
        open.reading = decided(&open.cases, open.reading, progress)?;
        Ok(opened(open.into()))
    });
    jobs.edits.insert("dataset", job);
}

/// Matches the materials of a session, as [`DatasetState::of_session`].
pub fn restore(jobs: &mut Jobs, session: SessionDataset, results: Option<PathBuf>, strict: bool) {
    let job = Job::start(&jobs.waker, move |progress| {
        Ok(opened(DatasetState::of_session(session, results, strict, progress)?))
    });
    jobs.edits.insert("dataset", job);
}

/// The edit that takes over a data set that has been matched.
fn opened(state: DatasetState) -> Edit {
    Box::new(|model| {
        model.dialogs.open = None;
        model.open_dataset(state);
    })
}

/// Puts the material that was asked for into the window, once it has been read.
pub fn show(model: &mut Model, jobs: &Jobs) {
    let Some(read) = cases::ask(Shown { model, jobs }) else { return };
    if let Some(open) = model.dataset.open.clone().filter(|_| model.dataset.is_waiting()) {
        put(model, &open, &read);
    }
}

/// Puts a material into the window, the ground truth first, with what is not there of it. What the hand has set stays: the view is
/// at the same place, by shares of the size, and the chosen method is the same wherever it has a prediction.
///
/// All of it is put there in one frame, so that nothing of one material is seen beside something of another.
fn put(model: &mut Model, open: &OpenDataset, read: &ReadCase) {
    let before = model.materials.ground_truth().map(LoadedMaterial::grid);
    let predictions = model.materials.predictions();
    let is_of = |one: &LoadedMaterial| model.dataset.method.as_deref() == Some(one.material().name());
    // Where the chosen method had no prediction, another one stood in for it.
    if model.dataset.shown.is_some()
        && predictions.iter().any(is_of)
        && let Some(chosen) = predictions.get(model.view.display.prediction)
    {
        model.dataset.method = Some(chosen.material().name().to_owned());
    }
    model.materials.replace_all(&read.materials);
    let names = || model.materials.predictions().iter().map(|one| one.material().name());
    let chosen = model.dataset.method.as_deref().and_then(|method| names().position(|name| name == method));
    let count = model.materials.predictions().len();
    let display = &mut model.view.display;
    // Of a list of predictions, the chosen one is before the pinned ones.
    let chosen = if open.is_of_predictions() { Some(0) } else { chosen };
    display.prediction = chosen.unwrap_or(display.prediction).min(count.saturating_sub(1));
    display.corrected = None;
    if let (Some(before), Some(now)) = (before, model.materials.ground_truth().map(LoadedMaterial::grid)) {
        display.framing = display.framing.map(|framing| in_other_size(framing, before, now));
    }
    model.swapped = false;
    let is_first = model.dataset.shown.is_none();
    (model.dataset.shown, model.dataset.is_stale) = (Some(read.case), false);
    model.dataset.missing.clone_from(&read.missing);
    if is_first && model.dataset.method.is_none() {
        model.dataset.method = open.methods().first().cloned();
    }
}

/// The same part of a material of another size.
fn in_other_size(framing: Framing, before: Grid, now: Grid) -> Framing {
    let scale =
        [now.width as f32 / before.width.max(1) as f32, now.height as f32 / before.height.max(1) as f32];
    Framing {
        pixels_per_texel: framing.pixels_per_texel / scale[0].max(scale[1]),
        centre: std::array::from_fn(|axis| framing.centre[axis] * scale[axis]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_place_of_a_material_of_another_size_is_in_the_centre() {
        let framing = Framing { pixels_per_texel: 8.0, centre: [32.0, 16.0] };
        let grid = |width, height| Grid { width, height };
        let moved = in_other_size(framing, grid(128, 64), grid(256, 128));
        assert_eq!(moved, Framing { pixels_per_texel: 4.0, centre: [64.0, 32.0] });
        assert_eq!(in_other_size(moved, grid(256, 128), grid(128, 64)), framing);
    }
}
