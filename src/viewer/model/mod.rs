//! The model of the window: materials, view, settings and history, changed by input, by panels and by the results of jobs.
//!
//! What an edit needs outside of it, as a file to be read, it adds to [`Model::effects`].

pub mod blind;
pub mod dataset;
pub mod dialogs;
pub mod display;
pub mod endpoint;
pub mod framing;
pub mod inspection;
pub mod material;
pub mod opening;
pub mod ranges;
pub mod session;
pub mod settings;
pub mod undo;
pub mod view;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use eframe::egui::util::undoer::{Settings as Undoing, Undoer};

use svbrdf_core::loss::FileScenes;
use svbrdf_files::convention::ChosenConvention;
use svbrdf_files::photograph::SessionPhotograph;
use svbrdf_files::session::Session;
use svbrdf_files::session::dataset::SessionDataset;
use svbrdf_files::source::MaterialSource;

use crate::error::Error;
use crate::message::{Message, MessageList};
use crate::model::blind::Blind;
use crate::model::dataset::DatasetState;
use crate::model::dialogs::{Dialogs, SaveRequest};
use crate::model::inspection::Inspection;
use crate::model::material::MaterialList;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::opening::Opening;
use crate::model::material::photograph::PhotographState;
use crate::model::material::read::MaterialId;
use crate::model::settings::Settings;
use crate::model::view::{Exposed, ViewState, WindowGeometry};

/// Everything that is edited in the window. A copy is cheap: what is large is shared.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// Light, view and display: what undo covers.
    pub view: ViewState,
    /// What persists from one start to the next.
    pub settings: Settings,
    /// The sessions of the last comparisons of materials from files, the latest first, for the next start.
    pub recent: Arc<Vec<Session>>,
    pub materials: MaterialList,
    pub dataset: DatasetState,
    pub photograph: PhotographState,
    /// The blind comparison that has the window to itself.
    pub blind: Option<Blind>,
    pub inspection: Inspection,
    /// The inspected texels of a session whose materials are being read.
    pub inspected_later: Option<Inspection>,
    /// Scenes that the tab *Why* lists beyond the first few.
    pub more_scenes: usize,
    /// The prediction whose worst scene is being searched for.
    pub searched: Option<MaterialId>,
    /// What the automatic exposure was last computed for.
    pub exposed: Exposed,
    pub history: History,
    pub messages: MessageList,
    pub dialogs: Dialogs,
    /// What is to be done outside of the model.
    pub effects: Vec<Effect>,
    /// Whether ground truth and chosen prediction have changed places.
    pub swapped: bool,
    /// Whether the help is open.
    pub help: bool,
    /// Whether it is asked if the order of the predictions, or of the methods, survives other questions.
    pub asks_order: bool,
    /// Whether the side panel is open where the window is narrow.
    pub narrow_side_panel: bool,
    /// The conventions of files and sessions that were opened.
    pub conventions: Vec<ChosenConvention>,
    /// What the last frame measured.
    pub geometry: WindowGeometry,
    /// The time of this frame, in seconds.
    pub time: f64,
}

impl Model {
    /// The chosen prediction, if there is one.
    pub fn chosen_prediction(&self) -> Option<&LoadedMaterial> {
        self.materials.predictions().get(self.view.display.prediction)
    }

    /// Whether the side panel is open. Narrow windows have a choice of their own, which starts closed.
    pub fn side_panel(&self) -> bool {
        if self.geometry.is_narrow { self.narrow_side_panel } else { self.settings.side_panel }
    }

    pub fn toggle_side_panel(&mut self) {
        let is_open = match self.geometry.is_narrow {
            true => &mut self.narrow_side_panel,
            false => &mut self.settings.side_panel,
        };
        *is_open ^= true;
    }

    /// Whether a dialog or the help is open: the panes behind it do not move.
    pub fn is_modal(&self) -> bool {
        self.dialogs.is_open() || self.help
    }

    /// Whether methods are compared over materials.
    pub fn has_methods(&self) -> bool {
        self.dataset.open.as_ref().is_some_and(|open| !open.is_of_predictions())
    }

