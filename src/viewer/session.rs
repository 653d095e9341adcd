//! The session of the window: saved, opened, and remembered for the next start.

use eframe::egui;
use serde::Serialize;
use serde_json::{Map, Value};

use super::app::App;
use super::loaded::Rules;
use super::options::ViewerOptions;
use super::slots::Target;
use super::source::{Origin, Source, sources};
use super::state::ViewState;
use crate::files::read::ReadOptions;
use crate::files::session::{Session, SessionMaterial, SessionPhotograph};
use crate::files::steps::RunId;

/// The fields of the view that are in the session itself.
const ELSEWHERE: [&str; 3] = ["scene", "convention", "exposure_ev"];

impl App {
    /// Starts to read what the window starts with.
    pub(super) fn open_first(&mut self, ctx: &egui::Context, mut options: ViewerOptions) {
        let (photograph, scenes) = (options.photograph.take(), options.scenes.take());
        self.open_first_materials(ctx, options);
        // After a session, which may have others.
        photograph.into_iter().for_each(|(photograph, scene)| self.show_photograph(photograph, scene));
        scenes.into_iter().for_each(|file| self.use_scenes(file));
    }

    fn open_first_materials(&mut self, ctx: &egui::Context, options: ViewerOptions) {
        self.slots.rules = Rules { strict: options.strict, fit: options.fit };
        if let Some(session) = &options.session {
            return self.open_session(ctx, session);
        }
        let Some(ground_truth) = options.ground_truth else {
            return self.slots.open_built_in(ctx, self.gpu.as_ref().map(|g| &g.gpu));
        };
        let predictions = sources(&options.predictions, options.prediction_read);
        let ground_truth = Source::file(ground_truth, options.ground_truth_read);
        let sources = std::iter::once(ground_truth).chain(predictions).collect();
        self.slots.open(ctx, self.gpu.as_ref().map(|g| &g.gpu), sources, Target::Everything);
    }

    /// The current session.
    pub(super) fn session(&self) -> Session {
        let materials = self.slots.slots.iter().map(|slot| {
            let (path, built_in) = match &slot.loaded.origin {
                Origin::Path(path) => {
                    (Some(std::path::absolute(path).unwrap_or_else(|_| path.clone())), None)
                }
                Origin::BuiltIn(number) => (None, Some(*number)),
            };
            let read = if built_in.is_some() { ReadOptions::AUTO } else { slot.loaded.read };
            let steps = slot.loaded.run.is_some();
            SessionMaterial { path, built_in, read, fit: slot.loaded.fit, steps }
        });
        let state = &self.state;
        let convention = state.convention.clone();
        let mut session = Session::new(materials.collect(), state.scene, convention, state.exposure_ev);
        session.photograph = self.photograph.source().map(|source| SessionPhotograph {
            path: std::path::absolute(&source.path).unwrap_or_else(|_| source.path.clone()),
            ..source.clone()
        });
        let mut view = value(state);
        if let Some(view) = view.as_object_mut() {
            ELSEWHERE.iter().for_each(|key| drop(view.remove(*key)));
        }
        session.window = Map::from_iter([
            (Session::VIEW.to_owned(), view),
            (Session::LOSS.to_owned(), value(&self.settings.loss)),
        ]);
        session
    }

    /// Opens the materials of a session, and shows them as it does.
    pub(super) fn open_session(&mut self, ctx: &egui::Context, session: &Session) {
        let view: ViewState = session.window_part(Session::VIEW).unwrap_or_default();
        let (convention, exposure_ev) = (session.convention.clone(), session.exposure);
        self.state = ViewState { scene: session.scene, convention, exposure_ev, ..view };
        if let Some(loss) = session.window_part(Session::LOSS) {
            self.settings.loss = loss;
        }
        self.photograph.set(session.photograph.clone());
        let sources: Vec<_> = session.materials.iter().filter_map(source).collect();
        // They show the step that was saved, whatever has come since.
        self.training.held.extend(sources.iter().filter_map(|source| source.run.clone()));
        let gpu = self.gpu.as_ref().map(|g| &g.gpu);
        self.slots.restore(ctx, gpu, &sources);
    }

    /// Remembers the session for the next start, unless there are only built-in materials.
    pub(super) fn remember_session(&mut self) {
        if !self.slots.only_built_in() && self.slots.openings.is_empty() {
            self.settings.last = Some(self.session());
        }
    }
}

fn source(material: &SessionMaterial) -> Option<Source> {
    let (origin, run) = match (&material.path, material.built_in) {
        (Some(path), _) => {
            let run = RunId::of_step(path).filter(|_| material.steps);
            (Origin::Path(path.clone()), run.map(|(run, _)| run))
        }
        (None, number) => return number.map(Source::built_in),
    };
    let (read, fit) = (material.read, material.fit);
    Some(Source { origin, asked: read, exactly: Some(read), fit, run })
}

fn value(of: &impl Serialize) -> Value {
    serde_json::to_value(of).unwrap_or_default()
}
