//! Edits of which materials are open, and how they are read.

use std::path::{Path, PathBuf};

use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_evaluate::dataset::{Case, Source};
use svbrdf_files::convention::{self, ChosenConvention};
use svbrdf_files::disk::open::allow_outside;
use svbrdf_files::photograph::Capture;
use svbrdf_files::read::{MaterialPath, ReadOptions};
use svbrdf_files::session::Session;
use svbrdf_files::source::MaterialSource;
use svbrdf_files::{Error as FilesError, scene_file};

use crate::message::Retry;
use crate::model::Effect;
use crate::model::Model;
use crate::model::dataset::OpenDataset;
use crate::model::material::opening::{Opening, Target};

/// Opens materials: the first as ground truth where there is none or where `replace` is set, the others as predictions. Scene files,
/// conventions, sessions and data sets among them are what they are.
pub fn open(model: &mut Model, mut paths: Vec<PathBuf>, replace: bool, read: ReadOptions) {
    let is_scenes = |path: &PathBuf| scene_file::is_named(path);
    if replace && !paths.iter().all(|path| is_scenes(path) || convention::is_file(path)) {
        model.close_dataset();
        model.materials.rules.mask = None;
    }
    let read = if replace || read != ReadOptions::AUTO { read } else { model.materials.read_of_added() };
    // First: the scenes or the convention of a file replace those of a session.
    while let Some(at) = paths.iter().position(|path| convention::is_file(path)) {
        read_convention(model, &paths.remove(at));
    }
    let (files, paths): (Vec<_>, Vec<_>) = paths.into_iter().partition(is_scenes);
    if !files.is_empty() {
        model.effects.push(Effect::ReadScenes(files));
    }
    if paths.is_empty() {
        return;
    }
    if Session::is_among(&paths) {
        return read_session(model, &paths);
    }
    if is_dataset(&paths) {
        return model.effects.push(Effect::OpenDataset(paths));
    }
    if let Some(many) = many(model, &paths, replace, read) {
        model.dialogs.open = None;
        return model.open_dataset(many.into());
    }
    let target = if replace { Target::Everything } else { Target::Predictions };
    let material = |path: &PathBuf| MaterialSource::path(path.clone(), read);
    model.read(Opening::of_sources(paths.iter().map(material), target));
}

/// Renders and compares by the convention of a file.
fn read_convention(model: &mut Model, path: &Path) {
    match ChosenConvention::read(&path.to_string_lossy()) {
        Ok(convention) => {
            model.dialogs.open = None;
            model.use_convention(convention);
        }
        Err(error) => model.not_opened(error.into()),
    }
}

/// Opens a session file, which stands alone.
fn read_session(model: &mut Model, paths: &[PathBuf]) {
    let session = match paths {
        [path] => Session::read(path),
        _ => {
            let problem = "expected a session file alone: it names its materials itself".to_owned();
            Err(FilesError::BadSession { path: paths[0].clone(), problem })
        }
    };
    match session {
        Ok(session) => restore(model, session),
        Err(error) => {
            if matches!(error, FilesError::Outside { .. }) {
                // Asked in the window, where it can be allowed.
                model.dialogs.open = None;
            }
            model.not_opened(error.into());
        }
    }
}

/// Opens a session, as it was shown.
fn restore(model: &mut Model, session: Session) {
    model.dialogs.open = None;
    model.open_session(&session);
    let dataset = session.dataset.map(|dataset| Effect::RestoreDataset(Box::new(dataset), None));
    model.effects.extend(dataset);
}

/// Opens the recent comparison in this place.
pub fn reopen(model: &mut Model, index: usize) {
    if let Some(session) = model.recent.get(index).cloned() {
        model.close_dataset();
        restore(model, session);
    }
}

/// Makes the material at `index` the ground truth of the others. The methods of a data set have its own.
pub fn make_ground_truth(model: &mut Model, index: usize) {
    if model.dataset.open.is_none() {
        model.materials.make_ground_truth(index);
        if model.materials.rules.mask.is_some() {
            model.read(Opening::of_sources(model.materials.sources(), Target::Everything));
        }
    }
}

/// Compares renderings with the photograph at this path, under the light and view of the window; or with the first of those that a
/// folder or a JSON file lists, under its own.
pub fn open_photograph(model: &mut Model, path: PathBuf) {
    match Capture::is_named(&path).then(|| Capture::read(&path)).transpose() {
        Ok(capture) => {
            model.dialogs.open = None;
            let view = &mut model.view;
            view.scene = model.photograph.open(path, capture).unwrap_or(view.scene);
            view.display.quantity = Quantity::Rendering;
            if view.is_computed() {
                // Of the ground truth: there are no photographs of all scenes, and FLIP is not computed beside one.
                view.display.differences.choose(Quantity::Rendering, Difference::Log);
            }
        }
        Err(error) => model.not_opened(error.into()),
    }
}

/// Compares with the photograph of this number of those that are listed, under its light and view.
pub fn choose_photograph(model: &mut Model, index: usize) {
    model.view.scene = model.photograph.choose(index).unwrap_or(model.view.scene);
}

/// Opens the built-in materials in the place of all others.
pub fn open_built_in(model: &mut Model) {
    model.close_dataset();
    model.materials.rules.mask = None;
    model.read(Opening::built_in());
}

/// Opens again what was refused.
pub fn retry(model: &mut Model, retry: Retry) {
    match retry {
        Retry::Fitted(source) => {
            let source = MaterialSource { fit: true, ..*source };
            model.read(Opening::of_sources([source], Target::Predictions));
        }
        Retry::Outside(path, read) => {
            allow_outside();
            open(model, vec![path], false, read);
        }
    }
}

/// Reads all files again.
pub fn reload(model: &mut Model) {
    if model.dataset.open.is_some() {
        model.dataset.newer.insert(model.dataset.wanted);
        model.dataset.newer.clone().into_iter().for_each(|case| model.dataset.read_again(case));
    } else {
        model.materials.reload(None).into_iter().for_each(|opening| model.read(opening));
    }
}

/// Reads the material at this index again under other assumptions.
pub fn read_as(model: &mut Model, index: usize, read: ReadOptions) {
    if let Some(opening) = model.materials.read_as(index, read) {
        model.read(opening);
    }
}

/// Closes the prediction at `index`; the chosen prediction stays the same one where it can.
pub fn close(model: &mut Model, index: usize) {
    model.materials.close(index);
    let display = &mut model.view.display;
    if index <= display.prediction {
        display.prediction = display.prediction.saturating_sub(1);
    }
    display.corrected = None;
    display.prediction = display.prediction.min(model.materials.predictions().len().saturating_sub(1));
}

/// The list of predictions that there are, where these make them too many for panes.
fn many(model: &Model, paths: &[PathBuf], replace: bool, read: ReadOptions) -> Option<OpenDataset> {
    let open = if replace { &[][..] } else { &model.materials.all };
    let present = open.iter().map(|one| one.read.source.clone());
    let new = paths.iter().map(|path| MaterialSource::path(path.clone(), read));
    let all: Vec<_> = present.chain(new).collect();
    let is_possible = model.dataset.open.is_none() && model.photograph.source().is_none();
    OpenDataset::of_many(&all, &model.materials.rules).filter(|_| is_possible)
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
