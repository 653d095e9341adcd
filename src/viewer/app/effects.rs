//! Effects of commands, carried out.

use std::path::{Path, PathBuf};

use eframe::egui;

use super::App;
use crate::error::Error;
use crate::files::scene_file;
use crate::files::session::{Session, SessionPhotograph};
use crate::files::stamp::Stamp;
use crate::model::scene::Scene;
use crate::photograph::flash;
use crate::viewer::jobs::browse;
use crate::viewer::jobs::why::ComparedPair;
use crate::viewer::model::command::PhotographLight;
use crate::viewer::model::command::effect::{DialogEffect, Effect, LossEffect};
use crate::viewer::model::inspection;
use crate::viewer::model::material::request::ReadRequest;
use crate::viewer::model::message::Message;
use crate::viewer::ui::dialogs::open::OpenDialog;
use crate::viewer::ui::dialogs::photograph::PhotographDialog;
use crate::viewer::ui::dialogs::save::SaveDialog;

impl App {
    /// Carries out what a command has done outside of the model: the only place that does.
    pub(super) fn carry_out(&mut self, ctx: &egui::Context, effect: Effect) {
        match effect {
            Effect::Read(request) => self.read(request),
            Effect::ReadForDialog(request) => {
                let opening = self.jobs.read(&self.model, request);
                if let Some(dialog) = &mut self.ui.dialogs.open {
                    dialog.opening = dialog.submitted.then_some(opening);
                }
            }
            Effect::CancelReading(number) => self.jobs.openings.cancel(number),
            Effect::ReadScenes(paths) => self.jobs.read_scenes(paths),
            Effect::ReadSession(paths) => self.read_session(&paths),
            Effect::OpenPhotograph { photograph, light } => self.open_photograph(photograph, &light),
            Effect::SaveAssumptions(index) => self.save_assumptions(index),
            Effect::RescanTraining => self.jobs.training.scan.again(),
            Effect::ShowStep { index, number } => self.show_step(index, number),
            Effect::MoveStep(by) => self.move_step(by),
            Effect::Loss(effect) => self.carry_out_on_losses(effect),
            Effect::Dialog(effect) => self.carry_out_on_dialogs(effect),
            Effect::Save { kind, path, size } => self.save_file(ctx, kind, path, size),
            Effect::CopyPicture => self.copy_picture(ctx),
            Effect::CopyText { text, what } => self.copy_text(ctx, text, what),
            Effect::CopyLosses => {
                if let Some(text) = self.jobs.loss.losses().map(|losses| losses.report.text()) {
                    self.copy_text(ctx, text, "the losses as text");
                }
            }
            Effect::CopyPins => self.copy_text(ctx, self.pins_csv(), "the pinned texels as CSV"),
            Effect::SetScale(scale) => ctx.set_zoom_factor(scale),
        }
    }

    fn read(&mut self, request: ReadRequest) {
        self.jobs.read(&self.model, request);
    }

    fn carry_out_on_losses(&mut self, effect: LossEffect) {
        let (model, jobs) = (&self.model, &mut self.jobs);
        let (waker, materials, view) = (&jobs.waker, &model.materials, &model.view);
        match effect {
            LossEffect::Compute => jobs.loss.start(waker, materials, &model.loss_query()),
            LossEffect::Cancel => jobs.loss.cancel(),
            LossEffect::StartStudy => {
                jobs.study.start(waker, materials, view.display.prediction, &view.convention());
            }
            LossEffect::EnsureStudy => {
                jobs.study.ensure(waker, materials, view.display.prediction, &view.convention());
            }
            LossEffect::CancelStudy => jobs.study.cancel(),
            LossEffect::FindWorst => {
                if let Some(pair) = ComparedPair::of(&materials.all, view) {
                    jobs.why.search.start(waker, &pair, model.settings.loss.seed);
                }
            }
            LossEffect::CancelSearch => jobs.why.search.cancel(),
        }
    }

    fn carry_out_on_dialogs(&mut self, effect: DialogEffect) {
        let dialogs = &mut self.ui.dialogs;
        match effect {
            DialogEffect::ShowOpen(on) => dialogs.open = on.then(|| OpenDialog::from(self.model.read)),
            DialogEffect::ShowSave(kind) => {
                dialogs.save = kind.map(|kind| SaveDialog::new(kind, self.model.geometry.picture));
            }
            DialogEffect::ShowPhotograph(on) => dialogs.photograph = on.then(PhotographDialog::default),
            DialogEffect::FillPhotograph(path) => {
                dialogs.photograph.iter_mut().for_each(|dialog| dialog.fill(&path));
            }
            DialogEffect::Browse { folder } => {
                self.jobs.browsing = Some(browse::start(&self.jobs.waker, folder));
            }
        }
    }

    /// Opens a session file, which stands alone.
    fn read_session(&mut self, paths: &[PathBuf]) {
        let session = match paths {
            [path] => Session::read(path),
            _ => {
                let problem = "expected a session file alone: it names its materials itself".to_owned();
                Err(Error::BadSession { path: paths[0].clone(), problem })
            }
        };
        match (session, &mut self.ui.dialogs.open) {
            (Ok(session), _) => {
                self.ui.dialogs.open = None;
                let request = self.model.open_session(&session);
                self.jobs.read(&self.model, request);
            }
            (Err(error), Some(dialog)) => dialog.fail(error.to_string()),
            (Err(error), None) => self.model.report([Message::Failed(error)]),
        }
    }

    /// Compares renderings with a photograph, under its light and view.
    fn open_photograph(&mut self, photograph: SessionPhotograph, light: &PhotographLight) {
        let scene = match light {
            PhotographLight::AsNow => Ok(self.model.view.scene),
            PhotographLight::Flash { fov_degrees } => flash(*fov_degrees),
            PhotographLight::File { path, number } => scene_of(path, *number),
        };
        match (scene, &mut self.ui.dialogs.photograph) {
            (Ok(scene), _) => {
                self.ui.dialogs.photograph = None;
                let stamp = Stamp::of(&photograph.path);
                self.model.show_photograph(photograph, stamp, Some(scene));
            }
            (Err(error), Some(dialog)) => dialog.fail(error.to_string()),
            (Err(error), None) => self.model.report([Message::Failed(error)]),
        }
    }

    fn save_assumptions(&mut self, index: usize) {
        match self.model.materials.save_assumptions(index) {
            Ok(Some(request)) => self.read(request),
            Ok(None) => {}
            Err(error) => self.model.report([Message::Failed(error)]),
        }
    }

    /// Puts a text on the clipboard, and reports it.
    fn copy_text(&mut self, ctx: &egui::Context, text: String, what: &'static str) {
        ctx.copy_text(text);
        self.model.report([Message::Copied(what)]);
    }

    /// The numbers of every pin in every material, as CSV.
    fn pins_csv(&self) -> String {
        let (materials, view) = (self.displayed().materials(), &self.model.view);
        let convention = view.convention();
        inspection::csv(self.model.inspection.pins.iter().map(|pin| {
            let all = materials.iter().map(|one| one.material());
            let rows = inspection::rows(all, *pin, &view.scene, &convention);
            (*pin, materials.iter().map(|one| one.name()).zip(rows).collect())
        }))
    }
}

/// Scene `number` of a file.
fn scene_of(path: &Path, number: usize) -> Result<Scene, Error> {
    let scenes = scene_file::read(path)?;
    let problem =
        format!("it lists {} scenes, counted from 0, and number {number} was asked for", scenes.len());
    scenes.get(number).copied().ok_or_else(|| Error::BadScene { path: path.to_owned(), problem })
}
