//! Results of reading, saving, browsing and watching, taken over into the model and the dialogs.

use eframe::egui;

use super::App;
use crate::viewer::jobs::reading::watch::Change;
use crate::viewer::model::material::problem::MaterialProblem;
use crate::viewer::model::message::Message;

impl App {
    /// Takes over the results that have arrived since the last frame.
    pub(super) fn take_results(&mut self, ctx: &egui::Context) {
        if let Some(seconds) = self.model.messages.expire(self.model.time) {
            ctx.request_repaint_after_secs(seconds as f32);
        }
        self.take_materials();
        let error = self.jobs.study.poll();
        self.model.report(error.map(Message::Failed));
        let fault = self.gpu.as_ref().and_then(|gpu| gpu.gpu.take_fault());
        self.model.report(fault.map(Message::Failed));
        self.take_saved();
        self.take_browsed();
        self.take_scene_file();
        if self.model.settings.watch {
            self.follow_files();
        } else {
            self.jobs.watch.stop();
        }
        self.follow_training();
    }

    fn take_materials(&mut self) {
        let mut problems = Vec::new();
        let (jobs, materials) = (&mut self.jobs, &mut self.model.materials);
        let errors = jobs
            .openings
            .take(&mut jobs.uploads, |place, arrival| materials.place(place, arrival, &mut problems));
        for path in std::mem::take(&mut self.model.materials.read) {
            self.model.messages.settle(&path);
        }
        let opened = std::mem::take(&mut self.model.materials.opened);
        opened.iter().rev().for_each(|path| self.model.settings.remember(path));
        self.report_problems(problems);
        self.model.report(errors.into_iter().map(Message::Failed));
    }

    /// Reports problems with materials: those of the open dialog in the dialog, which stays open with its text.
    fn report_problems(&mut self, problems: Vec<MaterialProblem>) {
        let asked = self.ui.dialogs.open.as_ref().and_then(|dialog| dialog.opening);
        let mut is_told = false;
        for problem in problems {
            match (&problem, &mut self.ui.dialogs.open) {
                (MaterialProblem::NotRead { error, opening, .. }, Some(dialog))
                    if asked == Some(*opening) =>
                {
                    dialog.fail(error.to_string());
                    is_told = true;
                }
                (MaterialProblem::NotOpened(_), _) if is_told => {}
                _ => self.model.report([problem.into()]),
            }
        }
        if asked.is_some_and(|opening| !self.jobs.openings.is_waiting(opening)) && !is_told {
            self.ui.dialogs.open = None;
        }
    }

    /// Reads files that have changed again, and marks materials whose files are gone.
    fn follow_files(&mut self) {
        for (index, change) in self.jobs.watch.poll(&self.jobs.waker, &self.model.materials) {
            let material = &mut self.model.materials.all[index];
            match change {
                Change::Changed => {
                    for request in self.model.materials.reload(Some(&[index])) {
                        self.jobs.read(&self.model, request);
                    }
                }
                Change::Gone(path) => {
                    let problem =
                        format!("{} is gone; the material is as it was read before", path.display());
                    material.problem = Some(problem);
                }
                Change::Back => material.problem = None,
            }
        }
    }

    fn take_saved(&mut self) {
        let Some(result) = self.jobs.saving.as_ref().and_then(|job| job.poll()) else { return };
        self.jobs.saving = None;
        match (result, &mut self.ui.dialogs.save) {
            (Ok(path), _) => {
                self.ui.dialogs.save = None;
                self.model.report([Message::Saved(std::path::absolute(&path).unwrap_or(path))]);
            }
            (Err(error), Some(dialog)) => dialog.fail(error.to_string()),
            (Err(error), None) => self.model.report([Message::Failed(error)]),
        }
    }

    fn take_scene_file(&mut self) {
        let Some(result) = self.jobs.scene_file.as_ref().and_then(|job| job.poll()) else { return };
        self.jobs.scene_file = None;
        match (result, &mut self.ui.dialogs.open) {
            (Ok(file), _) => {
                self.ui.dialogs.open = None;
                self.model.use_scenes(file);
            }
            (Err(error), Some(dialog)) => dialog.fail(error.to_string()),
            (Err(error), None) => self.model.report([Message::Failed(error)]),
        }
    }

    fn take_browsed(&mut self) {
        let Some(result) = self.jobs.browsing.as_ref().and_then(|job| job.poll()) else { return };
        self.jobs.browsing = None;
        self.ui.dialogs.browsed(result);
    }
}
