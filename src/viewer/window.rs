//! Window of the system: opened with the adapter that the panes need, and closed with the error of a panic.

use std::sync::Arc;

use eframe::egui;
use eframe::egui_wgpu::{WgpuSetup, WgpuSetupCreateNew};

use svbrdf_core::error::Error;
use svbrdf_gpu::Gpu;

use super::app::{App, CrashGuard, Stop, outcome};
use super::jobs::work::{panics, priority};
use super::model::settings::options::ViewerOptions;

/// Opens the window and returns when it is closed.
///
/// # Errors
/// [`Error::NoWindow`] without a display or the libraries of the window system, [`Error::NoAdapter`] without a
/// graphics adapter that can draw into it, [`Error::Cancelled`] where a signal closed it, [`Error::Internal`] after a panic.
pub fn run(options: ViewerOptions) -> Result<(), Error> {
    // Panics become errors, which are printed at the end.
    panics::print(false);
    let (stop, crash) = (Stop::default(), CrashGuard::default());
    let (signals, guard) = (stop.clone(), crash.clone());
    priority::yield_to_window();
    let create = move |cc: &eframe::CreationContext<'_>| {
        let mut app = App::new(cc, options);
        app.stop_at_signals(&cc.egui_ctx, &signals);
        app.guard(&guard);
        app
    };
    // The window system's layer panics where a library of it is missing.
    let result = panics::caught(|| {
        Ok(eframe::run_native("svbrdf", native_options(), Box::new(|cc| Ok(Box::new(create(cc))))))
    });
    panics::print(true);
    outcome(&crash, result)?;
    if stop.is_stopped() { Err(Error::Cancelled) } else { Ok(()) }
}

fn native_options() -> eframe::NativeOptions {
    let mut setup = WgpuSetupCreateNew::without_display_handle();
    setup.native_adapter_selector = Some(Arc::new(Gpu::select_adapter));
    setup.device_descriptor = Arc::new(Gpu::device_descriptor);
    let mut options = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_title("svbrdf")
            .with_app_id("svbrdf")
            .with_icon(icon())
            .with_inner_size([1360.0, 860.0])
            .with_min_inner_size([640.0, 420.0])
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
    eframe::icon_data::from_png_bytes(include_bytes!("../../packaging/icons/64.png")).unwrap_or_default()
}
