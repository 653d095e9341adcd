//! The window without a window: egui_kittest drives it by accessible labels, on a real adapter.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]
#![allow(clippy::disallowed_methods, reason = "a test reads its own files")]

mod assumptions;
mod bar;
mod blind;
mod damaged;
mod dataset;
mod differences;
mod fields;
mod files;
mod gestures;
mod hands;
mod key_presses;
mod loss_panel;
mod mask;
mod materials;
mod observed;
mod order;
mod photograph;
mod quantities;
mod reading;
mod saving;
mod scene_files;
mod screenshots;
mod seen;
mod sizes;
mod snapshots;
mod soak;
mod stillness;
mod texels;
mod view;
mod why;

#[path = "../support/gpu.rs"]
#[allow(dead_code, reason = "the tests of the core use the rest")]
mod gpu;
#[path = "../support/npy.rs"]
mod npy;
#[path = "../support/surroundings.rs"]
mod surroundings;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use eframe::egui::accesskit::Role;
use eframe::egui::{self, Modifiers, Pos2, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use hands::*;
use materials::{loss_in, losses, losses_in, materials, strip, strips, write_packed};
use observed::Observed as _;
use rand::rngs::ChaCha8Rng;
use rand::{Rng as _, SeedableRng as _};
use seen::*;
use serde_json::json;
use soak::below;
use svbrdf_core::loss::{Comparison, Request};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::colour_map::difference_to_display;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::picture::statistics::Statistics;
use svbrdf_core::progress::Progress;
use svbrdf_core::render::render_f32;
use svbrdf_files::convention::ChosenConvention;
use svbrdf_files::read::ReadOptions;
use svbrdf_files::session::Session;
use svbrdf_files::session::window::Framing;
use svbrdf_needs::needs;
use svbrdf_viewer::ViewerOptions;
use svbrdf_viewer::frame::actions;
use svbrdf_viewer::frame::storage::SettingsStorage;
use svbrdf_viewer::frame::{App, CrashGuard};
use svbrdf_viewer::model::Effect;
use svbrdf_viewer::model::dialogs::{SaveKind, SaveRequest};
use svbrdf_viewer::model::endpoint;
use svbrdf_viewer::model::inspection::{Inspection, Region};
use svbrdf_viewer::model::settings::Tab;
use svbrdf_viewer::model::view::{AutoExposure, Layout, Projection, ViewState};
use svbrdf_viewer::model::{Model, display, opening, undo as history};

type Window<'a> = Harness<'a, App>;

/// The window on the given materials (none: the built-in pair), once they have been read.
fn window<'a>(options: ViewerOptions) -> Window<'a> {
    scaled_window(options, 1.0)
}

/// The window on a screen with this many pixels per point.
fn scaled_window<'a>(options: ViewerOptions, scale: f32) -> Window<'a> {
    guarded_window(options, CrashGuard::default(), scale)
}

/// The window that reports its end to this guard.
fn guarded_window<'a>(options: ViewerOptions, guard: CrashGuard, scale: f32) -> Window<'a> {
    gpu::gpu();
    let mut window = Harness::builder()
        .with_size(vec2(1200.0, 800.0))
        .with_pixels_per_point(scale)
        .with_max_steps(16)
        .with_step_dt(1.0 / 30.0)
        .wgpu()
        .build_eframe(|cc| App::new(cc, options, SettingsStorage::default()).guarded(guard));
    window.set_render_cursor(false);
    // Otherwise a pane tells what a drag does.
    window.state_mut().parts.model.settings.has_dragged = true;
    wait(&mut window, "the materials to be read", |app| {
        !app.is_reading() && (!app.names().is_empty() || !app.messages().is_empty())
    });
    window
}

/// Runs frames until `done`, or fails after a generous while.
fn wait(window: &mut Window<'_>, what: &str, done: impl Fn(&App) -> bool) {
    wait_in(window, what, |window| done(window.state()));
}

/// Runs frames until something that contains `text` is there.
fn see(window: &mut Window<'_>, text: &str) {
    wait_in(window, text, |window| window.query_all_by_label_contains(text).next().is_some());
}

fn wait_in(window: &mut Window<'_>, what: &str, done: impl Fn(&Window<'_>) -> bool) {
    for _ in 0..6000 {
        window.step();
        if done(window) {
            window.run_steps(3);
            return;
        }
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    panic!("waited in vain for {what}");
}

/// Frames with time between them, in which work goes on behind the window.
fn rest(window: &mut Window<'_>, frames: usize) {
    for _ in 0..frames {
        window.step();
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
}

fn edit(window: &mut Window<'_>, edit: impl FnOnce(&mut Model)) {
    let ctx = window.ctx.clone();
    window.state_mut().edit(&ctx, edit);
    window.run_steps(2);
}

fn built_in<'a>() -> Window<'a> {
    window(ViewerOptions::default())
}

/// The built-in pair with the differences of its predictions.
fn with_differences<'a>() -> Window<'a> {
    let mut window = built_in();
    press(&mut window, egui::Key::D);
    statistics(&mut window);
    window
}

/// The window on the materials of these files, the ground truth first.
fn on_files<'a>(paths: impl IntoIterator<Item = PathBuf>) -> Window<'a> {
    window(options_of(paths))
}

fn options_of(paths: impl IntoIterator<Item = PathBuf>) -> ViewerOptions {
    let mut paths = paths.into_iter();
    ViewerOptions {
        ground_truth: paths.next().map(Into::into),
        predictions: paths.map(Into::into).collect(),
        ..ViewerOptions::default()
    }
}

/// The built-in pair, with the loss over the 6 + 3 scenes of the papers.
fn by_scenes<'a>() -> Window<'a> {
    let mut window = built_in();
    click(&mut window, "Scenes");
    window
}

const GROUND_TRUTH: &str = "GROUND TRUTH  worn tiles";
const PREDICTIONS: [&str; 2] = ["1  blurred normals", "2  wrong roughness"];

/// Saves, and dismisses the message that says so.
fn save(window: &mut Window<'_>, kind: SaveKind, path: &Path) {
    let message = format!("Saved {}", path.display());
    edit(window, |model| model.effects.push(Effect::Save(SaveRequest { kind, path: path.to_owned() })));
    wait(window, "the file", |app| !app.messages().is_empty());
    assert_eq!(window.messages(), [message]);
    edit(window, |model| model.messages.dismiss_all());
}

/// Opens files in the place of those of before.
fn open(window: &mut Window<'_>, paths: impl Into<Vec<PathBuf>>) {
    let paths = paths.into();
    edit(window, |model| opening::open(model, paths, true, ReadOptions::AUTO));
}

/// The window on a saved session.
fn on_session<'a>(path: &Path) -> Window<'a> {
    let session = Some(Session::read(path).unwrap());
    window(ViewerOptions { session, ..ViewerOptions::default() })
}

/// Chooses a difference of the quantity.
fn choose_difference(model: &mut Model, kind: Difference) {
    let display = &mut model.view.display;
    display.differences.choose(display.quantity, kind);
}

/// Sets the difference that has the last colour.
fn set_range(model: &mut Model, range: Option<f64>) {
    let display = &mut model.view.display;
    display.differences.set_range(display.quantity, range);
}
