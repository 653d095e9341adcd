//! The application: owns the model, polls the workers, draws the panels, carries out what they return.

use std::path::PathBuf;
use std::time::Instant;

use eframe::egui;
use eframe::egui::util::undoer::{self, Undoer};

use super::command::Command;
use super::gpu_view::GpuView;
use super::loaded::Rules;
use super::loss_run::Asked;
use super::loss_run::LossRun;
use super::panels::open::OpenWindow;
use super::panels::save::SaveWindow;
use super::settings::{self, Settings};
use super::slots::{Slots, Target};
use super::state::ViewState;
use super::study::StudyRun;
use super::viewport::Viewport;
use super::watch::Watch;
use super::worker::Job;
use super::{ViewerOptions, keys, theme};
use crate::files::read::ReadOptions;
use crate::loss::Loss;
use crate::material::Material;
use crate::study::Study;

/// The viewer. What it shows is public for tests; what changes it are [`Command`]s.
#[derive(Debug)]
pub struct App {
    pub state: ViewState,
    pub settings: Settings,
    /// The settings as they were stored last.
    kept: Settings,
    pub(super) slots: Slots,
    pub(super) undoer: Undoer<ViewState>,
    pub(super) loss: LossRun,
    pub(super) study: StudyRun,
    pub(super) study_window: bool,
    pub(super) gpu: Option<GpuView>,
    pub(super) viewport: Viewport,
    pub(super) watch: Watch,
    pub(super) browsing: Option<Job<Vec<PathBuf>>>,
    pub(super) saving: Option<Job<PathBuf>>,
    pub(super) open_window: Option<OpenWindow>,
    pub(super) save_window: Option<SaveWindow>,
    pub(super) help: bool,
    pub(super) swapped: bool,
    /// How materials were read that were opened last, which the open window offers again.
    pub(super) read: ReadOptions,
    /// What went wrong or was done, the latest last, until a person has read it.
    messages: Vec<String>,
    pub(super) frame_ms: f32,
}

impl App {
    /// Starts to read what `options` names; the window is there before it has been read.
    pub fn new(cc: &eframe::CreationContext<'_>, options: ViewerOptions) -> Self {
        theme::install(&cc.egui_ctx);
        let settings: Settings =
            cc.storage.and_then(|s| eframe::get_value(s, settings::KEY)).unwrap_or_default();
        let mut messages = Vec::new();
        let gpu = match cc.wgpu_render_state.as_ref().map(GpuView::new) {
            Some(Ok(gpu)) => Some(gpu),
            Some(Err(error)) => {
                messages.push(error.to_string());
                None
            }
            None => None,
        };
        let undo = undoer::Settings { stable_time: 0.4, ..Default::default() };
        let mut app = Self {
            state: ViewState::default(),
            kept: settings.clone(),
            settings,
            slots: Slots::default(),
            undoer: Undoer::with_settings(undo),
            loss: LossRun::default(),
            study: StudyRun::default(),
            study_window: false,
            gpu,
            viewport: Viewport::default(),
            watch: Watch::default(),
            browsing: None,
            saving: None,
            open_window: None,
            save_window: None,
            help: false,
            swapped: false,
            read: ReadOptions::AUTO,
            messages,
            frame_ms: 0.0,
        };
        app.open_first(&cc.egui_ctx, options);
        app
    }

    fn open_first(&mut self, ctx: &egui::Context, options: ViewerOptions) {
        let gpu = self.gpu.as_ref().map(|g| &g.gpu);
        self.slots.rules = Rules { strict: options.strict, fit: options.fit };
        let Some(ground_truth) = options.ground_truth else {
            return self.slots.open_built_in(ctx, gpu);
        };
        let predictions = options.predictions.into_iter().map(|p| (p, options.prediction_read));
        let sources: Vec<_> =
            std::iter::once((ground_truth, options.ground_truth_read)).chain(predictions).collect();
        self.slots.open(ctx, gpu, sources, Target::Everything);
    }

    /// What is asked of the loss: by the settings, in the convention that is rendered.
    pub(super) fn asked(&self) -> Asked {
        Asked { request: self.settings.loss.request(), convention: self.state.convention() }
    }

    /// The losses of the predictions, where they have been computed to the end for what is shown now.
    pub fn losses(&self) -> Option<&[Loss]> {
        self.loss.finished(&self.slots, &self.asked())
    }

    /// What has been measured of the chosen pair, and whether that is all.
    pub fn study(&self) -> Option<(&Study, bool)> {
        let (study, current) =
            self.study.shown(&self.slots, self.state.prediction, &self.state.convention())?;
        current.then_some((study, self.study.job().is_none()))
    }

