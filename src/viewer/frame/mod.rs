//! Application: the frame of the window, which holds the model, the jobs and the user interface together.

pub mod actions;
pub mod blind;
pub mod content;
pub mod crash;
pub mod effects;
pub mod inspection;
pub mod keys;
pub mod layout;
pub mod light_and_view;
pub mod menu;
pub mod messages;
pub mod side;
pub mod status;
pub mod storage;
pub mod top;
pub mod written;

use std::time::Duration;

use eframe::egui;

use crate::dataset::{self, opening};
use crate::frame::crash::{DeviceLoss, lost, told};
use crate::frame::layout::Parts;
use crate::frame::storage::{NAME, SettingsStorage};
pub use crash::CrashGuard;

use crate::frame::layout::WindowUi;
use crate::jobs::answers::Answer;
use crate::jobs::answers::content::ComparedPair;
use crate::jobs::work::Waker;
use crate::jobs::{Jobs, SAVING, Shown};
use crate::message::Message;
use crate::model::Model;
use crate::model::session::ViewerOptions;
use crate::model::view::ViewState;
use crate::model::{display, undo};
use crate::pane::Displayed;
use crate::pane::gpu_view::GpuView;
use crate::pane::scenery::peeks;
use crate::why::scenes::FindWorst;
use crate::widgets::theme;

/// The viewer.
#[derive(Debug)]
pub struct App {
    pub parts: Parts,
    storage: SettingsStorage,
    crash: CrashGuard,
    /// The title that the window was given.
    title: String,
    /// Whether the scale of text and controls is to be chosen by the monitor: at the first start.
    unscaled: bool,
}

impl App {
    /// Starts to read the materials that `options` names, and returns before they have been read.
    pub fn new(cc: &eframe::CreationContext<'_>, options: ViewerOptions, storage: SettingsStorage) -> Self {
        theme::install(&cc.egui_ctx);
        let mut model = Model::default();
        storage.load(&mut model);
        cc.egui_ctx.set_zoom_factor(model.settings.ui_scale);
        let gpu = adapter(cc, &mut model);
        let woken = cc.egui_ctx.clone();
        let waker = Waker::new(move |after: Duration| woken.request_repaint_after(after));
        let jobs = Jobs::new(waker, gpu.as_ref().map(|gpu| gpu.gpu.clone()));
        let mut parts = Parts { model, jobs, ui: WindowUi::default(), gpu };
        parts.model.start(options);
        parts.model.report(crash::message().map(Message::Warning));
        effects::carry_out(&mut parts, &cc.egui_ctx);
        // Before the first frame, which takes longer than others.
        parts.begin_to_read();
        parts.jobs.answers.end_frame();
        let unscaled = storage.is_new();
        let (crash, title) = (CrashGuard::default(), String::new());
        Self { parts, storage, crash, title, unscaled }
    }

    /// Reports failures of the frames to this guard.
    #[must_use]
    pub fn guarded(mut self, crash: CrashGuard) -> Self {
        self.crash = crash;
        self
    }

    /// Whether a frame has panicked.
    pub fn has_crashed(&self) -> bool {
        self.crash.has_crashed()
    }

    /// Edits the model as a panel does.
    pub fn edit(&mut self, ctx: &egui::Context, edit: impl FnOnce(&mut Model)) {
        edit(&mut self.parts.model);
        effects::carry_out(&mut self.parts, ctx);
        ctx.request_repaint();
    }

    /// Takes over what edits have made of the view `before`, in the same frame: it is no step of its own to undo.
    fn settle(&mut self, ctx: &egui::Context, before: &ViewState) {
        effects::carry_out(&mut self.parts, ctx);
        if self.parts.model.view != *before {
            self.parts.model.keep_visible();
        }
        display::follow_exposure(&mut self.parts.model);
    }

    /// One frame: input, model, picture. What a gesture changes is in the frame that read it; what is edited in a panel is in the next
    /// one.
    fn frame(&mut self, ui: &mut egui::Ui) {
        let ctx = ui.ctx().clone();
        theme::choose(&ctx, self.parts.model.settings.dark);
        menu::suit(&ctx, &mut self.unscaled);
        self.parts.model.settings.ui_scale = ctx.zoom_factor();
        self.parts.model.time = ctx.input(|i| i.time);
        self.parts.model.geometry = self.parts.ui.geometry(&ctx);
        let errors = self.parts.jobs.answers.begin_frame();
        self.parts.model.report(errors.into_iter().map(Message::Failed));
        effects::take_results(&mut self.parts, &ctx);
        let before = self.parts.model.view.clone();
        self.parts.ui.input(&ctx, &mut self.parts.model, &self.parts.jobs);
        ctx.set_zoom_factor(self.parts.model.settings.ui_scale);
        self.settle(&ctx, &before);
        opening::show(&mut self.parts.model, &self.parts.jobs);
        display::follow_exposure(&mut self.parts.model);
        self.inspect();
        let Parts { model, jobs, ui: window, gpu } = &mut self.parts;
        let mut next = model.clone();
        let displayed = Displayed::ask(Shown { model, jobs }).peeking(peeks(&ctx));
        search(&ctx, displayed.shown(), &mut next);
        window.draw(ui, &displayed, &mut next, gpu.as_mut());
        let photograph = displayed.open_photograph.as_ref();
        let is_photograph_settled = photograph.is_none_or(|one| one.photograph.is_some());
        if photograph.is_some_and(|one| one.has_failed) {
            next.photograph.set(None);
            ctx.request_repaint();
        }
        self.name_window(&ctx);
        let before = std::mem::replace(&mut self.parts.model, next).view;
        self.settle(&ctx, &before);
        self.parts.begin_to_read();
        self.parts.jobs.answers.end_frame();
        undo::remember(&mut self.parts.model, is_photograph_settled);
    }

