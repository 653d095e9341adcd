//! Commands about files and materials.

use std::path::PathBuf;

use eframe::egui;

use crate::error::Error;
use crate::files::scene_file;
use crate::files::session::Session;
use crate::viewer::app::App;
use crate::viewer::command::MaterialsCommand;
use crate::viewer::message::Message;
use crate::viewer::slots::Target;
use crate::viewer::source::{Source, sources};
use crate::viewer::worker::Task;

impl App {
    pub(super) fn apply_to_materials(&mut self, ctx: &egui::Context, command: MaterialsCommand) {
        let gpu = self.gpu.as_ref().map(|g| &g.gpu);
        match command {
            // First: the scenes of a file replace the scenes of a session.
            MaterialsCommand::Open { paths, replace, read }
                if paths.iter().any(|path| scene_file::is_named(path)) =>
            {
                let (files, paths): (Vec<_>, Vec<_>) =
                    paths.into_iter().partition(|path| scene_file::is_named(path));
                self.open_scene_file(ctx, files);
                if !paths.is_empty() {
                    self.apply_to_materials(ctx, MaterialsCommand::Open { paths, replace, read });
                }
            }
            MaterialsCommand::Open { paths, .. } if paths.iter().any(|path| Session::is_named(path)) => {
                self.open_session_file(ctx, &paths);
            }
            MaterialsCommand::ReopenLast => match self.settings.last.clone() {
                Some(session) => {
                    self.open_window = None;
                    self.open_session(ctx, &session);
                }
                None => self.report([Message::NothingToReopen]),
            },
            MaterialsCommand::Open { paths, replace, read } => {
                self.read = read;
                let target = if replace { Target::Everything } else { Target::Predictions };
                let (first, predictions) = paths.split_at(usize::from(replace).min(paths.len()));
                let first = first.iter().map(|path| Source::file(path.clone(), read));
                let sources = first.chain(sources(predictions, read)).collect();
                let opening = self.slots.open(ctx, gpu, sources, target);
                if let Some(window) = &mut self.open_window {
                    window.opening = window.submitted.then_some(opening);
                }
            }
            MaterialsCommand::OpenAgain(source) => {
                self.slots.open(ctx, gpu, vec![*source], Target::Predictions);
            }
            MaterialsCommand::OpenBuiltIn => self.slots.open_built_in(ctx, gpu),
            MaterialsCommand::Reload => {
                self.slots.reload(ctx, gpu, None);
                self.training.scan.again();
            }
            MaterialsCommand::ReadAs { slot, read } => self.slots.read_as(ctx, gpu, slot, read),
            MaterialsCommand::SaveAssumptions { slot } => {
                let saved = self.slots.save_assumptions(ctx, gpu, slot);
                self.report(saved.err().map(Message::Failed));
            }
            MaterialsCommand::Close(slot) => self.close_prediction(slot),
            MaterialsCommand::MakeGroundTruth(slot) => self.slots.make_ground_truth(slot),
            MaterialsCommand::SetWatch(on) => self.settings.watch = on,
            MaterialsCommand::SetFit(on) => self.slots.rules.fit = on,
        }
    }

    /// Opens a session file, which stands alone.
    fn open_session_file(&mut self, ctx: &egui::Context, paths: &[PathBuf]) {
        let session = match paths {
            [path] => Session::read(path),
            _ => {
                let problem = "expected a session file alone: it names its materials itself".to_owned();
                Err(Error::BadSession { path: paths[0].clone(), problem })
            }
        };
        match (session, &mut self.open_window) {
            (Ok(session), _) => {
                self.open_window = None;
                self.open_session(ctx, &session);
            }
            (Err(error), Some(window)) => window.fail(error.to_string()),
            (Err(error), None) => self.report([Message::Failed(error)]),
        }
    }

    /// Starts to read a scene file.
    fn open_scene_file(&mut self, ctx: &egui::Context, paths: Vec<PathBuf>) {
        self.scene_file = Some(Task::start(ctx, move |_| {
            let read = scene_file::read_one(&paths)?;
            read.ok_or_else(|| Error::Internal("there is no scene file".to_owned()))
        }));
    }

    /// Closes the material in slot `slot`; the chosen prediction stays the same one where it can.
    fn close_prediction(&mut self, slot: usize) {
        self.slots.close(slot);
        let state = &mut self.state;
        if slot <= state.prediction {
            state.prediction = state.prediction.saturating_sub(1);
        }
        state.prediction = state.prediction.min(self.slots.predictions().len().saturating_sub(1));
    }
}
