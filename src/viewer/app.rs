//! The application: owns the model, polls the workers, draws the panels, carries out their commands.

use std::path::PathBuf;
use std::time::Instant;

use eframe::egui;

use super::animation::Animation;
use super::browse::Browsed;
use super::difference_run::DifferenceRun;
use super::error_map_run::ErrorMapRun;
use super::gpu_view::GpuView;
use super::history::History;
use super::inspect::{Inspect, RegionRun};
use super::loss_run::Asked;
use super::loss_run::LossRun;
use super::message::Message;
use super::message_list::MessageList;
use super::mixture::MixtureRun;
use super::options::ViewerOptions;
use super::panels::open::OpenWindow;
use super::panels::photograph_open::PhotographWindow;
use super::panels::save::SaveWindow;
use super::photograph::PhotographRun;
use super::scene_loss::SceneLossRun;
use super::settings::{self, Settings};
use super::slots::{Slot, Slots};
use super::state::ViewState;
use super::stop::Stop;
use super::study::StudyRun;
use super::training::Training;
use super::values_run::ValuesRun;
use super::viewport::Viewport;
use super::watch::Watch;
use super::why::Why;
use super::worker::Task;
use super::{sight, theme};
use crate::files::read::ReadOptions;
use crate::loss::FileScenes;

/// Width of a window, in points, below which the side panel is hidden until it is asked for.
const NARROW: f32 = 900.0;

/// The viewer. Only [`Command`](super::command::Command)s change it.
#[derive(Debug)]
pub struct App {
    pub state: ViewState,
    pub settings: Settings,
    /// The settings as last stored.
    stored: Settings,
    pub(super) slots: Slots,
    /// What the panes show: the materials, with a mixture in the place of the chosen prediction where one is shown.
    pub(super) seen: Vec<Slot>,
    pub(super) mixture: MixtureRun,
    pub(super) history: History,
    pub(super) loss: LossRun,
    /// The loss over the few scenes of the papers, beside a more accurate one.
    pub(super) few: LossRun,
    pub(super) scene_loss: SceneLossRun,
    pub(super) values: ValuesRun,
    pub(super) animation: Animation,
    /// Whether something was dragged since Space was pressed: then Space pans and does not pause.
    pub(super) space_dragged: bool,
    pub(super) study: StudyRun,
    pub(super) why: Why,
    pub(super) difference: DifferenceRun,
    pub(super) error_map: ErrorMapRun,
    pub(super) photograph: PhotographRun,
    pub(super) study_window: bool,
    pub(super) inspect: Inspect,
    pub(super) region: RegionRun,
    pub(super) gpu: Option<GpuView>,
    pub(super) viewport: Viewport,
    pub(super) watch: Watch,
    pub(super) training: Training,
    pub(super) browsing: Option<Task<Browsed>>,
    pub(super) saving: Option<Task<PathBuf>>,
    /// The scene file that is being read.
    pub(super) scene_file: Option<Task<FileScenes>>,
    pub(super) open_window: Option<OpenWindow>,
    pub(super) save_window: Option<SaveWindow>,
    pub(super) photograph_window: Option<PhotographWindow>,
    pub(super) help: bool,
    pub(super) swapped: bool,
    /// Whether the side panel is shown where the window is narrow.
    narrow_side_panel: bool,
    /// How the last materials were read: what the open dialog starts with.
    pub(super) read: ReadOptions,
    pub(super) messages: MessageList,
    pub(super) stop: Stop,
    /// Size of the panes and the legend, in pixels.
    pub(super) picture_size: [u32; 2],
    /// Share of the window between its bars that the drawer takes.
    pub(super) drawer_share: f32,
    /// The time of the last frame, in seconds.
    now: f64,
    pub(super) frame_ms: f32,
}

impl App {
    /// Starts to read the materials that `options` names, and returns before they have been read.
    pub fn new(cc: &eframe::CreationContext<'_>, options: ViewerOptions) -> Self {
        theme::install(&cc.egui_ctx);
        let settings: Settings =
            cc.storage.and_then(|s| eframe::get_value(s, settings::KEY)).unwrap_or_default();
        cc.egui_ctx.set_zoom_factor(settings.ui_scale);
        let mut messages = MessageList::default();
        let gpu = match cc.wgpu_render_state.as_ref().map(GpuView::new) {
            Some(Ok(gpu)) => Some(gpu),
            Some(Err(error)) => {
                messages.add(Message::Failed(error), 0.0);
                None
            }
            None => None,
        };
        gpu.iter().for_each(|gpu| theme::suit(&cc.egui_ctx, &gpu.gpu.report));
        let mut app = Self {
            state: ViewState::default(),
            stored: settings.clone(),
            settings,
            slots: Slots::default(),
            seen: Vec::new(),
            mixture: MixtureRun::default(),
            history: History::default(),
            loss: LossRun::default(),
            few: LossRun::default(),
            scene_loss: SceneLossRun::default(),
            values: ValuesRun::default(),
            animation: Animation::default(),
            space_dragged: false,
            study: StudyRun::default(),
            why: Why::default(),
            difference: DifferenceRun::default(),
            error_map: ErrorMapRun::default(),
            photograph: PhotographRun::default(),
            study_window: false,
            inspect: Inspect::default(),
            region: RegionRun::default(),
            gpu,
            viewport: Viewport::default(),
            watch: Watch::default(),
            training: Training::default(),
            browsing: None,
            saving: None,
            scene_file: None,
            open_window: None,
            save_window: None,
            photograph_window: None,
            help: false,
            swapped: false,
            narrow_side_panel: false,
            read: ReadOptions::AUTO,
            messages,
            stop: Stop::default(),
            picture_size: [1, 1],
            drawer_share: 0.0,
            now: 0.0,
            frame_ms: 0.0,
        };
        app.open_first(&cc.egui_ctx, options);
        app
    }

