//! Window of the system: opened with the adapter that the panes need, and closed with the error of a panic or of a lost device.

use std::sync::Arc;
use std::thread;
use std::time::Duration;

use eframe::egui;
use eframe::egui_wgpu::{WgpuSetup, WgpuSetupCreateNew};

use svbrdf_core::error::Error as CoreError;
use svbrdf_files::disk::signals;
use svbrdf_gpu::{Gpu, choice};

use crate::error::Error;
use crate::frame::crash;
use crate::frame::storage::{self, NAME, SettingsStorage};
use crate::frame::{App, CrashGuard};
use crate::jobs::work::threads;
use crate::model::session::ViewerOptions;

/// Size of the first window, in points: with its title bar it fits a screen of 1366 x 768. Least and greatest size of a window.
const FIRST: [f32; 2] = [1340.0, 700.0];
const LEAST: [f32; 2] = [640.0, 420.0];
const MOST: f32 = 16_384.0;

/// The exit code after a signal, as of the command line.
const INTERRUPTED: i32 = 130;
/// How long a window may take to close after one.
const PATIENCE: Duration = Duration::from_secs(10);

/// Opens the window and returns when it is closed.
///
/// # Errors
/// [`Error::NoWindow`] without a display or the libraries of the window system,
/// [`NoAdapter`](svbrdf_core::error::Error::NoAdapter) without a graphics adapter that can draw into it,
/// [`Gpu`](svbrdf_core::error::Error::Gpu) where its device was lost, an internal one after a panic.
pub fn run(options: ViewerOptions) -> Result<(), Error> {
    // Panics become errors, which are printed at the end.
    threads::print_panics(false);
    threads::yield_to_window();
    let result = Gpu::check_environment().map_err(Error::from).and_then(|()| open(options));
    threads::print_panics(true);
    result
}

fn open(options: ViewerOptions) -> Result<(), Error> {
    let (storage, guard) = (SettingsStorage::read(storage::folder()), CrashGuard::default());
    let settings = storage.settings();
    settings.and_then(|last| last.adapter.clone()).into_iter().for_each(choice::prefer);
    let (native, of_app) = (native_options(settings.and_then(|last| last.window)), guard.clone());
    let create = move |cc: &eframe::CreationContext<'_>| {
        stop_at_signals(&of_app, &cc.egui_ctx);
        App::new(cc, options, storage).guarded(of_app)
    };
    let run = || eframe::run_native(NAME, native, Box::new(|cc| Ok(Box::new(create(cc)))));
    let result = threads::caught(|| Ok(run()));
    if matches!(result, Ok(Err(eframe::Error::Wgpu(_)))) {
        crash::with_another_interface();
    }
    if guard.is_stopped() {
        return Err(CoreError::Cancelled.into());
    }
    if let Some(loss) = guard.loss() {
        crash::after_loss(&loss)?;
    }
    guard.outcome(result)
}

/// Closes the window at a signal that ends the program, or ends it where the system asks a hidden window for no frame. A second signal ends
/// it at once.
fn stop_at_signals(guard: &CrashGuard, ctx: &egui::Context) {
    let (guard, ctx) = (guard.clone(), ctx.clone());
    signals::on_end(move || {
        if !guard.stop() {
            std::process::exit(INTERRUPTED);
        }
        ctx.request_repaint();
        thread::spawn(|| {
            thread::sleep(PATIENCE);
            std::process::exit(INTERRUPTED);
        });
    });
}

fn native_options(size: Option<[f32; 2]>) -> eframe::NativeOptions {
    let mut setup = WgpuSetupCreateNew::without_display_handle();
    setup.native_adapter_selector = Some(Arc::new(Gpu::select_adapter));
    setup.device_descriptor = Arc::new(Gpu::device_descriptor);
    let usable = |size: &[f32; 2]| (0..2).all(|axis| (LEAST[axis]..=MOST).contains(&size[axis]));
    let mut options = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_title(NAME)
            .with_app_id(NAME)
            .with_icon(icon())
            .with_inner_size(size.filter(usable).unwrap_or(FIRST))
            .with_min_inner_size(LEAST)
            .with_drag_and_drop(true),
        renderer: eframe::Renderer::Wgpu,
        // Colours are displayed as they are.
        dithering: false,
        ..Default::default()
    };
    options.wgpu_options.wgpu_setup = WgpuSetup::CreateNew(setup);
    options
}

fn icon() -> egui::IconData {
    // A window without an icon is a window.
    eframe::icon_data::from_png_bytes(svbrdf_assets::ICON).unwrap_or_default()
}
