//! Session of the window: what it starts with, and the comparison that is saved, opened, and remembered for the next start.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use svbrdf_core::loss::FileScenes;
use svbrdf_evaluate::protocols::MaskSource;
use svbrdf_files::convention::ChosenConvention;
use svbrdf_files::photograph::SessionPhotograph;
use svbrdf_files::read::ReadOptions;
use svbrdf_files::session::Session;
use svbrdf_files::session::window::{SessionInspection, SessionWindow};
use svbrdf_files::source::{MaterialSource, Place};

use crate::message::Message;
use crate::model::Effect;
use crate::model::History;
use crate::model::dataset::session::absolute;
use crate::model::dataset::{DatasetState, OpenDataset};
use crate::model::inspection::Inspection;
use crate::model::material::opening::{Opening, Target};
use crate::model::material::read::Rules;
use crate::model::ranges::bring_into_range;
use crate::model::view::{Exposed, ViewState};
use crate::model::{Model, opening};

/// The materials that the window opens, and how it reads them.
#[derive(Clone, Debug, Default)]
pub struct ViewerOptions {
    /// A session, in place of materials.
    pub session: Option<Session>,
    /// `None` for the built-in pair.
    pub ground_truth: Option<MaterialSource>,
    pub predictions: Vec<MaterialSource>,
    /// A data set, in place of materials.
    pub dataset: Option<Box<OpenDataset>>,
    /// The results folder of the data set of the session.
    pub results: Option<PathBuf>,
    /// Whether guesses about materials are errors.
    pub strict: bool,
    /// Whether predictions of another size are resized to the ground truth.
    pub fit: bool,
    /// Which texels are compared, where not all are.
    pub mask: Option<MaskSource>,
    /// A photograph that renderings are compared with, or what lists several.
    pub photograph: Option<PathBuf>,
    /// The convention of renderings and loss; `None` for that of the session or the default.
    pub convention: Option<ChosenConvention>,
    /// The scenes of the loss; `None` for the scenes of the session or the settings.
    pub scenes: Option<FileScenes>,
}

/// Number of comparisons that are remembered.
const RECENT: usize = 12;

impl Model {
    /// Takes in what the window starts with.
    pub fn start(&mut self, options: ViewerOptions) {
        let mask = options.mask.clone();
        self.materials.rules = Rules { strict: options.strict, fit: options.fit, mask };
        let all = options.ground_truth.map(|ground_truth| {
            std::iter::once(ground_truth).chain(options.predictions).collect::<Vec<MaterialSource>>()
        });
        let of_many = || {
            let all = all.as_ref().filter(|_| options.photograph.is_none())?;
            OpenDataset::of_many(all, &self.materials.rules)
        };
        let dataset = options.dataset.map(|open| *open).or_else(of_many);
        match (&options.session, all) {
            (Some(session), _) => self.open_session(session),
            (None, _) if dataset.is_some() => {}
            (None, Some(all)) => self.read(Opening::of_sources(all, Target::Everything)),
            (None, None) => self.read(Opening::built_in()),
        }
        if let Some(dataset) = dataset {
            self.open_dataset(dataset.into());
        }
        // After a session, which may have others.
        options.convention.into_iter().for_each(|convention| self.use_convention(convention));
        options.scenes.into_iter().for_each(|file| self.use_scenes(file));
        let of_session = options.session.and_then(|session| session.dataset).map(Box::new);
        self.effects.extend(of_session.map(|session| Effect::RestoreDataset(session, options.results)));
        if let Some(path) = options.photograph {
            opening::open_photograph(self, path);
        }
    }

    /// Takes a data set as what is open. What could be undone belongs to the last materials.
    pub fn open_dataset(&mut self, dataset: DatasetState) {
        self.dataset = dataset;
        self.materials.rules.mask = None;
        self.history = History::default();
    }

    /// Goes on with a single comparison.
    pub fn close_dataset(&mut self) {
        if self.dataset.open.is_some() {
            self.open_dataset(DatasetState::default());
        }
    }

    /// The current session.
    pub fn session(&self) -> Session {
        let materials = self.materials.all.iter().map(|one| {
            let source = &one.read.source;
            let (place, options) = match &source.place {
                Place::Path(path) => (Place::Path(absolute(path)), one.read.record.options),
                Place::BuiltIn(number) => (Place::BuiltIn(*number), ReadOptions::AUTO),
            };
            MaterialSource { place, options, ..source.clone() }
        });
        let view = &self.view;
        let convention = view.convention.content();
        let mut session = Session::new(materials.collect(), view.scene, convention, view.exposure_ev);
        session.photograph = self
            .photograph
            .source()
            .map(|source| SessionPhotograph { path: absolute(&source.path), ..source.clone() });
        let (display, loss) = (Some(view.display.clone()), Some(self.settings.loss.clone()));
        let inspection =
            Some(SessionInspection::from(&self.inspection)).filter(|one| *one != Default::default());
        session.dataset = self.dataset.session();
        session.mask = self.materials.rules.mask.as_ref().map(|mask| match mask {
            MaskSource::File(path) => absolute(path),
            alpha => alpha.to_string().into(),
        });
        session.window = SessionWindow { display, loss, inspection };
        session
    }

    /// Takes over light, view, display, loss settings and photograph of a session, and begins to read its materials.
    pub fn open_session(&mut self, session: &Session) {
        let convention = ChosenConvention::read(&session.convention);
        self.view = ViewState {
            scene: session.scene,
            convention: ChosenConvention::default(),
            exposure_ev: session.exposure,
            display: session.window.display.clone().unwrap_or_default(),
        };
        self.close_dataset();
        self.exposed = Exposed::Restored;
        if let Some(loss) = &session.window.loss {
            self.settings.loss = loss.clone();
        }
        // Of its materials, once they are there.
        self.inspection = Inspection::default();
        self.inspected_later = session.window.inspection.as_ref().map(Inspection::from);
        match convention {
            Ok(convention) => self.use_convention(convention),
            Err(problem) => self.report([Message::Failed(problem.into())]),
        }
        let out_of_range = bring_into_range(self).map(Message::Warning);
        self.report(out_of_range);
        self.photograph.set(session.photograph.clone());
        let mask = session.mask.as_deref().map(MaskSource::named);
        if self.materials.rules.mask != mask {
            // All have to be read again.
            self.materials.all.clear();
            self.materials.rules.mask = mask;
        }
        self.effects.push(Effect::CheckFiles(Box::new(session.clone())));
        self.read(self.materials.restore(&session.materials));
    }

    /// Remembers the comparison for the next start, unless there are only built-in materials, or some are still being read.
    pub fn remember_session(&mut self) {
        let is_settled = self.materials.openings.is_empty() && !self.dataset.is_waiting();
        if is_settled && !self.materials.only_built_in() {
            let session = self.session();
            let files = compared_files(&session);
            let recent = Arc::make_mut(&mut self.recent);
            recent.retain(|one| compared_files(one) != files);
            recent.insert(0, session);
            recent.truncate(RECENT);
        }
    }
}

/// The files of a comparison.
fn compared_files(session: &Session) -> Vec<PathBuf> {
    // Of a data set, whichever material is shown.
    if let Some(dataset) = &session.dataset {
        return dataset.paths().cloned().collect();
    }
    session.materials.iter().filter_map(|material| material.place.path()).map(Path::to_owned).collect()
}
