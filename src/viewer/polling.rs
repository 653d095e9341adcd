//! The results of reading, saving and browsing, taken over.

use std::path::PathBuf;

use eframe::egui;

use super::app::App;
use super::browse::Browsed;
use super::command::{Command, MaterialsCommand, PhotographCommand};
use super::message::Message;
use super::watch::Change;
use crate::files::read::ReadOptions;
use crate::loss::FileScenes;

/// What to do without a file dialog.
const NO_DIALOG: &str = "This system has no file dialog: install zenity or a desktop portal. Type a path here, or drop files \
                         on the window.";

impl App {
    pub(super) fn poll_readings(&mut self, ctx: &egui::Context) {
        let problems = self.slots.poll(ctx);
        for path in std::mem::take(&mut self.slots.read) {
            self.messages.settle(&path);
        }
        let opened = std::mem::take(&mut self.slots.opened);
        opened.iter().rev().for_each(|path| self.settings.remember(path));
        let asked = self.open_window.as_ref().and_then(|window| window.opening);
        let mut is_told = false;
        for problem in problems {
            match (&problem, &mut self.open_window) {
                // The dialog stays open, with its text.
                (Message::NotRead { error, opening, .. }, Some(window)) if asked == Some(*opening) => {
                    window.fail(error.to_string());
                    is_told = true;
                }
                (Message::NotOpened(_), _) if is_told => {}
                _ => self.report([problem]),
            }
        }
        let of_dialog = self.slots.openings.iter().find(|opening| Some(opening.id) == asked);
        if asked.is_some() && !is_told && of_dialog.is_none_or(|opening| opening.arrived > 0) {
            self.open_window = None;
        }
    }

    /// Reads files that have changed again, and marks materials whose files are gone.
    pub(super) fn follow_files(&mut self, ctx: &egui::Context) {
        let gpu = self.gpu.as_ref().map(|g| &g.gpu);
        for (index, change) in self.watch.poll(ctx, &self.slots) {
            match change {
                Change::Changed => self.slots.reload(ctx, gpu, Some(&[index])),
                Change::Gone(path) => {
                    let problem =
                        format!("{} is gone; the material is as it was read before", path.display());
                    self.slots.slots[index].problem = Some(problem);
                }
                Change::Back => self.slots.slots[index].problem = None,
            }
        }
    }

    pub(super) fn poll_saving(&mut self, ctx: &egui::Context) {
        let Some(result) = self.saving.as_ref().and_then(|job| job.poll(ctx)) else { return };
        self.saving = None;
        match (result, &mut self.save_window) {
            (Ok(path), _) => {
                self.save_window = None;
                self.report([Message::Saved(std::path::absolute(&path).unwrap_or(path))]);
            }
            (Err(error), Some(window)) => window.fail(error.to_string()),
            (Err(error), None) => self.report([Message::Failed(error)]),
        }
    }

    /// Takes over a scene file that has been read.
    pub(super) fn poll_scene_file(&mut self, ctx: &egui::Context) {
        let Some(result) = self.scene_file.as_ref().and_then(|job| job.poll(ctx)) else { return };
        self.scene_file = None;
        match (result, &mut self.open_window) {
            (Ok(file), _) => {
                self.open_window = None;
                self.use_scenes(file);
            }
            (Err(error), Some(window)) => window.fail(error.to_string()),
            (Err(error), None) => self.report([Message::Failed(error)]),
        }
    }

    /// Computes the loss over the scenes of a file.
    pub(super) fn use_scenes(&mut self, file: FileScenes) {
        self.report([Message::ScenesOpened(file.name.clone(), file.scenes.len())]);
        self.settings.loss = self.settings.loss.with_file(Some(file));
    }

    pub(super) fn poll_browsing(&mut self, ctx: &egui::Context) {
        let Some(result) = self.browsing.as_ref().and_then(|job| job.poll(ctx)) else { return };
        self.browsing = None;
        if let Some(window) = &mut self.photograph_window {
            match result {
                Ok(Browsed::Chosen(paths)) => {
                    paths.first().into_iter().for_each(|path| window.path = path.display().to_string());
                }
                Ok(Browsed::Cancelled) => {}
                Ok(Browsed::Unavailable) => window.fail(NO_DIALOG.to_owned()),
                Err(error) => window.fail(error.to_string()),
            }
            return;
        }
        let window = self.open_window.get_or_insert_default();
        match result {
            Ok(Browsed::Chosen(paths)) => {
                paths.iter().for_each(|path| window.add(&path.display().to_string()));
            }
            Ok(Browsed::Cancelled) => {}
            Ok(Browsed::Unavailable) => window.fail(NO_DIALOG.to_owned()),
            Err(error) => window.fail(error.to_string()),
        }
    }

    /// Opens the files that were dropped on the window.
    pub(super) fn dropped(&self, ctx: &egui::Context) -> Option<Command> {
        let paths: Vec<PathBuf> =
            ctx.input(|i| i.raw.dropped_files.iter().map(|f| f.path().to_owned()).collect());
        if let (Some(path), Some(_)) = (paths.first(), &self.photograph_window) {
            return Some(PhotographCommand::Fill(path.clone()).into());
        }
        (!paths.is_empty()).then(|| self.opened_from_outside(paths).into())
    }

    /// Opens files that were dropped or pasted: in place of the built-in materials, otherwise as predictions.
    pub(super) fn opened_from_outside(&self, paths: Vec<PathBuf>) -> MaterialsCommand {
        MaterialsCommand::Open { paths, replace: self.slots.only_built_in(), read: ReadOptions::AUTO }
    }
}
