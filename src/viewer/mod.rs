//! The window: ground truth and predictions side by side under a light and a view that a person drags.
//!
//! Panels and keys return `command::Command`s; `app::App` carries them out; slow work runs in `worker::Task`s.

mod animation;
#[cfg(not(feature = "testing"))]
pub(crate) mod app;
#[cfg(feature = "testing")]
pub mod app;
mod apply;
mod assumed;
mod background;
mod browse;
mod cells;
#[cfg(not(feature = "testing"))]
pub(crate) mod command;
#[cfg(feature = "testing")]
pub mod command;
mod follow;
mod follow_training;
mod gestures;
mod gpu_view;
mod handles;
mod history;
mod hovered;
mod inspect;
#[cfg(not(feature = "testing"))]
pub(crate) mod keys;
#[cfg(feature = "testing")]
pub mod keys;
mod latest;
mod loaded;
mod loss_run;
mod marks;
#[cfg(not(feature = "testing"))]
pub(crate) mod message;
#[cfg(feature = "testing")]
pub mod message;
mod message_list;
mod mixture;
mod names;
#[cfg(feature = "testing")]
mod observe;
mod opening;
mod options;
mod pace;
mod pane_texels;
mod pane_text;
mod panel_texture;
mod panels;
mod panes;
mod pasted;
mod photograph;
mod photograph_command;
mod polling;

mod difference_run;
mod draw;
mod endpoint;
mod error_map_run;
mod readout;
mod save;
#[cfg(not(feature = "testing"))]
pub(crate) mod save_kind;
#[cfg(feature = "testing")]
pub mod save_kind;
mod scene_loss;
mod session;
mod settings;
mod shaded;
mod shown_difference;
mod sight;
mod slot;
mod slots;
mod snapshot;
#[cfg(not(feature = "testing"))]
pub(crate) mod source;
#[cfg(feature = "testing")]
pub mod source;
#[cfg(not(feature = "testing"))]
pub(crate) mod state;
#[cfg(feature = "testing")]
pub mod state;
mod stop;
mod study;
mod theme;
mod title;
mod training;
mod uploaded;
mod values_run;
mod viewport;
mod visible;
mod watch;
mod why;
mod work_context;
#[cfg(not(feature = "testing"))]
pub(crate) mod worker;
#[cfg(feature = "testing")]
pub mod worker;

use std::panic::AssertUnwindSafe;
use std::sync::{Arc, Mutex, PoisonError};

use eframe::egui;
use eframe::egui_wgpu::{WgpuError, WgpuSetup, WgpuSetupCreateNew};

use crate::error::Error;
use crate::gpu::Gpu;

pub use options::ViewerOptions;

/// Opens the window and returns when it is closed.
///
/// # Errors
/// [`Error::NoWindow`] without a display or the libraries of the window system, [`Error::NoAdapter`] without a
/// graphics adapter that can draw into it, [`Error::Cancelled`] where a signal closed it.
pub fn run(options: ViewerOptions) -> Result<(), Error> {
    // The window system's layer panics where a library of it is missing; its words are kept for the error.
    let panic_text = Arc::new(Mutex::new(String::new()));
    let earlier_hook = std::panic::take_hook();
    let heard = panic_text.clone();
    std::panic::set_hook(Box::new(move |info| {
        *heard.lock().unwrap_or_else(PoisonError::into_inner) = info.to_string();
    }));
    let stop = stop::Stop::default();
    let signals = stop.clone();
    background::yield_to_window();
    let start = || {
        let create = |cc: &eframe::CreationContext<'_>| {
            let mut app = app::App::new(cc, options);
            app.stop_at_signals(&cc.egui_ctx, &signals);
            app
        };
        eframe::run_native("svbrdf", native_options(), Box::new(|cc| Ok(Box::new(create(cc)))))
    };
    let result = std::panic::catch_unwind(AssertUnwindSafe(start));
    std::panic::set_hook(earlier_hook);
    match result {
        Ok(Ok(())) if stop.is_stopped() => Err(Error::Cancelled),
        Ok(result) => result.map_err(|e| no_window(&e)),
        Err(_) => Err(Error::NoWindow {
            problem: format!(
                "the window system failed: {}",
                panic_text.lock().unwrap_or_else(PoisonError::into_inner)
            ),
            remedy: "install libxkbcommon0 and libxkbcommon-x11-0, then try again",
        }),
    }
}

fn native_options() -> eframe::NativeOptions {
    let mut setup = WgpuSetupCreateNew::without_display_handle();
    setup.native_adapter_selector = Some(Arc::new(Gpu::select_adapter));
    setup.device_descriptor = Arc::new(Gpu::device_descriptor);
    let mut options = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_title("svbrdf")
            .with_app_id("svbrdf")
            .with_inner_size([1360.0, 860.0])
            .with_min_inner_size([640.0, 420.0])
            .with_drag_and_drop(true),
        renderer: eframe::Renderer::Wgpu,
        // Colours are shown as they are.
        dithering: false,
        ..Default::default()
    };
    options.wgpu_options.wgpu_setup = WgpuSetup::CreateNew(setup);
    options
}

fn no_window(error: &eframe::Error) -> Error {
    match error {
        eframe::Error::Wgpu(WgpuError::CreateSurfaceError(_) | WgpuError::RequestAdapterError(_)) => {
            Error::NoAdapter {
                problem: "no driver for Vulkan or OpenGL was found".to_owned(),
                remedy: "install one, for example the software driver in Debian's mesa-vulkan-drivers",
            }
        }
        eframe::Error::Winit(_) | eframe::Error::WinitEventLoop(_) => Error::NoWindow {
            problem: "there is no display".to_owned(),
            remedy: "set DISPLAY or WAYLAND_DISPLAY, or start a virtual one with xvfb-run",
        },
        other => Error::NoWindow {
            problem: other.to_string(),
            remedy: "check the graphics driver and the display",
        },
    }
}