    /// The files of the materials, of the photograph and of the scenes, which nothing that is saved may replace.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        let materials = self.materials.all.iter().flat_map(|material| &material.read.record.files);
        let photograph = self.photograph.source().map(|photograph| photograph.path.as_path());
        let scenes = self.settings.loss.file_scenes().map(|file| file.path.as_path());
        materials.map(PathBuf::as_path).chain(photograph).chain(scenes)
    }

    /// Begins to read materials; a dialog that has asked for them stays open until they are there.
    pub fn read(&mut self, opening: Opening) {
        if let Some(dialog) = self.dialogs.open.as_mut().filter(|dialog| dialog.submitted) {
            dialog.opening = Some(opening.number);
        }
        self.materials.open(opening, self.settings.watch);
    }

    /// Adds messages.
    pub fn report(&mut self, messages: impl IntoIterator<Item = Message>) {
        let now = self.time;
        messages.into_iter().for_each(|message| self.messages.add(message, now));
    }

    /// Reports why something was not opened: in the dialog that has asked for it, where it is open.
    pub fn not_opened(&mut self, error: Error) {
        match &mut self.dialogs.open {
            Some(dialog) => dialog.fail(error.to_string()),
            None => self.report([Message::Failed(error)]),
        }
    }

    /// Reports a file that was written, or why it was not: in the dialog that has asked for it, where it is open.
    pub fn saved(&mut self, result: Result<PathBuf, Error>) {
        match (result, &mut self.dialogs.save) {
            (Ok(path), _) => {
                self.dialogs.save = None;
                let path = std::path::absolute(&path).unwrap_or(path);
                self.report([Message::Done(format!("Saved {}", path.display()))]);
            }
            (Err(error), _) if error.is_cancelled() => {}
            (Err(error), Some(dialog)) => dialog.field.fail(error.to_string()),
            (Err(error), None) => self.report([Message::Failed(error)]),
        }
    }

    /// Takes the scenes of a file as those of the loss.
    pub fn use_scenes(&mut self, file: FileScenes) {
        let text = format!("The loss is over the {} scenes of {}", file.scenes.len(), file.name);
        self.report([Message::Done(text)]);
        self.settings.loss = self.settings.loss.with_file(Some(file));
    }

    /// Takes a convention as that of renderings and loss; one of a file stays in the list of choices.
    pub fn use_convention(&mut self, chosen: ChosenConvention) {
        self.view.convention = chosen.clone();
        if chosen.is_own() {
            self.conventions.retain(|one| one.argument() != chosen.argument());
            self.conventions.push(chosen);
        }
    }

    /// Pans back a material that would be lost from the panes.
    pub fn keep_visible(&mut self) {
        if let Some(ground_truth) = self.materials.ground_truth() {
            self.view.keep_visible(ground_truth.grid());
        }
    }
}

/// What happens outside of the model: files, dialogs of the system, the clipboard. One place of the application carries it out.
#[derive(Clone, Debug)]
pub enum Effect {
    /// Reads scene files.
    ReadScenes(Vec<PathBuf>),
    /// Matches the materials of folders: the first has the ground truths, each other one the predictions of a method; or reads one
    /// table of pairs.
    OpenDataset(Vec<PathBuf>),
    /// Opens the data set of a session, with the losses of a results folder.
    RestoreDataset(Box<SessionDataset>, Option<PathBuf>),
    /// Tells which files have changed since the picture was saved that this session is from.
    CheckFiles(Box<Session>),
    /// Asks with the system's dialog; the choice goes into the path field of the dialog that is open.
    Browse(BrowseFor),
    /// Writes a file.
    Save(SaveRequest),
    /// Puts the view on the clipboard as a picture.
    CopyPicture,
}

/// What the file dialog of the system is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BrowseFor {
    Files,
    Folders,
    /// A file to save.
    Saving,
}

/// How long nothing changes, in seconds, before it becomes a moment to return to: all of a drag is one step.
const STABLE: f32 = 0.4;

/// A moment to return to.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    pub view: ViewState,
    pub materials: Vec<MaterialSource>,
    /// The scenes of a file, where the loss is over them.
    pub scenes: Option<FileScenes>,
    /// The photograph that renderings are compared with.
    pub photograph: Option<SessionPhotograph>,
}

/// The earlier and the later moments.
#[derive(Clone, Debug)]
pub struct History {
    pub moments: Undoer<Arc<Moment>>,
    /// The set of materials in the window, or the one that is being opened.
    pub materials: Vec<MaterialSource>,
}

impl Default for History {
    fn default() -> Self {
        let drags = Undoing { stable_time: STABLE, auto_save_interval: f32::INFINITY, max_undos: 100 };
        Self { moments: Undoer::with_settings(drags), materials: Vec::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn narrow_windows_have_a_side_panel_of_their_own() {
        let mut model = Model::default();
        assert!(model.side_panel());
        model.geometry = WindowGeometry { is_narrow: true, ..WindowGeometry::default() };
        assert!(!model.side_panel());
        model.toggle_side_panel();
        assert!(model.side_panel() && model.settings.side_panel);
        model.geometry.is_narrow = false;
        model.toggle_side_panel();
        assert!(!model.side_panel() && model.narrow_side_panel);
    }
}
