//! Window of the system: opened with the adapter that the panes need, again after its device was lost, and closed with the error
//! of a panic.

use std::cell::RefCell;
use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Arc;
use std::time::{Duration, Instant};

use eframe::egui;
use eframe::egui_wgpu::{WgpuSetup, WgpuSetupCreateNew};

use svbrdf_core::error::Error as CoreError;
use svbrdf_gpu::Gpu;

use super::app::device_loss::{Adapters, DeviceLosses, given_up};
use super::app::{App, CrashGuard, NAME, Stop, Watch, display, outcome, stored_file};
use super::jobs::work::{panics, priority};
use super::model::message::Message;
use super::model::settings::options::ViewerOptions;
use crate::error::Error;

/// How long a driver has to recover before the next device is asked for.
const PAUSE_AFTER_LOSS: Duration = Duration::from_millis(300);

/// Opens the window and returns when it is closed.
///
/// # Errors
/// [`Error::NoWindow`] without a display or the libraries of the window system, [`CoreError::NoAdapter`] without a graphics
/// adapter that can draw into it, [`CoreError::Gpu`] where its devices are lost again and again, [`CoreError::Cancelled`] where a
/// signal closed it, an internal one after a panic.
pub fn run(options: ViewerOptions) -> Result<(), Error> {
    run_watched(options, |_, _| ())
}

/// [`run`], and calls `watch` in the middle of every frame, after its input and before it is drawn.
///
/// # Errors
/// As [`run`].
pub fn run_watched(
    options: ViewerOptions,
    watch: impl Fn(&egui::Context, &Gpu) + 'static,
) -> Result<(), Error> {
    // Panics become errors, which are printed at the end.
    panics::print(false);
    let stop = Stop::default();
    priority::yield_to_window();
    let result =
        Gpu::check_environment().map_err(Error::from).and_then(|()| windows(options, &stop, Rc::new(watch)));
    panics::print(true);
    result?;
    if stop.is_stopped() { Err(CoreError::Cancelled.into()) } else { Ok(()) }
}

/// The application, which outlives the window of a lost device.
#[derive(Clone)]
struct Surviving {
    app: Rc<RefCell<Option<App>>>,
    watch: Rc<Watch>,
}

/// The folder of the settings.
fn settings_folder() -> Option<PathBuf> {
    eframe::storage_dir(NAME)
}

/// Opens the window, and opens it again where its device was lost.
fn windows(options: ViewerOptions, stop: &Stop, watch: Rc<Watch>) -> Result<(), Error> {
    let damaged = settings_folder().map(|folder| stored_file::prepare(&folder)).transpose()?.flatten();
    let (app, crash) = (Surviving { app: Rc::default(), watch }, CrashGuard::default());
    let (mut losses, mut adapters) = (DeviceLosses::default(), Adapters::All);
    loop {
        // winit 0.30 panics where libxkbcommon or another library that it loads is missing.
        let result = panics::caught(|| Ok(open(&app, adapters, &options, damaged.as_ref(), stop, &crash)));
        let loss = app.app.borrow().as_ref().and_then(|app| app.loss().map(str::to_owned));
        let Some(loss) = loss.filter(|_| !stop.is_stopped()) else {
            let move_settings = || settings_folder().and_then(|folder| stored_file::move_aside(&folder));
            return outcome(&crash, result, move_settings);
        };
        // winit 0.30 creates one event loop in a process; a panic leaves it unusable.
        let next = result.ok().and_then(|_| losses.next(Instant::now()));
        adapters = next.ok_or_else(|| given_up(&loss))?;
        std::thread::sleep(PAUSE_AFTER_LOSS);
    }
}

/// Opens a window for `app`, which is created in the first one, and returns when it is closed.
fn open(
    app: &Surviving,
    adapters: Adapters,
    options: &ViewerOptions,
    damaged: Option<&PathBuf>,
    stop: &Stop,
    crash: &CrashGuard,
) -> Result<(), eframe::Error> {
    let create = |cc: &eframe::CreationContext<'_>| -> Box<dyn eframe::App> {
        let mut place = app.app.borrow_mut();
        match &mut *place {
            Some(app) => app.resume(cc),
            None => {
                let mut new = App::new(cc, options.clone());
                new.stop_at_signals(stop);
                new.guard(crash);
                new.parts.model.report(damaged.cloned().map(Message::SettingsDamaged));
                *place = Some(new);
            }
        }
        Box::new(app.clone())
    };
    eframe::run_native(NAME, native_options(adapters), Box::new(|cc| Ok(create(cc))))
}

impl Surviving {
    fn with(&self, work: impl FnOnce(&mut App)) {
        self.app.borrow_mut().iter_mut().next().map(work);
    }
}

impl eframe::App for Surviving {
    fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
        self.with(|app| app.draw(ui, frame, &*self.watch));
    }

    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        App::background(visuals)
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        self.with(|app| app.save(storage));
    }

    fn persist_egui_memory(&self) -> bool {
        // Its numbers decide the window, and no file of them can be checked.
        false
    }

    fn on_exit(&mut self) {
        self.with(eframe::App::on_exit);
    }
}

fn native_options(adapters: Adapters) -> eframe::NativeOptions {
    let mut setup = WgpuSetupCreateNew::without_display_handle();
    setup.native_adapter_selector = Some(match adapters {
        Adapters::All => Arc::new(Gpu::select_adapter),
        Adapters::Software => Arc::new(Gpu::select_software),
    });
    setup.device_descriptor = Arc::new(Gpu::device_descriptor);
    let mut options = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_title(NAME)
            .with_app_id(NAME)
            .with_icon(icon())
            // With its title bar it fits a screen of 1366 x 768.
            .with_inner_size([1340.0, 700.0])
            .with_min_inner_size([640.0, 420.0])
            .with_drag_and_drop(true),
        renderer: eframe::Renderer::Wgpu,
        // Colours are displayed as they are.
        dithering: false,
        ..Default::default()
    };
    options.wgpu_options.wgpu_setup = WgpuSetup::CreateNew(setup);
    display::choose(&mut options);
    options
}

fn icon() -> egui::IconData {
    // A window without an icon is a window.
    eframe::icon_data::from_png_bytes(svbrdf_assets::ICON).unwrap_or_default()
}