    /// The names of the materials, the ground truth first.
    pub fn names(&self) -> Vec<String> {
        self.slots.slots.iter().map(|s| s.name().to_owned()).collect()
    }

    /// The materials in the window, the ground truth first.
    pub fn materials(&self) -> impl Iterator<Item = &Material<f32>> {
        self.slots.slots.iter().map(|slot| &slot.loaded.material)
    }

    /// Whether a material is being read.
    pub fn is_reading(&self) -> bool {
        !self.slots.openings.is_empty()
    }

    /// What the window tells the person: errors and what was done.
    pub fn messages(&self) -> &[String] {
        &self.messages
    }

    /// Tells the person something; what has been said before moves to the end.
    pub(super) fn say(&mut self, messages: impl IntoIterator<Item = String>) {
        for message in messages {
            self.messages.retain(|said| *said != message);
            self.messages.push(message);
        }
    }

    /// Takes what was said off the window.
    pub(super) fn dismiss(&mut self) {
        self.messages.clear();
    }

    /// Takes over what the workers have finished.
    fn poll(&mut self, ctx: &egui::Context) {
        let errors = self.slots.poll(ctx);
        self.say(errors);
        let opened = std::mem::take(&mut self.slots.opened);
        opened.iter().rev().for_each(|path| self.settings.remember(path));
        let error = self.study.poll(ctx);
        self.say(error);
        let fault = self.gpu.as_ref().and_then(|g| g.gpu.take_fault());
        self.say(fault.map(|error| error.to_string()));
        if let Some(result) = self.saving.as_ref().and_then(|job| job.poll(ctx)) {
            self.saving = None;
            self.say([match result {
                Ok(path) => format!("Saved {}", std::path::absolute(&path).unwrap_or(path).display()),
                Err(error) => error.to_string(),
            }]);
        }
        if let Some(result) = self.browsing.as_ref().and_then(|job| job.poll(ctx)) {
            self.browsing = None;
            let paths = result.unwrap_or_default();
            let window = self.open_window.get_or_insert_default();
            paths.iter().for_each(|path| window.add(&path.display().to_string()));
        }
        if self.settings.watch {
            let stale = self.watch.poll(ctx, &self.slots);
            let gpu = self.gpu.as_ref().map(|g| &g.gpu);
            self.slots.reload(ctx, gpu, Some(&stale));
        }
        self.loss.follow(ctx, &self.slots, &self.asked(), self.settings.auto_loss);
        self.loss.poll(ctx);
    }

    fn keys(&self, ctx: &egui::Context) -> Vec<Command> {
        let escape = match (self.help, &self.open_window, &self.save_window) {
            (true, _, _) => Command::SetHelp(false),
            (_, Some(_), _) => Command::ShowOpen(false),
            (_, _, Some(_)) => Command::ShowSave(false),
            _ if self.study_window => Command::ShowStudy(false),
            _ => Command::CancelLoss,
        };
        let now = keys::Context { enter_is_free: ctx.memory(|m| m.focused()).is_none(), escape: &escape };
        keys::commands(ctx, now)
    }

    /// Stores changed settings at once, not only at the end: programs are killed, too.
    fn keep_settings(&mut self, ctx: &egui::Context, storage: Option<&mut (dyn eframe::Storage + 'static)>) {
        if self.settings == self.kept || ctx.input(|i| i.pointer.any_down()) {
            return;
        }
        self.kept = self.settings.clone();
        if let Some(storage) = storage {
            eframe::set_value(storage, settings::KEY, &self.settings);
            storage.flush();
        }
    }

    /// Files that were dropped on the window.
    fn dropped(&self, ctx: &egui::Context) -> Option<Command> {
        let paths: Vec<PathBuf> =
            ctx.input(|i| i.raw.dropped_files.iter().map(|f| f.path().to_owned()).collect());
        let replace = self.slots.only_built_in();
        (!paths.is_empty()).then_some(Command::Open { paths, replace, read: ReadOptions::AUTO })
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
        let start = Instant::now();
        let ctx = ui.ctx().clone();
        theme::choose(&ctx, self.settings.dark);
        self.poll(&ctx);
        let mut commands = self.keys(&ctx);
        commands.extend(self.dropped(&ctx));
        commands.extend(self.show(ui));
        for command in commands {
            self.apply(&ctx, command);
            ctx.request_repaint();
        }
        self.undoer.feed_state(ctx.input(|i| i.time), &self.state);
        self.keep_settings(&ctx, frame.storage_mut());
        self.frame_ms = start.elapsed().as_secs_f32() * 1e3;
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        eframe::set_value(storage, settings::KEY, &self.settings);
    }
}
