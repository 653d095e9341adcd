//! Commands about files and materials.

use std::path::PathBuf;

use svbrdf_evaluate::dataset::{Case, Source};
use svbrdf_files::convention;
use svbrdf_files::read::{MaterialPath, ReadOptions};
use svbrdf_files::scene_file;
use svbrdf_files::session::Session;
use svbrdf_files::source::MaterialSource;

use crate::model::Model;
use crate::model::command::effect::Effect;
use crate::model::command::{MaterialsCommand, WindowCommand};
use crate::model::dataset::OpenDataset;
use crate::model::material::request::{ReadRequest, Target};

pub(super) fn apply(model: &mut Model, command: MaterialsCommand) -> Vec<Effect> {
    if replaces_all(&command) {
        model.close_dataset();
    }
    let materials = &mut model.materials;
    match command {
        MaterialsCommand::Open { paths, replace, read } => open(model, paths, replace, read),
        MaterialsCommand::OpenAgain(source) => {
            vec![Effect::Read(ReadRequest::new(vec![*source], Target::Predictions))]
        }
        MaterialsCommand::AllowOutside { paths, read } => {
            let opened = open(model, paths, false, read);
            std::iter::once(Effect::AllowOutside).chain(opened).collect()
        }
        MaterialsCommand::OpenBuiltIn => {
            vec![Effect::Read(ReadRequest::built_in())]
        }
        MaterialsCommand::CancelReading(number) => vec![Effect::CancelReading(number)],
        MaterialsCommand::Reopen(index) => reopen(model, index),
        MaterialsCommand::Reload if model.dataset.open.is_some() => {
            model.dataset.is_stale = true;
            vec![Effect::ReadCaseAgain(model.dataset.wanted)]
        }
        MaterialsCommand::Reload => materials.reload(None).into_iter().map(Effect::Read).collect(),
        MaterialsCommand::ReadAs { index, read } => {
            materials.read_as(index, read).map(Effect::Read).into_iter().collect()
        }
        MaterialsCommand::SaveAssumptions { index } => vec![Effect::SaveAssumptions(index)],
        MaterialsCommand::Close(index) => {
            close(model, index);
            Vec::new()
        }
        MaterialsCommand::MakeGroundTruth(index) => {
            materials.make_ground_truth(index);
            Vec::new()
        }
        MaterialsCommand::SetWatch(on) => {
            model.settings.watch = on;
            Vec::new()
        }
    }
}

fn open(model: &mut Model, paths: Vec<PathBuf>, replace: bool, read: ReadOptions) -> Vec<Effect> {
    let read = if replace || read != ReadOptions::AUTO { read } else { model.materials.read_of_added() };
    // First: the scenes or the convention of a file replace those of a session.
    if let Some(at) = paths.iter().position(|path| convention::is_file(path)) {
        let mut paths = paths;
        let mut effects = vec![Effect::ReadConvention(paths.remove(at))];
        if !paths.is_empty() {
            effects.extend(open(model, paths, replace, read));
        }
        return effects;
    }
    if paths.iter().any(|path| scene_file::is_named(path)) {
        let (files, paths): (Vec<_>, Vec<_>) = paths.into_iter().partition(|path| scene_file::is_named(path));
        let mut effects = vec![Effect::ReadScenes(files)];
        if !paths.is_empty() {
            effects.extend(open(model, paths, replace, read));
        }
        return effects;
    }
    if paths.iter().any(|path| Session::is_named(path)) {
        return vec![Effect::ReadSession(paths)];
    }
    if is_dataset(&paths) {
        return vec![Effect::OpenDataset(paths)];
    }
    if let Some(many) = many(model, &paths, replace, read) {
        return vec![Effect::OpenMany(Box::new(many))];
    }
    let target = if replace { Target::Everything } else { Target::Predictions };
    let material = |path: &PathBuf| MaterialSource::path(path.clone(), read);
    let sources = paths.iter().map(material).collect();
    vec![Effect::ReadForDialog(ReadRequest::new(sources, target))]
}

/// The list of predictions that there are, where these make them too many for panes.
fn many(model: &Model, paths: &[PathBuf], replace: bool, read: ReadOptions) -> Option<OpenDataset> {
    let open = if replace { &[][..] } else { &model.materials.all };
    let present = open.iter().map(|one| one.read.source.clone());
    let new = paths.iter().map(|path| MaterialSource::path(path.clone(), read));
    let all: Vec<_> = present.chain(new).collect();
    let is_possible = model.dataset.open.is_none() && model.photograph.source().is_none();
    OpenDataset::of_many(&all, model.materials.rules).filter(|_| is_possible)
}

/// Whether a command puts other materials into the place of those in the window.
fn replaces_all(command: &MaterialsCommand) -> bool {
    match command {
        MaterialsCommand::Open { paths, replace, .. } => {
            *replace && !paths.iter().all(|path| scene_file::is_named(path) || convention::is_file(path))
        }
        MaterialsCommand::OpenBuiltIn | MaterialsCommand::Reopen(_) => true,
        _ => false,
    }
}

/// Whether these are folders of materials of the same names, and the first is no material itself.
fn is_dataset(paths: &[PathBuf]) -> bool {
    let [first, methods @ ..] = paths else { return false };
    let are_folders = !methods.is_empty() && paths.iter().all(|path| path.is_dir());
    if !are_folders || MaterialPath::new(first, &ReadOptions::AUTO).dependencies().is_ok() {
        return false;
    }
    let source = Source::folders(first.clone(), methods.iter().map(|path| (None, path.clone())).collect());
    let is_there = |case: &Case| case.candidates.iter().any(|one| one.missing.is_none());
    source.cases().is_ok_and(|cases| cases.iter().any(is_there))
}

/// Opens a recent comparison as it was shown.
fn reopen(model: &mut Model, index: usize) -> Vec<Effect> {
    let Some(session) = model.recent.get(index).cloned() else { return Vec::new() };
    let mut effects = vec![Effect::Window(WindowCommand::ShowOpen(false))];
    effects.push(Effect::Read(model.open_session(&session)));
    effects.extend(session.dataset.map(|dataset| Effect::RestoreDataset(Box::new(dataset), None)));
    effects
}

/// Closes the prediction at `index`; the chosen prediction stays the same one where it can.
fn close(model: &mut Model, index: usize) {
    model.materials.close(index);
    let view = &mut model.view;
    if index <= view.display.prediction {
        view.display.prediction = view.display.prediction.saturating_sub(1);
    }
    view.display.corrected = None;
    view.display.prediction =
        view.display.prediction.min(model.materials.predictions().len().saturating_sub(1));
}
