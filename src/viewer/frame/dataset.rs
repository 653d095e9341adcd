//! Data set: matched on a worker, and shown material by material.

use std::path::PathBuf;
use std::sync::Arc;

use svbrdf_core::loss::Request;
use svbrdf_evaluate::dataset::{DatasetReading, Method, Source, decided};
use svbrdf_files::session::dataset::{SessionDataset, SessionMethod};

use crate::frame::layout::Parts;
use crate::jobs::Edit;
use crate::jobs::answers::Answered;
use crate::jobs::dataset::cases::ReadCase;
use crate::jobs::work::job::Job;
use crate::model::case;
use crate::model::dataset::{DatasetState, OpenDataset, REQUEST};

/// Matches the materials of these folders, or of one table.
pub(super) fn open(parts: &mut Parts, paths: Vec<PathBuf>) {
    let job = Job::start(&parts.jobs.waker, move |progress| {
        let mut paths = paths.into_iter();
        let first = paths.next().unwrap_or_default();
        let methods: Vec<_> = paths.map(|path| (None, path)).collect();
        let source = if methods.is_empty() { Source::Table(first) } else { Source::folders(first, methods) };
        let mut open = OpenDataset::new(source, DatasetReading::default(), REQUEST, None)?;
        open.reading = decided(&open.cases, open.reading, progress)?;
        Ok(opened(DatasetState::of(Arc::new(open), 0, Default::default())))
    });
    parts.jobs.edits.insert("dataset", job);
}

/// Matches the materials of a session; `results` is a folder that a person named.
pub(super) fn restore(parts: &mut Parts, session: SessionDataset, results: Option<PathBuf>) {
    let strict = parts.model.materials.rules.strict;
    let job = Job::start(&parts.jobs.waker, move |_| {
        let SessionDataset { ground_truths, methods, predictions, shown, list, marks, .. } = session;
        // Another version may have had other terms.
        let list = serde_json::from_value(list).unwrap_or_default();
        let named = |all: Vec<SessionMethod>| -> Vec<Method> {
            all.into_iter().map(|one| Method { name: one.name, path: one.path }).collect()
        };
        let source = match (methods.is_empty(), predictions.is_empty()) {
            (_, false) => {
                Source::Predictions { ground_truth: ground_truths, predictions: named(predictions) }
            }
            (true, true) => Source::Table(ground_truths),
            (false, true) => Source::Folders { ground_truths, methods: named(methods) },
        };
        let reading = DatasetReading {
            ground_truths: session.read,
            predictions: session.read_predictions,
            methods: session.read_methods,
            strict,
            ..DatasetReading::default()
        };
        let request = Request::Accuracy { target: session.target_error, seed: session.seed };
        let mut open = OpenDataset::new(source, reading, request, results)?;
        open.settings.diagnose = session.diagnose;
        let wanted = open.cases.iter().position(|case| case.material == shown).unwrap_or(0);
        Ok(opened(DatasetState { list, ..DatasetState::of(Arc::new(open), wanted, marks) }))
    });
    parts.jobs.edits.insert("dataset", job);
}

/// The edit that takes over a data set that has been matched.
fn opened(state: DatasetState) -> Edit {
    Edit::new(|model| {
        model.dialogs.open = None;
        model.open_dataset(state);
    })
}

/// Reads a material and its losses again.
pub(super) fn read_again(parts: &mut Parts, case: usize) {
    let jobs = &mut parts.jobs.dataset;
    if parts.model.dataset.open.as_ref().is_some_and(|open| open.is_of_predictions()) {
        // It may be the ground truth of all.
        jobs.restart();
        return;
    }
    jobs.forget_cases();
    jobs.losses.forget(case);
}

/// Puts the material that was asked for into the window, once it has been read: all of it in one frame, so that nothing of one material
/// is seen beside something of another.
pub(super) fn show(parts: &mut Parts) {
    let dataset = &parts.model.dataset;
    let Some(open) = dataset.open.clone().filter(|_| dataset.is_waiting()) else { return };
    let is_wanted =
        |read: &&Arc<Answered<ReadCase>>| read.case == dataset.wanted && read.pinned == dataset.pinned();
    let Some(read) = parts.jobs.dataset.cases.iter().find(is_wanted).cloned() else { return };
    parts.jobs.uploads.extend(read.uploads.iter().cloned());
    case::show(&mut parts.model, &open, read.case, &read.materials, read.missing.clone());
}