    /// Gives the window the name of what is open.
    fn name_window(&mut self, ctx: &egui::Context) {
        let Parts { model, jobs, .. } = &self.parts;
        let open = || dataset::title(Shown { model, jobs }).or_else(|| model.materials.title());
        let open = if model.blind.is_some() { Some("Compare blind".to_owned()) } else { open() };
        let title = open.map_or_else(|| NAME.to_owned(), |open| format!("{open} - {NAME}"));
        // Assistive software asks the root for the name of the window.
        ctx.accesskit_node_builder(egui::accesskit_root_id(), |root| root.set_label(title.as_str()));
        if title != self.title {
            ctx.send_viewport_cmd(egui::ViewportCommand::Title(title.clone()));
            self.title = title;
        }
    }

    /// Takes over the inspected texels of a session once its materials are there.
    fn inspect(&mut self) {
        let model = &mut self.parts.model;
        if model.materials.openings.is_empty()
            && let Some(inspection) = model.inspected_later.take()
        {
            model.inspection = inspection;
        }
        if let Some(ground_truth) = model.materials.ground_truth() {
            model.inspection.keep_within(ground_truth.material().size());
        }
    }

    /// Why the device of the window was lost, where it was.
    fn loss(&self) -> Option<String> {
        self.parts.gpu.as_ref().and_then(|gpu| gpu.gpu.loss()).map(told)
    }
}

impl eframe::App for App {
    /// The frame of a window, which closes where the device is lost or the frame panics.
    fn ui(&mut self, ui: &mut egui::Ui, _: &mut eframe::Frame) {
        let crash = self.crash.clone();
        let is_drawn = self.loss().is_none() && crash.frame(|| self.frame(ui));
        if let Some(reason) = self.loss() {
            crash.fail(lost(&reason));
            // egui-wgpu 0.37 would panic.
            ui.ctx().graphics_mut(|graphics| *graphics = Default::default());
        }
        if crash.has_crashed() || crash.is_stopped() {
            ui.ctx().send_viewport_cmd(egui::ViewportCommand::Close);
        } else if is_drawn && !ui.input(|i| i.pointer.any_down()) {
            self.storage.store(&self.parts.model);
        }
    }

    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        visuals.panel_fill.to_normalized_gamma_f32()
    }

    fn on_exit(&mut self) {
        if self.crash.has_crashed() {
            return;
        }
        self.parts.model.remember_session();
        self.parts.model.settings.window = Some(self.parts.model.geometry.window);
        self.storage.store(&self.parts.model);
        // A file that is being written is completed, unless a signal ends the program.
        if let Some(saving) = self.parts.jobs.edits.remove(SAVING) {
            if self.crash.is_stopped() {
                saving.cancel();
            }
            let _ = saving.wait();
        }
    }
}

/// The window library drops the application where it panics over the lost device, too.
impl Drop for App {
    fn drop(&mut self) {
        if let Some(reason) = self.parts.gpu.as_ref().and_then(|gpu| gpu.gpu.loss_by_now()).map(told) {
            let model = &self.parts.model;
            let is_read = model.materials.openings.is_empty();
            let results = model.dataset.open.as_ref().and_then(|open| open.results.clone());
            self.crash.lose(DeviceLoss { reason, session: is_read.then(|| model.session()), results });
        }
    }
}

/// Searches for the worst scene, whatever the panels show, and shows it once it is found.
fn search(ctx: &egui::Context, Shown { model, jobs }: Shown<'_>, next: &mut Model) {
    let Some(searched) = model.searched else { return };
    let is_chosen = model.chosen_prediction().is_some_and(|chosen| chosen.id() == searched);
    let pair = ComparedPair::of(&model.materials.all, &model.view).filter(|_| is_chosen);
    let found = pair.map(|pair| jobs.answers.get(&FindWorst { pair, seed: model.settings.loss.seed }));
    if let Some(Answer::Running(..)) = found {
        return;
    }
    next.searched = None;
    if let Some(Answer::Ready(worst)) = found {
        display::choose_scene(next, worst.scene);
    }
    ctx.request_repaint();
}

/// The adapter of a window, and its limits for the user interface; a message where its driver fails.
fn adapter(cc: &eframe::CreationContext<'_>, model: &mut Model) -> Option<GpuView> {
    let gpu = match GpuView::new(cc.wgpu_render_state.as_ref()?) {
        Ok(gpu) => gpu,
        Err(error) => {
            model.report([Message::Failed(error.into())]);
            return None;
        }
    };
    theme::suit(&cc.egui_ctx, &gpu.gpu.report);
    let context = cc.egui_ctx.clone();
    gpu.gpu.at_loss(move || context.request_repaint());
    Some(gpu)
}
