//! Effects of commands, carried out.

use std::path::{Path, PathBuf};

use eframe::egui;

use svbrdf_evaluate::report::Report as _;
use svbrdf_files::Error as FilesError;
use svbrdf_files::convention::ChosenConvention;
use svbrdf_files::disk::open::allow_outside;
use svbrdf_files::photograph::Capture;
use svbrdf_files::session::Session;

use super::parts::Parts;
use super::{dataset, saving};
use crate::jobs::browse;
use crate::jobs::why::ComparedPair;
use crate::jobs::work::job::Job;
use crate::model::command::effect::Effect;
use crate::model::command::{LossCommand, WhyCommand, WindowCommand};
use crate::model::material::request::ReadRequest;
use crate::model::message::Message;
use crate::model::settings::save_kind::SaveKind;
use crate::ui::dialogs::open::OpenDialog;
use crate::ui::dialogs::save::SaveDialog;

/// Carries out what a command has done outside of the model: the only place that does.
pub(super) fn carry_out(parts: &mut Parts, ctx: &egui::Context, effect: Effect) {
    match effect {
        Effect::Read(request) => read(parts, request),
        Effect::ReadForDialog(request) => {
            let opening = parts.jobs.read(&parts.model, request);
            if let Some(dialog) = &mut parts.ui.dialogs.open {
                dialog.opening = dialog.submitted.then_some(opening);
            }
        }
        Effect::CancelReading(number) => parts.jobs.openings.cancel(number),
        Effect::AllowOutside => allow_outside(),
        Effect::ReadConvention(path) => read_convention(parts, &path),
        Effect::ReadScenes(paths) => parts.jobs.read_scenes(paths),
        Effect::OpenDataset(paths) => dataset::open(parts, paths),
        Effect::OpenMany(open) => dataset::open_many(parts, *open),
        Effect::ReadCaseAgain(case) => dataset::read_again(parts, case),
        Effect::RestoreDataset(session, results) => dataset::restore(parts, *session, results),
        Effect::ReadSession(paths) => read_session(parts, &paths),
        Effect::OpenPhotograph(path) => open_photograph(parts, path),
        Effect::SaveAssumptions(index) => save_assumptions(parts, index),
        Effect::Loss(command) => apply_to_losses(parts, ctx, &command),
        Effect::Why(command) => apply_to_search(parts, command),
        Effect::Window(command) => apply_to_window(parts, ctx, command),
        Effect::CopyText { text, what } => copy_text(parts, ctx, text, what),
    }
}

fn read(parts: &mut Parts, request: ReadRequest) {
    parts.jobs.read(&parts.model, request);
}

fn apply_to_losses(parts: &mut Parts, ctx: &egui::Context, command: &LossCommand) {
    let (model, jobs) = (&parts.model, &mut parts.jobs);
    match command {
        LossCommand::Compute => jobs.loss.start(&jobs.waker, &model.materials, &model.loss_query()),
        LossCommand::Cancel => jobs.loss.cancel(),
        LossCommand::Copy => {
            if let Some(text) = jobs.loss.losses().map(|losses| losses.report.text()) {
                copy_text(parts, ctx, text, "the losses as text");
            }
        }
        _ => {}
    }
}

fn apply_to_search(parts: &mut Parts, command: WhyCommand) {
    let (model, jobs) = (&parts.model, &mut parts.jobs);
    match (command, ComparedPair::of(&model.materials.all, &model.view)) {
        (WhyCommand::FindWorst, Some(pair)) => {
            jobs.why.search.start(&jobs.waker, &pair, model.settings.loss.seed);
        }
        (WhyCommand::CancelSearch, _) => jobs.why.search.cancel(),
        _ => {}
    }
}

fn apply_to_window(parts: &mut Parts, ctx: &egui::Context, command: WindowCommand) {
    let dialogs = &mut parts.ui.dialogs;
    let has_dataset = parts.model.dataset.open.is_some();
    match command {
        WindowCommand::ShowOpen(on) => dialogs.open = on.then(OpenDialog::default),
        WindowCommand::ShowSave(on) => {
            dialogs.save = on.then(|| SaveDialog::new(SaveKind::default(), has_dataset));
        }
        WindowCommand::SaveScenes => dialogs.save = Some(SaveDialog::new(SaveKind::Scenes, has_dataset)),
        WindowCommand::Browse(what) => {
            // Where what is open came from.
            let from = parts.model.files().next().and_then(Path::parent);
            parts.jobs.browsing = Some(browse::start(&parts.jobs.waker, what, from));
        }
        WindowCommand::Save(request) => saving::save_file(parts, ctx, request),
        WindowCommand::CancelSaving => parts.jobs.saving.iter().for_each(Job::cancel),
        WindowCommand::CopyPicture => saving::copy_picture(parts, ctx),
        WindowCommand::SetScale(scale) => ctx.set_zoom_factor(scale),
        _ => {}
    }
}

/// Renders and compares by the convention of a file.
fn read_convention(parts: &mut Parts, path: &Path) {
    match (ChosenConvention::read(&path.to_string_lossy()), &mut parts.ui.dialogs.open) {
        (Ok(convention), _) => {
            parts.ui.dialogs.open = None;
            parts.model.use_convention(convention);
        }
        (Err(error), Some(dialog)) => dialog.fail(error.to_string()),
        (Err(error), None) => parts.model.report([Message::Failed(error.into())]),
    }
}

/// Opens a session file, which stands alone.
fn read_session(parts: &mut Parts, paths: &[PathBuf]) {
    let session = match paths {
        [path] => Session::read(path),
        _ => {
            let problem = "expected a session file alone: it names its materials itself".to_owned();
            Err(FilesError::BadSession { path: paths[0].clone(), problem })
        }
    };
    match (session, &mut parts.ui.dialogs.open) {
        (Ok(session), _) => {
            parts.ui.dialogs.open = None;
            let request = parts.model.open_session(&session);
            parts.jobs.read(&parts.model, request);
            if let Some(of_session) = session.dataset.clone() {
                dataset::restore(parts, of_session, None);
            }
        }
        (Err(error), Some(dialog)) if !matches!(error, FilesError::Outside { .. }) => {
            dialog.fail(error.to_string())
        }
        (Err(error), _) => {
            // Asked in the window, where it can be allowed.
            parts.ui.dialogs.open = None;
            parts.model.report([Message::Failed(error.into())]);
        }
    }
}

/// Compares renderings with the photograph at `path`, or with the first of the list there, under its light and view.
fn open_photograph(parts: &mut Parts, path: PathBuf) {
    let capture = Capture::is_named(&path).then(|| Capture::read(&path)).transpose();
    match (capture, &mut parts.ui.dialogs.open) {
        (Ok(capture), _) => {
            parts.ui.dialogs.open = None;
            parts.model.open_photograph(path, capture);
        }
        (Err(error), Some(dialog)) => dialog.fail(error.to_string()),
        (Err(error), None) => parts.model.report([Message::Failed(error.into())]),
    }
}

fn save_assumptions(parts: &mut Parts, index: usize) {
    match parts.model.materials.save_assumptions(index) {
        Ok(Some(request)) => read(parts, request),
        Ok(None) => {}
        Err(error) => parts.model.report([Message::Failed(error)]),
    }
}

/// Puts a text on the clipboard, and reports it.
fn copy_text(parts: &mut Parts, ctx: &egui::Context, text: String, what: &'static str) {
    ctx.copy_text(text);
    parts.model.report([Message::Done(format!("Copied {what}"))]);
}