    /// Closes the window at a signal, and cancels what is being written.
    pub(super) fn stop_at_signals(&mut self, ctx: &egui::Context, stop: &Stop) {
        stop.listen(ctx);
        self.stop = stop.clone();
    }

    /// Whether the side panel is shown. Narrow windows have a choice of their own, which starts with no panel.
    pub(super) fn side_panel(&mut self, ctx: &egui::Context) -> &mut bool {
        if ctx.content_rect().width() < NARROW {
            &mut self.narrow_side_panel
        } else {
            &mut self.settings.side_panel
        }
    }

    /// What is asked of the loss: by the settings, in the convention that is rendered.
    pub(super) fn asked(&self) -> Asked {
        Asked { request: self.settings.loss.request(), convention: self.state.convention() }
    }

    /// Adds messages.
    pub(super) fn report(&mut self, messages: impl IntoIterator<Item = Message>) {
        let now = self.now;
        messages.into_iter().for_each(|message| self.messages.add(message, now));
    }

    /// Takes over the results of the workers.
    fn poll(&mut self, ctx: &egui::Context) {
        self.now = ctx.input(|i| i.time);
        if let Some(rest) = self.messages.expire(self.now) {
            ctx.request_repaint_after_secs(rest as f32);
        }
        self.slots.patient = self.settings.watch;
        self.poll_readings(ctx);
        let error = self.study.poll(ctx);
        self.report(error.map(Message::Failed));
        let fault = self.gpu.as_ref().and_then(|g| g.gpu.take_fault());
        self.report(fault.map(Message::Failed));
        self.poll_saving(ctx);
        self.poll_browsing(ctx);
        self.poll_scene_file(ctx);
        if self.settings.watch {
            self.follow_files(ctx);
        } else {
            self.watch.stop();
        }
        self.follow_training(ctx);
        // A loss of materials that are not all there yet would be computed in vain.
        let auto = self.settings.auto_loss && !self.slots.expects_more();
        self.loss.follow(ctx, &self.slots, &self.asked(), auto);
        self.loss.poll(ctx);
        self.follow_shown(ctx);
    }

    /// Pans back a material that would be lost from sight.
    fn keep_in_sight(&mut self) {
        if let Some(slot) = self.slots.ground_truth() {
            let grid = slot.loaded.material.grid();
            self.state.pan = sight::kept_pan(&self.state, grid, self.viewport.aspect());
        }
    }

    /// Stores changed settings at once: a program that is killed stores nothing at its end.
    fn store_settings(&mut self, ctx: &egui::Context, storage: Option<&mut (dyn eframe::Storage + 'static)>) {
        if self.settings == self.stored || ctx.input(|i| i.pointer.any_down()) {
            return;
        }
        self.stored = self.settings.clone();
        if let Some(storage) = storage {
            self.settings.store(storage);
            storage.flush();
        }
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
        let start = Instant::now();
        let ctx = ui.ctx().clone();
        theme::choose(&ctx, self.settings.dark);
        // Ctrl with plus, minus or 0 changes it, too.
        self.settings.ui_scale = ctx.zoom_factor();
        self.poll(&ctx);
        let mut commands = self.keys(&ctx);
        commands.extend(self.pause_key(&ctx));
        self.animation.follow(&ctx, &mut self.state.scene);
        commands.extend(self.dropped(&ctx));
        commands.extend(self.draw(ui));
        let changed = !commands.is_empty();
        for command in commands {
            self.apply(&ctx, command);
        }
        if changed {
            self.keep_in_sight();
            ctx.request_repaint();
        }
        self.remember_moment(&ctx);
        self.store_settings(&ctx, frame.storage_mut());
        self.frame_ms = start.elapsed().as_secs_f32() * 1e3;
    }

    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        visuals.panel_fill.to_normalized_gamma_f32()
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        self.remember_session();
        self.settings.store(storage);
    }

    fn on_exit(&mut self) {
        // A file that is being written is completed, or cancelled by the signal that closed the window.
        if let Some(saving) = self.saving.take() {
            let _ = saving.wait();
        }
    }
}
